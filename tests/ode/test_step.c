/* test_step.c -- controllers of every kind, along x'' = -x: x = cos t, x' = -sin t. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include <math.h>

#include "ode/integrate.h"
#include "ode/step.h"

enum { MOST = 40, STRIDE = 48 };

static double coefficients[2 * STRIDE], unit_now;

static qdot_status
rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -y[0];
    return QDOT_OK;
}

static qdot_status
jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    static const double slopes[4] = {0, 1, -1, 0};

    (void)t;
    (void)y;
    (void)user;
    memcpy(dfdy, slopes, sizeof slopes);
    dfdt[0] = dfdt[1] = 0;
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    double *x = coefficients, *v = x + STRIDE;

    (void)user;
    for (int k = 1; k < p; k++) {
        x[k + 1] = unit_now / (k + 1) * v[k];
        v[k + 1] = -unit_now / (k + 1) * x[k];
    }
    return QDOT_OK;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    (void)t;
    (void)user;
    unit_now = unit;
    coefficients[0] = y[0];
    coefficients[STRIDE] = y[1];
    coefficients[1] = unit * y[1];
    coefficients[STRIDE + 1] = -unit * y[0];
    return QDOT_OK;
}

static const qdot_ode_series series = {.most = MOST,
                                       .x = coefficients,
                                       .stride = STRIDE,
                                       .checked = 1,
                                       .cost = {.kernels = {100, 10, 1}},
                                       .begin = begin,
                                       .extend = extend};
static const qdot_ode_system oscillator = {
    .n = 2, .rhs = rhs, .jacobian = jacobian, .halves = true, .series = &series};

/* A method and its options for each kind of controller. */
static const struct {
    const char *method;
    bool alternates;
} kinds[] = {{"taylor", false}, {"dop853", false}, {"rk8pd", false}, {"gauss8", false},
             {"radau", false}, {"radau", true}, {"msadams", false}};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const double start_of[2] = {1, 0};

static qdot_ode_options
options_of(size_t kind)
{
    return (qdot_ode_options){.tol = 1e-10, .alternates = kinds[kind].alternates};
}

static void
open(qdot_ode_controller *c, size_t kind, const qdot_ode_options *o, double t1)
{
    if (qdot_ode_controller_open(c, &oscillator, qdot_ode_method_find(kinds[kind].method), o, 0, t1, start_of)
        != QDOT_OK)
        fail_msg("%s: %s", kinds[kind].method, qdot_last_error()->message);
}

static void
steps_join_and_follow_the_solution(void **state)
{
    (void)state;
    for (size_t k = 0; k < KINDS; k++) {
        const qdot_ode_options o = options_of(k);
        qdot_ode_controller c;
        qdot_ode_step step;
        uint64_t steps = 0;

        open(&c, k, &o, 20);
        for (; c.t != 20; steps++) {
            const double t = c.t;
            double y[2];

            qdot_ode_controller_state(&c, y, NULL);
            assert_true(fabs(y[1] + sin(t)) < 1e-7);
            assert_int_equal(qdot_ode_controller_next(&c, &step), QDOT_OK);
            assert_true(step.t_end > t && step.t_end <= 20);
            assert_int_equal(step.series != NULL, step.method->series);
            assert_true(fabs(step.y_end[0] - cos(step.t_end)) < 1e-7);
            assert_int_equal(qdot_ode_controller_settle(&c, &step, QDOT_OK), QDOT_OK);
            assert_true(c.t == step.t_end);
        }
        qdot_ode_controller_close(&c, QDOT_OK, false);
        assert_int_equal(c.result.outcome, QDOT_ODE_DONE);
        assert_int_equal(c.result.stats.steps, steps);
    }
}

/* The solution is known inside a step by series, and its end may be brought nearer. */
static void
a_step_by_series_ends_where_its_owner_says(void **state)
{
    const qdot_ode_options o = options_of(0);
    qdot_ode_controller c;
    qdot_ode_step step;
    bool taken;

    (void)state;
    open(&c, 0, &o, 20);
    for (int i = 0; i < 10; i++) {
        double end, sum = 0;

        assert_int_equal(qdot_ode_controller_offer(&c, &step), QDOT_OK);
        end = c.t + 0.37 * (step.t_end - c.t);
        for (int k = step.series->order; k >= 0; k--)
            sum = sum * ((end - c.t) / step.series->unit) + coefficients[k];
        step.series->t_end = end;
        assert_int_equal(qdot_ode_controller_take(&c, &step, &taken), QDOT_OK);
        assert_true(taken && step.t_end == end);
        assert_true(fabs(step.y_end[0] - sum) < 1e-15 && fabs(sum - cos(end)) < 1e-13);
        assert_int_equal(qdot_ode_controller_accept(&c, &step), QDOT_OK);
    }
    qdot_ode_controller_close(&c, QDOT_OK, true);
    assert_int_equal(c.result.outcome, QDOT_ODE_STOPPED);
}

static void
a_refused_step_is_offered_shorter(void **state)
{
    (void)state;
    for (size_t k = 0; k < KINDS; k++) {
        const qdot_ode_options o = options_of(k);
        qdot_ode_controller c;
        qdot_ode_step step;
        double length, y[2];

        open(&c, k, &o, 20);
        for (int i = 0; i < 3; i++) {
            assert_int_equal(qdot_ode_controller_next(&c, &step), QDOT_OK);
            assert_int_equal(qdot_ode_controller_settle(&c, &step, QDOT_OK), QDOT_OK);
        }
        assert_int_equal(qdot_ode_controller_next(&c, &step), QDOT_OK);
        length = step.t_end - c.t;
        assert_int_equal(qdot_ode_controller_refuse(&c, qdot_fail(QDOT_EDOMAIN, "not there")), QDOT_OK);
        qdot_ode_controller_state(&c, y, NULL);
        assert_true(fabs(y[0] - cos(c.t)) < 1e-7);
        assert_int_equal(qdot_ode_controller_next(&c, &step), QDOT_OK);
        if (!(step.t_end - c.t < 0.5 * length))
            fail_msg("%s: %g after %g", kinds[k].method, step.t_end - c.t, length);
        assert_int_equal(qdot_ode_controller_refuse(&c, qdot_fail(QDOT_ELIMIT, "no more")), QDOT_ELIMIT);
        qdot_ode_controller_state(&c, y, NULL);
        assert_true(fabs(y[0] - cos(c.t)) < 1e-7);
        qdot_ode_controller_close(&c, QDOT_ELIMIT, false);
        assert_int_equal(c.result.outcome, QDOT_ODE_FAILED);
        assert_string_equal(c.result.reason, "no more");
    }
}

/* Its owner may leave it behind any call. */
static void
steps_are_those_of_an_integration(void **state)
{
    (void)state;
    for (size_t k = 0; k < KINDS; k++) {
        const qdot_ode_options o = options_of(k);
        const qdot_ode_method *method = qdot_ode_method_find(kinds[k].method);
        double y[2] = {1, 0}, now[2], t;
        qdot_ode_controller c;
        qdot_ode_result r;
        qdot_ode_step step;

        open(&c, k, &o, 20);
        while (c.t < 10) {
            assert_int_equal(qdot_ode_controller_next(&c, &step), QDOT_OK);
            assert_int_equal(qdot_ode_controller_settle(&c, &step, QDOT_OK), QDOT_OK);
        }
        t = c.t;
        assert_int_equal(qdot_ode_controller_offer(&c, &step), QDOT_OK);
        qdot_ode_controller_close(&c, QDOT_OK, true);
        assert_true(c.result.t == t);

        open(&c, k, &o, 20);
        while (c.t != 20) {
            assert_int_equal(qdot_ode_controller_next(&c, &step), QDOT_OK);
            assert_int_equal(qdot_ode_controller_settle(&c, &step, QDOT_OK), QDOT_OK);
        }
        qdot_ode_controller_state(&c, now, NULL);
        qdot_ode_controller_close(&c, QDOT_OK, false);
        assert_int_equal(qdot_ode_integrate(&oscillator, method, &o, 0, 20, y, &r), QDOT_OK);
        assert_memory_equal(y, now, sizeof y);
        assert_int_equal(r.stats.evaluations, c.result.stats.evaluations);
    }
}

static void
what_cannot_begin_says_why(void **state)
{
    const qdot_ode_options o = {.tol = 1e-40};

    (void)state;
    for (size_t k = 0; k < KINDS; k++) {
        qdot_ode_controller c;
        double y[2] = {3, 4};
        const qdot_status status = qdot_ode_controller_open(
            &c, &oscillator, qdot_ode_method_find(kinds[k].method), &o, 0, 1, start_of);

        assert_int_equal(status, QDOT_EINVAL);
        qdot_ode_controller_state(&c, y, NULL);
        assert_true(y[0] == 3 && y[1] == 4);
        qdot_ode_controller_close(&c, status, false);
        assert_int_equal(c.result.outcome, QDOT_ODE_FAILED);
        assert_true(c.result.reason[0] != '\0');
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_join_and_follow_the_solution),
        cmocka_unit_test(a_step_by_series_ends_where_its_owner_says),
        cmocka_unit_test(a_refused_step_is_offered_shorter),
        cmocka_unit_test(steps_are_those_of_an_integration),
        cmocka_unit_test(what_cannot_begin_says_why),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
