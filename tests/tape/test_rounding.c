/* test_rounding.c -- bounds of the rounding of a tape, and factors that show it. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "expr/calculus.h"
#include "tape/reference.h"
#include "tape/rounding.h"
#include "tape/shake.h"
#include "tape/random.h"

static qdot_tape *
lowered(qdot_pool *pool, size_t n, const qdot_expr *in, size_t m, const qdot_expr *out)
{
    qdot_tape *tape;

    if (qdot_tape_new(pool, n, in, m, out, &tape) != QDOT_OK)
        fail_msg("%s", qdot_last_error()->message);
    return tape;
}

static double
evaluate(const qdot_tape *tape, const double *in)
{
    double *work = malloc((qdot_tape_work(tape) + 1) * sizeof *work), out;

    qdot_tape_eval(tape, in, &out, work);
    free(work);
    return out;
}

static double
bound(const qdot_tape *tape, const double *in)
{
    double *work = malloc((2 * qdot_tape_work(tape) + 1) * sizeof *work), out;

    qdot_rounding_bounds(tape, in, NULL, &out, work);
    free(work);
    return out;
}

/* f - f(0) of functions f, and others with terms that cancel for small x. */
static size_t
cancelling(qdot_pool *pool, qdot_expr x, qdot_expr *e)
{
    const qdot_expr more = qdot_add(pool, x, QDOT_ONE), square = qdot_mul(pool, x, x);
    const qdot_expr root = qdot_sqrt(pool, qdot_add(pool, square, QDOT_ONE));
    size_t n = 0;

    e[n++] = qdot_sub(pool, qdot_fun1(pool, QDOT_COS, x), QDOT_ONE);
    e[n++] = qdot_sub(pool, QDOT_ONE, qdot_fun1(pool, QDOT_EXP, x));
    e[n++] = qdot_sub(pool, qdot_fun1(pool, QDOT_COS, x), qdot_fun1(pool, QDOT_COSH, x));
    e[n++] = qdot_sub(pool, qdot_fun1(pool, QDOT_SIN, x), x);
    e[n++] = qdot_sub(pool, qdot_fun1(pool, QDOT_TANH, x), x);
    e[n++] = qdot_sub(pool, qdot_sqrt(pool, more), QDOT_ONE);
    e[n++] = qdot_sub(pool, qdot_pow_int(pool, root, -3), QDOT_ONE);
    e[n++] = qdot_fun1(pool, QDOT_LOG, more);
    e[n++] = qdot_fun1(pool, QDOT_LOG, root);
    e[n++] = qdot_mul(pool, x, qdot_sub(pool, qdot_fun1(pool, QDOT_COS, x), QDOT_ONE));
    e[n++] = qdot_sub(pool, qdot_pow_int(pool, qdot_fun1(pool, QDOT_TANH, root), 3),
                      qdot_pow_int(pool, qdot_fun1(pool, QDOT_TANH, QDOT_ONE), 3));
    return n;
}

/* A shaken tape is off by more than rounding, and not by much more; without it nothing changes. */
static void
cancelling_terms_are_shaken(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr x = coordinate(pool, "x", 0);
    qdot_expr e[16];
    const size_t n = cancelling(pool, x, e);

    (void)state;
    for (size_t i = 0; i < n; i++) {
        qdot_tape *tape = lowered(pool, 1, &x, 1, e + i), *plain = lowered(pool, 1, &x, 1, e + i);
        qdot_tape *shaken;
        size_t hidden = 0;

        assert_int_equal(qdot_rounding_show(tape), QDOT_OK);
        assert_int_equal(qdot_tape_shake(tape, &shaken), QDOT_OK);
        for (double at = 3e-3; at > 1e-6; at *= 0.7) {
            const double value = evaluate(plain, &at), by = fabs(evaluate(shaken, &at) - value);
            const double least = nextafter(at, 1), moved = fabs(evaluate(plain, &least) - value);
            const long double exact = at;
            const double off =
                (double)fabsl((long double)value - reference(pool, e[i], 1, &x, &exact).v);

            assert_true(evaluate(tape, &at) == value);
            if (!(off <= 3 * (by + moved)) || !(by <= 100 * bound(plain, &at)))
                fail_msg("%zu at %g: off by %g, shaken by %g", i, at, off, by);
            if (!(off <= bound(plain, &at)))
                fail_msg("%zu at %g: off by %g, bound %g", i, at, off, bound(plain, &at));
            hidden += off > 10 * moved;
        }
        assert_true(hidden > 0);
        qdot_tape_free(shaken);
        qdot_tape_free(plain);
        qdot_tape_free(tape);
    }
    qdot_pool_free(pool);
}

/* A product that is rounded before it is added: 10^4 x - 20007 near 0, x modulo 2/3. */
static void
products_within_operations_count(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr x = coordinate(pool, "x", 0);
    const qdot_expr third = qdot_div(pool, qdot_expr_int(pool, 2), qdot_expr_int(pool, 3));
    const qdot_expr e[] = {
        qdot_sub(pool, qdot_mul(pool, qdot_expr_int(pool, 10000), x), qdot_expr_int(pool, 20007)),
        qdot_fun(pool, QDOT_MOD, 2, (const qdot_expr[]){qdot_mul(pool, x, x), third}),
    };

    (void)state;
    for (size_t i = 0; i < sizeof e / sizeof *e; i++) {
        qdot_tape *tape = lowered(pool, 1, &x, 1, e + i);
        size_t rounded = 0;

        for (double at = 2.0007; at < 2.0008; at += 1e-6) {
            const long double exact = at;
            const double off = (double)fabsl((long double)evaluate(tape, &at)
                                             - reference(pool, e[i], 1, &x, &exact).v);

            rounded += off > 0;
            if (!(off <= bound(tape, &at)))
                fail_msg("%zu at %.17g: off by %g, bound %g", i, at, off, bound(tape, &at));
        }
        assert_true(rounded > 20);
        qdot_tape_free(tape);
    }
    qdot_pool_free(pool);
}

/* What underflows counts where it is multiplied by much; a product with 0 loses nothing. */
static void
underflow_counts(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr x = coordinate(pool, "x", 0);
    const qdot_expr much = qdot_pow_int(pool, qdot_expr_int(pool, 10), 200);
    const qdot_expr square = qdot_mul(pool, x, x);
    const qdot_expr e[] = {
        qdot_mul(pool, much, square),
        qdot_sub(pool, qdot_mul(pool, much, square), qdot_mul(pool, much, x)),
        qdot_mul(pool, much, qdot_fun1(pool, QDOT_EXP, qdot_div(pool, qdot_expr_int(pool, -1), x))),
    };
    const double small[] = {3e-165, 0x1p-545, 0x1.37p-10};

    (void)state;
    for (size_t i = 0; i < sizeof e / sizeof *e; i++) {
        qdot_tape *tape = lowered(pool, 1, &x, 1, e + i);
        double *work = malloc((2 * qdot_tape_work(tape) + 1) * sizeof *work), lost;
        const long double exact = small[i];
        const double off =
            (double)fabsl((long double)evaluate(tape, &small[i]) - reference(pool, e[i], 1, &x, &exact).v);

        assert_true(off > 0 && off <= bound(tape, &small[i]));
        qdot_rounding_underflows(tape, &small[i], &lost, work);
        assert_true(lost > 0 && lost <= 1e-100);
        qdot_rounding_underflows(tape, (const double[]){1}, &lost, work);
        assert_true(lost == 0);
        free(work);
        qdot_tape_free(tape);
    }
    qdot_pool_free(pool);
}

/* What moving the inputs shows has no factors: products, forces of a spring and of a mass. */
static void
other_sums_stay_as_they_are(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr in[] = {coordinate(pool, "x", 0), coordinate(pool, "y", 0)};
    const qdot_expr x = in[0], y = in[1];
    const qdot_expr r = qdot_sqrt(pool, qdot_add(pool, qdot_mul(pool, x, x), qdot_mul(pool, y, y)));
    const qdot_expr pull = qdot_sub(pool, qdot_pow_int(pool, r, -1), QDOT_ONE);
    const qdot_expr e[] = {
        qdot_fun1(pool, QDOT_SIN, qdot_sub(pool, x, y)),
        qdot_sub(pool, x, qdot_pow_int(pool, x, 3)),
        qdot_mul(pool, x, qdot_pow_int(pool, r, -3)),
        qdot_mul(pool, x, pull),
        qdot_add(pool, qdot_sub(pool, qdot_mul(pool, x, y), y), qdot_fun1(pool, QDOT_EXP, x)),
    };

    (void)state;
    for (size_t i = 0; i < sizeof e / sizeof *e; i++) {
        qdot_tape *tape = lowered(pool, 2, in, 1, e + i);
        const size_t operations = qdot_tape_operations(tape);

        assert_int_equal(qdot_rounding_show(tape), QDOT_OK);
        if (qdot_tape_operations(tape) != operations)
            fail_msg("%zu has a factor", i);
        qdot_tape_free(tape);
    }
    qdot_pool_free(pool);
}

/* Random expressions at random places: with factors the same values; bounds hold in nearly all. */
static void
bounds_hold_and_values_stay(void **state)
{
    size_t compared = 0, beyond = 0;

    (void)state;
    for (int round = 0; round < 300; round++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr have[24], in[3];
        qdot_tape *plain, *tape;
        double at[3];
        long double exact[3];
        unsigned n = 3;

        for (int i = 0; i < 3; i++) {
            in[i] = have[i] = coordinate(pool, "x", i);
            exact[i] = at[i] = ((double)roll(2001) - 1000) / 700;
        }
        while (n < 24) {
            have[n] = random_node(pool, have, n);
            n++;
        }
        plain = lowered(pool, 3, in, 1, have + 23);
        tape = lowered(pool, 3, in, 1, have + 23);
        assert_int_equal(qdot_rounding_show(tape), QDOT_OK);
        const double value = evaluate(plain, at);
        const reference_value want = reference(pool, have[23], 3, in, exact);

        if (isfinite(value)) {
            assert_true(evaluate(tape, at) == value);
            if (isfinite((double)want.err)) {
                compared++;
                beyond += !(fabsl(value - want.v) <= bound(plain, at));
            }
        }
        qdot_tape_free(plain);
        qdot_tape_free(tape);
        qdot_pool_free(pool);
    }
    assert_true(compared > 200);
    if (50 * beyond > compared)
        fail_msg("%zu of %zu beyond their bounds", beyond, compared);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cancelling_terms_are_shaken),
        cmocka_unit_test(products_within_operations_count),
        cmocka_unit_test(underflow_counts),
        cmocka_unit_test(other_sums_stay_as_they_are),
        cmocka_unit_test(bounds_hold_and_values_stay),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
