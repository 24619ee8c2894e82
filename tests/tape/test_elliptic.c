/* test_elliptic.c -- elliptic functions on tapes: values and slopes against those of expressions at the same place. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/pool.h"
#include "expr/symbol.h"
#include "tape/derivative.h"
#include "tape/random.h"
#include "tape/tape.h"

static const struct {
    qdot_fun_id f;
    uint32_t n;
} kinds[] = {{QDOT_ELLIPTIC_K, 1},  {QDOT_ELLIPTIC_E, 1}, {QDOT_ELLIPTIC_E, 2}, {QDOT_ELLIPTIC_F, 2},
             {QDOT_ELLIPTIC_PI, 2}, {QDOT_JACOBI_AM, 2},  {QDOT_JACOBI_SN, 2},  {QDOT_JACOBI_CN, 2},
             {QDOT_JACOBI_DN, 2}};
enum { KINDS = sizeof kinds / sizeof *kinds, TRIALS = 1800 };

/* f of x [n] with its slope by x[i] (i = n: none): of the tape, the arguments being inputs. */
static double
on_tape(qdot_pool *pool, int k, const double *x, uint32_t i, double *slope)
{
    const uint32_t n = kinds[k].n;
    const qdot_expr in[2] = {coordinate(pool, "a", 1), coordinate(pool, "a", 2)};
    const qdot_expr e = qdot_fun(pool, kinds[k].f, n, in);
    double value = NAN, J[2] = {NAN, NAN}, *work;
    qdot_tape *tape;

    assert_int_equal(qdot_tape_new(pool, n, in, 1, &e, &tape), QDOT_OK);
    work = malloc((qdot_derivative_work(tape) + 1) * sizeof *work);
    qdot_derivative_eval(tape, x, 0, n, &value, J, work);
    *slope = J[i];
    assert_int_equal(qdot_tape_check_digits(tape), QDOT_ENOTBUILT);
    free(work);
    qdot_tape_free(tape);
    return value;
}

/* The number of an expression; NAN where there is none. */
static double
exactly(qdot_pool *pool, qdot_expr e)
{
    double value = NAN;

    return qdot_pool_check(pool) == QDOT_OK && qdot_constant_double(pool, e, &value) == QDOT_OK ? value : NAN;
}

static void
values_and_slopes_agree(void **state)
{
    int compared = 0, slopes = 0;

    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        qdot_pool *pool = qdot_pool_new();
        const int k = trial % KINDS;
        const uint32_t n = kinds[k].n, i = roll(n);
        qdot_expr args[2];
        double x[2], slope, seen, wanted;

        for (uint32_t j = 0; j < 2; j++) {
            const int64_t eighths = (int64_t)roll(160) - 100; /* the last one, m, and n of Pi: up to 1 */

            args[j] = qdot_expr_ratio(pool, j + 1 == n || kinds[k].f == QDOT_ELLIPTIC_PI ? 8 - llabs(eighths) : eighths, 8);
            assert_int_equal(qdot_constant_double(pool, args[j], x + j), QDOT_OK);
        }
        seen = on_tape(pool, k, x, i, &slope);
        wanted = exactly(pool, qdot_fun(pool, kinds[k].f, n, args));
        if (isfinite(wanted) && x[n - 1] != 1) {
            compared++;
            if (!(fabs(seen - wanted) <= 1e-13 * fmax(1, fabs(wanted))))
                fail_msg("%s(%g, %g): %.17g, on a tape %.17g", qdot_fun_name(kinds[k].f), x[0], x[1], wanted, seen);
        }
        wanted = qdot_pool_check(pool) == QDOT_OK ? exactly(pool, qdot_fun_derivative(pool, kinds[k].f, n, args, i)) : NAN;
        if (isfinite(wanted) && x[n - 1] != 1) {
            slopes++;
            if (!(fabs(slope - wanted) <= 1e-12 * fmax(1, fabs(wanted))))
                fail_msg("%s(%g, %g) by %u: %.17g, on a tape %.17g", qdot_fun_name(kinds[k].f), x[0], x[1], i, wanted, slope);
        }
        qdot_pool_free(pool);
    }
    assert_true(compared > TRIALS / 2 && slopes > TRIALS / 3);
}

/* At m = 0 the formula of the derivative of K is 0/0; on a tape it is pi/8. Beyond m = 1 there are no numbers. */
static void
m_0_is_an_ordinary_place(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    double slope;

    (void)state;
    assert_true(fabs(on_tape(pool, 0, (double[]){0}, 0, &slope) - M_PI_2) < 1e-15);
    assert_true(fabs(slope - M_PI / 8) < 1e-15);
    assert_true(isnan(on_tape(pool, 0, (double[]){1.5}, 0, &slope)));
    assert_true(isinf(on_tape(pool, 0, (double[]){1}, 0, &slope)));
    assert_true(isnan(on_tape(pool, 1, (double[]){1}, 0, &slope)));
    assert_true(isnan(on_tape(pool, 5, (double[]){2, 1}, 0, &slope)) && isnan(on_tape(pool, 8, (double[]){2, 1}, 0, &slope)));
    qdot_pool_free(pool);
}

/* Pi(n, 0) = pi/(2 sqrt(1 - n)) for n near 1 and far below, where p_0 is far from the limit and the sum cancels. */
static void
n_may_be_far(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    double slope;

    (void)state;
    for (int k = -14; k <= 15; k++) {
        const double rest = ldexp(1, 3 * k), value = on_tape(pool, 4, (double[]){1 - rest, 0}, 0, &slope);

        assert_true(fabs(value * sqrt(rest) / M_PI_2 - 1) < 4e-15 * (sqrt(rest) + 1 / sqrt(rest)));
    }
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_and_slopes_agree),
        cmocka_unit_test(m_0_is_an_ordinary_place),
        cmocka_unit_test(n_may_be_far),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
