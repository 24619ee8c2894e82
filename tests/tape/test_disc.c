/* test_disc.c -- tapes over discs: each operation at random places of random discs, and what an
 * expression does not leave. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <complex.h>
#undef I
#include <math.h>
#include <stdlib.h>

#include "tape/disc.h"
#include "tape/lone.h"

typedef double complex number;

#ifndef CMPLX /* glibc has it for gcc alone */
#define CMPLX(re, im) __builtin_complex((double)(re), (double)(im))
#endif

/* --- operations over complex numbers ------------------------------------------------- */

static number
plane_atan2(number y, number x)
{
    const number i = CMPLX(0, 1);

    return (clog(x + i * y) - clog(x - i * y)) / (2 * i);
}

/* What operation.def has a complex meaning for; NULL: real places only. */
/* erf(x + iy) - erf x = 2i/sqrt(pi) e^(-x^2) int_0^y e^(t^2 - 2ixt) dt, by Simpson's rule */
static number
beside_the_line(number z)
{
    const double x = creal(z), y = cimag(z);
    const int n = 400;
    number sum = 0;

    for (int k = 0; k <= n; k++) {
        const double t = y * k / n;

        sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * cexp(CMPLX(t * t - x * x, -2 * x * t));
    }
    return CMPLX(0, M_2_SQRTPI * y / (3 * n)) * sum;
}

#define UNARY(ID, value)                                                                 \
    static number plane_##ID(number a, number b, number c)                               \
    {                                                                                    \
        (void)b, (void)c;                                                                \
        return value;                                                                    \
    }
UNARY(NEG, -a)
UNARY(ADD, a + b)
UNARY(SUB, a - b)
UNARY(MUL, a *b)
UNARY(DIV, a / b)
UNARY(MADD, a *b + c)
UNARY(MSUB, a *b - c)
UNARY(NMADD, c - a * b)
UNARY(SQRT, csqrt(a))
UNARY(POW, cpow(a, b))
UNARY(SINCOS, csin(a))
UNARY(SIN, csin(a))
UNARY(COS, ccos(a))
UNARY(ASIN, casin(a))
UNARY(ACOS, cacos(a))
UNARY(ATAN, catan(a))
UNARY(ATAN2, plane_atan2(a, b))
UNARY(SINH, csinh(a))
UNARY(COSH, ccosh(a))
UNARY(TANH, ctanh(a))
UNARY(ASINH, casinh(a))
UNARY(ACOSH, cacosh(a))
UNARY(ATANH, catanh(a))
UNARY(EXP, cexp(a))
UNARY(LOG, clog(a))
UNARY(ERF, erf(creal(a)) + beside_the_line(a))
UNARY(ERFC, erfc(creal(a)) - beside_the_line(a))
UNARY(SOFTPLUS, creal(a) > 0 ? a + clog(1 + cexp(-a)) : clog(1 + cexp(a)))

typedef number plane(number a, number b, number c);

static plane *const planes[QDOT_OP_COUNT] = {
#define ROW(ID) [QDOT_OP_##ID] = plane_##ID
    ROW(NEG),  ROW(ADD),   ROW(SUB),   ROW(MUL),    ROW(DIV),   ROW(MADD),  ROW(MSUB),
    ROW(NMADD), ROW(SQRT), ROW(POW),   ROW(SINCOS), ROW(SIN),   ROW(COS),   ROW(ASIN),
    ROW(ACOS), ROW(ATAN),  ROW(ATAN2), ROW(SINH),   ROW(COSH),  ROW(TANH),  ROW(ASINH),
    ROW(ACOSH), ROW(ATANH), ROW(EXP),  ROW(LOG),
    ROW(ERF), ROW(ERFC), ROW(SOFTPLUS),
#undef ROW
};

/* Places on the rim of the discs, where an analytic function goes farthest. */
static void
stays_inside(const char *name, plane *f, const double *c, const double *r, double C, double R)
{
    for (int k = 0; k < 12; k++) {
        number z[3];
        double far;

        for (int i = 0; i < 3; i++)
            z[i] = c[i] + r[i] * cexp(CMPLX(0, 6.2831853 * (k % 4 == 0 ? k / 12.0 : unit())));
        far = cabs(f(z[0], z[1], z[2]) - C);
        if (f == plane_ATAN2) /* whichever branches the logarithms are on */
            far = fmin(far, fmin(cabs(f(z[0], z[1], z[2]) - C - M_PI),
                                 cabs(f(z[0], z[1], z[2]) - C + M_PI)));
        if (!(far <= R * (1 + 1e-9) + 1e-12 * fabs(C)))
            fail_msg("%s: %g beyond %g; about %g %g %g, radii %g %g %g", name, far, R, c[0],
                     c[1], c[2], r[0], r[1], r[2]);
    }
}

static void
stays_inside_on_the_line(const qdot_tape *tape, const char *name, const double *c,
                         const double *r, double C, double R)
{
    double work[16], out[2], in[3];

    assert_true(qdot_tape_work(tape) <= 16);
    for (int k = 0; k < 12; k++) {
        for (int i = 0; i < 3; i++)
            in[i] = c[i] + r[i] * (2 * unit() - 1);
        qdot_tape_eval(tape, in, out, work);
        if (!(fabs(out[0] - C) <= R * (1 + 1e-9) + 1e-12 * fabs(C)))
            fail_msg("%s: %g beyond %g; about %g %g, radii %g %g", name, out[0], R, c[0], c[1],
                     r[0], r[1]);
    }
}

static void
no_operation_leaves_its_disc(void **state)
{
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    srand(7);
    for (int op = 0; op < QDOT_OP_COUNT; op++) {
        qdot_tape *tape = lone(pool, op, false);
        double *work = malloc(qdot_disc_work(tape) * sizeof *work);
        int bounded = 0;

        for (int k = 0; k < 4000; k++) {
            double c[3], r[3], C[2], R[2];

            for (int i = 0; i < 3; i++) {
                c[i] = 6 * unit() - 3;
                r[i] = 2 * pow(unit(), 4);
            }
            if (k % 3 == 0)
                r[1] = 0;
            if (k % 6 == 0)
                c[1] = floor(c[1]);
            if (op == QDOT_OP_AND || op == QDOT_OP_OR || op == QDOT_OP_NOT ||
                op == QDOT_OP_SELECT) {
                c[0] = k % 2;
                r[0] = 0;
            }
            qdot_disc_eval(tape, c, r, C, R, work);
            if (!(R[0] < INFINITY))
                continue;
            bounded++;
            if (planes[op])
                stays_inside(qdot_operations[op].name, planes[op], c, r, C[0], R[0]);
            stays_inside_on_the_line(tape, qdot_operations[op].name, c, r, C[0], R[0]);
            if (op == QDOT_OP_SINCOS)
                stays_inside("cos", plane_COS, c, r, C[1], R[1]);
        }
        if (bounded < 20)
            fail_msg("%s: only %d of 4000 discs have a bound", qdot_operations[op].name,
                     bounded);
        free(work);
        qdot_tape_free(tape);
    }
    qdot_pool_free(pool);
}

static double
radius_of(qdot_op op, double a, double ra, double b, double rb)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_tape *tape = lone(pool, op, false);
    double *work = malloc(qdot_disc_work(tape) * sizeof *work);
    const double c[3] = {a, b, 0}, r[3] = {ra, rb, 0};
    double C[2], R[2];

    qdot_disc_eval(tape, c, r, C, R, work);
    free(work);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
    return R[0];
}

static void
what_is_singular_has_no_radius(void **state)
{
    (void)state;
    assert_true(isnan(radius_of(QDOT_OP_DIV, 1, 0, 0.5, 0.5)));
    assert_true(isnan(radius_of(QDOT_OP_SQRT, 1, 1.5, 0, 0)));
    assert_true(isnan(radius_of(QDOT_OP_ABS, 0.1, 0.2, 0, 0)));
    assert_true(isnan(radius_of(QDOT_OP_LT, 0.1, 0.2, 0.2, 0)));
    assert_true(isnan(radius_of(QDOT_OP_FLOOR, 1.9, 0.2, 0, 0)));
    assert_true(isnan(radius_of(QDOT_OP_ATAN2, 0.1, 0.2, -1, 0)));
    assert_true(isnan(radius_of(QDOT_OP_TANH, 0.1, 1.6, 0, 0)));
    assert_true(radius_of(QDOT_OP_TANH, 50, 20, 0, 0) < 1e-15);
    assert_true(radius_of(QDOT_OP_EXP, -9e6, 1e6, 0, 0) == 0);
    assert_true(isinf(radius_of(QDOT_OP_EXP, 9e6, 1e6, 0, 0)));
    assert_true(isinf(radius_of(QDOT_OP_MUL, 2, 0, 0, INFINITY)));
    assert_true(radius_of(QDOT_OP_MUL, 0, 0, 3, INFINITY) == 0);
    assert_true(radius_of(QDOT_OP_SIGN, 0, 0, 0, 0) == 0); /* a number */
}

/* Whether the operation reaches farther than `most`. */
static bool
reaches(const qdot_tape *tape, qdot_disc_hiding by, const double *c, const double *r, double most)
{
    double *work = malloc(qdot_disc_work(tape) * sizeof *work);
    size_t last = 9;
    const size_t found = qdot_disc_hiders(tape, by, c, r, most, &last, work);

    free(work);
    assert_true(found == 0 || (found == 1 && last == 0));
    return found == 1;
}

static void
tells_how_far_arguments_of_exponentials_go(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_tape *wave = lone(pool, QDOT_OP_SIN, false), *fall = lone(pool, QDOT_OP_EXP, false);
    qdot_tape *power = lone(pool, QDOT_OP_POW, false), *quotient = lone(pool, QDOT_OP_DIV, false);
    qdot_tape *step = lone(pool, QDOT_OP_TANH, false);
    const double c[3] = {2, -50, 0}, r[3] = {0.1, 0, 0}, far[3] = {0, 25, 0};
    const double below[3] = {-1000}, wide[3] = {984};
    const qdot_disc_hiding by = QDOT_HIDES_EXPONENTIALS;

    (void)state;
    assert_false(qdot_disc_may_hide(wave, QDOT_HIDES_QUOTIENTS));
    assert_true(qdot_disc_may_hide(fall, QDOT_HIDES_EXPONENTIALS));
    assert_false(reaches(wave, by, c, r, 0));
    assert_false(reaches(fall, by, c, r, 0.1));
    assert_true(reaches(fall, by, c, r, 0.0999));
    assert_false(reaches(power, by, c, r, 2.5 + 1e-9));
    assert_true(reaches(power, by, c, r, 2.5 - 1e-9));
    assert_false(qdot_disc_may_hide(quotient, QDOT_HIDES_EXPONENTIALS));
    assert_true(qdot_disc_may_hide(quotient, QDOT_HIDES_QUOTIENTS));
    assert_false(reaches(quotient, QDOT_HIDES_QUOTIENTS, c, far, M_LN2 + 1e-9));
    assert_true(reaches(quotient, QDOT_HIDES_QUOTIENTS, c, far, M_LN2 - 1e-9));
    assert_false(reaches(step, by, below, wide, 4)); /* -1984 ... -16, of which 4 count */
    assert_true(reaches(step, by, below, wide, 3.9));
    qdot_tape_free(wave);
    qdot_tape_free(fall);
    qdot_tape_free(power);
    qdot_tape_free(quotient);
    qdot_tape_free(step);
    qdot_pool_free(pool);
}

/* Forms of f = tanh(a), by two other inputs b, c; whether they are plain for b in 1.5 ... 2.5, c about 0. */
static void
knows_plain_sums_and_multiples(void **state)
{
    const struct {
        qdot_op op;
        int x, y, z; /* -1: f */
        bool plain;
    } forms[] = {{QDOT_OP_NEG, -1, 0, 0, true},   {QDOT_OP_ADD, 2, -1, 0, true},
                 {QDOT_OP_SUB, -1, -1, 0, true}, /* no f at all */
                 {QDOT_OP_MUL, -1, 1, 0, true},   {QDOT_OP_MUL, -1, 2, 0, false},
                 {QDOT_OP_MUL, -1, -1, 0, false}, {QDOT_OP_DIV, -1, 1, 0, true},
                 {QDOT_OP_DIV, 1, -1, 0, false},  {QDOT_OP_MADD, 1, -1, 2, true},
                 {QDOT_OP_NMADD, 1, 1, -1, true}, {QDOT_OP_NMADD, 2, -1, -1, true},
                 {QDOT_OP_MSUB, 2, -1, 2, false}, {QDOT_OP_EXP, -1, 0, 0, false}};
    const double c[3] = {0, 2, 0}, r[3] = {50, 0.5, 0.1};
    double work[64];

    (void)state;
    for (size_t k = 0; k < sizeof forms / sizeof forms[0]; k++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_tape *tape;
        qdot_code code;
        qdot_value f, v, from[3];
        double most, result;

        qdot_code_init(&code, pool, 3);
        f = qdot_code_op(&code, QDOT_OP_TANH, 0, 0, 0);
        for (int j = 0; j < 3; j++) {
            const int at = j == 0 ? forms[k].x : j == 1 ? forms[k].y : forms[k].z;

            from[j] = at < 0 ? f : (qdot_value)at;
        }
        v = qdot_code_op(&code, forms[k].op, from[0], from[1], from[2]);
        assert_int_equal(qdot_code_finish(&code, 1, &v, &tape), QDOT_OK);
        assert_true(qdot_disc_work(tape) <= 64);
        if (qdot_disc_is_plain(tape, 0, c, r, &most, work) != forms[k].plain)
            fail_msg("form %zu", k);
        assert_true(qdot_disc_argument(tape, 0, c, &result, work) == c[0]);
        assert_true(result == tanh(c[0]));
        qdot_code_clear(&code);
        qdot_tape_free(tape);
        qdot_pool_free(pool);
    }
}

/* c = a b - a once read, and what is not. */
static void
knows_what_is_read(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_code code;
    qdot_value v;
    qdot_tape *tape;
    bool used[4];

    (void)state;
    qdot_code_init(&code, pool, 4);
    v = qdot_code_op(&code, QDOT_OP_MUL, 0, 2, 0);
    v = qdot_code_op(&code, QDOT_OP_SQRT, v, 0, 0);
    assert_int_equal(qdot_code_finish(&code, 1, &v, &tape), QDOT_OK);
    assert_int_equal(qdot_disc_reads(tape, used), QDOT_OK);
    assert_true(used[0] && !used[1] && used[2] && !used[3]);
    qdot_code_clear(&code);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_operation_leaves_its_disc),
        cmocka_unit_test(what_is_singular_has_no_radius),
        cmocka_unit_test(tells_how_far_arguments_of_exponentials_go),
        cmocka_unit_test(knows_plain_sums_and_multiples),
        cmocka_unit_test(knows_what_is_read),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
