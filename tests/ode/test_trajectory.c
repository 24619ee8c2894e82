#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "base/interrupt.h"
#include "ode/failing.h"

/* The pendulum from its start by a row of the table. */
static qdot_status
swing(qdot_trajectory *tr, const char *name, const qdot_ode_options *o, double t0,
      double t1)
{
    return qdot_trajectory_run(tr, &pendulum.system, method(name), o, t0, t1,
                               pendulum.y0);
}

static void
stored_points_are_given_back_bit_by_bit(void **state)
{
    qdot_trajectory tr = {0};
    double y[2];

    (void)state;
    assert_int_equal(swing(&tr, "rk8pd", NULL, 0, 10), QDOT_OK);
    assert_int_equal(tr.count, tr.result.stats.steps + 1);
    assert_true(tr.t[0] == 0 && tr.t[tr.count - 1] == 10 && tr.result.t == 10);
    for (size_t k = 0; k < tr.count; k++) {
        assert_true(k == 0 || tr.t[k] > tr.t[k - 1]);
        assert_int_equal(qdot_trajectory_at(&tr, &pendulum.system, tr.t[k], y), QDOT_OK);
        assert_memory_equal(y, tr.y + 2 * k, sizeof y);
    }
    qdot_trajectory_clear(&tr);
}

/* Between the points, forwards and backwards, every method: no worse than the points. */
static void
any_time_is_as_accurate_as_the_run(void **state)
{
    (void)state;
    srand(11);
    for_each_method(m)
        for (int back = 0; back < 2; back++) {
            double t1 = back ? -12 : 12, y[4], at_points = 0, between = 0;
            qdot_trajectory tr = {0};
            qdot_trajectory_cursor *c;

            assert_int_equal(qdot_trajectory_run(&tr, &henon.system,
                                                 qdot_ode_method_at(m), NULL, 0, t1,
                                                 henon.y0),
                             QDOT_OK);
            assert_int_equal(qdot_trajectory_open(&tr, &henon.system, &c), QDOT_OK);
            for (size_t k = 0; k < tr.count; k += 1 + tr.count / 50)
                at_points = fmax(at_points, true_error(&henon, tr.t[k], tr.y + 4 * k));
            for (int i = 0; i < 100; i++) {
                double t = t1 * rand() / RAND_MAX;

                assert_int_equal(qdot_trajectory_read(c, t, y), QDOT_OK);
                between = fmax(between, true_error(&henon, t, y));
            }
            qdot_trajectory_close(c);
            if (between > 1.5 * at_points + 1e-12)
                fail_msg("%s: %g at points, %g between", qdot_ode_method_at(m)->name,
                         at_points, between);
            qdot_trajectory_clear(&tr);
        }
}

/* One stored step far larger than the tolerance allows: read by many small ones. */
static void
a_step_too_large_is_walked_through(void **state)
{
    qdot_trajectory tr = {0};
    qdot_ode_options o = {.tol = 1e-13, .h_fixed = 2};
    double y[2];

    (void)state;
    assert_int_equal(swing(&tr, "rk8pd", &o, 0, 2), QDOT_OK);
    assert_int_equal(tr.count, 2);
    for (double t = 0.1; t < 2; t += 0.3) {
        assert_int_equal(qdot_trajectory_at(&tr, &pendulum.system, t, y), QDOT_OK);
        assert_true(true_error(&pendulum, t, y) < 1e-12);
    }
    assert_true(true_error(&pendulum, 2, tr.y + 2) > 1e-6);
    qdot_trajectory_clear(&tr);
}

/* Steps of a low order are short: however often one is read, it costs a step of the partner, and two
 * evaluations. */
static void
a_short_step_is_read_by_its_polynomial(void **state)
{
    static const char *const low[] = {"msbdf", "rkf45"};

    (void)state;
    for (size_t m = 0; m < 2; m++) {
        const qdot_ode_options o = {.tol = 1e-12};
        qdot_trajectory tr = {0};
        qdot_trajectory_cursor *c;
        double y[2], at_points = 0, between = 0;

        assert_int_equal(swing(&tr, low[m], &o, 0, 3), QDOT_OK);
        assert_int_equal(qdot_trajectory_open(&tr, &pendulum.system, &c), QDOT_OK);
        for (size_t k = tr.count / 2; k < tr.count / 2 + 40; k++) {
            const uint64_t before = qdot_trajectory_evaluations(c);

            at_points = fmax(at_points, true_error(&pendulum, tr.t[k], tr.y + 2 * k));
            for (int j = 1; j < 20; j++) {
                const double t = tr.t[k] + 0.05 * j * (tr.t[k + 1] - tr.t[k]);

                assert_int_equal(qdot_trajectory_read(c, t, y), QDOT_OK);
                between = fmax(between, true_error(&pendulum, t, y));
            }
            if (qdot_trajectory_evaluations(c) - before > (m ? 16 : 150))
                fail_msg("%s, step %zu: %d evaluations", low[m], k,
                         (int)(qdot_trajectory_evaluations(c) - before));
        }
        if (between > 1.01 * at_points + 2e-12)
            fail_msg("%s: %g at points, %g between", low[m], at_points, between);
        qdot_trajectory_close(c);
        qdot_trajectory_clear(&tr);
    }
}

/* The state does not depend on the questions before, nor on who asks. */
static void
cursor_and_single_query_agree_bit_by_bit(void **state)
{
    qdot_trajectory tr = {0};
    qdot_trajectory_cursor *c;
    double y[2], z[2];

    (void)state;
    assert_int_equal(swing(&tr, "rk8pd", NULL, 1, 9), QDOT_OK);
    assert_int_equal(qdot_trajectory_open(&tr, &pendulum.system, &c), QDOT_OK);
    for (int i = 0; i < 500; i++) {
        double t = i < 300 ? 1 + 8 * i / 299.0 : 1 + 8.0 * rand() / RAND_MAX;

        assert_int_equal(qdot_trajectory_read(c, t, y), QDOT_OK);
        assert_int_equal(qdot_trajectory_at(&tr, &pendulum.system, t, z), QDOT_OK);
        assert_memory_equal(y, z, sizeof y);
    }
    qdot_trajectory_close(c);
    qdot_trajectory_clear(&tr);
}

static void
locate_matches_a_plain_search(void **state)
{
    qdot_trajectory tr = {0};

    (void)state;
    for (int back = 0; back < 2; back++) {
        double sign = back ? -1 : 1;

        assert_int_equal(swing(&tr, "rkf45", NULL, 0, sign), QDOT_OK);
        for (int i = 0; i < 2000; i++) {
            double t = sign * rand() / RAND_MAX;
            size_t want = 0;

            if (i % 3 == 0)
                t = tr.t[rand() % tr.count];
            while (want + 1 < tr.count && sign * tr.t[want + 1] <= sign * t)
                want++;
            assert_int_equal(qdot_trajectory_locate(&tr, t, rand() % (tr.count + 1)),
                             want);
        }
    }
    qdot_trajectory_clear(&tr);
}

static void
times_outside_the_run_are_refused_with_its_range(void **state)
{
    const double outside[] = {-0.5, 10.5, NAN, INFINITY};
    qdot_trajectory tr = {0};
    qdot_trajectory_cursor *c;
    double y[2];

    (void)state;
    assert_int_equal(qdot_trajectory_open(&tr, &pendulum.system, &c), QDOT_EDOMAIN);
    assert_int_equal(swing(&tr, "rk8pd", NULL, 0, 10), QDOT_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(qdot_trajectory_at(&tr, &pendulum.system, outside[i], y),
                         QDOT_EDOMAIN);
        assert_non_null(strstr(qdot_last_error()->message, "covers 0 to 10"));
    }
    qdot_trajectory_clear(&tr);
}

static void
an_interrupted_run_can_be_looked_at(void **state)
{
    qdot_trajectory tr = {0};
    qdot_ode_options o = {.accepted = interrupt_beyond_two};
    double y[2];

    (void)state;
    assert_int_equal(swing(&tr, "rk8pd", &o, 0, 1e9), QDOT_EINTR);
    qdot_interrupt_clear();
    assert_int_equal(tr.result.outcome, QDOT_ODE_FAILED);
    assert_true(tr.t[tr.count - 1] == tr.result.t && tr.result.t > 2);
    assert_int_equal(qdot_trajectory_at(&tr, &pendulum.system, 1.7, y), QDOT_OK);
    assert_true(true_error(&pendulum, 1.7, y) < 1e-10);
    qdot_trajectory_clear(&tr);
}

static void
a_run_goes_on_from_its_own_end(void **state)
{
    qdot_trajectory tr = {0};

    (void)state;
    assert_int_equal(swing(&tr, "rk8pd", NULL, 0, 3), QDOT_OK);
    assert_int_equal(qdot_trajectory_run(&tr, &pendulum.system, method("rk8pd"), NULL, 3,
                                         7, tr.y + 2 * (tr.count - 1)),
                     QDOT_OK);
    assert_true(tr.t[0] == 3);
    assert_true(true_error(&pendulum, 7, tr.y + 2 * (tr.count - 1)) < 1e-10);
    qdot_trajectory_clear(&tr);
}

/* y' = -1e6 (y - cos t) - sin t, see test_integrate.c */
static uint64_t calls;

static qdot_status
counted_stiff(double t, const double *y, double *dydt, void *user)
{
    calls++;
    return stiff(t, y, dydt, user);
}

static void
a_stiff_run_is_read_cheaply(void **state)
{
    qdot_ode_system s = {.n = 1, .rhs = counted_stiff, .jacobian = stiff_jacobian};
    qdot_ode_options o = {.tol = 1e-9};
    double y0 = 1, y;

    (void)state;
    for (size_t m = 3; m < 5; m++) {
        qdot_trajectory tr = {0};
        qdot_trajectory_cursor *c;

        assert_int_equal(qdot_trajectory_run(&tr, &s, qdot_ode_method_at(m), &o, 0, 10,
                                             &y0),
                         QDOT_OK);
        assert_int_equal(qdot_trajectory_open(&tr, &s, &c), QDOT_OK);
        calls = 0;
        for (int i = 1; i < 100; i++) {
            assert_int_equal(qdot_trajectory_read(c, i * 0.0999, &y), QDOT_OK);
            assert_true(fabs(y - cos(i * 0.0999)) < 1e-7);
        }
        assert_true(calls < 100 * 1000);
        qdot_trajectory_close(c);
        qdot_trajectory_clear(&tr);
    }
}

/* t = s + sin s, which stands still at s = pi. */
static qdot_status
clock_rhs(double s, const double *y, double *dydt, void *user)
{
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -sin(s);
    return QDOT_OK;
}

/* s where t = s + sin s. */
static double
true_s(double t)
{
    double a = 0, b = 10;

    for (int i = 0; i < 100; i++) {
        const double middle = (a + b) / 2;

        *(middle + sin(middle) < t ? &a : &b) = middle;
    }
    return a;
}

static void
a_run_is_timed_by_a_component(void **state)
{
    const qdot_ode_system s = {.n = 2, .rhs = clock_rhs};
    const double y0[2] = {0, 2};
    static const char *const methods[] = {"rk8pd", "dop853"};

    (void)state;
    for (size_t m = 0; m < 2; m++) {
        qdot_trajectory tr = {0};
        qdot_trajectory_cursor *c;
        size_t count;

        assert_int_equal(qdot_trajectory_run(&tr, &s, method(methods[m]), NULL, 0, 10, y0),
                         QDOT_OK);
        count = tr.count;
        assert_int_equal(qdot_trajectory_refine(&tr, &s, 3), QDOT_OK);
        assert_int_equal(tr.count, 3 * (count - 1) + 1);
        assert_int_equal(qdot_trajectory_by_clock(&tr, 0), QDOT_OK);
        assert_int_equal(qdot_trajectory_open(&tr, &s, &c), QDOT_OK);
        for (int i = 0; i <= 1000; i++) {
            const double t = 9.4 * i / 1000, wanted = 1 + cos(true_s(t));
            double y[2];

            assert_int_equal(qdot_trajectory_read(c, t, y), QDOT_OK);
            /* dt = s^2 ds/2 about s = pi */
            assert_true(fabs(y[0] - t) < 1e-14 && fabs(y[1] - wanted) < 1e-8);
            if (fabs(t - 3.14) > 0.5)
                assert_true(fabs(y[1] - wanted) < 1e-10);
        }
        qdot_trajectory_close(c);
        qdot_trajectory_clear(&tr);
    }
}

static void
every_failed_allocation_is_told(void **state)
{
    (void)state;
    failed_allocations_are_told(method("rk8pd"));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stored_points_are_given_back_bit_by_bit),
        cmocka_unit_test(any_time_is_as_accurate_as_the_run),
        cmocka_unit_test(a_step_too_large_is_walked_through),
        cmocka_unit_test(a_short_step_is_read_by_its_polynomial),
        cmocka_unit_test(cursor_and_single_query_agree_bit_by_bit),
        cmocka_unit_test(locate_matches_a_plain_search),
        cmocka_unit_test(times_outside_the_run_are_refused_with_its_range),
        cmocka_unit_test(an_interrupted_run_can_be_looked_at),
        cmocka_unit_test(a_run_goes_on_from_its_own_end),
        cmocka_unit_test(a_stiff_run_is_read_cheaply),
        cmocka_unit_test(a_run_is_timed_by_a_component),
        cmocka_unit_test(every_failed_allocation_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
