#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>

#include "num/sum.h"
#include "ode/geometric/geometric.h"
#include "ode/geometric/splitting.h"
#include "problems.h"

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
                {"gauss6", 0.4},  {"gauss8", 0.8},       {"gauss12", 1.6}};
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

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_matches_table),
        cmocka_unit_test(way_back_ends_at_the_start),
        cmocka_unit_test(energy_does_not_drift),
        cmocka_unit_test(steps_keep_the_tolerance),
        cmocka_unit_test(lengths_of_a_composition_add_up),
        cmocka_unit_test(too_many_steps_are_told_beforehand),
        cmocka_unit_test(other_systems_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
