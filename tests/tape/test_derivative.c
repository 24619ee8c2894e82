/* test_derivative.c -- forward derivatives: each operation against differences, whole
 * tapes against symbolic derivatives. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "expr/calculus.h"
#include "num/batch.h"
#include "num/kinds.h"
#include "tape/derivative.h"
#include "tape/lone.h"
#include "tape/random.h"
#include "tape/reference.h"

enum { MANY = 19, OUTPUTS = 6 };

static void
evaluate(const qdot_tape *tape, const double *in, double *out)
{
    double *work = malloc((qdot_tape_work(tape) + 1) * sizeof *work);

    qdot_tape_eval(tape, in, out, work);
    free(work);
}

static void
derive(const qdot_tape *tape, const double *in, size_t from, size_t columns, double *out,
       double *J)
{
    double *work = malloc((qdot_derivative_work(tape) + 1) * sizeof *work);

    qdot_derivative_eval(tape, in, from, columns, out, J, work);
    free(work);
}

/* The rows of operation.def, at points inside their domains and on both sides of what
 * switches, on every kind of processor. */
static void
every_operation_agrees_with_differences(void **state)
{
    static const double points[][3] = {
        {0.37, 1.6, -0.8}, {1.7, 0.45, 2.2}, {-0.62, -1.1, 0.3}, {5.3, 1.6, 1}, {0, 2, 3}};
    const double h = 1e-5;
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    for (size_t kind = 0; kind < 3; kind++) {
        qdot_kind_limit(kind);
        for (int op = 0; op < QDOT_OP_COUNT; op++) {
            qdot_tape *tape = lone(pool, op, false);
            size_t compared = 0;

            for (size_t p = 0; p < sizeof points / sizeof *points; p++) {
                const double a = points[p][0], slope = M_2_SQRTPI * exp(-a * a);
                const double b = op == QDOT_OP_ERF    ? slope
                                 : op == QDOT_OP_ERFC ? -slope
                                 : op == QDOT_OP_SOFTPLUS ? (1 + tanh(a / 2)) / 2
                                                      : points[p][1];
                const double at[] = {a, b, points[p][2]};
                double out[2], plain[2], J[6], up[2], down[2];

                derive(tape, at, 0, 3, out, J);
                evaluate(tape, at, plain);
                assert_true(out[0] == plain[0] || isnan(plain[0]));
                for (size_t j = 0; j < 3; j++) {
                    double x[3] = {at[0], at[1], at[2]};

                    x[j] += h;
                    evaluate(tape, x, up);
                    x[j] -= 2 * h;
                    evaluate(tape, x, down);
                    for (size_t i = 0; i < 2; i++) {
                        double want = (up[i] - down[i]) / (2 * h), got = J[3 * i + j];

                        /* not defined, or a corner */
                        if (!isfinite(want) || a == 0)
                            continue;
                        compared++;
                        if (!(fabs(got - want) <= 1e-8 * (1 + fabs(want))))
                            fail_msg("%s, input %zu: %.12g, not %.12g",
                                     qdot_operations[op].name, j, got, want);
                    }
                }
            }
            assert_true(compared > 0);
            qdot_tape_free(tape);
        }
    }
    qdot_kind_limit(SIZE_MAX);
    qdot_pool_free(pool);
}

/* What is read, too: a place that is given over keeps nothing of its old slopes. */
static void
whole_tapes_agree_with_symbolic_derivatives(void **state)
{
    static const size_t ranges[][2] = {{0, MANY}, {3, 8}, {10, 9}, {7, 1}, {0, 0}};
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x[MANY], e[OUTPUTS], slopes[OUTPUTS * MANY], sum = QDOT_ZERO;
    double at[MANY], out[OUTPUTS], plain[OUTPUTS], J[OUTPUTS * MANY], want[OUTPUTS * MANY];
    qdot_tape *tape, *symbolic;

    (void)state;
    for (int i = 0; i < MANY; i++) {
        char name[16];

        snprintf(name, sizeof name, "x[%d]", i);
        x[i] = qdot_symbol_get(pool, QDOT_COORD, name);
        at[i] = 0.3 + 0.1 * i - 0.01 * i * i;
    }
    for (int i = 0; i < MANY; i++) /* a chain's: angles, and their differences */
        sum = qdot_add(pool, qdot_mul(pool, sum, qdot_fun1(pool, QDOT_COS, qdot_sub(pool, x[i], x[(i + 5) % MANY]))),
                       qdot_mul(pool, x[i], qdot_fun1(pool, QDOT_SIN, x[i])));
    e[0] = sum;
    e[1] = qdot_pow(pool, qdot_add(pool, QDOT_ONE, qdot_mul(pool, sum, sum)),
                    qdot_expr_ratio(pool, -3, 2));
    e[2] = qdot_div(pool, qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, x[3])),
                    qdot_add(pool, qdot_pow_int(pool, x[18], 7), x[1]));
    e[3] = qdot_fun1(pool, QDOT_ATAN, qdot_mul(pool, qdot_fun1(pool, QDOT_TAN, x[9]), x[2]));
    e[4] = qdot_expr_int(pool, 5);
    e[5] = x[12];
    assert_int_equal(qdot_tape_new(pool, MANY, x, OUTPUTS, e, &tape), QDOT_OK);
    for (int i = 0; i < OUTPUTS; i++)
        for (int j = 0; j < MANY; j++)
            slopes[i * MANY + j] = qdot_diff(pool, e[i], x[j]);
    assert_int_equal(qdot_tape_new(pool, MANY, x, OUTPUTS * MANY, slopes, &symbolic),
                     QDOT_OK);
    evaluate(symbolic, at, want);
    evaluate(tape, at, plain);
    for (size_t r = 0; r < sizeof ranges / sizeof *ranges; r++) {
        size_t from = ranges[r][0], columns = ranges[r][1];

        derive(tape, at, from, columns, out, J);
        for (size_t i = 0; i < OUTPUTS; i++) {
            assert_true(fabs(out[i] - plain[i]) <= 1e-14 * (1 + fabs(plain[i])));
            for (size_t j = 0; j < columns; j++) {
                double w = want[i * MANY + from + j], got = J[i * columns + j];

                if (!(fabs(got - w) <= 1e-12 * (1 + fabs(w))))
                    fail_msg("d%zu/d%zu: %.15g, not %.15g", i, from + j, got, w);
            }
        }
    }
    qdot_tape_free(tape);
    qdot_tape_free(symbolic);
    qdot_pool_free(pool);
}

/* Slopes of 1000 random expressions by the tape and by symbols, these in long double, to 1e-13: where
 * rounding of the symbolic slope in doubles would be above a tenth of that it is no reference. */
static void
random_slopes_agree_with_symbolic_derivatives(void **state)
{
    enum { LEAVES = 3, NODES = 9, WANTED = 1000 };
    const double within = 1e-13;
    size_t expressions = 0, slopes = 0;

    (void)state;
    for (int round = 0; expressions < WANTED; round++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr have[LEAVES + NODES], e;
        double at[LEAVES], out, J[LEAVES];
        long double exact[LEAVES];
        qdot_tape *tape = NULL;
        bool looked = false;

        assert_true(round < 4 * WANTED);
        for (int i = 0; i < LEAVES; i++) {
            have[i] = coordinate(pool, "x", i);
            exact[i] = at[i] = (double)roll(4001) / 1000.0 - 2.0 + 1e-9;
        }
        for (unsigned i = LEAVES; i < LEAVES + NODES; i++)
            have[i] = random_node(pool, have, i);
        e = have[LEAVES + NODES - 1];
        if (qdot_pool_check(pool) == QDOT_OK) {
            assert_int_equal(qdot_tape_new(pool, LEAVES, have, 1, &e, &tape), QDOT_OK);
            derive(tape, at, 0, LEAVES, &out, J);
        }
        for (size_t j = 0; j < LEAVES && tape; j++) {
            const qdot_expr slope = qdot_diff(pool, e, have[j]);
            reference_value want;
            long double size;

            if (qdot_pool_check(pool) != QDOT_OK)
                break;
            want = reference(pool, slope, LEAVES, have, exact);
            size = fmaxl(1, fabsl(want.v));
            if (!isfinite(want.v) || !(want.err <= within / 10 * size))
                continue;
            if (!(fabsl(J[j] - want.v) <= within * size))
                fail_msg("expression %d: the slope along x[%zu] is %.17g, not %.17Lg", round, j,
                         J[j], want.v);
            looked = true;
            slopes++;
        }
        expressions += looked;
        qdot_tape_free(tape);
        qdot_pool_free(pool);
    }
    assert_true(slopes > WANTED);
}

/* Where arguments of max and min are equal, on intervals or at one place, tapes and symbols have the slope
 * of the same one, along all inputs. */
static void
slopes_where_arguments_are_equal_agree(void **state)
{
    enum { LEAVES = 2, NODES = 4, WANTED = 600 };

    (void)state;
    for (int round = 0; round < WANTED; round++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr have[LEAVES + NODES], slope[LEAVES];
        double at[LEAVES], out, J[LEAVES], want[LEAVES];
        qdot_tape *tape, *symbolic;

        for (int i = 0; i < LEAVES; i++) {
            have[i] = coordinate(pool, "x", i);
            at[i] = (double)roll(3) - 1;
        }
        for (unsigned i = LEAVES; i < LEAVES + NODES; i++) {
            const qdot_expr x = have[roll(i)], y = have[roll(i)];
            const qdot_expr of[] = {x, y, roll(2) ? qdot_fun1(pool, QDOT_ABS, x) : QDOT_ZERO};

            have[i] = qdot_fun(pool, roll(2) ? QDOT_MAX : QDOT_MIN, 2 + roll(2), of);
            if (roll(3) == 0)
                have[i] = qdot_mul(pool, qdot_expr_int(pool, 2), have[i]);
        }
        for (int j = 0; j < LEAVES; j++)
            slope[j] = qdot_diff(pool, have[LEAVES + NODES - 1], have[j]);
        assert_int_equal(qdot_tape_new(pool, LEAVES, have, 1, have + LEAVES + NODES - 1, &tape), QDOT_OK);
        assert_int_equal(qdot_tape_new(pool, LEAVES, have, LEAVES, slope, &symbolic), QDOT_OK);
        derive(tape, at, 0, LEAVES, &out, J);
        evaluate(symbolic, at, want);
        for (int j = 0; j < LEAVES; j++)
            if (J[j] != want[j])
                fail_msg("expression %d: the slope along x[%d] is %g, not %g", round, j, J[j], want[j]);
        qdot_tape_free(tape);
        qdot_tape_free(symbolic);
        qdot_pool_free(pool);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_operation_agrees_with_differences),
        cmocka_unit_test(whole_tapes_agree_with_symbolic_derivatives),
        cmocka_unit_test(random_slopes_agree_with_symbolic_derivatives),
        cmocka_unit_test(slopes_where_arguments_are_equal_agree),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
