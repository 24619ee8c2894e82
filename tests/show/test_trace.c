/* test_trace.c -- points of curves: no corner is seen where there is none. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include "base/memory.h"
#include "show/trace.h"

/* (s, f(s)) of one of a few functions. */
typedef double function(double s);

static qdot_status
values_of(void *user, size_t n, const double *s, double *values)
{
    function *const *f = user;

    for (size_t k = 0; k < n; k++) {
        values[k] = s[k];
        values[n + k] = (*f)(s[k]);
    }
    return QDOT_OK;
}

static double
peak(double s)
{
    return 1 / (1 + 1e4 * (s - 0.3) * (s - 0.3));
}

static double
straight(double s)
{
    return 2 * s - 1;
}

static double
corner(double s)
{
    return fabs(s - 0.3);
}

static double
pole(double s)
{
    return 1 / (s - 0.3);
}

/* The points of f over 0..1 in a figure of 12 cm x 6 cm. */
static qdot_trace
trace(function *f, double least, double most, bool jumps)
{
    enum { FIRST = 12 };
    const qdot_trace_source source = {
        .axes = 2, .values = values_of, .user = &f, .jumps = jumps};
    const qdot_figure_view view = {
        .least = {0, least}, .most = {1, most}, .length = {12, 6}};
    double s[FIRST];
    qdot_trace points;

    for (int k = 0; k < FIRST; k++)
        s[k] = k / (double)(FIRST - 1);
    assert_int_equal(qdot_trace_begin(&source, FIRST, s, &points), QDOT_OK);
    assert_int_equal(qdot_trace_refine(&source, &view, &points), QDOT_OK);
    return points;
}

/* The largest turn of the line, in radians, where its segments are longer than 0.2 mm. */
static double
largest_turn(const qdot_trace *p, double height)
{
    double most = 0;

    for (size_t k = 1; k + 1 < p->n; k++) {
        double ax = 12 * (p->at[0][k] - p->at[0][k - 1]), bx = 12 * (p->at[0][k + 1] - p->at[0][k]);
        double ay = 6 * (p->at[1][k] - p->at[1][k - 1]) / height;
        double by = 6 * (p->at[1][k + 1] - p->at[1][k]) / height;

        if (hypot(ax, ay) > 0.02 || hypot(bx, by) > 0.02)
            most = fmax(most, fabs(atan2(ax * by - ay * bx, ax * bx + ay * by)));
    }
    return most;
}

static void
a_narrow_peak_has_no_corners(void **state)
{
    qdot_trace p = trace(peak, 0, 1, false);
    double top = 0;

    (void)state;
    for (size_t k = 0; k < p.n; k++)
        top = fmax(top, p.at[1][k]);
    assert_true(top > 0.999);
    assert_true(p.n > 60 && p.n < 400);
    assert_true(largest_turn(&p, 1) < 0.0601);
    qdot_trace_clear(&p);
}

static void
a_straight_line_needs_no_more_points(void **state)
{
    qdot_trace p = trace(straight, -1, 1, false);

    (void)state;
    assert_int_equal(p.n, 12);
    qdot_trace_clear(&p);
}

static void
a_corner_is_met_to_a_fifth_of_a_millimetre(void **state)
{
    qdot_trace p = trace(corner, 0, 1, false);
    double nearest = 1;

    (void)state;
    for (size_t k = 0; k < p.n; k++)
        nearest = fmin(nearest, fabs(p.at[0][k] - 0.3));
    assert_true(12 * nearest < 0.02);
    assert_true(p.n < 60);
    qdot_trace_clear(&p);
}

static void
a_pole_breaks_the_line(void **state)
{
    qdot_trace p = trace(pole, -50, 50, true);
    size_t breaks = 0;

    (void)state;
    for (size_t k = 0; k < p.n; k++)
        breaks += isnan(p.at[1][k]);
    assert_int_equal(breaks, 1);
    qdot_trace_clear(&p);
    p = trace(pole, -50, 50, false); /* along a run it may be a jump that happened */
    for (size_t k = 0; k < p.n; k++)
        assert_false(isnan(p.at[1][k]));
    qdot_trace_clear(&p);
}

/* Noise cannot be resolved. */
static double
noise(double s)
{
    return fmod(fabs(sin(12345.678 * s) * 98765.4321), 1);
}

static void
noise_ends_in_bounded_points(void **state)
{
    qdot_trace p = trace(noise, 0, 1, false);

    (void)state;
    assert_true(p.n <= QDOT_TRACE_MOST);
    qdot_trace_clear(&p);
}

static void
no_memory_is_an_error(void **state)
{
    function *f = peak;
    const qdot_trace_source source = {.axes = 2, .values = values_of, .user = &f};
    const qdot_figure_view view = {.most = {1, 1}, .length = {12, 6}};
    const double s[] = {0, 0.2, 0.3, 1};
    qdot_status status = QDOT_ENOMEM;

    (void)state;
    for (int64_t n = 0; status != QDOT_OK; n++) {
        qdot_trace p;

        qdot_memory_fail_at(n);
        status = qdot_trace_begin(&source, 4, s, &p);
        if (status == QDOT_OK)
            status = qdot_trace_refine(&source, &view, &p);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_trace_clear(&p);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_narrow_peak_has_no_corners),
        cmocka_unit_test(a_straight_line_needs_no_more_points),
        cmocka_unit_test(a_corner_is_met_to_a_fifth_of_a_millimetre),
        cmocka_unit_test(a_pole_breaks_the_line),
        cmocka_unit_test(noise_ends_in_bounded_points),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
