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

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_near_may_go_by_the_order),
        cmocka_unit_test(the_sum_is_the_limit),
        cmocka_unit_test(what_does_not_move_bounds_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
