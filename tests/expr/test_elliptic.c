/* test_elliptic.c -- Legendre's elliptic integrals: special values, derivatives, doubles against balls. */
#include "expr/kit.h"

#include "expr/constant.h"
#include "expr/elliptic-ball.h"
#include "expr/elliptic.h"
#include "expr/jacobi.h"
#include "expr/pool.h"

static const struct {
    qdot_fun_id f;
    uint32_t n;
} kinds[] = {{QDOT_ELLIPTIC_K, 1},  {QDOT_ELLIPTIC_E, 1},  {QDOT_ELLIPTIC_E, 2},
             {QDOT_ELLIPTIC_F, 2},  {QDOT_ELLIPTIC_PI, 2}, {QDOT_ELLIPTIC_PI, 3},
             {QDOT_JACOBI_AM, 2},  {QDOT_JACOBI_DN, 2}};
enum { KINDS = sizeof kinds / sizeof *kinds, BITS = 256 };

/* f at x [n] in double. */
static double
double_at(qdot_fun_id f, uint32_t n, const double *x)
{
    return f >= QDOT_JACOBI_AM ? qdot_jacobi_double(f, x) : qdot_elliptic_double(f, n, x);
}

/* f at x [n] eighths, args[i] moved by h; NAN where it is not defined. */
static long double
value_at(qdot_fun_id f, uint32_t n, const int64_t *x, uint32_t i, double h)
{
    arb_t arg[3], y;
    const arb_struct *at[3];
    long double value = NAN;

    arb_init(y);
    for (uint32_t k = 0; k < 3; k++) {
        arb_init(arg[k]);
        at[k] = arg[k];
        if (k >= n)
            continue;
        arb_set_si(arg[k], (slong)x[k]);
        arb_mul_2exp_si(arg[k], arg[k], -3);
        if (k == i) {
            arb_set_d(y, h);
            arb_add(arg[k], arg[k], y, BITS);
        }
    }
    qdot_elliptic_ball(y, f, n, at, BITS);
    if (arb_is_finite(y))
        value = (long double)arf_get_d(arb_midref(y), ARF_RND_NEAR);
    for (uint32_t k = 0; k < 3; k++)
        arb_clear(arg[k]);
    arb_clear(y);
    return value;
}

/* Random arguments in eighths: angles and parameters of both signs. */
static void
choose_arguments(int64_t *x)
{
    for (int k = 0; k < 3; k++)
        x[k] = (int64_t)random_below(160) - 100;
}

static void
doubles_agree_with_balls(void **state)
{
    int compared = 0, undefined = 0;

    (void)state;
    for (int trial = 0; trial < 6000; trial++) {
        const int k = trial % KINDS;
        int64_t x[3];
        double d[3], seen;
        long double wanted;

        choose_arguments(x);
        for (int i = 0; i < 3; i++)
            d[i] = (double)x[i] / 8;
        wanted = value_at(kinds[k].f, kinds[k].n, x, 3, 0);
        seen = double_at(kinds[k].f, kinds[k].n, d);
        undefined += isnan(wanted);
        if (isnan(wanted) != isnan(seen))
            fail_msg("%s(%g, %g, %g): %Lg and %g", qdot_fun_name(kinds[k].f), d[0], d[1], d[2], wanted, seen);
        if (isnan(wanted))
            continue;
        compared++;
        if (fabsl(seen - wanted) > 4e-14L * fmaxl(1, fabsl(wanted)))
            fail_msg("%s(%g, %g, %g): %.17Lg and %.17g", qdot_fun_name(kinds[k].f), d[0], d[1], d[2], wanted, seen);
    }
    assert_true(compared > 2000 && undefined > 500);
}

static void
derivatives_are_limits_of_differences(void **state)
{
    int compared = 0;

    (void)state;
    for (int trial = 0; trial < 3000; trial++) {
        const int k = trial % KINDS;
        const uint32_t n = kinds[k].n, i = (uint32_t)random_below(n);
        const double h = 1e-5;
        qdot_expr args[3];
        qdot_expr derivative;
        long double far, near_;
        double d[3], seen;
        int64_t x[3];

        choose_arguments(x);
        for (uint32_t j = 0; j < 3; j++) {
            d[j] = (double)x[j] / 8;
            args[j] = qdot_expr_ratio(p.pool, x[j], 8);
        }
        far = (value_at(kinds[k].f, n, x, i, 2 * h) - value_at(kinds[k].f, n, x, i, -2 * h)) / (4 * (long double)h);
        near_ = (value_at(kinds[k].f, n, x, i, h) - value_at(kinds[k].f, n, x, i, -h)) / (2 * (long double)h);
        if (isnan(far) || isnan(near_))
            continue;
        near_ = (4 * near_ - far) / 3;
        derivative = qdot_fun_derivative(p.pool, kinds[k].f, n, args, i);
        if (qdot_pool_check(p.pool) != QDOT_OK || qdot_constant_double(p.pool, derivative, &seen) != QDOT_OK)
            continue; /* at m = 0, n = m, n = 0 or 1 the formula is 0/0 */
        compared++;
        if (fabsl(seen - near_) > 1e-6L * fmaxl(1, fabsl(near_)))
            fail_msg("%s(%g, %g, %g) by %u: %Lg and %g", qdot_fun_name(kinds[k].f), d[0], d[1], d[2], i, near_, seen);
    }
    assert_true(compared > 500);
}

static void
special_values_are_found(void **state)
{
    const qdot_expr half = times(QDOT_HALF, QDOT_PI), m = qdot_symbol_get(p.pool, QDOT_PARAM, "m"),
                    phi = qdot_symbol_get(p.pool, QDOT_PARAM, "phi"), c = qdot_symbol_get(p.pool, QDOT_PARAM, "c");

    (void)state;
    assert_int_equal(qdot_fun1(p.pool, QDOT_ELLIPTIC_K, QDOT_ZERO), half);
    assert_int_equal(qdot_fun1(p.pool, QDOT_ELLIPTIC_E, QDOT_ZERO), half);
    assert_int_equal(qdot_fun1(p.pool, QDOT_ELLIPTIC_E, QDOT_ONE), QDOT_ONE);
    refuses(qdot_fun1(p.pool, QDOT_ELLIPTIC_K, QDOT_ONE), QDOT_EDOMAIN);
    refuses(qdot_fun1(p.pool, QDOT_ELLIPTIC_E, number(9, 8)), QDOT_EDOMAIN);
    assert_int_equal(qdot_fun(p.pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){phi, QDOT_ZERO}), phi);
    assert_int_equal(qdot_fun(p.pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){half, m}), qdot_fun1(p.pool, QDOT_ELLIPTIC_K, m));
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){times(number(-5, 1), half), m}), "-5*elliptic_K(m)");
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_E, 2, (qdot_expr[]){qdot_neg(p.pool, phi), m}), "-elliptic_E(phi, m)");
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_E, 2, (qdot_expr[]){times(number(17, 6), QDOT_PI), QDOT_ONE}), "11/2");
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_E, 2, (qdot_expr[]){times(number(-2, 3), QDOT_PI), QDOT_ONE}),
                  "1/2*sqrt(3) - 2");
    /* where the root ends, m sin(phi)^2 = 1 */
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){times(number(-1, 6), QDOT_PI), number(4, 1)}),
                  "-1/2*elliptic_K(1/4)");
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_E, 2, (qdot_expr[]){times(number(1, 3), QDOT_PI), number(4, 3)}),
                  "2/3*sqrt(3)*(elliptic_E(3/4) - 1/4*elliptic_K(3/4))");
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){times(number(2, 3), QDOT_PI), number(4, 3)}),
                  "elliptic_F(2/3*pi, 4/3)");
    assert_int_equal(qdot_fun(p.pool, QDOT_ELLIPTIC_PI, 2, (qdot_expr[]){QDOT_ZERO, m}),
                     qdot_fun1(p.pool, QDOT_ELLIPTIC_K, m));
    assert_int_equal(qdot_fun(p.pool, QDOT_ELLIPTIC_PI, 3, (qdot_expr[]){c, QDOT_PI, m}),
                     times(number(2, 1), qdot_fun(p.pool, QDOT_ELLIPTIC_PI, 2, (qdot_expr[]){c, m})));
}

static void
jacobi_has_special_values(void **state)
{
    const qdot_expr m = qdot_symbol_get(p.pool, QDOT_PARAM, "m"), u = qdot_symbol_get(p.pool, QDOT_PARAM, "u");
    const qdot_expr K = qdot_fun1(p.pool, QDOT_ELLIPTIC_K, m), four = number(4, 1);
    const qdot_fun_id am = QDOT_JACOBI_AM, sn = QDOT_JACOBI_SN, cn = QDOT_JACOBI_CN, dn = QDOT_JACOBI_DN;

    (void)state;
#define OF(f, a, b) qdot_fun(p.pool, f, 2, (qdot_expr[]){a, b})
    assert_int_equal(OF(sn, u, m), qdot_fun1(p.pool, QDOT_SIN, OF(am, u, m)));
    assert_prints(p.pool, OF(sn, u, m), "jacobi_sn(u, m)");
    assert_prints(p.pool, qdot_pow_int(p.pool, OF(cn, qdot_neg(p.pool, u), m), 2), "jacobi_cn(u, m)^2");
    assert_int_equal(OF(am, u, QDOT_ZERO), u);
    assert_int_equal(OF(sn, u, QDOT_ONE), qdot_fun1(p.pool, QDOT_TANH, u));
    assert_int_equal(OF(dn, u, QDOT_ZERO), QDOT_ONE);
    assert_prints(p.pool, OF(cn, u, QDOT_ONE), "1/cosh(u)");
    assert_prints(p.pool, OF(sn, u, four), "1/2*jacobi_sn(2*u, 1/4)");
    assert_prints(p.pool, OF(cn, u, four), "jacobi_dn(2*u, 1/4)");
    assert_prints(p.pool, OF(dn, u, four), "jacobi_cn(2*u, 1/4)");
    refuses(OF(am, u, four), QDOT_EDOMAIN);
    assert_prints(p.pool, OF(am, times(number(3, 1), K), m), "3/2*pi");
    assert_prints(p.pool, OF(dn, K, m), "sqrt(1 - m)");
    assert_int_equal(OF(am, OF(QDOT_ELLIPTIC_F, u, m), m), u);
    assert_int_equal(OF(QDOT_ELLIPTIC_F, OF(am, u, m), m), u);
#undef OF
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        MOVED_TEST(doubles_agree_with_balls),
        MOVED_TEST(derivatives_are_limits_of_differences),
        MOVED_TEST(special_values_are_found),
        MOVED_TEST(jacobi_has_special_values),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
