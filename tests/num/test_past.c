#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/past.h"

/* The unknown that is called so, at u, as equations read it. */
static double
past_at(uint32_t called, double u)
{
    const double piece = qdot_past_lookup((double)qdot_past_piece(called), u);
    const double w = (u - qdot_past_lookup((double)qdot_past_knot(called), piece)) *
                     qdot_past_lookup((double)qdot_past_rate(called), piece);
    double y = 0;

    for (int k = QDOT_PAST_ORDER; k >= 0; k--)
        y = y * w + qdot_past_lookup((double)qdot_past_coefficient(called, k), piece);
    return y;
}

/* Before the start the values of the start, then the series of each step; from another step at the same time on, that one. */
static void
is_what_the_steps_were(void **state)
{
    const uint32_t called[] = {7, 4000000000u};
    const double start[] = {2.385, -1}, first[] = {2.385, 0.5, 0.25, -1, 3, 0}, other[] = {3.135, 1, 0, 1, 2, 0};
    qdot_past *h;
    double lo, hi;

    (void)state;
    assert_int_equal(qdot_past_new(2, called, &h), QDOT_OK);
    assert_true(isnan(past_at(7, 0)));
    qdot_past_read(h);
    assert_int_equal(qdot_past_begin(h, 1, start), QDOT_OK);
    qdot_past_bounds(0.3, &lo, &hi);
    assert_true(isinf(lo) && hi == 1);
    assert_int_equal(qdot_past_add(h, 1, 0.5, 2, first, 3), QDOT_OK);
    assert_true(past_at(7, 0.3) == 2.385 && past_at(4000000000u, -40) == -1);
    assert_float_equal(past_at(7, 1.5), 2.385 + 0.5 + 0.25, 1e-15);
    assert_float_equal(past_at(4000000000u, 1.25), -1 + 1.5, 1e-15);
    qdot_past_reach(h, 1.5);
    assert_int_equal(qdot_past_add(h, 1.5, 1, 2, first, 3), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1.5, 2, 2, other, 3), QDOT_OK);
    assert_float_equal(past_at(7, 2.5), 3.135 + 0.5, 1e-15);
    qdot_past_bounds(1.2, &lo, &hi);
    assert_true(lo == 1 && hi == 1.5);
    qdot_past_reach(h, 3);
    qdot_past_bounds(2, &lo, &hi);
    assert_true(lo == 1.5 && hi == 3);
    assert_true(isnan(past_at(8, 2)));
    qdot_past_free(h);
    assert_true(isnan(past_at(7, 2)));
}

/* The second unknown jumps from 2 to 1 where the second step begins: equations that read it end a step there. */
static void
jumps_are_seen(void **state)
{
    const uint32_t called[] = {7, 9};
    const double start[] = {1, -1}, first[] = {1, 1, -1, 3}, same[] = {2, 1, 2, 0}, other[] = {3, 1, 1, 0};
    qdot_past *h;

    (void)state;
    assert_int_equal(qdot_past_new(2, called, &h), QDOT_OK);
    qdot_past_read(h);
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 0, 1, 1, first, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1, 1, 1, same, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 2, 1, 1, other, 2), QDOT_OK);
    assert_true(qdot_past_jumps(-1));
    assert_false(qdot_past_jumps(0.5));
    assert_true(qdot_past_jumps(1.5));
    qdot_past_free(h);
}

/* A step of some roundings, over a jump at 1, is no piece: the one before goes on to its end, where the unknown jumps. */
static void
short_steps_leave_no_piece(void **state)
{
    const uint32_t called[] = {7};
    const double start[] = {0}, first[] = {0, 1}, over[] = {1, 1}, behind[] = {5, 2}, end = 1 + 1e-14;
    qdot_past *h;
    double lo, hi;

    (void)state;
    assert_int_equal(qdot_past_new(1, called, &h), QDOT_OK);
    qdot_past_read(h);
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 0, 1, 1, first, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1, 1e-14, 1, over, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, end, 1, 1, behind, 2), QDOT_OK);
    qdot_past_reach(h, 2);
    qdot_past_bounds(0.5, &lo, &hi);
    assert_true(lo == 0 && hi == end);
    assert_true(qdot_past_jumps(0.5));
    assert_float_equal(past_at(7, 1.5), 5 + 2 * (1.5 - end), 1e-15);
    /* the first step of a run is one, however short */
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 0, 1e-18, 1, first, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1e-18, 1, 1, behind, 2), QDOT_OK);
    qdot_past_bounds(0, &lo, &hi);
    assert_true(lo == 0 && hi == 1e-18);
    qdot_past_free(h);
}

/* Of all handles only that of c_0 is that of an unknown's value. */
static void
values_are_told_by_their_handles(void **state)
{
    uint32_t called = 0;

    (void)state;
    assert_true(qdot_past_is_value((double)qdot_past_coefficient(4000000000u, 0), &called));
    assert_int_equal(called, 4000000000u);
    assert_false(qdot_past_is_value((double)qdot_past_coefficient(7, 1), &called));
    assert_false(qdot_past_is_value((double)qdot_past_piece(7), &called));
    assert_false(qdot_past_is_value(3, &called));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_what_the_steps_were),
        cmocka_unit_test(jumps_are_seen),
        cmocka_unit_test(short_steps_leave_no_piece),
        cmocka_unit_test(values_are_told_by_their_handles),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
