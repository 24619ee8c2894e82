/* test_routh.c -- momenta kept in place of velocities: the same motion, coefficient by
 * coefficient and run by run, and what is not kept. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/bind/bind.h"
#include "sim/form/motion-series.h"
#include "sim/model/momenta.h"
#include "sim/plan/plan.h"
#include "sim/plan/routh.h"

/* --- scenes ---------------------------------------------------------------------------- */

static qdot_expr
sine(fixture *f, qdot_expr x)
{
    return qdot_fun1(f->pool, QDOT_SIN, x);
}

static qdot_expr
cosine(fixture *f, qdot_expr x)
{
    return qdot_fun1(f->pool, QDOT_COS, x);
}

/* A particle in a plane, in polar coordinates about a centre that attracts it. */
static void
kepler(fixture *f)
{
    qdot_expr r, theta, m;

    begin(f);
    m = parameter(f, "m");
    r = coordinate(f, "r");
    theta = coordinate(f, "theta");
    must(qdot_scene_particle(
        f->scene, "p", m,
        pair(f, times(f, r, cosine(f, theta)), times(f, r, sine(f, theta)))));
    must(qdot_scene_potential(
        f->scene, qdot_neg(f->pool, qdot_div(f->pool, parameter(f, "k"), r))));
    set(f, "m", "1.3");
    set(f, "k", "1.1");
    f->q0[0] = QDOT_ONE;
    f->v0[1] = number(f, "0.9");
}

/* The same in a field B, turned with the angle w t, beside a third coordinate along which
 * nothing is applied: p has a term without velocities, positions have the time. */
static void
magnetic(fixture *f)
{
    qdot_expr r, theta, z, m, angle, at[3];

    begin(f);
    m = parameter(f, "m");
    r = coordinate(f, "r");
    theta = coordinate(f, "theta");
    z = coordinate(f, "z");
    angle = qdot_add(f->pool, theta, times(f, parameter(f, "w"), QDOT_T));
    at[0] = times(f, r, cosine(f, angle));
    at[1] = times(f, r, sine(f, angle));
    at[2] = z;
    must(qdot_scene_particle(f->scene, "p", m, qdot_vector(f->pool, 3, at)));
    must(qdot_scene_potential(
        f->scene,
        qdot_sub(f->pool, times(f, parameter(f, "k"), qdot_pow_int(f->pool, r, 2)),
                 times(f, times(f, parameter(f, "B"), qdot_pow_int(f->pool, r, 2)),
                       velocity(f, theta)))));
    set(f, "m", "1.3");
    set(f, "k", "0.6");
    set(f, "w", "0.7");
    set(f, "B", "0.4");
    f->q0[0] = QDOT_ONE;
    f->v0[0] = number(f, "0.3");
    f->v0[1] = number(f, "0.5");
    f->v0[2] = number(f, "0.25");
}

/* Lagrange's top, its momenta coupled, as a stated Lagrangian. */
static void
top(fixture *f)
{
    qdot_expr phi, theta, psi, spin, turn, L;
    qdot_pool *pool;

    begin(f);
    pool = f->pool;
    phi = coordinate(f, "phi");
    theta = coordinate(f, "theta");
    psi = coordinate(f, "psi");
    spin = qdot_add(pool, velocity(f, psi),
                    times(f, velocity(f, phi), cosine(f, theta)));
    turn = times(f, velocity(f, phi), sine(f, theta));
    L = qdot_add(pool, qdot_pow_int(pool, turn, 2),
                 qdot_pow_int(pool, velocity(f, theta), 2));
    L = qdot_add(pool, times(f, QDOT_HALF, L),
                 times(f, parameter(f, "C"), qdot_pow_int(pool, spin, 2)));
    L = qdot_sub(pool, L, times(f, parameter(f, "G"), cosine(f, theta)));
    must(qdot_scene_lagrangian(f->scene, L));
    set(f, "C", "0.2");
    set(f, "G", "4.9");
    f->q0[1] = number(f, "0.5");
    f->v0[0] = QDOT_ONE;
    f->v0[2] = number(f, "4");
}

/* --- the same motion ------------------------------------------------------------------- */

static qdot_plan *
plan_of(fixture *f)
{
    qdot_plan *plan;

    f->request.method = "taylor";
    must(qdot_plan_new(f->scene, &f->request, &plan));
    return plan;
}

/* Coefficients of both, about a state. */
static void
series_agree(const qdot_plan *plan, const double *y, double t)
{
    enum { P = 20 };
    const size_t n = plan->n;
    const qdot_ode_series *a, *b;
    const qdot_ode_following *following;
    qdot_ode_system system;
    qdot_motion_series *direct;
    qdot_bind *bind;

    must(qdot_motion_series_new(plan, false, &direct));
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    following = system.following;
    assert_non_null(following);
    must(following->enter(t, y, NULL, following->user));
    a = qdot_motion_series_get(direct);
    b = system.series;
    must(a->begin(t, y, 0.125, a->user));
    must(a->extend(P, a->user));
    must(b->begin(t, y, 0.125, b->user));
    must(b->extend(P, b->user));
    for (size_t i = 0; i < 2 * n; i++) {
        double size = 0;

        for (int k = 0; k < P; k++) {
            double x = a->x[i * a->stride + (size_t)k];
            double z = b->x[i * b->stride + (size_t)k];

            size = fmax(size, fabs(x));
            if (!(fabs(x - z) <= 1e-12 * (1e-3 + size)))
                fail_msg("component %zu, order %d: %.17g and %.17g", i, k, x, z);
        }
    }
    qdot_motion_series_free(direct);
    qdot_bind_free(bind);
}

/* rhs gives what is integrated, _accelerations all; velocities follow from the rest. */
static void
values_agree(const qdot_plan *plan, const double *y, double t)
{
    const qdot_plan *r = plan->reduced;
    const size_t n = plan->n;
    double dydt[2 * MOST_COORDINATES], a[MOST_COORDINATES], z[2 * MOST_COORDINATES];
    const qdot_ode_following *following;
    qdot_ode_system system;
    qdot_bind *bind;

    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    following = system.following;
    must(following->enter(t, y, NULL, following->user));
    memcpy(z, y, 2 * n * sizeof *z);
    for (size_t k = 0; k < r->n_kept; k++)
        z[following->index[k]] = NAN; /* nothing reads it */
    must(system.rhs(t, z, dydt, system.user));
    must(qdot_bind_accelerations(&system, t, y, a));
    for (size_t i = 0; i < n; i++) {
        bool kept = false;

        for (size_t k = 0; k < r->n_kept; k++)
            kept |= r->kept[k] == i;
        assert_true(fabs(dydt[i] - y[n + i]) <= 1e-14 * (1 + fabs(y[n + i])));
        if (kept)
            assert_true(dydt[n + i] == 0);
        else if (!(fabs(dydt[n + i] - a[i]) <= 1e-13 * (1 + fabs(a[i]))))
            fail_msg("acceleration %zu: %.17g and %.17g", i, dydt[n + i], a[i]);
    }
    must(following->derive(t, z, following->user));
    for (size_t i = 0; i < 2 * n; i++)
        assert_true(fabs(z[i] - y[i]) <= 1e-14 * (1 + fabs(y[i])));
    qdot_bind_free(bind);
}

static void
keeps(fixture *f, size_t count, const double *y, double t)
{
    qdot_plan *plan = plan_of(f);

    assert_non_null(plan->reduced);
    assert_int_equal(plan->reduced->n_kept, count);
    assert_true(plan->reduced->convolutions_derived < plan->convolutions_derived);
    series_agree(plan, y, t);
    values_agree(plan, y, t);
    qdot_plan_free(plan);
    end(f);
}

static void
a_centre_keeps_the_angular_momentum(void **state)
{
    const double y[] = {0.7, 2.1, -0.4, 0.9};
    qdot_plan *plan;
    fixture f;

    (void)state;
    kepler(&f);
    plan = plan_of(&f);
    assert_true(plan->reduced->convolutions_derived == 2.5);
    qdot_plan_free(plan);
    keeps(&f, 1, y, 0);
}

static void
fields_and_moving_frames_are_in_the_momentum(void **state)
{
    const double y[] = {0.7, 2.1, 0.3, -0.4, 0.9, 1.7};
    fixture f;

    (void)state;
    magnetic(&f);
    keeps(&f, 2, y, 0.6);
}

static void
momenta_that_couple_are_solved_for(void **state)
{
    const double y[] = {0.3, 0.8, -1, 0.7, -0.2, 3};
    fixture f;

    (void)state;
    top(&f);
    keeps(&f, 2, y, 0);
}

/* p_phi - p_psi cos(theta) of a fast one cancels: at the last tolerances the velocities are
 * carried. */
static void
what_cancels_is_not_kept_to_the_last_digit(void **state)
{
    qdot_plan *plan;
    fixture f;

    (void)state;
    top(&f);
    f.v0[2] = qdot_expr_int(f.pool, 40);
    plan = plan_of(&f);
    assert_non_null(plan->reduced);
    qdot_plan_free(plan);
    f.request.tol = 1e-15;
    plan = plan_of(&f);
    assert_null(plan->reduced);
    qdot_plan_free(plan);
    end(&f);
}

/* --- what is not kept ------------------------------------------------------------------ */

static void
a_force_along_it_leaves_a_coordinate_in(void **state)
{
    fixture f;
    qdot_plan *plan;
    qdot_expr theta;

    (void)state;
    kepler(&f);
    theta = f.scene->coordinates.at[1];
    must(qdot_scene_dissipation(
        f.scene,
        times(&f, QDOT_HALF, qdot_pow_int(f.pool, velocity(&f, theta), 2))));
    plan = plan_of(&f);
    assert_null(plan->reduced);
    qdot_plan_free(plan);
    end(&f);
    /* one along the other that knows nothing of it does not */
    kepler(&f);
    must(qdot_scene_dissipation(
        f.scene,
        times(&f, QDOT_HALF,
              qdot_pow_int(f.pool, velocity(&f, f.scene->coordinates.at[0]), 2))));
    plan = plan_of(&f);
    assert_non_null(plan->reduced);
    qdot_plan_free(plan);
    end(&f);
    /* methods with a Jacobian have that of all velocities */
    kepler(&f);
    f.request.method = "bsimp";
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_null(plan->reduced);
    qdot_plan_free(plan);
    end(&f);
}

/* --- runs -------------------------------------------------------------------------------- */

/* By every method the end is that of 30 digits, as far as is stated, and the momentum at
 * any time is what it was. */
static void
runs_end_where_they_should(void **state)
{
    static const char *const methods[] = {"taylor", "dop853", "rk8pd", "msadams"};
    void (*const scenes[])(fixture *) = {kepler, magnetic, top};

    (void)state;
    for (size_t s = 0; s < 3; s++) {
        fixture f;
        qdot_run *exact;

        scenes[s](&f);
        f.request.t1 = qdot_expr_int(f.pool, s == 1 ? -4 : 4);
        f.request.digits = 20;
        must(qdot_run_new(f.scene, &f.request, &exact));
        f.request.digits = 0;
        for (size_t m = 0; m < 4; m++) {
            const qdot_run_report *a, *b = qdot_run_get_report(exact);
            qdot_run *run;

            f.request.method = methods[m];
            must(qdot_run_new(f.scene, &f.request, &run));
            a = qdot_run_get_report(run);
            assert_int_equal(a->status, QDOT_RUN_DONE);
            for (size_t i = 0; i < a->n; i++) {
                double dq = fabs(a->q[i] - b->q[i]) / fmax(1, fabs(b->q[i]));
                double dv = fabs(a->v[i] - b->v[i]) / fmax(1, fabs(b->v[i]));

                if (!(fmax(dq, dv) <= 3 * a->error))
                    fail_msg("scene %zu, %s, coordinate %zu: %g, stated %g", s,
                             methods[m], i, fmax(dq, dv), a->error);
            }
            for (size_t i = 0; i < a->n_drifts; i++) {
                const double times[] = {0, s == 1 ? -1.23 : 1.23, s == 1 ? -3.9 : 3.9};
                qdot_expr p = a->drifts[i].quantity;
                double values[3], size;

                if (strcmp(a->drifts[i].name, "energy") == 0)
                    continue;
                assert_true(a->drifts[i].drift == 0);
                /* z shares nothing and runs apart, as it is */
                assert_true(a->drifts[i].kept || strcmp(a->drifts[i].name, "p[z]") == 0);
                must(qdot_run_values(run, 1, &p, 3, times, values, NULL));
                size = fmax(1, fabs(values[0]));
                assert_true(fabs(values[1] - values[0]) <= 2e-14 * size);
                assert_true(fabs(values[2] - values[0]) <= 2e-14 * size);
            }
            qdot_run_free(run);
        }
        qdot_run_free(exact);
        end(&f);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_centre_keeps_the_angular_momentum),
        cmocka_unit_test(fields_and_moving_frames_are_in_the_momentum),
        cmocka_unit_test(momenta_that_couple_are_solved_for),
        cmocka_unit_test(what_cancels_is_not_kept_to_the_last_digit),
        cmocka_unit_test(a_force_along_it_leaves_a_coordinate_in),
        cmocka_unit_test(runs_end_where_they_should),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
