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

    (void)state;
    assert_int_equal(qdot_past_new(2, called, &h), QDOT_OK);
    assert_true(isnan(past_at(7, 0)));
    qdot_past_read(h);
    assert_int_equal(qdot_past_begin(h, 1, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1, 0.5, 2, 1.5, first, 3), QDOT_OK);
    assert_true(past_at(7, 0.3) == 2.385 && past_at(4000000000u, -40) == -1);
    qdot_past_reach(h, 1.5);
    assert_float_equal(past_at(7, 1.5), 2.385 + 0.5 + 0.25, 1e-15);
    assert_float_equal(past_at(4000000000u, 1.25), -1 + 1.5, 1e-15);
    assert_true(isnan(past_at(7, 1.6)));
    assert_int_equal(qdot_past_add(h, 1.5, 1, 2, 2.5, first, 3), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1.5, 2, 2, 3.5, other, 3), QDOT_OK);
    qdot_past_reach(h, 3);
    assert_float_equal(past_at(7, 2.5), 3.135 + 0.5, 1e-15);
    assert_true(isnan(past_at(8, 2)));
    qdot_past_free(h);
    assert_true(isnan(past_at(7, 2)));
}

enum { DEGREE = 20 };

/* Make the step of exp(-u), one unknown, from t to t + h. */
static void
add_decay(qdot_past *p, double t, double h)
{
    double x[DEGREE + 1] = {exp(-t)};

    for (int k = 1; k <= DEGREE; k++)
        x[k] = -x[k - 1] / k;
    assert_int_equal(qdot_past_add(p, t, 1, DEGREE, t + 1.5, x, DEGREE + 1), QDOT_OK);
    qdot_past_reach(p, t + h);
}

/* Two delays, and a breaking point at the start, where x'' jumps: steps end at its sums with delays, up to the order of the series,
 * and at no ends of earlier steps. Here x is the same function throughout, so all jumps but that at the start are not seen. */
static void
steps_end_at_breaking_points(void **state)
{
    const uint32_t called[] = {7};
    const double start[] = {1};
    qdot_past *h;

    (void)state;
    assert_int_equal(qdot_past_new(1, called, &h), QDOT_OK);
    qdot_past_read(h);
    assert_int_equal(qdot_past_delay(h, 1, 2), QDOT_OK);
    assert_int_equal(qdot_past_delay(h, 1.25, 2), QDOT_OK);
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_float_equal(qdot_past_next(h, 0), 1, 1e-14);
    add_decay(h, 0, 0.75);
    assert_float_equal(qdot_past_next(h, 0.75), 1, 1e-14);
    add_decay(h, 0.75, 0.25);
    {
        const double one = qdot_past_next(h, 0.75);

        assert_true(one > 1);
        /* there the jump at the start is behind by a time 1, and ahead by 1.25 */
        add_decay(h, one, 0.2);
        assert_float_equal(qdot_past_next(h, one), 1.25, 1e-14);
        /* neither at 1.75, where the first step ended, nor at 2, as what began at 1 was not seen: the delay is the longest step */
        add_decay(h, 1.2, 0.4);
        assert_float_equal(qdot_past_next(h, 1.6), 2.6, 1e-14);
        assert_true(qdot_past_is_smooth((double)qdot_past_piece(7), 0.7, 0.3));
        assert_false(qdot_past_is_smooth((double)qdot_past_piece(7), 0.1, 0.2));
    }
    qdot_past_free(h);
}

/* Expanded at t, the series that holds longest is read, from before its begin: of 0.7 the one that begins at 0.75. */
static void
steps_read_the_series_that_holds_longest(void **state)
{
    const uint32_t called[] = {7};
    const double start[] = {1};
    qdot_past *h;

    (void)state;
    assert_int_equal(qdot_past_new(1, called, &h), QDOT_OK);
    qdot_past_read(h);
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    add_decay(h, 0, 0.75);
    add_decay(h, 0.75, 0.75);
    assert_true(qdot_past_lookup((double)qdot_past_piece(7), 0.7) == 1);
    qdot_past_expand(h, 1.5);
    assert_true(qdot_past_lookup((double)qdot_past_piece(7), 0.7) == 2);
    assert_float_equal(past_at(7, 0.7), exp(-0.7), 1e-15);
    qdot_past_expand(h, 0.75); /* it did not exist then */
    assert_true(qdot_past_lookup((double)qdot_past_piece(7), 0.7) == 1);
    qdot_past_free(h);
}

/* The unknown jumps from 2 to 1 where a step begins, which is said to be a breaking point: equations that read it end a step before and
 * behind it. */
static void
jumps_are_seen(void **state)
{
    const uint32_t called[] = {7};
    const double start[] = {1}, first[] = {1, 1}, same[] = {2, 1}, other[] = {1, 0};
    qdot_past *h;

    (void)state;
    assert_int_equal(qdot_past_new(1, called, &h), QDOT_OK);
    assert_int_equal(qdot_past_delay(h, 1.5, 2), QDOT_OK);
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 0, 1, 1, 2, first, 2), QDOT_OK);
    qdot_past_reach(h, 1);
    qdot_past_restart(h, 1); /* an event that changes nothing is no breaking point */
    assert_int_equal(qdot_past_add(h, 1, 1, 1, 2, same, 2), QDOT_OK);
    qdot_past_reach(h, 1.25);
    qdot_past_restart(h, 1.25);
    assert_int_equal(qdot_past_add(h, 1.25, 1, 1, 4, other, 2), QDOT_OK);
    qdot_past_reach(h, 2.5);
    assert_float_equal(qdot_past_next(h, 2.25), 2.75, 1e-14);
    assert_true(qdot_past_next(h, 2.25) < 2.75);
    assert_true(qdot_past_next(h, qdot_past_next(h, 2.25)) > 2.75);
    qdot_past_free(h);
}

/* A step of some roundings, over a jump at 1, is no piece: the one before goes on to its end, where the unknown jumps. */
static void
short_steps_leave_no_piece(void **state)
{
    const uint32_t called[] = {7};
    const double start[] = {0}, first[] = {0, 1}, over[] = {1, 1}, behind[] = {5, 2}, end = 1 + 1e-14;
    qdot_past *h;

    (void)state;
    assert_int_equal(qdot_past_new(1, called, &h), QDOT_OK);
    qdot_past_read(h);
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 0, 1, 1, 1, first, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1, 1e-14, 1, end, over, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, end, 1, 1, 2, behind, 2), QDOT_OK);
    qdot_past_reach(h, 2);
    assert_true(qdot_past_lookup((double)qdot_past_piece(7), 1 + 5e-15) == 1);
    assert_float_equal(past_at(7, 1.5), 5 + 2 * (1.5 - end), 1e-15);
    /* the first step of a run is one, however short */
    assert_int_equal(qdot_past_begin(h, 0, start), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 0, 1e-18, 1, 1e-18, first, 2), QDOT_OK);
    assert_int_equal(qdot_past_add(h, 1e-18, 1, 1, 1, behind, 2), QDOT_OK);
    assert_true(qdot_past_lookup((double)qdot_past_piece(7), 0) == 1);
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
        cmocka_unit_test(steps_end_at_breaking_points),
        cmocka_unit_test(steps_read_the_series_that_holds_longest),
        cmocka_unit_test(jumps_are_seen),
        cmocka_unit_test(short_steps_leave_no_piece),
        cmocka_unit_test(values_are_told_by_their_handles),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
