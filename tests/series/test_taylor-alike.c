/* test_taylor-alike.c -- forces between pairs of points: how many parts, sums and rows are made of them, and their
 * series against those of the program that is carried out step by step. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "num/kinds.h"
#include "series/alike-kinds.h"
#include "series/taylor-alike.h"
#include "series/taylor-motion.h"

enum { MOST_POINTS = 24, AXES = 3, ORDERS = 24, MOST = AXES * MOST_POINTS };

typedef enum { GRAVITY, SPRINGS, SCREENED } law;

/* N points in space and their accelerations a_i = sum_j c_ij f(r_ij) (x_j - x_i) + g_i, lowered to a motion. */
typedef struct {
    size_t n;
    qdot_pool *pool;
    qdot_motion motion;
    double start[2 * MOST];
} scene;

static qdot_expr
power(qdot_pool *pool, qdot_expr x, int64_t num, int64_t den)
{
    return qdot_pow(pool, x, qdot_expr_ratio(pool, num, den));
}

/* The force of a pair by its distance, over that distance. */
static qdot_expr
slope(qdot_pool *pool, law by, qdot_expr square)
{
    const qdot_expr r = power(pool, square, 1, 2);

    switch (by) {
    case GRAVITY: return power(pool, square, -3, 2);
    case SPRINGS: return qdot_sub(pool, qdot_expr_int(pool, 3), power(pool, square, -1, 2));
    default: return qdot_mul(pool, qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, r)), power(pool, square, -1, 2));
    }
}

static void
make_accelerations(qdot_pool *pool, law by, size_t n, const qdot_expr *x, qdot_expr *a)
{
    for (size_t i = 0; i < AXES * n; i++)
        a[i] = i % (size_t)AXES == 2 ? qdot_expr_ratio(pool, -7, 5) : QDOT_ZERO;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            qdot_expr d[AXES], square = QDOT_ZERO, f;

            for (size_t k = 0; k < AXES; k++) {
                d[k] = qdot_sub(pool, x[AXES * j + k], x[AXES * i + k]);
                square = qdot_add(pool, square, power(pool, d[k], 2, 1));
            }
            f = slope(pool, by, square);
            for (size_t k = 0; k < AXES; k++) {
                const qdot_expr F = qdot_mul(pool, f, d[k]);
                const qdot_expr mi = qdot_expr_ratio(pool, (int64_t)i + 2, 7), mj = qdot_expr_ratio(pool, (int64_t)j + 2, 7);

                a[AXES * i + k] = qdot_add(pool, a[AXES * i + k], qdot_mul(pool, mj, F));
                a[AXES * j + k] = qdot_sub(pool, a[AXES * j + k], qdot_mul(pool, mi, F));
            }
        }
}

static void
make_scene(scene *s, law by, size_t n)
{
    qdot_expr in[2 * MOST], out[MOST];
    qdot_program_row rows[2 * MOST], values[MOST];
    qdot_program_builder *b;
    qdot_status status = QDOT_OK;
    qdot_tape *tape;

    *s = (scene){.n = n, .pool = qdot_pool_new()};
    for (size_t i = 0; i < AXES * n; i++) {
        char name[32];

        snprintf(name, sizeof name, "x%zu", i);
        in[i] = qdot_symbol_get(s->pool, QDOT_COORD, name);
        in[AXES * n + i] = qdot_symbol_jet(s->pool, in[i], 1);
        s->start[i] = 3 * sin(1.7 * (double)i * (double)i + 0.3) + (double)(i / AXES);
        s->start[AXES * n + i] = 0.4 * cos(2.3 * (double)i);
    }
    make_accelerations(s->pool, by, n, in, out);
    assert_int_equal(qdot_tape_new(s->pool, 2 * AXES * n, in, AXES * n, out, &tape), QDOT_OK);
    assert_int_equal(qdot_program_begin(2 * AXES * n, 2 * AXES * n, false, &s->motion.program, &b), QDOT_OK);
    for (size_t i = 0; i < 2 * AXES * n; i++)
        rows[i] = (qdot_program_row)i;
    qdot_program_append(b, tape, rows, values);
    for (size_t i = 0; i < AXES * n && status == QDOT_OK; i++) {
        status = qdot_vec_push(&s->motion.program.outputs, values[i]);
        if (status == QDOT_OK)
            status = qdot_motion_give(&s->motion, values[i], (qdot_program_row)(AXES * n + i), (qdot_program_row)i);
    }
    assert_int_equal(qdot_motion_complete(&s->motion, b, status), QDOT_OK);
    assert_int_equal(qdot_alike_find(&s->motion), QDOT_OK);
    qdot_tape_free(tape);
}

static void
clear_scene(scene *s)
{
    qdot_motion_clear(&s->motion);
    qdot_pool_free(s->pool);
}

static void
set_start(const scene *s, qdot_taylor *taylor, double unit)
{
    const size_t n = AXES * s->n;

    for (size_t i = 0; i < 2 * n; i++)
        qdot_taylor_input(taylor, i)[0] = s->start[i];
    for (size_t i = 0; i < n; i++)
        qdot_taylor_input(taylor, i)[1] = unit * s->start[n + i];
}

/* The series of both executors agree within some roundings of the largest coefficient of their order. */
static void
assert_same_series(const scene *s)
{
    const double unit = 0.01;
    qdot_taylor *steps, *parts;
    qdot_taylor_alike *alike;

    assert_int_equal(qdot_taylor_of_motion(&s->motion, false, ORDERS, 0, &steps), QDOT_OK);
    assert_int_equal(qdot_taylor_of_motion(&s->motion, false, ORDERS, 0, &parts), QDOT_OK);
    assert_int_equal(qdot_taylor_alike_new(&s->motion, parts, &alike), QDOT_OK);
    set_start(s, steps, unit);
    set_start(s, parts, unit);
    qdot_taylor_begin(steps, unit);
    qdot_taylor_extend(steps, 1, ORDERS - 2);
    qdot_taylor_alike_begin(alike, unit);
    qdot_taylor_alike_extend(alike, 1, ORDERS - 2);
    for (int k = 0; k < ORDERS; k++) {
        double largest = 0;

        for (size_t i = 0; i < AXES * s->n; i++)
            largest = fmax(largest, fabs(qdot_taylor_input(steps, i)[k]));
        for (size_t i = 0; i < AXES * s->n; i++) {
            assert_true(fabs(qdot_taylor_input(steps, i)[k] - qdot_taylor_input(parts, i)[k]) <= 1e-12 * largest);
            if (k < ORDERS - 1)
                assert_true(fabs(qdot_taylor_output(steps, i)[k] - qdot_taylor_output(parts, i)[k]) <=
                            1e-10 * (k + 1) * (k + 2) * largest / unit / unit);
        }
    }
    assert_true(fabs(qdot_taylor_near(steps, ORDERS - 2, 2, 0) / qdot_taylor_alike_near(alike, ORDERS - 2, 2, 0) - 1) <
                0.7);
    qdot_taylor_alike_free(alike);
    qdot_taylor_free(steps);
    qdot_taylor_free(parts);
}

/* Pairs of points are one kind, whose rows of all orders do not depend on their number; sums have two terms for
 * each pair and axis, and one for the constant force. */
static void
pairs_are_one_kind(void **state)
{
    static const size_t numbers[] = {6, 12, MOST_POINTS};

    (void)state;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const size_t n = numbers[i], pairs = n * (n - 1) / 2;
        const qdot_alike_kind *kind;
        scene s;

        make_scene(&s, GRAVITY, n);
        assert_non_null(s.motion.alike);
        assert_int_equal(s.motion.alike->kinds.n, 1);
        kind = s.motion.alike->kinds.at;
        assert_int_equal(kind->parts, pairs);
        assert_int_equal(kind->orders, 5); /* three differences, r^2, 1/r^3 */
        assert_true(kind->convolutions == 5.5);
        assert_true(kind->steps.n <= 9);
        assert_true(s.motion.alike->terms.n <= 2 * AXES * pairs + AXES * n);
        clear_scene(&s);
    }
}

static void
few_parts_are_none(void **state)
{
    scene s;

    (void)state;
    make_scene(&s, GRAVITY, 3);
    assert_null(s.motion.alike);
    clear_scene(&s);
}

static void
series_are_those_of_the_steps(void **state)
{
    (void)state;
    for (size_t kind = 0; kind <= 2; kind++) {
        qdot_kind_limit(kind);
        for (law by = GRAVITY; by <= SCREENED; by++) {
            scene s;

            make_scene(&s, by, 7);
            assert_non_null(s.motion.alike);
            assert_same_series(&s);
            clear_scene(&s);
        }
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_one_kind),
        cmocka_unit_test(few_parts_are_none),
        cmocka_unit_test(series_are_those_of_the_steps),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
