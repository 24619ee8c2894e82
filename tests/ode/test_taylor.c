/* test_taylor.c -- runs by Taylor series written by hand, against references. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include "num/series.h"
#include "ode/companion.h"
#include "ode/taylor.h"
#include "ode/trajectory.h"
#include "ode/problems.h"

enum { MOST = 40, STRIDE = 48 };

/* x'' = -a sin x for POTENTIAL 0, -x^5 for 5, -x^-2 for -2, 0 for 1. */
typedef struct {
    double x[2 * STRIDE], s[STRIDE], c[STRIDE], p[6][STRIDE], unit;
    double g;
    int kind;
} motion;

static double
product(const double *a, const double *b, int k)
{
    double sum = 0;

    for (int j = 0; j <= k; j++)
        sum += a[j] * b[k - j];
    return sum;
}

/* Acceleration of order k. */
static double
acceleration(motion *m, int k)
{
    double *q = m->x, sum = 0;

    switch (m->kind) {
    case 0:
        if (k == 0) {
            m->s[0] = sin(q[0]);
            m->c[0] = cos(q[0]);
        } else {
            m->s[k] = m->c[k] = 0;
            for (int j = 1; j <= k; j++) {
                m->s[k] += j * q[j] * m->c[k - j] / k;
                m->c[k] -= j * q[j] * m->s[k - j] / k;
            }
        }
        return -m->g * m->s[k];
    case 5:
        m->p[2][k] = product(q, q, k);
        m->p[4][k] = product(m->p[2], m->p[2], k);
        return -product(m->p[4], q, k);
    case -2: /* p = q^-2: q p' = -2 q' p */
        if (k == 0)
            m->p[0][0] = 1 / (q[0] * q[0]);
        else {
            for (int j = 1; j <= k; j++)
                sum += (-2.0 * j - (k - j)) * q[j] * m->p[0][k - j];
            m->p[0][k] = sum / (k * q[0]);
        }
        return -m->p[0][k];
    default: return 0;
    }
}

static qdot_status
expand_order(motion *m, int k)
{
    double *v = m->x + STRIDE, a = acceleration(m, k);

    m->x[k + 1] = m->unit * v[k] / (k + 1);
    v[k + 1] = m->unit * a / (k + 1);
    return isfinite(a) ? QDOT_OK : qdot_fail(QDOT_EDOMAIN, "no force there");
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    motion *m = user;

    (void)t;
    m->unit = unit;
    m->x[0] = y[0];
    m->x[STRIDE] = y[1];
    return expand_order(m, 0);
}

static qdot_status
extend(int p, void *user)
{
    for (int k = 1; k < p; k++)
        if (expand_order(user, k) != QDOT_OK)
            return QDOT_EDOMAIN;
    return QDOT_OK;
}

static qdot_status
rhs(double t, const double *y, double *dydt, void *user)
{
    motion *m = user;

    (void)t;
    dydt[0] = y[1];
    m->x[0] = y[0];
    dydt[1] = acceleration(m, 0);
    return QDOT_OK;
}

typedef struct {
    motion m;
    qdot_ode_series series;
    qdot_ode_system system;
    const qdot_ode_method *taylor;
} fixture;

static void
start(fixture *f, int kind)
{
    memset(f, 0, sizeof *f);
    f->m.kind = kind;
    f->m.g = 9.81;
    f->series = (qdot_ode_series){.most = MOST,
                                  .x = f->m.x,
                                  .stride = STRIDE,
                                  .checked = 1,
                                  .cost.kernels = {50, 5, 0.3},
                                  .begin = begin,
                                  .extend = extend,
                                  .user = &f->m};
    f->system =
        (qdot_ode_system){.n = 2, .rhs = rhs, .user = &f->m, .series = &f->series};
    f->taylor = qdot_ode_method_find("taylor");
    assert_non_null(f->taylor);
}

static qdot_ode_result
integrate(fixture *f, double tol, double t1, double *y)
{
    qdot_ode_options o = {.tol = tol};
    qdot_ode_result r;

    if (qdot_ode_integrate(&f->system, f->taylor, &o, 0, t1, y, &r) != QDOT_OK)
        fail_msg("%s", r.reason);
    assert_int_equal(r.outcome, QDOT_ODE_DONE);
    assert_true(r.t == t1);
    return r;
}

static void
error_follows_the_tolerance(void **state)
{
    fixture f;

    (void)state;
    start(&f, 0);
    for (int e = 3; e <= 15; e++) {
        double tol = pow(10, -e), y[2] = {2, 0};
        qdot_ode_result r = integrate(&f, tol, 20, y);
        double error = true_error(&pendulum, 20, y);

        if (!(error <= 1000 * tol + 5e-15))
            fail_msg("tol %g: error %g", tol, error);
        assert_true(r.stats.evaluations >= r.stats.steps);
    }
}

static void
backwards_and_back_again(void **state)
{
    double y[2] = {2, 0};
    long double ref[2];
    fixture f;

    (void)state;
    start(&f, 0);
    integrate(&f, 1e-15, -7, y);
    pendulum_at(pendulum.y0, -7, ref);
    assert_true(fabsl(y[0] - ref[0]) < 4e-15 && fabsl(y[1] - ref[1]) < 8e-15);
}

static int orders_expanded;

static qdot_status
extend_and_count(int p, void *user)
{
    orders_expanded += p;
    return extend(p, user);
}

static double
next_hundredth(double t, int direction, void *user)
{
    (void)user;
    return direction * (floor(direction * t * 100 + 1e-9) + 1) / 100;
}

/* Steps that end at given times are expanded to no more orders than so short ones need, with the same error. */
static void
short_steps_have_low_orders(void **state)
{
    fixture f;

    (void)state;
    start(&f, 0);
    f.system.until = next_hundredth;
    f.series.extend = extend_and_count;
    for (int e = 6; e <= 15; e += 3) {
        double tol = pow(10, -e), y[2] = {2, 0}, back[2];
        qdot_ode_result r = integrate(&f, tol, 20, y);

        if (!(true_error(&pendulum, 20, y) <= 100 * tol + 5e-15))
            fail_msg("tol %g: error %g", tol, true_error(&pendulum, 20, y));
        assert_true(r.stats.steps >= 2000);
        orders_expanded = 0;
        r = integrate(&f, tol, 20, memcpy(back, (double[]){2, 0}, sizeof back));
        if (!(orders_expanded < 14 * (int)r.stats.evaluations))
            fail_msg("tol %g: %d orders in %d expansions", tol, orders_expanded, (int)r.stats.evaluations);
    }
}

/* x'' = -x^5 from x = 0: five coefficients of six vanish; at order 6 all of the upper half
 * but the last. */
static void
vanishing_coefficients_fool_no_step(void **state)
{
    double reference[2] = {0, 1};
    fixture f;

    (void)state;
    start(&f, 5);
    {
        qdot_ode_options o = {.tol = 1e-15};
        qdot_ode_result r;

        assert_int_equal(qdot_ode_integrate(&f.system, qdot_ode_method_find("rk8pd"), &o,
                                            0, 10, reference, &r),
                         QDOT_OK);
    }
    for (int e = 2; e <= 15; e++) {
        double tol = pow(10, -e), y[2] = {0, 1};

        integrate(&f, tol, 10, y);
        if (!(fabs(y[0] - reference[0]) <= 1000 * tol + 1e-13))
            fail_msg("tol %g: x = %.17g, not %.17g", tol, y[0], reference[0]);
    }
    {
        double y[2] = {0, 1}; /* orders up to 5: nothing after the first is there */

        f.series.most = 5;
        integrate(&f, 1e-9, 10, y);
        if (!(fabs(y[0] - reference[0]) <= 1e-6))
            fail_msg("order 5: x = %.17g, not %.17g", y[0], reference[0]);
    }
}

static void
what_ends_is_one_step(void **state)
{
    double y[2] = {3, -2};
    fixture f;

    (void)state;
    start(&f, 1); /* no force */
    assert_int_equal(integrate(&f, 1e-12, 1000, y).stats.steps, 1);
    assert_true(y[0] == 3 - 2000.0 && y[1] == -2);
    start(&f, 0); /* an equilibrium */
    y[0] = y[1] = 0;
    assert_int_equal(integrate(&f, 1e-12, 1000, y).stats.steps, 1);
    assert_true(y[0] == 0 && y[1] == 0);
}

/* A pendulum whose g is 9.81/far^2 does in far seconds what the other does in one. */
static void
any_unit_of_time_will_do(void **state)
{
    static const double far[] = {0x1p40, 0x1p-40};

    (void)state;
    for (int i = 0; i < 2; i++) {
        double y[2] = {2, 0}, slow[2] = {2, 0};
        fixture f;

        start(&f, 0);
        integrate(&f, 1e-13, 5, y);
        start(&f, 0);
        f.m.g = 9.81 / (far[i] * far[i]);
        integrate(&f, 1e-13, 5 * far[i], slow);
        assert_true(fabs(slow[0] - y[0]) < 1e-11);
        assert_true(fabs(slow[1] * far[i] - y[1]) < (i ? 1e-11 : 1e-2));
    }
}

static void
a_singularity_ends_the_run_and_says_when(void **state)
{
    const double collision = acos(-1) / (2 * sqrt(2)); /* from rest at 1 */
    double y[2] = {1, 0};
    qdot_ode_options o = {.tol = 1e-12};
    qdot_ode_result r;
    fixture f;

    (void)state;
    start(&f, -2);
    assert_int_equal(qdot_ode_integrate(&f.system, f.taylor, &o, 0, 3, y, &r),
                     QDOT_EFAILED);
    assert_int_equal(r.outcome, QDOT_ODE_FAILED);
    assert_true(fabs(r.t - collision) < 1e-6);
    assert_true(isfinite(y[0]) && isfinite(y[1]) && y[0] > 0 && y[0] < 1e-3);
    assert_non_null(strstr(r.reason, "stopped at t = 1.1107"));
}

static void
between_steps_it_is_as_accurate(void **state)
{
    qdot_ode_options o = {.tol = 1e-14};
    qdot_trajectory tr = {0};
    fixture f;
    double y[2];

    (void)state;
    start(&f, 0);
    assert_int_equal(
        qdot_trajectory_run(&tr, &f.system, f.taylor, &o, 0, 10, pendulum.y0), QDOT_OK);
    for (int i = 0; i <= 200; i++) {
        double t = i * 0.05;

        assert_int_equal(qdot_trajectory_at(&tr, &f.system, t, y), QDOT_OK);
        if (!(true_error(&pendulum, t, y) <= 3e-14))
            fail_msg("t = %g: error %g", t, true_error(&pendulum, t, y));
    }
    qdot_trajectory_clear(&tr);
}

/* Rounding alone is left: the energy of 1e4 periods stays within a few roundings. */
static void
energy_does_not_drift(void **state)
{
    double y[2] = {2, 0}, E0 = -9.81 * cos(2), E;
    fixture f;

    (void)state;
    start(&f, 0);
    integrate(&f, 1e-16, 20000, y);
    E = 0.5 * y[1] * y[1] - 9.81 * cos(y[0]);
    if (!(fabs(E - E0) < 6e-13)) /* a random walk of 1e5 steps: 3e-13 */
        fail_msg("energy off by %g", E - E0);
}

/* The last step goes beyond its double; the slope must be looked at as far. */
static void
an_end_beyond_its_double_rejects_nothing(void **state)
{
    (void)state;
    for (double low = -0x1p-53; low < 0x1p-52; low += 0x1p-53) {
        qdot_ode_options o = {.tol = 1e-16, .t1_low = 16 * low};
        double y[2] = {2, 0};
        qdot_ode_result r;
        fixture f;

        start(&f, 0);
        assert_int_equal(qdot_ode_integrate(&f.system, f.taylor, &o, 0, 22.123, y, &r),
                         QDOT_OK);
        assert_true(r.outcome == QDOT_ODE_DONE && r.stats.rejected == 0);
    }
}

static void
the_stated_error_is_honest(void **state)
{
    static const double tols[] = {1e-6, 1e-9, 1e-12, 1e-14, 1e-15};

    (void)state;
    for (int i = 0; i < 5; i++) {
        double y[2] = {2, 0}, true_value;
        qdot_companion_estimate e;
        qdot_companion *c;
        fixture f, g, h;

        start(&f, 0);
        start(&g, 0);
        start(&h, 0);
        assert_int_equal(
            qdot_companion_start(
                &(qdot_companion_request){.system = &g.system,
                                          .twin = &h.system,
                                          .method = f.taylor,
                                          .tol = tols[i],
                                          .t1 = 30,
                                          .y0 = y,
                                          .threaded = true},
                &c),
            QDOT_OK);
        integrate(&f, tols[i], 30, y);
        qdot_companion_finish(c, 30, y, NULL, &e);
        true_value = true_error(&pendulum, 30, y);
        if (!(e.known && true_value <= 3 * e.error &&
              e.error <= 100 * (true_value + 1e-14)))
            fail_msg("tol %g: stated %g, true %g", tols[i], e.error, true_value);
    }
}

static void
nonsense_is_refused(void **state)
{
    qdot_ode_options o = {.tol = 1e-18};
    double y[2] = {2, 0};
    qdot_ode_result r;
    fixture f;

    (void)state;
    start(&f, 0);
    assert_int_equal(qdot_ode_integrate(&f.system, f.taylor, &o, 0, 1, y, &r),
                     QDOT_EINVAL);
    f.system.series = NULL;
    assert_int_equal(qdot_ode_integrate(&f.system, f.taylor, NULL, 0, 1, y, &r),
                     QDOT_EINVAL);
}

/* What a second vector of orders costs is no part of a smooth cost. */
static void
orders_stay_narrow_where_wider_ones_cost(void **state)
{
    qdot_ode_series series = {
        .most = 40,
        .cost = {.code = {600, 89, 1.2},
                 .narrow = 18,
                 .of_vector = 16,
                 .digits = QDOT_ODE_DIGITS}};
    const int smooth = qdot_ode_taylor_order(&series, 1e-3, false, 0);

    (void)state;
    assert_true(smooth >= 19 && smooth <= 24);
    series.cost.wider = 300;
    assert_int_equal(qdot_ode_taylor_order(&series, 1e-3, false, 0), 18);
    assert_int_equal(qdot_ode_taylor_order(&series, 1e-3, false, 3), 21);
    series.cost.wider = 1;
    assert_int_equal(qdot_ode_taylor_order(&series, 1e-3, false, 0), smooth);
    series.cost.wider = 300;
    series.cost.of_vector = 8;
    series.cost.digits = 27;
    assert_int_equal(qdot_ode_taylor_order(&series, 1e-3, false, 0), 26);
    series.cost.wider = 1;
    series.cost.digits = 30; /* steps of orders beside it are by a sixth shorter, and more */
    assert_int_not_equal(qdot_ode_taylor_order(&series, 1e-3, false, 0), 29);
    series.cost.by_stability = true;
    assert_int_equal(qdot_ode_taylor_order(&series, 1e-3, false, 0), 29);
    series.cost.code[0] = 0; /* no code */
    series.cost.wider = 1e6;
    series.cost.kernels[0] = 600;
    series.cost.kernels[1] = 89;
    series.cost.kernels[2] = 1.2;
    assert_true(qdot_ode_taylor_order(&series, 1e-12, false, 0) > 18);
}

/* The longest steps that let no oscillation grow, by the polynomials themselves. */
static void
stable_steps_are_those_of_the_polynomials(void **state)
{
    (void)state;
    for (int p = 6; p <= QDOT_SERIES_MOST; p++) {
        const double said = qdot_ode_taylor_stable(p);

        for (int tenth = 1; tenth <= 300; tenth++) {
            const long double z = 0.1L * (long double)tenth;
            long double term = 1, sum[2] = {0};

            for (int k = 0; k <= p; k++) {
                sum[k % 2] += k % 4 < 2 ? term : -term;
                term *= z / (long double)(k + 1);
            }
            if (hypotl(sum[0], sum[1]) > 1 + 1e-6L) {
                assert_true(fabs(0.1 * (tenth - 1) - said) < 1e-9);
                break;
            }
        }
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_follows_the_tolerance),
        cmocka_unit_test(backwards_and_back_again),
        cmocka_unit_test(short_steps_have_low_orders),
        cmocka_unit_test(vanishing_coefficients_fool_no_step),
        cmocka_unit_test(what_ends_is_one_step),
        cmocka_unit_test(any_unit_of_time_will_do),
        cmocka_unit_test(a_singularity_ends_the_run_and_says_when),
        cmocka_unit_test(between_steps_it_is_as_accurate),
        cmocka_unit_test(energy_does_not_drift),
        cmocka_unit_test(an_end_beyond_its_double_rejects_nothing),
        cmocka_unit_test(the_stated_error_is_honest),
        cmocka_unit_test(nonsense_is_refused),
        cmocka_unit_test(orders_stay_narrow_where_wider_ones_cost),
        cmocka_unit_test(stable_steps_are_those_of_the_polynomials),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
