#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "ode/radau-basis.h"
#include "ode/radau.h"
#include "ode/trajectory.h"
#include "ode/problems.h"

static const qdot_ode_method *
radau(void)
{
    return qdot_ode_method_find("radau");
}

/* `steps` steps of that many stages from 0 to t1, whatever their error, y [n] in/out. */
static void
march(const qdot_ode_system *system, size_t stages, double t1, int steps, double *y)
{
    const double h = t1 / steps;
    qdot_ode_stepper *s;
    double ratio;

    assert_int_equal(qdot_ode_stepper_new(system, radau(), 1e-13, &s), QDOT_OK);
    qdot_radau_keep_stages(s, stages);
    qdot_ode_stepper_start(s, y);
    for (int k = 0; k < steps; k++) {
        assert_int_equal(qdot_ode_stepper_try(s, k * h, h, &ratio), QDOT_OK);
        assert_true(isfinite(ratio));
        s->dydt_known = ratio <= 1;
        qdot_ode_stepper_accept(s);
    }
    memcpy(y, s->y, system->n * sizeof *y);
    qdot_ode_stepper_free(s);
}

/* y'' = -(1 + t) y, whose steps may be long, as Newton's iteration has nothing to do */
static qdot_status
airy_rhs(double t, const double *y, double *dydt, void *user)
{
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -(1 + t) * y[0];
    return QDOT_OK;
}

static qdot_status
airy_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)y;
    (void)user;
    dfdy[0] = dfdy[3] = dfdt[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -(1 + t);
    dfdt[1] = 0; /* not asked for */
    return QDOT_OK;
}

static const qdot_ode_system airy = {.n = 2, .rhs = airy_rhs, .jacobian = airy_jacobian};

/* From the errors of `steps` and half as many more. */
static void
check_order(const qdot_ode_system *system, const double *y0, const double *end,
            size_t stages, int steps)
{
    double error[2] = {0}, y[4], seen;

    for (int k = 0; k < 2; k++) {
        memcpy(y, y0, system->n * sizeof *y);
        march(system, stages, 4, steps * (2 + k) / 2, y);
        for (size_t i = 0; i < system->n; i++)
            error[k] = fmax(error[k], fabs(y[i] - end[i]));
    }
    seen = log(error[0] / error[1]) / log(1.5);
    if (!(fabs(seen - (2 * (double)stages - 1)) < 0.6))
        fail_msg("%zu stages: order %.2f (%g, %g)", stages, seen, error[0], error[1]);
}

/* y'' = -sin y */
static qdot_status
swing_rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -sin(y[0]);
    return QDOT_OK;
}

static qdot_status
swing_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    dfdy[0] = dfdy[3] = dfdt[0] = dfdt[1] = 0;
    dfdy[1] = 1;
    dfdy[2] = -cos(y[0]);
    return QDOT_OK;
}

/* What the iteration leaves is alike in all steps: the energy of a pendulum over 20,000 of them. */
static void
what_is_left_does_not_add_up(void **state)
{
    const qdot_ode_system swing = {.n = 2, .rhs = swing_rhs, .jacobian = swing_jacobian};
    double y[] = {1, 0}, drift;

    (void)state;
    march(&swing, 7, 4000, 20000, y);
    drift = fabs(y[1] * y[1] / 2 - cos(y[0]) + cos(1));
    if (!(drift < 1e-13))
        fail_msg("the energy is off by %g", drift);
}

static void
orders_are_2s_less_1(void **state)
{
    const double y0[] = {1, 0.3};
    long double exact[4];
    double end[4];

    (void)state;
    memcpy(end, y0, sizeof y0);
    march(&airy, 7, 4, 40, end);
    check_order(&airy, y0, end, 3, 20);
    check_order(&airy, y0, end, 5, 8);
    check_order(&airy, y0, end, 7, 4);
    henon.at(henon.y0, 4, exact);
    for (int i = 0; i < 4; i++)
        end[i] = (double)exact[i];
    check_order(&henon.system, henon.y0, end, 3, 40);
    check_order(&henon.system, henon.y0, end, 5, 10);
}

/* y' = k t^(k-1) beside z' = -1e9 z */
typedef struct {
    int k;
} power_of_time;

static qdot_status
power_rhs(double t, const double *y, double *dydt, void *user)
{
    const power_of_time *p = user;

    dydt[0] = p->k * pow(t, p->k - 1);
    dydt[1] = -1e9 * y[1];
    return QDOT_OK;
}

static qdot_status
power_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)y;
    (void)user;
    memset(dfdy, 0, 4 * sizeof *dfdy);
    memset(dfdt, 0, 2 * sizeof *dfdt); /* not asked for */
    dfdy[3] = -1e9;
    return QDOT_OK;
}

/* Polynomials up to the order are integrated exactly in one step, and what is stiff is damped. */
static void
polynomials_are_met(void **state)
{
    (void)state;
    for (size_t stages = 3; stages <= 7; stages += 2)
        for (int k = 1; k <= 2 * (int)stages; k++) {
            power_of_time p = {k};
            const qdot_ode_system system = {
                .n = 2, .rhs = power_rhs, .jacobian = power_jacobian, .user = &p};
            double y[2] = {0, 1};

            march(&system, stages, 1, 1, y);
            if (k < 2 * (int)stages)
                assert_true(fabs(y[0] - 1) < 1e-14);
            else
                assert_true(fabs(y[0] - 1) > 1e-9);
            assert_true(fabs(y[1]) < 1e-7);
        }
}

/* (2 + cos q) q'' = sin(q) q'^2/2 - sin q - 1e3 q', with M; and divided by it. */
static qdot_status
heavy_residual(double t, const double *y, const double *a, const double *z, double *r,
               void *user)
{
    (void)t;
    (void)z;
    (void)user;
    r[0] = sin(y[0]) * y[1] * y[1] / 2 - sin(y[0]) - 1e3 * y[1] - (2 + cos(y[0])) * a[0];
    return QDOT_OK;
}

static qdot_status
heavy_slopes(double t, const double *y, const double *a, double *z, double *dq, double *dv,
             double *M, void *user)
{
    (void)t;
    (void)z;
    (void)user;
    dq[0] = cos(y[0]) * y[1] * y[1] / 2 - cos(y[0]) + sin(y[0]) * a[0];
    dv[0] = sin(y[0]) * y[1] - 1e3;
    M[0] = 2 + cos(y[0]);
    return QDOT_OK;
}

static qdot_status
heavy_rhs(double t, const double *y, double *dydt, void *user)
{
    const double none = 0;

    dydt[0] = y[1];
    QDOT_TRY(heavy_residual(t, y, &none, NULL, dydt + 1, user));
    dydt[1] /= 2 + cos(y[0]);
    return QDOT_OK;
}

static qdot_status
heavy_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    double dydt[2], M;

    QDOT_TRY(heavy_rhs(t, y, dydt, user));
    QDOT_TRY(heavy_slopes(t, y, dydt + 1, NULL, dfdy + 2, dfdy + 3, &M, user));
    dfdy[2] /= M;
    dfdy[3] /= M;
    dfdy[0] = dfdt[0] = dfdt[1] = 0;
    dfdy[1] = 1;
    return QDOT_OK;
}

static void
the_form_with_mass_is_the_same(void **state)
{
    static const qdot_ode_mass_form form = {1, 0, heavy_residual, heavy_slopes, NULL};
    const qdot_ode_system with = {.n = 2,
                                  .rhs = heavy_rhs,
                                  .mass_form = &form,
                                  .jacobian = heavy_jacobian},
                          plain = {.n = 2, .rhs = heavy_rhs, .jacobian = heavy_jacobian};
    const qdot_ode_options o = {.tol = 1e-11};
    qdot_ode_result a, b;
    double x[] = {1, 3}, y[] = {1, 3};

    (void)state;
    assert_int_equal(qdot_ode_integrate(&with, radau(), &o, 0, 500, x, &a), QDOT_OK);
    assert_int_equal(qdot_ode_integrate(&plain, radau(), &o, 0, 500, y, &b), QDOT_OK);
    assert_true(fabs(x[0] - y[0]) < 1e-10);
    assert_true(fabs(x[1] - y[1]) < 1e-10);
    assert_true(a.stats.steps < 60 && b.stats.steps < 60);
    assert_true(a.stats.jacobians < a.stats.steps);
}

static qdot_status
vanderpol_rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[1];
    dydt[1] = 1000 * (1 - y[0] * y[0]) * y[1] - y[0];
    return QDOT_OK;
}

static qdot_status
vanderpol_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    dfdy[0] = dfdt[0] = dfdt[1] = 0;
    dfdy[1] = 1;
    dfdy[2] = -2000 * y[0] * y[1] - 1;
    dfdy[3] = 1000 * (1 - y[0] * y[0]);
    return QDOT_OK;
}

static const qdot_ode_system vanderpol = {
    .n = 2, .rhs = vanderpol_rhs, .jacobian = vanderpol_jacobian};

/* Two jumps; the reference by series in 30 digits. Tolerances are kept all along. */
static void
tolerances_are_kept_where_it_is_stiff(void **state)
{
    (void)state;
    for (int k = 3; k <= 12; k++) {
        const qdot_ode_options o = {.tol = pow(10, -k)};
        qdot_ode_result r;
        double y[] = {2, 0};

        assert_int_equal(qdot_ode_integrate(&vanderpol, radau(), &o, 0, 2000, y, &r),
                         QDOT_OK);
        if (!(fabs(y[0] - 1.706167732170465008) < o.tol + 1e-13))
            fail_msg("tol %g: off by %g", o.tol, fabs(y[0] - 1.706167732170465008));
        assert_true(r.stats.steps < 1000);
    }
}

/* Between the ends of steps, too. */
static void
polynomials_of_steps_keep_the_tolerance(void **state)
{
    const qdot_ode_options o = {.tol = 1e-9};
    qdot_trajectory tr = {0};
    qdot_trajectory_cursor *c;
    double y[4], worst = 0;

    (void)state;
    assert_int_equal(
        qdot_trajectory_run(&tr, &henon.system, radau(), &o, 0, 20, henon.y0), QDOT_OK);
    assert_int_equal(qdot_trajectory_open(&tr, &henon.system, &c), QDOT_OK);
    for (int k = 0; k <= 500; k++) {
        assert_int_equal(qdot_trajectory_read(c, 0.04 * k, y), QDOT_OK);
        worst = fmax(worst, true_error(&henon, 0.04 * k, y));
    }
    qdot_trajectory_close(c);
    qdot_trajectory_clear(&tr);
    assert_true(worst < 3e-9);
}

/* --- a multiplier: free on a circle, x u + y v = 0 at the stages, nothing projected ----------- */

static qdot_status
circle_residual(double t, const double *y, const double *a, const double *z, double *r, void *user)
{
    (void)t;
    (void)user;
    r[0] = y[0] * z[0] - a[0];
    r[1] = y[1] * z[0] - a[1];
    r[2] = y[0] * y[2] + y[1] * y[3];
    return QDOT_OK;
}

static qdot_status
circle_slopes(double t, const double *y, const double *a, double *z, double *dq, double *dv,
              double *M, void *user)
{
    static const double mass[9] = {1, 0, 0, 0, 1};

    (void)t;
    (void)a;
    (void)user;
    z[0] = -(y[2] * y[2] + y[3] * y[3]) / (y[0] * y[0] + y[1] * y[1]);
    memcpy(dq, (double[9]){z[0], 0, 0, 0, z[0], 0, y[2], y[3], 0}, 9 * sizeof *dq);
    memcpy(dv, (double[9]){0, 0, y[0], 0, 0, y[1], y[0], y[1], 0}, 9 * sizeof *dv);
    memcpy(M, mass, sizeof mass);
    return QDOT_OK;
}

static qdot_status
circle_rhs(double t, const double *y, double *dydt, void *user)
{
    const double z = -(y[2] * y[2] + y[3] * y[3]) / (y[0] * y[0] + y[1] * y[1]);

    (void)t;
    (void)user;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = z * y[0];
    dydt[3] = z * y[1];
    return QDOT_OK;
}

/* There is one, but the form with M is what is read. */
static qdot_status
circle_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)y;
    (void)dfdy;
    (void)dfdt;
    (void)user;
    return QDOT_EINVAL;
}

/* The error of the state at t = 2, and by how much the constraint is broken there. */
static double
circle_error(size_t stages, int steps, double *broken)
{
    static const qdot_ode_mass_form form = {2, 1, circle_residual, circle_slopes, NULL};
    const qdot_ode_system system = {
        .n = 4, .rhs = circle_rhs, .jacobian = circle_jacobian, .mass_form = &form};
    double y[] = {1, 0, 0, 1};

    march(&system, stages, 2, steps, y);
    *broken = fabs(y[0] * y[2] + y[1] * y[3]);
    return hypot(hypot(y[0] - cos(2), y[1] - sin(2)), hypot(y[2] + sin(2), y[3] - cos(2)));
}

/* Order 2s - 1 with multipliers too (Hairer & Wanner II, VII.4). */
static void
multipliers_keep_the_order(void **state)
{
    double broken, wide, narrow;

    (void)state;
    wide = circle_error(3, 60, &broken);
    assert_true(broken < 1e-13);
    narrow = circle_error(3, 120, &broken);
    assert_true(log2(wide / narrow) > 4.6);
    assert_true(circle_error(5, 12, &broken) < 1e-12);
}

/* A^-1 = sum_k lambda_k u_k w_k^T */
static void
eigenvectors_make_the_matrix(void **state)
{
    (void)state;
    for (size_t kind = 0; kind < QDOT_RADAU_KINDS; kind++) {
        const qdot_radau_basis *b = qdot_radau_basis_get(kind);

        for (size_t i = 0; i < b->stages; i++)
            for (size_t j = 0; j < b->stages; j++) {
                double sum = 0;

                for (size_t k = 0; k < b->spaces; k++) {
                    const double ur = b->right_re[k][i], ui = b->right_im[k][i];
                    const double wr = b->left_re[k][j], wi = b->left_im[k][j];

                    sum += b->lambda_re[k] * (ur * wr - ui * wi) -
                           b->lambda_im[k] * (ur * wi + ui * wr);
                }
                assert_true(fabs(sum - b->inverse[i][j]) < 1e-10);
            }
    }
}

/* An oscillator that passes near its centre, in polar coordinates r, phi, r', phi'; evaluations are
 * counted. */
static qdot_status
near_pole_rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    ++*(int *)user;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = y[0] * (y[3] * y[3] - 1);
    dydt[3] = -2 * y[2] * y[3] / y[0];
    return QDOT_OK;
}

static qdot_status
near_pole_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    for (int i = 0; i < 16; i++)
        dfdy[i] = 0;
    for (int i = 0; i < 4; i++)
        dfdt[i] = 0;
    dfdy[2] = dfdy[7] = 1;
    dfdy[8] = y[3] * y[3] - 1;
    dfdy[11] = 2 * y[0] * y[3];
    dfdy[12] = 2 * y[2] * y[3] / (y[0] * y[0]);
    dfdy[14] = -2 * y[3] / y[0];
    dfdy[15] = -2 * y[2] / y[0];
    return QDOT_OK;
}

/* Steps are read by the formula that made them, whatever its stages: at 20 places for less than the run. */
static void
steps_are_read_by_their_formula(void **state)
{
    enum { places = 20 };
    int count = 0;
    const qdot_ode_system system = {
        .n = 4, .rhs = near_pole_rhs, .jacobian = near_pole_jacobian, .user = &count};
    const qdot_ode_options o = {.tol = 1e-5};
    const double start[] = {1, 0, 0, 1e-3};
    qdot_trajectory tr = {0};
    qdot_trajectory_cursor *c;
    double y[4];
    int by_run;

    (void)state;
    assert_int_equal(qdot_trajectory_run(&tr, &system, radau(), &o, 0, 20, start), QDOT_OK);
    by_run = count;
    assert_int_equal(qdot_trajectory_open(&tr, &system, &c), QDOT_OK);
    for (size_t i = 0; i + 1 < tr.count; i++)
        for (int k = 1; k < places; k++)
            assert_int_equal(
                qdot_trajectory_read(c, tr.t[i] + k * (tr.t[i + 1] - tr.t[i]) / places, y),
                QDOT_OK);
    if (count - by_run > 2 * by_run)
        fail_msg("%d evaluations of a run, %d to read it", by_run, count - by_run);
    qdot_trajectory_close(c);
    qdot_trajectory_clear(&tr);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eigenvectors_make_the_matrix),
        cmocka_unit_test(orders_are_2s_less_1),
        cmocka_unit_test(what_is_left_does_not_add_up),
        cmocka_unit_test(polynomials_are_met),
        cmocka_unit_test(multipliers_keep_the_order),
        cmocka_unit_test(the_form_with_mass_is_the_same),
        cmocka_unit_test(tolerances_are_kept_where_it_is_stiff),
        cmocka_unit_test(steps_are_read_by_their_formula),
        cmocka_unit_test(polynomials_of_steps_keep_the_tolerance),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
