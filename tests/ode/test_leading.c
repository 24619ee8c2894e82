/* test_leading.c -- an oscillator whose first orders are sums of two doubles, to the last bits
 * of both. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include <mpfr.h>

#include "ode/companion.h"
#include "ode/leading.h"
#include "ode/step.h"
#include "ode/trajectory.h"

enum { MOST = 40, STRIDE = 48, FIRST = QDOT_ODE_LEADING_MOST + 1 };

/* x'' = -x. */
typedef struct {
    double x[2 * STRIDE], unit;
    qdot_two first[2 * FIRST], scale;
    int asked; /* the highest order in two doubles */
} oscillator;

typedef struct {
    oscillator o;
    qdot_ode_series series;
    qdot_ode_leading leading;
    qdot_ode_system system;
    const qdot_ode_method *taylor;
} fixture;

static qdot_status
rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t, (void)user;
    dydt[0] = y[1];
    dydt[1] = -y[0];
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    oscillator *o = user;

    for (int k = 0; k < p; k++) {
        o->x[k + 1] = o->unit * o->x[STRIDE + k] / (k + 1);
        o->x[STRIDE + k + 1] = -o->unit * o->x[k] / (k + 1);
    }
    return QDOT_OK;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    oscillator *o = user;

    (void)t;
    o->unit = unit;
    o->x[0] = y[0];
    o->x[STRIDE] = y[1];
    return extend(1, o);
}

static qdot_status
begin_first(const qdot_ode_place *at, double unit, void *user)
{
    oscillator *o = user;

    assert_true(at->carry != NULL);
    o->scale = (qdot_two){unit, 0};
    for (int i = 0; i < 2; i++)
        o->first[i * FIRST] = qdot_two_of(at->y[i], at->carry[i]);
    return QDOT_OK;
}

static qdot_status
next_first(int k, void *user)
{
    oscillator *o = user;
    const qdot_two *x = o->first + k - 1, *v = x + FIRST;

    o->first[k] = qdot_two_div_double(qdot_two_mul(o->scale, *v), k);
    o->first[FIRST + k] = qdot_two_div_double(qdot_two_mul(o->scale, *x), -k);
    o->asked = k > o->asked ? k : o->asked;
    return QDOT_OK;
}

static void
start(fixture *f)
{
    memset(f, 0, sizeof *f);
    f->series = (qdot_ode_series){.most = MOST,
                                  .x = f->o.x,
                                  .stride = STRIDE,
                                  .checked = 1,
                                  .cost.kernels = {50, 5, 0.3},
                                  .begin = begin,
                                  .extend = extend,
                                  .user = &f->o};
    f->leading = (qdot_ode_leading){.x = f->o.first,
                                    .stride = FIRST,
                                    .begin = begin_first,
                                    .next = next_first,
                                    .user = &f->o};
    f->system = (qdot_ode_system){.n = 2,
                                  .rhs = rhs,
                                  .user = &f->o,
                                  .series = &f->series,
                                  .leading = &f->leading};
    f->taylor = qdot_ode_method_find("taylor");
}

/* y + low less the oscillation from x = 1 at rest at t0 (a sum of two doubles, as t1 is). */
static double
error_of(const double *y, const double *low, const double *t0, const double *t1)
{
    double worst = 0;
    mpfr_t t, s, c;

    mpfr_inits2(200, t, s, c, (mpfr_ptr)0);
    mpfr_set_d(t, t1[0], MPFR_RNDN);
    mpfr_add_d(t, t, t1[1], MPFR_RNDN);
    mpfr_sub_d(t, t, t0[0], MPFR_RNDN);
    mpfr_sub_d(t, t, t0[1], MPFR_RNDN);
    mpfr_sin_cos(s, c, t, MPFR_RNDN);
    mpfr_d_sub(c, y[0], c, MPFR_RNDN);
    mpfr_add_d(s, s, y[1], MPFR_RNDN);
    mpfr_add_d(c, c, low ? low[0] : 0, MPFR_RNDN);
    mpfr_add_d(s, s, low ? low[1] : 0, MPFR_RNDN);
    worst = fmax(fabs(mpfr_get_d(s, MPFR_RNDN)), fabs(mpfr_get_d(c, MPFR_RNDN)));
    mpfr_clears(t, s, c, (mpfr_ptr)0);
    return worst;
}

/* From y + low [2] at t0 to t1. */
static void
integrate_in_two(fixture *f, const qdot_ode_options *o, double t0, double t1, double *y, double *low)
{
    qdot_ode_controller c;
    qdot_ode_step step;
    qdot_status status = qdot_ode_controller_open(&c, &f->system, f->taylor, o, t0, t1, y);

    while (status == QDOT_OK && c.t != t1) {
        status = qdot_ode_controller_next(&c, &step);
        if (status == QDOT_OK)
            status = qdot_ode_controller_settle(&c, &step, QDOT_OK);
    }
    qdot_ode_controller_state(&c, y, low);
    qdot_ode_controller_close(&c, status, false);
    if (status != QDOT_OK)
        fail_msg("%s", c.result.reason);
}

static double
run(fixture *f, qdot_ode_options *o, const double *t0, const double *t1)
{
    double y[2] = {1, 0}, low[2] = {0, 0};

    o->t0_low = t0[1];
    o->t1_low = t1[1];
    integrate_in_two(f, o, t0[0], t1[0], y, low);
    return error_of(y, low, t0, t1);
}

static void
the_end_is_known_beyond_a_double(void **state)
{
    const double t0[2] = {0.3, 0x1p-56}, t1[2] = {100, 0x1p-48};
    qdot_ode_options o = {.tol = 1e-15, .leading = true}, plain = {.tol = 1e-15};
    fixture f;
    double error;

    (void)state;
    start(&f);
    error = run(&f, &o, t0, t1);
    if (!(error < 2e-17))
        fail_msg("forwards: %g", error);
    error = run(&f, &o, t1, t0);
    if (!(error < 2e-17))
        fail_msg("backwards: %g", error);
    assert_true(f.o.asked > 3);
    assert_true(run(&f, &plain, (double[]){0, 0}, (double[]){100, 0}) > 1e-16);
}

/* An end on the way hands on what it is beyond a double. */
static void
a_run_goes_on(void **state)
{
    double y[2] = {1, 0}, low[2] = {0, 0};
    qdot_ode_options o = {.tol = 1e-15, .leading = true, .carry = low};
    fixture f;

    (void)state;
    start(&f);
    for (int i = 0; i < 30; i++)
        integrate_in_two(&f, &o, i, i + 1, y, low);
    if (!(error_of(y, low, (double[]){0, 0}, (double[]){30, 0}) < 1e-17))
        fail_msg("%g", error_of(y, low, (double[]){0, 0}, (double[]){30, 0}));
}

/* Between the steps the state is right to the last bit. */
static void
it_is_read_in_two_doubles(void **state)
{
    qdot_ode_options o = {.tol = 1e-15, .leading = true};
    const double y0[2] = {1, 0};
    qdot_trajectory tr = {0};
    double y[2];
    fixture f;

    (void)state;
    start(&f);
    assert_int_equal(qdot_trajectory_run(&tr, &f.system, f.taylor, &o, 0, 40, y0), QDOT_OK);
    assert_true(tr.leading && tr.low != NULL);
    for (double t = 0.1; t < 40; t += 0.37) {
        assert_int_equal(qdot_trajectory_at(&tr, &f.system, t, y), QDOT_OK);
        if (!(error_of(y, NULL, (double[]){0, 0}, (double[]){t, 0}) < 1.2e-16))
            fail_msg("at %g: %g", t, error_of(y, NULL, (double[]){0, 0}, (double[]){t, 0}));
    }
    qdot_trajectory_clear(&tr);
}

/* Companions of such a run start beside it by far less than a double. */
static void
its_error_is_stated(void **state)
{
    double y[2] = {1, 0}, difference[2];
    const double y0[2] = {1, 0};
    qdot_ode_options o = {.tol = 1e-15, .leading = true};
    qdot_companion_estimate e;
    qdot_companion *c;
    qdot_ode_result r;
    fixture f, beside;
    qdot_companion_request request = {.method = qdot_ode_method_find("taylor"),
                                      .tol = 1e-15,
                                      .t1 = 1000,
                                      .y0 = y0,
                                      .leading = true};

    (void)state;
    start(&f);
    start(&beside);
    request.system = &beside.system;
    assert_int_equal(qdot_companion_start(&request, &c), QDOT_OK);
    assert_int_equal(qdot_ode_integrate(&f.system, f.taylor, &o, 0, 1000, y, &r), QDOT_OK);
    qdot_companion_finish(c, 1000, y, difference, &e);
    assert_true(e.known && e.error >= 0x1p-53 && e.error < 1e-15);
    assert_true(error_of(y, NULL, (double[]){0, 0}, (double[]){1000, 0}) <= 3 * e.error);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_end_is_known_beyond_a_double),
        cmocka_unit_test(a_run_goes_on),
        cmocka_unit_test(it_is_read_in_two_doubles),
        cmocka_unit_test(its_error_is_stated),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
