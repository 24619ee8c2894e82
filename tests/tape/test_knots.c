#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "expr/expr.h"
#include "num/samples.h"
#include "tape/knots.h"

static const double x[] = {0, 1, 2.5, 4}, f[] = {1, 0.5, 2, -1};

static int64_t
piece_of_table(int degree, qdot_samples_beyond beyond)
{
    int number;

    assert_int_equal(qdot_samples_add(&(qdot_samples_given){.axes = 1,
                                                            .n = {4, 0},
                                                            .knots = {x, NULL},
                                                            .values = f,
                                                            .degree = degree,
                                                            .beyond = beyond},
                                      &number),
                     QDOT_OK);
    return qdot_samples_piece(number, 0);
}

/* A tape that reads a table at a + b t; its knots. */
static void
read_at_line(double a, double b, int64_t handle, qdot_knots *knots)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr inputs[] = {QDOT_T};
    const qdot_expr u = qdot_add(pool, qdot_expr_ratio(pool, (int64_t)(a * 8), 8),
                                 qdot_mul(pool, qdot_expr_ratio(pool, (int64_t)(b * 8), 8), QDOT_T));
    const qdot_expr e = qdot_fun(pool, QDOT_LOOKUP, 2, (qdot_expr[]){u, qdot_expr_int(pool, handle)});
    qdot_tape *tape;

    assert_int_equal(qdot_tape_new(pool, 1, inputs, 1, &e, &tape), QDOT_OK);
    assert_true(qdot_knots_any(tape));
    assert_int_equal(qdot_knots_find(tape, 0, knots), QDOT_OK);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* Of the time itself knots are met exactly: there the next piece is read, and not before. */
static void
knots_of_time_are_exact(void **state)
{
    const int64_t handle = piece_of_table(3, QDOT_SAMPLES_HOLD);
    qdot_knots knots = {0};

    (void)state;
    read_at_line(0, 1, handle, &knots);
    assert_int_equal(knots.n, 1);
    assert_true(qdot_knots_next(knots.n, knots.at, 0.3, 1) == 1);
    assert_true(qdot_knots_next(knots.n, knots.at, 1, 1) == 2.5);
    assert_true(isinf(qdot_knots_next(knots.n, knots.at, 4, 1)));
    assert_true(qdot_knots_next(knots.n, knots.at, 2.5, -1) == nextafter(2.5, 0));
    assert_true(qdot_knots_next(knots.n, knots.at, nextafter(2.5, 0), -1) == nextafter(1, 0));
    assert_true(isinf(qdot_knots_next(knots.n, knots.at, nextafter(0, -1), -1)));
    qdot_free(knots.at);
}

/* Of a + b t the time is behind the knot, by some roundings. */
static void
knots_of_lines_are_passed(void **state)
{
    static const double lines[][2] = {{0.25, 1}, {-3, 0.125}, {5, -2}, {100, -1}};
    const int64_t handle = piece_of_table(1, QDOT_SAMPLES_PERIODIC);

    (void)state;
    for (size_t k = 0; k < 4; k++)
        for (int direction = -1; direction <= 1; direction += 2) {
            const double a = lines[k][0], b = lines[k][1];
            qdot_knots knots = {0};
            double t = 0.377;

            read_at_line(a, b, handle, &knots);
            for (int i = 0; i < 20; i++) {
                const double next = qdot_knots_next(knots.n, knots.at, t, direction), step = next - t;

                assert_true(direction * step > 0);
                assert_true(qdot_samples_lookup((double)handle, a + b * next) ==
                            qdot_samples_lookup((double)handle, a + b * t) + (b * direction > 0 ? 1 : -1));
                assert_true(qdot_samples_lookup((double)handle, a + b * (t + 0.999 * step)) ==
                            qdot_samples_lookup((double)handle, a + b * t));
                t = next;
            }
            qdot_free(knots.at);
        }
}

/* A table that jumps has the double before its knot, too. */
static void
jumps_have_two_times(void **state)
{
    qdot_knots knots = {0};

    (void)state;
    read_at_line(0, 1, piece_of_table(0, QDOT_SAMPLES_HOLD), &knots);
    assert_true(qdot_knots_next(knots.n, knots.at, 0.3, 1) == nextafter(1, 0));
    assert_true(qdot_knots_next(knots.n, knots.at, nextafter(1, 0), 1) == 1);
    assert_true(qdot_knots_next(knots.n, knots.at, 2, -1) == 1);
    assert_true(qdot_knots_next(knots.n, knots.at, 1, -1) == nextafter(1, 0));
    qdot_free(knots.at);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(knots_of_time_are_exact),
        cmocka_unit_test(knots_of_lines_are_passed),
        cmocka_unit_test(jumps_have_two_times),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
