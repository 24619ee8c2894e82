#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>

#include "num/sum.h"
#include "ode/geometric/geometric.h"
#include "ode/geometric/splitting.h"
#include "ode/problems.h"

#define for_each_geometric(m)                                                            \
    for (size_t m = 0; m < qdot_ode_method_count(); m++)                                 \
        if (qdot_ode_method_at(m)->geometric)

/* Integrate; the steps taken. */
static uint64_t
go(const problem *p, const qdot_ode_method *m, const qdot_ode_options *o, double t0, double t1,
   double *y)
{
    qdot_ode_system system = p->system;
    qdot_ode_result r;

    system.halves = true;
    if (qdot_ode_integrate(&system, m, o, t0, t1, y, &r) != QDOT_OK)
        fail_msg("%s: %s", m->name, r.reason);
    assert_true(r.t == t1);
    return r.stats.steps;
}

static double
henon_energy(const double *y)
{
    const double x = y[0], z = y[1];

    return 0.5 * (y[2] * y[2] + y[3] * y[3] + x * x + z * z) + z * (x * x - z * z / 3);
}

/* From the errors at h and h/2, Henon-Heiles against its Taylor series in long double. */
static void
order_matches_table(void **state)
{
    static const struct {
        const char *name;
        double h;
    } rows[] = {{"verlet", 0.02}, {"composition8", 0.8}, {"gauss4", 0.1},
                {"gauss6", 0.4},  {"gauss8", 0.8},       {"gauss12", 1.6},
                {"variational", 0.8}};
    size_t seen = 0;

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const qdot_ode_method *m = qdot_ode_method_find(rows[i].name);
        double error[2], order;

        for (int k = 0; k < 2; k++) {
            const qdot_ode_options o = {.tol = 1, .h_fixed = rows[i].h / (k ? 2 : 1)};
            double y[4];

            memcpy(y, henon.y0, sizeof y);
            assert_int_equal(go(&henon, m, &o, 0, 8, y), (uint64_t)round(8 / o.h_fixed));
            error[k] = true_error(&henon, 8, y);
        }
        order = log2(error[0] / error[1]);
        if (fabs(order - m->order) > 0.5)
            fail_msg("%s: order %.2f (%g, %g), table says %d", m->name, order, error[0], error[1],
                     m->order);
        seen++;
    }
    for_each_geometric(m) seen--;
    assert_int_equal(seen, 0);
}

/* Symmetric: the way back by the same steps ends where it began, whatever their error. */
static void
way_back_ends_at_the_start(void **state)
{
    (void)state;
    for_each_geometric(m)
    {
        const qdot_ode_options o = {.h_fixed = 0.08 * qdot_ode_method_at(m)->order};
        double y[4];

        memcpy(y, henon.y0, sizeof y);
        go(&henon, qdot_ode_method_at(m), &o, 0, 50, y);
        assert_true(true_error(&henon, 50, y) > 1e-11);
        go(&henon, qdot_ode_method_at(m), &o, 50, 0, y);
        if (true_error(&henon, 0, y) > 2e-13)
            fail_msg("%s: off by %g", qdot_ode_method_at(m)->name, true_error(&henon, 0, y));
    }
}

/* The error of the energy in every tenth of the run. */
typedef struct {
    double energy, most[10];
} tenths;

static qdot_status
follow_energy(double t, const double *y, bool *stop, void *user)
{
    tenths *e = user;
    const int k = t < 2000 ? (int)(t / 200) : 9;

    (void)stop;
    e->most[k] = fmax(e->most[k], fabs(henon_energy(y) - e->energy));
    return QDOT_OK;
}

static void
energy_does_not_drift(void **state)
{
    (void)state;
    for_each_geometric(m)
    {
        tenths e = {.energy = henon_energy(henon.y0)};
        const qdot_ode_options o = {.tol = 1e-5, .accepted = follow_energy, .user = &e};
        double y[4];

        memcpy(y, henon.y0, sizeof y);
        go(&henon, qdot_ode_method_at(m), &o, 0, 2000, y);
        if (!(e.most[9] < 2 * e.most[0]) || e.most[0] == 0)
            fail_msg("%s: energy off by %g, then %g", qdot_ode_method_at(m)->name, e.most[0],
                     e.most[9]);
    }
}

/* Every step keeps the tolerance, as the exact solution from its start shows. */
static qdot_status
compare(double t, const double *y, bool *stop, void *user)
{
    double *before = user, *worst = before + 5;
    long double exact[4];

    (void)stop;
    henon_at(before + 1, t - before[0], exact);
    for (int i = 0; i < 4; i++)
        *worst = fmax(*worst, fabs(y[i] - (double)exact[i]));
    before[0] = t;
    memcpy(before + 1, y, 4 * sizeof *y);
    return QDOT_OK;
}

static void
steps_keep_the_tolerance(void **state)
{
    (void)state;
    for_each_geometric(m)
        for (int k = 3; k <= 12; k += 3)
        {
            double from[6] = {0}, y[4];
            const qdot_ode_options o = {.tol = pow(10, -k), .accepted = compare, .user = from};

            if (k == 12 && qdot_ode_method_at(m)->order < 6)
                continue;
            memcpy(y, henon.y0, sizeof y);
            memcpy(from + 1, y, sizeof y);
            go(&henon, qdot_ode_method_at(m), &o, 0, 40, y);
            if (!(from[5] < 3 * o.tol))
                fail_msg("%s, tol %g: off by %g in a step", qdot_ode_method_at(m)->name, o.tol,
                         from[5]);
            if (from[5] < 1e-4 * o.tol)
                fail_msg("%s, tol %g: off by %g only", qdot_ode_method_at(m)->name, o.tol, from[5]);
        }
}

/* Where only rounding is left it has no direction: with the low parts of coefficients lost the energy
 * was off by 1e-14 and more here. */
static void
rounding_does_not_drift(void **state)
{
    static const char *const names[] = {"composition8", "gauss8", "gauss12", "variational"};

    (void)state;
    for (int i = 0; i < 4; i++) {
        const qdot_ode_options o = {.tol = 1e-15};
        double y[4];

        memcpy(y, henon.y0, sizeof y);
        go(&henon, qdot_ode_method_find(names[i]), &o, 0, 20000, y);
        if (!(fabs(henon_energy(y) - henon_energy(henon.y0)) < 4e-15))
            fail_msg("%s: energy off by %g", names[i],
                     fabs(henon_energy(y) - henon_energy(henon.y0)));
    }
}

static void
lengths_of_a_composition_add_up(void **state)
{
    (void)state;
    for (int k = 1; k < 100; k++) {
        const double h = 1.0 / (3 + k);
        double length[QDOT_COMPOSITION_STAGES], rest;
        qdot_sum sum = {0};

        qdot_composition_lengths(h, length, &rest);
        for (int i = 0; i < QDOT_COMPOSITION_STAGES; i++)
            qdot_sum_add(&sum, length[i]);
        qdot_sum_add(&sum, rest);
        assert_true(fabs(rest) < 1e-15 * h);
        assert_true(fabs((sum.sum - h) + sum.carry) < 1e-30);
    }
}

static void
too_many_steps_are_told_beforehand(void **state)
{
    const qdot_ode_method *m = qdot_ode_method_find("verlet");
    qdot_ode_system system = henon.system;
    qdot_ode_result r;
    double y[4];

    (void)state;
    system.halves = true;
    memcpy(y, henon.y0, sizeof y);
    assert_int_equal(qdot_ode_integrate(&system, m, NULL, 0, 1e6, y, &r), QDOT_ELIMIT);
    assert_non_null(strstr(r.reason, "tol 1e-12 takes steps of"));
    assert_int_equal(r.stats.steps, 0);
    assert_memory_equal(y, henon.y0, sizeof y);
}

static void
other_systems_are_refused(void **state)
{
    (void)state;
    for_each_geometric(m)
    {
        qdot_ode_result r;
        double y[4];

        memcpy(y, henon.y0, sizeof y);
        assert_int_equal(qdot_ode_integrate(&henon.system, qdot_ode_method_at(m), NULL, 0, 1, y, &r),
                         QDOT_EINVAL);
        assert_int_equal(r.outcome, QDOT_ODE_FAILED);
    }
}

/* --- constraints -------------------------------------------------------------------- */

/* A particle of mass 1 on x^2 + y^2 + z^2 = 1 under z'' = -1, in Cartesian coordinates; scaled: half
 * the difference. */
static qdot_status
sphere_copy(double t, const double *q, const double *v, double *p, void *user)
{
    (void)t;
    (void)q;
    (void)user;
    memcpy(p, v, 3 * sizeof *p);
    return QDOT_OK;
}

static qdot_status
sphere_force(double t, const double *q, const double *v, double *F, void *user)
{
    (void)t;
    (void)q;
    (void)v;
    (void)user;
    F[0] = F[1] = 0;
    F[2] = -1;
    return QDOT_OK;
}

static double
dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static qdot_status
sphere_positions(double t, const double *q, double *g, void *user)
{
    (void)t;
    (void)user;
    *g = 0.5 * (dot(q, q) - 1);
    return QDOT_OK;
}

static qdot_status
sphere_velocities(double t, const double *q, const double *v, double *w, void *user)
{
    (void)t;
    (void)user;
    *w = dot(q, v);
    return QDOT_OK;
}

static qdot_status
sphere_pull(double t, const double *q, const double *lambda, double *F, void *user)
{
    (void)t;
    (void)user;
    for (int i = 0; i < 3; i++)
        F[i] += *lambda * q[i];
    return QDOT_OK;
}

static qdot_status
sphere_prepare(double t, const double *q, void *user)
{
    (void)t;
    memcpy(user, q, 3 * sizeof *q);
    return QDOT_OK;
}

static void
sphere_solve(double *c, double *nu, double *x, void *user)
{
    const double *q = user;

    *nu = *c / dot(q, q);
    for (int i = 0; i < 3; i++)
        x[i] = *nu * q[i];
}

static double sphere_q[3];
static const qdot_ode_phase sphere_phase = {sphere_copy, sphere_copy, sphere_force, NULL};
static const qdot_ode_bonds sphere_bonds = {
    1, sphere_positions, sphere_velocities, sphere_pull, sphere_prepare, sphere_solve, sphere_q};
static const qdot_ode_system sphere = {.n = 6, .phase = &sphere_phase, .bonds = &sphere_bonds};
static const double sphere_start[6] = {1, 0, 0, 0, 0.5, 0.25};

/* The largest errors of constraints, energy and angular momentum met. */
typedef struct {
    double g, w, energy, momentum, late; /* late: of the energy in the second half */
} sphere_errors;

static qdot_status
follow_sphere(double t, const double *y, bool *stop, void *user)
{
    sphere_errors *e = user;
    const double energy = 0.5 * dot(y + 3, y + 3) + y[2] - 0.5 * 0.3125;

    (void)stop;
    e->g = fmax(e->g, fabs(0.5 * (dot(y, y) - 1)));
    e->w = fmax(e->w, fabs(dot(y, y + 3)));
    e->energy = fmax(e->energy, fabs(energy));
    e->momentum = fmax(e->momentum, fabs(y[0] * y[4] - y[1] * y[3] - 0.5));
    if (t > 1000)
        e->late = fmax(e->late, fabs(energy));
    return QDOT_OK;
}

static void
constraints_hold_at_every_step(void **state)
{
    const qdot_ode_method *m = qdot_ode_method_find("variational");

    (void)state;
    for (int k = 4; k <= 12; k += 4) {
        sphere_errors e = {0};
        const qdot_ode_options o = {
            .tol = pow(10, -k), .accepted = follow_sphere, .user = &e};
        qdot_ode_result r;
        double y[6];

        memcpy(y, sphere_start, sizeof y);
        if (qdot_ode_integrate(&sphere, m, &o, 0, 2000, y, &r) != QDOT_OK)
            fail_msg("tol %g: %s", o.tol, r.reason);
        if (!(e.g < 1e-15 && e.w < 1e-15))
            fail_msg("tol %g: constraints off by %g, %g", o.tol, e.g, e.w);
        if (!(e.energy < 3 * o.tol && e.late <= 1.1 * e.energy && e.momentum < 1e-13))
            fail_msg("tol %g: energy off by %g, momentum by %g", o.tol, e.energy, e.momentum);
    }
}

/* The errors at h and h/2 against a finer run; and the way back. */
static void
order_stays_under_constraints(void **state)
{
    const qdot_ode_method *m = qdot_ode_method_find("variational");
    double y[4][6], error[2] = {0}, back = 0;

    (void)state;
    for (int k = 0; k < 4; k++) {
        const qdot_ode_options o = {.tol = 1, .h_fixed = 0.5 / (k < 3 ? 1 << k : 1)};
        qdot_ode_result r;

        memcpy(y[k], k < 3 ? sphere_start : y[0], sizeof y[k]);
        assert_int_equal(
            qdot_ode_integrate(&sphere, m, &o, k < 3 ? 0 : 8, k < 3 ? 8 : 0, y[k], &r), QDOT_OK);
    }
    for (int i = 0; i < 6; i++) {
        error[0] = fmax(error[0], fabs(y[0][i] - y[2][i]));
        error[1] = fmax(error[1], fabs(y[1][i] - y[2][i]));
        back = fmax(back, fabs(y[3][i] - sphere_start[i]));
    }
    if (fabs(log2(error[0] / error[1]) - 10) > 0.7)
        fail_msg("errors %g, %g: order %g", error[0], error[1], log2(error[0] / error[1]));
    if (!(error[0] > 1e-10 && back < 1e-13))
        fail_msg("error %g, on the way back %g", error[0], back);
}

static void
other_methods_know_no_constraints(void **state)
{
    (void)state;
    for_each_geometric(m)
    {
        qdot_ode_system system = sphere;
        qdot_ode_result r;
        double y[6];

        system.halves = qdot_ode_method_at(m)->geometric->separable;
        memcpy(y, sphere_start, sizeof y);
        assert_int_equal(qdot_ode_integrate(&system, qdot_ode_method_at(m), NULL, 0, 1, y, &r),
                         strcmp(qdot_ode_method_at(m)->name, "variational") == 0 ? QDOT_OK
                                                                                  : QDOT_EINVAL);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_matches_table),
        cmocka_unit_test(way_back_ends_at_the_start),
        cmocka_unit_test(energy_does_not_drift),
        cmocka_unit_test(steps_keep_the_tolerance),
        cmocka_unit_test(rounding_does_not_drift),
        cmocka_unit_test(lengths_of_a_composition_add_up),
        cmocka_unit_test(too_many_steps_are_told_beforehand),
        cmocka_unit_test(other_systems_are_refused),
        cmocka_unit_test(constraints_hold_at_every_step),
        cmocka_unit_test(order_stays_under_constraints),
        cmocka_unit_test(other_methods_know_no_constraints),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
