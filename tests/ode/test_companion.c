#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/memory.h"
#include "ode/companion.h"
#include "ode/problems.h"

static void
start(const qdot_ode_system *system, const qdot_ode_method *m, double tol, double t1,
      const double *y0, bool threaded, qdot_companion **c)
{
    qdot_companion_request request = {.system = system,
                                      .twin = system,
                                      .method = m,
                                      .tol = tol,
                                      .t1 = t1,
                                      .y0 = y0,
                                      .threaded = threaded};

    assert_int_equal(qdot_companion_start(&request, c), QDOT_OK);
}

/* The error stated for a run of p to t, and the true one. */
static qdot_companion_estimate
estimate(const problem *p, const qdot_ode_method *m, double tol, double t, bool threaded,
         double *error)
{
    double y[4], difference[4], largest = 0;
    qdot_ode_options o = {.tol = tol};
    qdot_ode_result r;
    qdot_companion *c;
    qdot_companion_estimate e;

    memcpy(y, p->y0, sizeof y);
    start(&p->system, m, tol, t, p->y0, threaded, &c);
    assert_int_equal(qdot_ode_integrate(&p->system, m, &o, 0, t, y, &r), QDOT_OK);
    qdot_companion_finish(c, r.t, y, difference, &e);
    *error = true_error(p, t, y);
    for (size_t i = 0; i < p->system.n; i++)
        largest = fmax(largest, difference[i] / fmax(1, fabs(y[i])));
    assert_true(!e.known || e.error >= 0.99 * largest); /* the companions differ, too */
    return e;
}

static void
the_stated_error_is_honest(void **state)
{
    const problem *const all[] = {&pendulum, &henon, &kepler};

    (void)state;
    for_each_method(m)
        for (int p = 0; p < 3; p++)
            for (double tol = 1e-6; tol > 5e-16; tol /= 10)
                for (double t = 9; t < 110; t *= 3.3) {
                    double error;
                    qdot_companion_estimate e =
                        estimate(all[p], qdot_ode_method_at(m), tol, t, true, &error);

                    assert_true(e.known);
                    if (error > 1.5 * e.error || (error > 1e-14 && e.error > 200 * error))
                        fail_msg("%s, %s, tol %g, t %g: true %g, stated %g",
                                 qdot_ode_method_at(m)->name, all[p]->name, tol, t, error,
                                 e.error);
                }
}

static void
a_thread_changes_nothing(void **state)
{
    double ignored;

    (void)state;
    for_each_method(m) {
        const qdot_ode_method *method = qdot_ode_method_at(m);
        double with = estimate(&henon, method, 1e-9, 10, true, &ignored).error;

        assert_true(with == estimate(&henon, method, 1e-9, 10, false, &ignored).error);
    }
}

static void
tolerances_follow_the_table(void **state)
{
    const qdot_ode_method *rk8pd = qdot_ode_method_find("rk8pd");
    const qdot_ode_method *rkf45 = qdot_ode_method_find("rkf45");

    (void)state;
    assert_true(fabs(qdot_companion_tolerance(&pendulum.system, rk8pd, 1e-9) / 1e-11 - 1) < 1e-12);
    assert_true(qdot_companion_tolerance(&pendulum.system, rk8pd, 1e-13) == rk8pd->companion_tol);
    assert_true(fabs(qdot_companion_tolerance(&pendulum.system, rk8pd, 1e-15) / 5e-14 - 1) < 1e-12);
    assert_true(qdot_companion_tolerance(&pendulum.system, rkf45, 1e-15) == rkf45->companion_tol);
    assert_true(qdot_companion_tolerance(&pendulum.system, qdot_ode_method_find("bsimp"), 1e-9)
                == qdot_ode_method_find("radau")->companion_tol);
}

/* In one unstable direction: a run off by 1, its companions by the rounding of their own. */
static void
companions_on_either_side_show_their_middle(void **state)
{
    const double beside[] = {1 - 3e4, 1 + 6e4}, alike[] = {1e-3, 1.1e-3};

    (void)state;
    assert_true(qdot_companion_apart(0, 2, beside) == 1 && qdot_companion_apart(0, 1, alike) == 1e-3);
    assert_true(fabs(qdot_companion_bound_of(1, 2, beside) / 6e4 - 1) < 1e-12);
    assert_true(fabs(qdot_companion_bound_of(1, 2, alike) / 1.25 - 1) < 1e-3);
    assert_true(fabs(qdot_companion_bound_of(1, 1, alike) / (3.25 * (1 - 1e-3)) - 1) < 1e-12);
    assert_true(isnan(qdot_companion_bound_of(NAN, 2, alike)));
}

/* A linear flow whose run is exact in doubles: only the moved start can tell. */
static qdot_status
growth(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = 2 * y[0];
    dydt[1] = 0;
    return QDOT_OK;
}

static void
zeros_of_the_start_are_moved_too(void **state)
{
    qdot_ode_system s = {.n = 2, .rhs = growth};
    const qdot_ode_method *m = qdot_ode_method_find("rk8pd");
    double y0[2] = {0, 1}, y[2] = {0, 1};
    qdot_ode_result r;
    qdot_companion *c;
    qdot_companion_estimate e;

    (void)state;
    start(&s, m, 1e-12, 5, y0, true, &c);
    assert_int_equal(qdot_ode_integrate(&s, m, NULL, 0, 5, y, &r), QDOT_OK);
    qdot_companion_finish(c, 5, y, NULL, &e);
    assert_true(y[0] == 0);
    /* two companions, moved to either side by 2^-53 and 2^-52, which resolve a value far below their
     * tolerance only roughly */
    assert_true(fabs(e.error / qdot_companion_bound(0, 0x1p-52 * exp(10)) - 1)
                < 0.05);
}

static qdot_status
stop_beyond_three(double t, const double *y, bool *stop, void *user)
{
    (void)y;
    (void)user;
    *stop = t > 3;
    return QDOT_OK;
}

static void
a_run_that_stops_early_is_compared_where_it_stopped(void **state)
{
    const qdot_ode_method *m = qdot_ode_method_find("rk8pd");
    qdot_ode_options o = {.tol = 1e-9, .accepted = stop_beyond_three};
    double y[2] = {2, 0}, error;
    qdot_ode_result r;
    qdot_companion *c;
    qdot_companion_estimate e;

    (void)state;
    start(&pendulum.system, m, 1e-9, 1e5, y, true, &c);
    assert_int_equal(qdot_ode_integrate(&pendulum.system, m, &o, 0, 1e5, y, &r), QDOT_OK);
    qdot_companion_finish(c, r.t, y, NULL, &e);
    error = true_error(&pendulum, r.t, y);
    assert_true(e.known && e.result.t == r.t);
    assert_true(error < 3 * e.error && e.error < 100 * error);
}

/* user: calls allowed before it fails */
static qdot_status
fails_later(double t, const double *y, double *dydt, void *user)
{
    if ((*(int *)user)-- <= 0)
        return qdot_fail(QDOT_EUNSET, "k has no value");
    return pendulum_rhs(t, y, dydt, NULL);
}

static void
a_companion_that_fails_leaves_the_error_unknown(void **state)
{
    const qdot_ode_method *m = qdot_ode_method_find("rk8pd");
    double y[2] = {2, 0}, difference[2];
    int allowed = 200;
    qdot_ode_system s = {.n = 2, .rhs = fails_later, .user = &allowed};
    qdot_companion *c;
    qdot_companion_estimate e;

    (void)state;
    start(&s, m, 1e-9, 10, y, true, &c);
    qdot_companion_finish(c, 10, y, difference, &e);
    assert_false(e.known);
    assert_true(isnan(e.error) && isnan(difference[0]) && isnan(difference[1]));
    assert_string_equal(e.result.reason, "k has no value");
}

static void
failed_allocations_are_told(void **state)
{
    const qdot_ode_method *m = qdot_ode_method_find("rk8pd");
    double y[2] = {2, 0};
    qdot_companion_request request = {.system = &pendulum.system,
                                      .twin = &pendulum.system,
                                      .method = m,
                                      .tol = 1e-9,
                                      .t1 = 1,
                                      .y0 = y};
    qdot_companion *c;

    (void)state;
    for (int64_t k = 0; k < 10; k++) {
        qdot_memory_fail_at(k);
        assert_int_equal(qdot_companion_start(&request, &c), QDOT_ENOMEM);
        assert_null(c);
    }
    qdot_memory_fail_at(-1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_stated_error_is_honest),
        cmocka_unit_test(a_thread_changes_nothing),
        cmocka_unit_test(tolerances_follow_the_table),
        cmocka_unit_test(companions_on_either_side_show_their_middle),
        cmocka_unit_test(zeros_of_the_start_are_moved_too),
        cmocka_unit_test(a_run_that_stops_early_is_compared_where_it_stopped),
        cmocka_unit_test(a_companion_that_fails_leaves_the_error_unknown),
        cmocka_unit_test(failed_allocations_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
