/* test_two.c -- sums of two doubles against MPFR. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>

#include <mpfr.h>

#include "num/two.h"

enum { BITS = 300, TRIES = 4000 };

static uint64_t seed;

/* In [0, 1). */
static double
chance(void)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(seed >> 11) * 0x1p-53;
}

/* From -most to most, of all sizes down to 2^-20 of it. */
static qdot_two
any(double most)
{
    const double hi = most * (2 * chance() - 1) * exp2(-20 * chance());

    return qdot_two_of(hi, hi * 0x1p-53 * (2 * chance() - 1));
}

static void
set(mpfr_ptr x, qdot_two a)
{
    mpfr_set_d(x, a.hi, MPFR_RNDN);
    mpfr_add_d(x, x, a.lo, MPFR_RNDN);
}

/* |a - x| <= 2^-bits max(|x|, least), and the form. */
static void
is_near(qdot_two a, mpfr_srcptr x, double bits, double least, const char *what, double at)
{
    double error;
    mpfr_t d;

    mpfr_init2(d, BITS);
    set(d, a);
    mpfr_sub(d, d, x, MPFR_RNDN);
    error = fabs(mpfr_get_d(d, MPFR_RNDN)) / fmax(least, fabs(mpfr_get_d(x, MPFR_RNDN)));
    mpfr_clear(d);
    if (!(error <= exp2(-bits)))
        fail_msg("%s at %.17g: 2^%.1f", what, at, log2(error));
    assert_true(a.hi + a.lo == a.hi);
}

static void
operations(void **state)
{
    mpfr_t x, y, z;

    (void)state;
    mpfr_inits2(BITS, x, y, z, (mpfr_ptr)0);
    for (int i = 0; i < TRIES; i++) {
        const qdot_two a = any(10), b = any(10);
        const double size = fabs(a.hi) + fabs(b.hi);

        set(x, a);
        set(y, b);
        mpfr_add(z, x, y, MPFR_RNDN);
        is_near(qdot_two_add(a, b), z, 103, size, "add", a.hi);
        mpfr_sub(z, x, y, MPFR_RNDN);
        is_near(qdot_two_sub(a, b), z, 103, size, "sub", a.hi);
        mpfr_mul(z, x, y, MPFR_RNDN);
        is_near(qdot_two_mul(a, b), z, 101, 0, "mul", a.hi);
        mpfr_div(z, x, y, MPFR_RNDN);
        is_near(qdot_two_div(a, b), z, 100, 0, "div", a.hi);
        mpfr_add_d(z, x, b.hi, MPFR_RNDN);
        is_near(qdot_two_add_double(a, b.hi), z, 103, size, "add_double", a.hi);
        mpfr_mul_d(z, x, b.hi, MPFR_RNDN);
        is_near(qdot_two_mul_double(a, b.hi), z, 101, 0, "mul_double", a.hi);
        mpfr_div_d(z, x, b.hi, MPFR_RNDN);
        is_near(qdot_two_div_double(a, b.hi), z, 101, 0, "div_double", a.hi);
        mpfr_abs(x, x, MPFR_RNDN);
        mpfr_sqrt(z, x, MPFR_RNDN);
        is_near(qdot_two_sqrt(a.hi < 0 ? qdot_two_neg(a) : a), z, 101, 0, "sqrt", a.hi);
    }
    mpfr_clears(x, y, z, (mpfr_ptr)0);
}

static void
a_sum_of_products(void **state)
{
    mpfr_t sum, x, y;

    (void)state;
    mpfr_inits2(BITS, sum, x, y, (mpfr_ptr)0);
    for (int tries = 0; tries < 200; tries++) {
        qdot_two_dot dot = {0};
        double size = 0;

        mpfr_set_zero(sum, 1);
        for (int i = 0; i < 12; i++) {
            const qdot_two a = any(10), b = any(10);

            qdot_two_dot_add(&dot, a, b);
            set(x, a);
            set(y, b);
            mpfr_mul(x, x, y, MPFR_RNDN);
            mpfr_add(sum, sum, x, MPFR_RNDN);
            size += fabs(a.hi * b.hi);
        }
        is_near(qdot_two_dot_value(dot), sum, 99, size, "dot", size);
    }
    mpfr_clears(sum, x, y, (mpfr_ptr)0);
}


/* One argument, `x` its exact value. */
#define TRY(function, reference, low, high, small)                                       \
    for (int i = 0; i < TRIES; i++) {                                                    \
        const double hi = (low) + ((high) - (low)) * chance();                           \
        const qdot_two a = qdot_two_of(hi, hi * 0x1p-53 * (2 * chance() - 1));           \
                                                                                         \
        set(x, a);                                                                       \
        reference(y, x, MPFR_RNDN);                                                      \
        is_near(f->function(a), y, 68, small, #function, a.hi);                          \
    }

static void
functions_of(const qdot_two_functions *f)
{
    mpfr_t x, y, z;

    mpfr_inits2(BITS, x, y, z, (mpfr_ptr)0);
    TRY(exp, mpfr_exp, -600, 600, 0)
    TRY(exp, mpfr_exp, -1, 1, 0)
    TRY(log, mpfr_log, 1e-3, 3, 0.1)
    TRY(log, mpfr_log, 3, 1e12, 0)
    TRY(tanh, mpfr_tanh, -1e-3, 1e-3, 0)
    TRY(tanh, mpfr_tanh, -60, 60, 0)
    TRY(asin, mpfr_asin, -1, 1, 0)
    TRY(acos, mpfr_acos, -1, 0.999, 0)
    TRY(atan, mpfr_atan, -1e-3, 1e-3, 0)
    TRY(atan, mpfr_atan, -50, 50, 0)
    TRY(asinh, mpfr_asinh, -1e-3, 1e-3, 0)
    TRY(asinh, mpfr_asinh, -1e6, 1e6, 0)
    TRY(acosh, mpfr_acosh, 1.001, 50, 0)
    TRY(atanh, mpfr_atanh, -0.999, 0.999, 0)
    TRY(erf, mpfr_erf, -1e-3, 1e-3, 0)
    TRY(erf, mpfr_erf, -8, 8, 0)
    TRY(erfc, mpfr_erfc, -8, 2, 0)
    TRY(erfc, mpfr_erfc, 0.5, 5, 0)
    for (int i = 0; i < 4 * TRIES; i++) {
        const qdot_two a = any(i % 4 == 0 ? 1e9 : i % 4 == 1 ? 700 : i % 4 == 2 ? 7 : 1e-3);
        qdot_two s, c;

        set(x, a);
        f->sincos(a, &s, &c);
        mpfr_sin_cos(y, z, x, MPFR_RNDN);
        is_near(s, y, 68, fabs(a.hi) * 1e-9, "sin", a.hi);
        is_near(c, z, 68, fabs(a.hi) * 1e-9, "cos", a.hi);
        if (fabs(a.hi) > 600)
            continue;
        f->sinhcosh(a, &s, &c);
        mpfr_sinh_cosh(y, z, x, MPFR_RNDN);
        is_near(s, y, 68, 0, "sinh", a.hi);
        is_near(c, z, 68, 0, "cosh", a.hi);
    }
    for (int i = 0; i < TRIES; i++) {
        const qdot_two a = any(8), b = any(8);

        set(x, a);
        set(y, b);
        mpfr_atan2(z, x, y, MPFR_RNDN);
        is_near(f->atan2(a, b), z, 68, 0, "atan2", a.hi);
        mpfr_abs(x, x, MPFR_RNDN);
        mpfr_pow(z, x, y, MPFR_RNDN);
        is_near(f->pow(a.hi < 0 ? qdot_two_neg(a) : a, b), z, 68, 0, "pow", a.hi);
    }
    mpfr_clears(x, y, z, (mpfr_ptr)0);
}

static void
functions(void **state)
{
    size_t kinds = 0;

    (void)state;
    for (const qdot_two_functions *f; (f = qdot_two_functions_at(kinds)); kinds++)
        functions_of(f);
    assert_true(kinds > 0);
}

static void
special_values(void **state)
{
    const qdot_two_functions *f = qdot_two_functions_get();
    qdot_two s, c;

    (void)state;
    f->sincos((qdot_two){0, 0}, &s, &c);
    assert_true(s.hi == 0 && s.lo == 0 && c.hi == 1 && c.lo == 0);
    assert_true(f->atan2((qdot_two){0, 0}, (qdot_two){-1, 0}).hi > 3);
    assert_true(f->pow((qdot_two){-2, 0}, (qdot_two){3, 0}).hi == -8);
    assert_true(f->pow((qdot_two){0, 0}, (qdot_two){3, 0}).hi == 0);
    assert_true(isnan(f->log((qdot_two){-1, 0}).hi));
    assert_true(isnan(f->acos((qdot_two){1.5, 0}).hi));
    assert_true(f->asin((qdot_two){1, 0}).hi == acos(0));
    assert_true(f->acosh((qdot_two){1, 0}).hi == 0);
    assert_true(f->exp((qdot_two){-2000, 0}).hi == 0);
    assert_true(qdot_two_sqrt((qdot_two){0, 0}).hi == 0);
    f->sincos((qdot_two){INFINITY, 0}, &s, &c);
    assert_true(isnan(s.hi) && isnan(c.hi));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations),
        cmocka_unit_test(a_sum_of_products),
        cmocka_unit_test(functions),
        cmocka_unit_test(special_values),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
