/* test_near.c -- steps that keep arguments of exponentials near. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "series/near.h"

static void
what_is_near_may_go_by_the_order(void **state)
{
    (void)state;
    assert_true(qdot_near_limit(31, 0, 37) == 16);
    assert_true(qdot_near_limit(31, -70, 37) == 16);
    assert_true(qdot_near_limit(31, 400, 37) == 343);
    assert_true(qdot_near_limit(31, -400, 37) == 343);
}

/* u = 400 - 3 s - 2 s^2: 3 s + 2 s^2 = 343 */
static void
the_sum_is_the_limit(void **state)
{
    const double sizes[] = {0, log2(3), 1, -INFINITY, -INFINITY};
    const double s = (-3 + sqrt(9 + 8 * 343.0)) / 4;

    (void)state;
    assert_true(fabs(exp2(qdot_near_log2(4, sizes, 343, INFINITY)) / s - 1) < 1e-4);
    assert_true(qdot_near_log2(4, sizes, 343, 1) == 1); /* a shorter one is as it was */
}

static void
what_does_not_move_bounds_nothing(void **state)
{
    const double sizes[] = {9, -INFINITY, -INFINITY};

    (void)state;
    assert_true(qdot_near_log2(2, sizes, 16, INFINITY) == INFINITY);
}

/* b = (1 - s)^2 + w^2 */
static void
a_divisor_may_fall_to_an_eighth(void **state)
{
    const double w = 1e-6, b[] = {1 + w * w, -2, 1};
    const double s = qdot_near_divisor(2, b, false, 5);

    (void)state;
    assert_true(qdot_near_may_fall(2, b, 5));
    assert_true(s > 0.2 && (1 - s) * (1 - s) >= QDOT_NEAR_LEFT);
    assert_false(qdot_near_may_fall(2, b, 0.2));
    assert_true(qdot_near_divisor(2, b, false, INFINITY) < 1);
}

/* It may grow as it likes, and fall as long as some is left. */
static void
a_divisor_that_grows_bounds_little(void **state)
{
    const double grows[] = {1, 2, 1}, falls[] = {4, -1, 0}, still[] = {3, 0, 0};

    (void)state;
    assert_true(qdot_near_divisor(2, grows, false, 1.5) == 1.5);
    assert_true(qdot_near_divisor(2, falls, false, 3) == 3);
    assert_false(qdot_near_may_fall(2, still, 1e9));
    assert_true(qdot_near_divisor(2, falls, true, 8) == 8);
    assert_true(qdot_near_divisor(2, falls, false, 8) < 4);
}

/* 1/(1 - s) at 2, sin s at 1 */
static void
a_quotient_that_diverges_is_told(void **state)
{
    const double pole[] = {1, 1, 1, 1, 1}, sine[] = {0, 1, 0, -1.0 / 6, 0};

    (void)state;
    assert_true(qdot_near_diverges(4, pole, 2));
    assert_false(qdot_near_diverges(4, pole, 0.5));
    assert_false(qdot_near_diverges(4, sine, 1));
}

/* u = 3 + s/8, and the same with a cubic term that is hardly there: the knot at 3.01 is passed by roundings of u. */
static void
a_step_ends_behind_a_knot(void **state)
{
    const double forwards[] = {3, 0.125, 0, 0}, backwards[] = {3, -0.125, 0, 0}, bent[] = {3, 0.125, 0, 1e-12};
    const double s = qdot_near_knot(3, forwards, 3, 3.01, 1), back = qdot_near_knot(3, backwards, 2.99, 3.01, 1);

    (void)state;
    assert_true(3 + s / 8 >= 3.01 && 3 + s / 8 < 3.01 + 1e-14);
    assert_true(3 - back / 8 < 2.99 && 3 - back / 8 > 2.99 - 1e-14);
    assert_true(fabs(qdot_near_knot(3, bent, 3, 3.01, 1) - s) < 1e-12);
    assert_true(qdot_near_knot(3, forwards, 3, 3.01, 0.07) == 0.07);
    assert_true(qdot_near_knot(3, forwards, 3, INFINITY, INFINITY) == INFINITY);
    assert_true(qdot_near_knot(3, (const double[]){3, 0, 0, 0}, 3, 3.01, 5) == 5);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_near_may_go_by_the_order),
        cmocka_unit_test(the_sum_is_the_limit),
        cmocka_unit_test(what_does_not_move_bounds_nothing),
        cmocka_unit_test(a_divisor_may_fall_to_an_eighth),
        cmocka_unit_test(a_divisor_that_grows_bounds_little),
        cmocka_unit_test(a_quotient_that_diverges_is_told),
        cmocka_unit_test(a_step_ends_behind_a_knot),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
