#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#include <gsl/gsl_odeiv2.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "ode/problems.h"

/* One run of row m of the table. */
static qdot_status
go(const qdot_ode_system *s, size_t m, const qdot_ode_options *o, double t0, double t1,
   double *y, qdot_ode_result *r)
{
    return qdot_ode_integrate(s, qdot_ode_method_at(m), o, t0, t1, y, r);
}

static void
every_method_follows_its_tolerance(void **state)
{
    const problem *const all[] = {&pendulum, &henon, &kepler};

    (void)state;
    for_each_method(m)
        for (int p = 0; p < 3; p++)
            for (double tol = 1e-6; tol > 1e-13; tol /= 100) {
                qdot_ode_options o = {.tol = tol};
                qdot_ode_result r;
                double y[4], error;

                memcpy(y, all[p]->y0, sizeof y);
                assert_int_equal(go(&all[p]->system, m, &o, 0, 10, y, &r), QDOT_OK);
                assert_int_equal(r.outcome, QDOT_ODE_DONE);
                error = true_error(all[p], 10, y);
                if (error > 3e4 * tol)
                    fail_msg("%s, %s, tol %g: error %g", qdot_ode_method_at(m)->name,
                             all[p]->name, tol, error);
            }
}

/* Kepler, e = 0.9, ten periods. */
static void
eccentric_orbit_keeps_its_energy(void **state)
{
    double y[4] = {0.1, 0, 0, sqrt(19)};
    const double energy = 0.5 * y[3] * y[3] - 1 / y[0];
    const problem p = {"", {.n = 4, .rhs = kepler_rhs}, {y[0], 0, 0, y[3]}, kepler_at};
    qdot_ode_options o = {.tol = 1e-14};
    qdot_ode_result r;

    (void)state;
    assert_int_equal(go(&p.system, 0, &o, 0, 65, y, &r), QDOT_OK);
    assert_true(true_error(&p, 65, y) < 1e-10);
    assert_true(fabs(0.5 * (y[2] * y[2] + y[3] * y[3]) - 1 / hypot(y[0], y[1]) - energy) <
                1e-13);
}

static qdot_status
constant(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)y;
    (void)user;
    dydt[0] = 1.0 / 3;
    return QDOT_OK;
}

/* 100,000 increments of 1/3000 to 1000: plain additions lose more than 1e-10. */
static void
additions_do_not_round(void **state)
{
    qdot_ode_system s = {.n = 1, .rhs = constant};
    qdot_ode_options o = {.h_fixed = 1e-3};
    double exact = (double)(1000 + 100 * (long double)(1.0 / 3)), plain = 1000;

    (void)state;
    for (size_t m = 0; m < 2; m++) {
        double y = 1000;
        qdot_ode_result r;

        assert_int_equal(go(&s, m, &o, 0, 100, &y, &r), QDOT_OK);
        assert_int_equal(r.stats.steps, 100000);
        assert_true(fabs(y - exact) <= 2 * 0x1p-43);
    }
    for (int i = 0; i < 100000; i++)
        plain += 1e-3 / 3;
    assert_true(fabs(plain - exact) > 1e-10);
}

static int
gsl_kepler(double t, const double *y, double *dydt, void *user)
{
    return kepler_rhs(t, y, dydt, user);
}

/* The same method and tolerance through GSL's own driver, which adds plainly. */
static void
compensation_pays(void **state)
{
    const problem p = {"", {.n = 4, .rhs = kepler_rhs}, {1, 0, 0, 1}, kepler_at};
    double ours = 0, theirs = 0;

    (void)state;
    for (double t = 400; t < 4000; t *= 1.5) {
        double y[4] = {1, 0, 0, 1}, z[4] = {1, 0, 0, 1}, now = 0;
        qdot_ode_options o = {.tol = 1e-15};
        qdot_ode_result r;
        gsl_odeiv2_system sys = {gsl_kepler, NULL, 4, NULL};
        gsl_odeiv2_driver *d =
            gsl_odeiv2_driver_alloc_y_new(&sys, gsl_odeiv2_step_rk8pd, 1e-3, 1e-15, 0);

        assert_int_equal(go(&p.system, 0, &o, 0, t, y, &r), QDOT_OK);
        assert_int_equal(gsl_odeiv2_driver_apply(d, &now, t, z), 0);
        gsl_odeiv2_driver_free(d);
        ours += log(true_error(&p, t, y)) / 6;
        theirs += log(true_error(&p, t, z)) / 6;
    }
    assert_true(exp(ours) < 0.6 * exp(theirs));
}

static void
backwards_returns_to_the_start(void **state)
{
    double y[4];
    qdot_ode_options o = {.tol = 1e-14};
    qdot_ode_result r;

    (void)state;
    memcpy(y, henon.y0, sizeof y);
    for_each_method(m) {
        double bound = qdot_ode_method_at(m)->multistep ? 1e-7 : 1e-11;

        memcpy(y, henon.y0, sizeof y);
        assert_int_equal(go(&henon.system, m, &o, 0, -7, y, &r), QDOT_OK);
        assert_true(r.t == -7);
        assert_true(true_error(&henon, -7, y) < bound);
        assert_int_equal(go(&henon.system, m, &o, -7, 0, y, &r), QDOT_OK);
        for (int i = 0; i < 4; i++)
            assert_true(fabs(y[i] - henon.y0[i]) < bound);
    }
}

static qdot_status
remember_last(double t, const double *y, bool *stop, void *user)
{
    double *last = user;

    (void)stop;
    assert_true(t != last[0]);
    last[0] = t;
    last[1] = y[0];
    return QDOT_OK;
}

static void
the_end_is_reached_to_the_bit(void **state)
{
    const double ends[] = {0.1, 1.0 / 3, 2 * M_PI, 100.25, 1e-9, 1e-100, -20, 0x1.fffp3};

    (void)state;
    for_each_method(m)
        for (size_t k = 0; k < sizeof ends / sizeof ends[0]; k++) {
            double y[2] = {2, 0}, last[2] = {NAN, NAN};
            qdot_ode_options o = {.tol = 1e-8, .accepted = remember_last, .user = last};
            qdot_ode_result r;

            assert_int_equal(go(&pendulum.system, m, &o, 0, ends[k], y, &r), QDOT_OK);
            assert_true(r.t == ends[k]);
            assert_true(last[0] == ends[k] && last[1] == y[0]);
        }
}

static void
short_and_empty_intervals_work(void **state)
{
    double y[2] = {2, 0};
    qdot_ode_result r;

    (void)state;
    assert_int_equal(go(&pendulum.system, 0, NULL, 3, 3, y, &r), QDOT_OK);
    assert_int_equal(r.outcome, QDOT_ODE_DONE);
    assert_int_equal(r.stats.steps, 0);
    assert_true(y[0] == 2 && r.t == 3);
    assert_int_equal(go(&pendulum.system, 0, NULL, 3, nextafter(3, 4), y, &r), QDOT_OK);
    assert_true(r.t == nextafter(3, 4));
    assert_int_equal(r.stats.steps, 1);
}

static qdot_status
square_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    dfdy[0] = 2 * y[0];
    dfdt[0] = 0;
    return QDOT_OK;
}

/* y' = y^2, y(0) = 1: y = 1/(1 - t). */
static void
a_singularity_is_told_where_it_is(void **state)
{
    qdot_ode_system s = {.n = 1, .rhs = square, .jacobian = square_jacobian};

    (void)state;
    for_each_method(m) {
        double y = 1, told = 0;
        qdot_ode_result r;

        assert_int_equal(go(&s, m, NULL, 0, 2, &y, &r), QDOT_EFAILED);
        assert_int_equal(r.outcome, QDOT_ODE_FAILED);
        assert_true(fabs(r.t - 1) < 1e-6);
        assert_true(isfinite(y) && y > 1e6);
        assert_int_equal(sscanf(r.reason, "stopped at t = %lf:", &told), 1);
        assert_true(told == r.t);
        assert_string_equal(r.reason, qdot_last_error()->message);
        assert_true(r.stats.steps > 0);
    }
}

/* user: what to do beyond t = 1 */
static qdot_status
ends_at_one(double t, const double *y, double *dydt, void *user)
{
    int how = *(int *)user;

    dydt[0] = y[1];
    dydt[1] = -y[0];
    if (t <= 1)
        return QDOT_OK;
    if (how == 0)
        dydt[1] = NAN;
    if (how == 1)
        dydt[0] = INFINITY;
    if (how == 2)
        return qdot_fail(QDOT_EDOMAIN, "sqrt of a negative number");
    if (how == 3)
        return qdot_fail(QDOT_ESINGULAR, "M is singular: theta has no inertia");
    return how == 4 ? qdot_fail(QDOT_EUNSET, "k has no value") : QDOT_OK;
}

static void
an_undefined_right_hand_side_is_approached_and_told(void **state)
{
    static const char *const words[] = {"not finite", "not finite", "negative",
                                        "no inertia"};

    (void)state;
    for (size_t m = 0; m < 3; m++) /* those without a Jacobian */
        for (int how = 0; how < 4; how++) {
            double y[2] = {0, 1};
            qdot_ode_system s = {.n = 2, .rhs = ends_at_one, .user = &how};
            qdot_ode_result r;

            assert_int_equal(go(&s, m, NULL, 0, 5, y, &r), QDOT_EFAILED);
            assert_true(r.t <= 1 && r.t > 1 - 1e-9);
            assert_true(fabs(y[0] - sin(r.t)) < 1e-8 && fabs(y[1] - cos(r.t)) < 1e-8);
            if (!strstr(r.reason, words[how]))
                fail_msg("%s: %s", qdot_ode_method_at(m)->name, r.reason);
            assert_non_null(strstr(r.reason, "stopped at t = "));
        }
}

static void
another_failure_ends_the_run_at_once(void **state)
{
    double y[2] = {0, 1};
    int how = 4;
    qdot_ode_system s = {.n = 2, .rhs = ends_at_one, .user = &how};
    qdot_ode_result r;

    (void)state;
    assert_int_equal(go(&s, 0, NULL, 0, 5, y, &r), QDOT_EUNSET);
    assert_string_equal(r.reason, "k has no value");
    assert_true(r.t > 0 && r.t <= 1 && fabs(y[0] - sin(r.t)) < 1e-9);
}

static void
a_start_where_nothing_is_defined_fails_there(void **state)
{
    double y[2] = {0, 1};
    int how = 0;
    qdot_ode_system s = {.n = 2, .rhs = ends_at_one, .user = &how};
    qdot_ode_result r;

    (void)state;
    assert_int_equal(go(&s, 0, NULL, 2, 5, y, &r), QDOT_EFAILED);
    assert_true(r.t == 2 && y[0] == 0 && y[1] == 1);
    assert_int_equal(r.stats.steps, 0);
}

static void
an_interrupt_keeps_the_run_so_far(void **state)
{
    double y[2] = {2, 0};
    qdot_ode_options o = {.accepted = interrupt_beyond_two};
    qdot_ode_result r;

    (void)state;
    assert_int_equal(go(&pendulum.system, 0, &o, 0, 1e9, y, &r), QDOT_EINTR);
    qdot_interrupt_clear();
    assert_int_equal(r.outcome, QDOT_ODE_FAILED);
    assert_true(r.t > 2 && r.t < 3);
    assert_true(true_error(&pendulum, r.t, y) < 1e-10);
}

/* user: 0 stop beyond 2, 1 leave the domain beyond 2, 2 fail there */
static qdot_status
object_beyond_two(double t, const double *y, bool *stop, void *user)
{
    (void)y;
    if (t <= 2)
        return QDOT_OK;
    if (*(int *)user == 1)
        return qdot_fail(QDOT_EDOMAIN, "r left its domain r > 0");
    if (*(int *)user == 2)
        return qdot_fail(QDOT_ELIMIT, "enough");
    *stop = true;
    return QDOT_OK;
}

static void
the_caller_can_stop_limit_and_end_a_run(void **state)
{
    (void)state;
    for_each_method(m) {
        double y[2];
        int how;
        qdot_ode_options o = {.accepted = object_beyond_two, .user = &how};
        qdot_ode_result r;

        for (how = 0; how < 3; how++) {
            const qdot_status want[] = {QDOT_OK, QDOT_EFAILED, QDOT_ELIMIT};

            y[0] = 2;
            y[1] = 0;
            assert_int_equal(go(&pendulum.system, m, &o, 0, 5, y, &r), want[how]);
            assert_int_equal(r.outcome, how == 0 ? QDOT_ODE_STOPPED : QDOT_ODE_FAILED);
            assert_true(how == 0 ? r.t > 2 : r.t <= 2);
            assert_true(how != 1 || r.t > 2 - 1e-9); /* up to the edge of the domain */
            assert_true(true_error(&pendulum, r.t, y) < 1e-6);
        }
    }
}

static void
senseless_arguments_are_refused(void **state)
{
    double y[2] = {2, 0}, bad[2] = {2, NAN};
    qdot_ode_system plain = {.n = 2, .rhs = pendulum_rhs};
    qdot_ode_options zero = {.tol = 1e-17}, steps = {.max_steps = 10},
                     evaluations = {.max_evaluations = 1000}, nan = {.tol = NAN};
    qdot_ode_result r;
    const qdot_ode_system *s = &pendulum.system;
    const qdot_ode_method *m = method("rk8pd");

    (void)state;
    assert_int_equal(qdot_ode_integrate(s, m, &zero, 0, 1, y, &r), QDOT_EINVAL);
    assert_int_equal(qdot_ode_integrate(s, m, &nan, 0, 1, y, &r), QDOT_EINVAL);
    assert_int_equal(qdot_ode_integrate(s, m, NULL, 0, INFINITY, y, &r), QDOT_EINVAL);
    assert_int_equal(qdot_ode_integrate(s, m, NULL, NAN, 1, y, &r), QDOT_EINVAL);
    assert_int_equal(qdot_ode_integrate(s, m, NULL, 0, 1, bad, &r), QDOT_EINVAL);
    assert_int_equal(qdot_ode_integrate(&plain, method("msbdf"), NULL, 0, 1, y, &r),
                     QDOT_EINVAL);
    assert_non_null(strstr(r.reason, "Jacobian"));
    assert_int_equal(qdot_ode_integrate(s, m, &steps, 0, 1000, y, &r), QDOT_ELIMIT);
    assert_int_equal(r.stats.steps + r.stats.rejected, 10);
    assert_true(r.t > 0 && true_error(&pendulum, r.t, y) < 1e-9);
    y[0] = 2, y[1] = 0;
    assert_int_equal(qdot_ode_integrate(s, m, &evaluations, 0, 1000, y, &r), QDOT_ELIMIT);
    assert_true(r.stats.evaluations >= 1000 && r.stats.evaluations < 1100);
    assert_true(r.t > 0 && true_error(&pendulum, r.t, y) < 1e-9);
}

static uint64_t calls;

static qdot_status
counted(double t, const double *y, double *dydt, void *user)
{
    calls++;
    return pendulum_rhs(t, y, dydt, user);
}

static uint64_t jacobian_calls;

static qdot_status
counted_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    jacobian_calls++;
    return pendulum_jacobian(t, y, dfdy, dfdt, user);
}

static void
statistics_count_what_was_called(void **state)
{
    qdot_ode_system s = {.n = 2, .rhs = counted, .jacobian = counted_jacobian};

    (void)state;
    for_each_method(m) {
        double y[2] = {2, 0};
        qdot_ode_result r;

        calls = jacobian_calls = 0;
        assert_int_equal(go(&s, m, NULL, 0, 10, y, &r), QDOT_OK);
        assert_int_equal(r.stats.evaluations, calls);
        assert_int_equal(r.stats.jacobians, jacobian_calls);
        assert_int_equal(r.stats.factorisations > 0, jacobian_calls > 0);
        assert_true(r.stats.cpu > 0 && r.stats.cpu < 60);
        if (m == 0) /* 12 new ones a try, one more a step taken, two to begin */
            assert_int_equal(calls,
                             12 * (r.stats.steps + r.stats.rejected) + r.stats.steps + 2);
    }
}

static void
stiff_methods_step_over_stiffness(void **state)
{
    qdot_ode_system s = {.n = 1, .rhs = stiff, .jacobian = stiff_jacobian};
    qdot_ode_options o = {.tol = 1e-9};
    uint64_t steps[16];

    (void)state;
    for_each_method(m) {
        bool is_stiff = qdot_ode_method_at(m)->stiff;
        double y = 2, t = is_stiff ? 10 : 0.1;
        qdot_ode_result r;

        assert_int_equal(go(&s, m, &o, 0, t, &y, &r), QDOT_OK);
        assert_true(fabs(y - cos(t)) < 1e-7);
        steps[m] = r.stats.steps;
        assert_true(is_stiff ? steps[m] < 2000 : steps[m] > 5000);
    }
}

/* Angles that grow, an equilibrium, free fall: nothing to control must not mean nothing
 * done. */
static qdot_status
fall(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -9.81;
    dydt[2] = 0;
    return QDOT_OK;
}

static void
free_fall_and_rest_are_exact(void **state)
{
    qdot_ode_system s = {.n = 3, .rhs = fall};

    (void)state;
    for (size_t m = 0; m < 3; m++) {
        double y[3] = {0, 0, 2.385};
        qdot_ode_result r;

        assert_int_equal(go(&s, m, NULL, 0, 100, y, &r), QDOT_OK);
        assert_true(fabs(y[0] / (-0.5 * 9.81 * 1e4) - 1) < 1e-11);
        assert_true(y[2] == 2.385);
    }
}

static void
every_failed_allocation_is_told(void **state)
{
    int failures = 0;

    (void)state;
    for (int64_t k = 0;; k++) {
        double y[2] = {2, 0};
        qdot_ode_result r;
        qdot_status status;

        qdot_memory_fail_at(k);
        status = go(&pendulum.system, 0, NULL, 0, 1, y, &r);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK)
            break;
        assert_int_equal(status, QDOT_ENOMEM);
        assert_int_equal(r.outcome, QDOT_ODE_FAILED);
        assert_true(y[0] == 2 && r.t == 0);
        failures++;
    }
    assert_true(failures >= 2);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_follows_its_tolerance),
        cmocka_unit_test(eccentric_orbit_keeps_its_energy),
        cmocka_unit_test(additions_do_not_round),
        cmocka_unit_test(compensation_pays),
        cmocka_unit_test(backwards_returns_to_the_start),
        cmocka_unit_test(the_end_is_reached_to_the_bit),
        cmocka_unit_test(short_and_empty_intervals_work),
        cmocka_unit_test(a_singularity_is_told_where_it_is),
        cmocka_unit_test(an_undefined_right_hand_side_is_approached_and_told),
        cmocka_unit_test(another_failure_ends_the_run_at_once),
        cmocka_unit_test(a_start_where_nothing_is_defined_fails_there),
        cmocka_unit_test(an_interrupt_keeps_the_run_so_far),
        cmocka_unit_test(the_caller_can_stop_limit_and_end_a_run),
        cmocka_unit_test(senseless_arguments_are_refused),
        cmocka_unit_test(statistics_count_what_was_called),
        cmocka_unit_test(stiff_methods_step_over_stiffness),
        cmocka_unit_test(free_fall_and_rest_are_exact),
        cmocka_unit_test(every_failed_allocation_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
