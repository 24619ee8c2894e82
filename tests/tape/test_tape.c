/* test_tape.c -- tapes against an evaluation of the DAG in long double, and their
 * counts. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "tape/code.h"
#include "tape/reference.h"
#include "tape/shake.h"
#include "tape/tape.h"
#include "tape/random.h"

/* --- helpers ------------------------------------------------------------------------ */

static qdot_tape *
lowered(qdot_pool *pool, size_t n, const qdot_expr *inputs, size_t m, const qdot_expr *outputs)
{
    qdot_tape *tape;

    if (qdot_tape_new(pool, n, inputs, m, outputs, &tape) != QDOT_OK)
        fail_msg("%s", qdot_last_error()->message);
    assert_int_equal(qdot_tape_inputs(tape), n);
    assert_int_equal(qdot_tape_outputs(tape), m);
    return tape;
}

static void
evaluate(const qdot_tape *tape, const double *in, double *out)
{
    double *work = malloc((qdot_tape_work(tape) + 1) * sizeof *work);

    qdot_tape_eval(tape, in, out, work);
    free(work);
}

static size_t
compare(qdot_pool *pool, size_t n, const qdot_expr *inputs, size_t m, const qdot_expr *outputs,
        const double *at)
{
    qdot_tape *tape = lowered(pool, n, inputs, m, outputs);
    double *out = malloc(m * sizeof *out);
    long double exact[16];
    size_t compared = 0;

    assert_true(n <= 16);
    for (size_t i = 0; i < n; i++)
        exact[i] = at[i];
    evaluate(tape, at, out);
    for (size_t i = 0; i < m; i++) {
        reference_value want = reference(pool, outputs[i], n, inputs, exact);

        if (!isfinite(want.v) || !isfinite(want.err) || want.err > 1e-6L * (1 + fabsl(want.v)))
            continue;
        compared++;
        if (!(fabsl(out[i] - want.v) <= 4 * want.err + 1e-300L))
            fail_msg("output %zu: %.17g, not %.17Lg +- %.1Le", i, out[i], want.v, want.err);
    }
    free(out);
    qdot_tape_free(tape);
    return compared;
}

/* --- random expressions ------------------------------------------------------------- */

enum { LEAVES = 5, NODES = 40, OUTPUTS = 12 };

static void
random_expressions_agree(void **state)
{
    size_t compared = 0;

    (void)state;
    for (int round = 0; round < 150; round++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr have[LEAVES + NODES];
        double at[LEAVES];

        for (int i = 0; i < LEAVES; i++) {
            have[i] = coordinate(pool, "x", i);
            at[i] = (double)roll(4001) / 1000.0 - 2.0 + 1e-9;
        }
        for (unsigned i = LEAVES; i < LEAVES + NODES; i++) {
            have[i] = random_node(pool, have, i < 20 ? i : 20);
            if (have[i] == QDOT_NIL) {
                assert_int_not_equal(qdot_pool_check(pool), QDOT_OK);
                have[i] = have[0];
            }
        }
        compared += compare(pool, LEAVES, have, OUTPUTS, have + LEAVES + NODES - OUTPUTS, at);
        qdot_pool_free(pool);
    }
    assert_true(compared > 1000);
}

/* d/dx on the tape against differences of the tape itself. */
static void
derivatives_agree_with_differences(void **state)
{
    size_t compared = 0;

    (void)state;
    for (int round = 0; round < 60; round++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr x[2] = {coordinate(pool, "x", 0), coordinate(pool, "x", 1)};
        qdot_expr have[20] = {x[0], x[1]}, outputs[2];
        double at[2] = {0.7 + 0.01 * round, -0.4 + 0.013 * round}, out[2], a[2], b[2];
        const double h = 1e-5;
        qdot_tape *tape;

        for (unsigned i = 2; i < 20; i++)
            have[i] = random_node(pool, have, i < 8 ? i : 8);
        outputs[0] = have[19];
        outputs[1] = qdot_diff(pool, have[19], x[0]);
        if (qdot_pool_check(pool) == QDOT_OK) {
            tape = lowered(pool, 2, x, 2, outputs);
            evaluate(tape, at, out);
            at[0] += h;
            evaluate(tape, at, a);
            at[0] -= 2 * h;
            evaluate(tape, at, b);
            if (isfinite(out[1]) && fabs(out[0]) < 1e3 && fabs(a[1] - b[1]) < 1e-2) {
                compared++;
                assert_true(fabs((a[0] - b[0]) / (2 * h) - out[1])
                            < 1e-5 * (1 + fabs(out[0]) + fabs(out[1])));
            }
            qdot_tape_free(tape);
        }
        qdot_pool_free(pool);
    }
    assert_true(compared > 20);
}

/* --- counts ------------------------------------------------------------------------- */

/* cos(theta_i - theta_j) for all pairs, and sin(theta_i) alone. */
static void
chain_calls_one_pair_a_link(void **state)
{
    enum { N = 8 };
    qdot_pool *pool = qdot_pool_new();
    qdot_expr q[N], out[N * N + N];
    double at[N];
    size_t m = 0;
    qdot_tape *tape;

    (void)state;
    for (int i = 0; i < N; i++) {
        q[i] = coordinate(pool, "theta", i);
        at[i] = 0.3 * i - 1.1;
    }
    for (int i = 0; i < N; i++) {
        out[m++] = qdot_fun1(pool, QDOT_SIN, q[i]);
        for (int j = 0; j < i; j++) {
            out[m++] = qdot_fun1(pool, QDOT_COS, qdot_sub(pool, q[i], q[j]));
            out[m++] = qdot_fun1(pool, QDOT_SIN, qdot_sub(pool, q[i], q[j]));
        }
    }
    tape = lowered(pool, N, q, m, out);
    assert_int_equal(qdot_tape_calls(tape), N);
    assert_true(qdot_tape_operations(tape) <= N + 7 * N * (N - 1) / 2);
    qdot_tape_free(tape);
    compare(pool, N, q, m, out, at);
    /* for series every pair is one of its own */
    assert_int_equal(qdot_tape_new_for_series(pool, N, q, m, out, &tape), QDOT_OK);
    assert_int_equal(qdot_tape_calls(tape), N + N * (N - 1) / 2);
    assert_true(qdot_tape_operations(tape) <= N + 3 * N * (N - 1) / 2);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* theta1, theta1 + theta2, ...: sums share their beginnings. */
static void
relative_angles_share_their_sums(void **state)
{
    enum { N = 8 };
    qdot_pool *pool = qdot_pool_new();
    qdot_expr q[N], out[2 * N], sum = QDOT_ZERO;
    double at[N];
    qdot_tape *tape;

    (void)state;
    for (int i = 0; i < N; i++) {
        q[i] = coordinate(pool, "theta", i);
        at[i] = 0.37 * i - 1.3;
        sum = qdot_add(pool, sum, q[i]);
        out[2 * i] = qdot_fun1(pool, QDOT_SIN, sum);
        out[2 * i + 1] = qdot_fun1(pool, QDOT_COS, sum);
    }
    tape = lowered(pool, N, q, 2 * N, out);
    assert_int_equal(qdot_tape_calls(tape), N);
    assert_true(qdot_tape_operations(tape) <= N + 6 * N);
    qdot_tape_free(tape);
    compare(pool, N, q, 2 * N, out, at);
    qdot_pool_free(pool);
}

/* One difference alone is one call, not two pairs. */
static void
a_lone_difference_is_one_call(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr q[2] = {coordinate(pool, "theta", 0), coordinate(pool, "theta", 1)};
    qdot_expr out = qdot_fun1(pool, QDOT_COS, qdot_sub(pool, q[0], q[1]));
    qdot_tape *tape = lowered(pool, 2, q, 1, &out);

    (void)state;
    assert_int_equal(qdot_tape_calls(tape), 1);
    assert_int_equal(qdot_tape_operations(tape), 2);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* sin x, cos x, tan x, sin 2x, cos 3x, sin(x + pi/7): one call. */
static void
multiples_and_shifts_use_the_base_angle(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = coordinate(pool, "x", 0), out[7];
    double at = 0.73;
    qdot_tape *tape;

    (void)state;
    out[0] = qdot_fun1(pool, QDOT_SIN, x);
    out[1] = qdot_fun1(pool, QDOT_COS, x);
    out[2] = qdot_fun1(pool, QDOT_TAN, x);
    out[3] = qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, qdot_expr_int(pool, 2), x));
    out[4] = qdot_fun1(pool, QDOT_COS, qdot_mul(pool, qdot_expr_int(pool, -3), x));
    out[5] = qdot_fun1(pool, QDOT_SIN,
                       qdot_add(pool, x, qdot_mul(pool, QDOT_PI, qdot_expr_ratio(pool, 1, 7))));
    out[6] = qdot_fun1(pool, QDOT_SEC, x);
    tape = lowered(pool, 1, &x, 7, out);
    assert_int_equal(qdot_tape_calls(tape), 1);
    qdot_tape_free(tape);
    assert_int_equal(compare(pool, 1, &x, 7, out, &at), 7);
    qdot_pool_free(pool);
}

/* x^2, x^4, x^7: x2, x4, x7 = x4 x2 x or x6 x: five at most; 1/x and 1/x^3 share one
 * division; (x^2 + y^2)^(-1/2) and ^(-3/2) one root and one division. */
static void
powers_are_shared(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr in[2] = {coordinate(pool, "x", 0), coordinate(pool, "y", 0)}, out[3], s;
    double at[2] = {1.3, -0.8};
    qdot_tape *tape;

    (void)state;
    out[0] = qdot_pow_int(pool, in[0], 2);
    out[1] = qdot_pow_int(pool, in[0], 4);
    out[2] = qdot_pow_int(pool, in[0], 6);
    tape = lowered(pool, 2, in, 3, out);
    assert_int_equal(qdot_tape_operations(tape), 3);
    qdot_tape_free(tape);
    compare(pool, 2, in, 3, out, at);

    out[0] = qdot_pow_int(pool, in[0], -1);
    out[1] = qdot_pow_int(pool, in[0], -3);
    tape = lowered(pool, 2, in, 2, out);
    assert_int_equal(qdot_tape_operations(tape), 3);
    qdot_tape_free(tape);
    compare(pool, 2, in, 2, out, at);

    s = qdot_add(pool, qdot_pow_int(pool, in[0], 2), qdot_pow_int(pool, in[1], 2));
    out[0] = qdot_pow(pool, s, qdot_expr_ratio(pool, -1, 2));
    out[1] = qdot_pow(pool, s, qdot_expr_ratio(pool, -3, 2));
    tape = lowered(pool, 2, in, 2, out);
    assert_int_equal(qdot_tape_operations(tape), 3 + 2 + 2);
    assert_int_equal(qdot_tape_calls(tape), 0);
    qdot_tape_free(tape);
    compare(pool, 2, in, 2, out, at);
    qdot_pool_free(pool);
}

static void
powers_up_to_70_are_right(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = coordinate(pool, "x", 0), out[140];
    double at = 1.0625;
    size_t m = 0;

    (void)state;
    for (int64_t n = -70; n <= 70; n++)
        if (n != 0)
            out[m++] = qdot_pow_int(pool, x, n);
    assert_int_equal(compare(pool, 1, &x, m, out, &at), 140);
    qdot_pool_free(pool);
}

/* What no output needs is not computed, and an output may be an input or a number. */
static void
dead_code_is_not_kept(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr in[2] = {coordinate(pool, "x", 0), coordinate(pool, "y", 0)};
    qdot_expr out[3] = {in[1], qdot_expr_ratio(pool, 3, 4), in[1]};
    double at[2] = {5, 7}, got[3];
    qdot_tape *tape = lowered(pool, 2, in, 3, out);

    (void)state;
    assert_int_equal(qdot_tape_operations(tape), 0);
    evaluate(tape, at, got);
    assert_true(got[0] == 7 && got[1] == 0.75 && got[2] == 7);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* Places are reused: a long sum of products needs few. */
static void
dead_places_are_used_again(void **state)
{
    enum { N = 40 };
    qdot_pool *pool = qdot_pool_new();
    qdot_expr q[N], sum = QDOT_ZERO;
    qdot_tape *tape;

    (void)state;
    for (int i = 0; i < N; i++)
        q[i] = coordinate(pool, "q", i);
    for (int i = 0; i < N; i++)
        sum = qdot_add(pool, sum, qdot_fun1(pool, QDOT_EXP, q[i]));
    tape = lowered(pool, N, q, 1, &sum);
    assert_true(qdot_tape_work(tape) <= 2 * N + 2);
    assert_int_equal(qdot_tape_calls(tape), N);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* 9.81 x + x/2: 9.81 moves to its other neighbour, 1/2 stays. */
static void
shaken_constants_bracket_the_exact_ones(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = coordinate(pool, "x", 0), out[2];
    qdot_tape *tape, *shaken;
    double one = 1, a[2], b[2];

    (void)state;
    out[0] = qdot_mul(pool, qdot_expr_decimal(pool, "9.81", 4), x);
    out[1] = qdot_mul(pool, QDOT_HALF, x);
    tape = lowered(pool, 1, &x, 2, out);
    assert_int_equal(qdot_tape_shake(tape, &shaken), QDOT_OK);
    evaluate(tape, &one, a);
    evaluate(shaken, &one, b);
    assert_true(a[0] == 9.81 && (b[0] == nextafter(9.81, 10) || b[0] == nextafter(9.81, 9)));
    assert_true(((long double)a[0] < 9.81L) != ((long double)b[0] < 9.81L));
    assert_true(a[1] == 0.5 && b[1] == 0.5);
    qdot_tape_free(tape);
    qdot_tape_free(shaken);
    qdot_pool_free(pool);
}

/* --- errors ------------------------------------------------------------------------- */

static void
names_without_value_are_told(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = coordinate(pool, "x", 0), m = qdot_symbol_get(pool, QDOT_PARAM, "m"), e;
    qdot_expr formals[2] = {qdot_symbol_get(pool, QDOT_FORMAL, "s"), QDOT_T};
    qdot_tape *tape;
    uint32_t f;

    (void)state;
    e = qdot_mul(pool, m, x);
    assert_int_equal(qdot_tape_new(pool, 1, &x, 1, &e, &tape), QDOT_EUNSET);
    assert_string_equal(qdot_last_error()->message, "parameter m has no value");
    assert_string_equal(qdot_last_error()->hint, "set m = ...");
    assert_null(tape);
    e = qdot_symbol_jet(pool, x, 1);
    assert_int_equal(qdot_tape_new(pool, 1, &x, 1, &e, &tape), QDOT_EUNSET);
    assert_string_equal(qdot_last_error()->message, "velocity x[0]' has no value");

    assert_int_equal(qdot_ufun_declare(pool, "X", 2, formals, &f), QDOT_OK);
    formals[0] = x;
    e = qdot_ufun_apply(pool, f, formals, NULL);
    assert_int_equal(qdot_tape_new(pool, 1, &x, 1, &e, &tape), QDOT_EUNSET);
    assert_string_equal(qdot_last_error()->message, "function X(s, t) has no value");
    assert_string_equal(qdot_last_error()->hint, "set X(s, t) = ...");
    qdot_pool_free(pool);
}

static void
vectors_are_refused(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x[2] = {coordinate(pool, "x", 0), coordinate(pool, "x", 1)};
    qdot_expr v = qdot_vector(pool, 2, x), one = QDOT_ONE;
    qdot_tape *tape;

    (void)state;
    assert_int_equal(qdot_tape_new(pool, 2, x, 1, &v, &tape), QDOT_ETYPE);
    assert_int_equal(qdot_tape_new(pool, 1, &one, 1, x, &tape), QDOT_EINVAL);
    qdot_pool_free(pool);
}

/* Out of memory at the n-th allocation, for every n, until it passes. */
static void
every_failed_allocation_is_survived(void **state)
{
    qdot_status status = QDOT_ENOMEM;
    int64_t n = 0;

    (void)state;
    for (; status != QDOT_OK && n < 10000; n++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr q[3], out;
        qdot_tape *tape = NULL;

        for (int i = 0; i < 3; i++)
            q[i] = coordinate(pool, "q", i);
        out = qdot_mul(pool, qdot_fun1(pool, QDOT_COS, qdot_sub(pool, q[0], q[1])),
                       qdot_add(pool, qdot_pow_int(pool, q[2], -2), QDOT_PI));
        qdot_memory_fail_at(n);
        status = qdot_tape_new(pool, 3, q, 1, &out, &tape);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        assert_true((status == QDOT_OK) == (tape != NULL));
        qdot_tape_free(tape);
        qdot_pool_free(pool);
    }
    assert_true(n > 5 && status == QDOT_OK);
}

/* A DAG 100,000 deep. */
/* As where Ctrl-C is pressed: from some node on the pool makes none. */
static void
every_node_may_be_the_last(void **state)
{
    uint64_t stopped = 0;

    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        qdot_status status = QDOT_ELIMIT;

        for (uint64_t work = 0; status != QDOT_OK; work++) {
            qdot_pool *pool = qdot_pool_new();
            qdot_expr have[LEAVES + NODES];
            qdot_tape *tape = NULL;

            seed = 1000 + round;
            for (int i = 0; i < LEAVES; i++)
                have[i] = coordinate(pool, "x", i);
            for (unsigned i = LEAVES; i < LEAVES + NODES; i++) {
                have[i] = random_node(pool, have, i < 12 ? i : 12);
                if (have[i] == QDOT_NIL) {
                    assert_int_not_equal(qdot_pool_check(pool), QDOT_OK);
                    have[i] = have[0];
                }
            }
            qdot_pool_budget(pool, work);
            status = qdot_tape_new(pool, LEAVES, have, OUTPUTS, have + LEAVES + NODES - OUTPUTS, &tape);
            assert_true(status == QDOT_OK || status == QDOT_ELIMIT);
            assert_true((status == QDOT_OK) == (tape != NULL));
            qdot_tape_free(tape);
            qdot_pool_free(pool);
            stopped += status != QDOT_OK;
        }
    }
    assert_true(stopped > 300);
}

static void
depth_is_no_limit(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = coordinate(pool, "x", 0), e = x;
    double at = 0.5, out;
    qdot_tape *tape;

    (void)state;
    for (int i = 0; i < 100000; i++)
        e = qdot_fun1(pool, QDOT_ATAN, qdot_add(pool, e, QDOT_ONE));
    tape = lowered(pool, 1, &x, 1, &e);
    evaluate(tape, &at, &out);
    assert_true(out > 1.13 && out < 1.14); /* x = atan(x + 1) */
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* Products of sines and cosines summed, made forwards or backwards; their tape. */
static qdot_tape *
made(bool backwards)
{
    enum { N = 9 };
    qdot_pool *pool = qdot_pool_new();
    qdot_expr q[N], sum = QDOT_ZERO;
    qdot_tape *tape;

    assert_non_null(pool);
    for (int i = 0; i < N; i++)
        q[i] = coordinate(pool, "q", i);
    for (int j = 0; j < N; j++) {
        int i = backwards ? N - 1 - j : j;
        qdot_expr s = qdot_fun1(pool, QDOT_SIN, q[i]);
        qdot_expr c = qdot_fun1(pool, QDOT_COS, q[(i + 4) % N]);

        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_mul(pool, s, c), q[(i + 7) % N]));
    }
    tape = lowered(pool, N, q, 1, &sum);
    qdot_pool_free(pool);
    return tape;
}

static void
when_nodes_were_made_does_not_matter(void **state)
{
    qdot_tape *forwards = made(false), *backwards = made(true);

    (void)state;
    assert_int_equal(forwards->length, backwards->length);
    assert_int_equal(forwards->output[0], backwards->output[0]);
    assert_memory_equal(forwards->code, backwards->code,
                        forwards->length * sizeof *forwards->code);
    qdot_tape_free(forwards);
    qdot_tape_free(backwards);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_expressions_agree),
        cmocka_unit_test(derivatives_agree_with_differences),
        cmocka_unit_test(chain_calls_one_pair_a_link),
        cmocka_unit_test(relative_angles_share_their_sums),
        cmocka_unit_test(a_lone_difference_is_one_call),
        cmocka_unit_test(multiples_and_shifts_use_the_base_angle),
        cmocka_unit_test(powers_are_shared),
        cmocka_unit_test(powers_up_to_70_are_right),
        cmocka_unit_test(dead_code_is_not_kept),
        cmocka_unit_test(dead_places_are_used_again),
        cmocka_unit_test(shaken_constants_bracket_the_exact_ones),
        cmocka_unit_test(names_without_value_are_told),
        cmocka_unit_test(vectors_are_refused),
        cmocka_unit_test(every_failed_allocation_is_survived),
        cmocka_unit_test(every_node_may_be_the_last),
        cmocka_unit_test(depth_is_no_limit),
        cmocka_unit_test(when_nodes_were_made_does_not_matter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
