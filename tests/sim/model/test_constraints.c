/* test_constraints.c -- runs of scenes with constraints against minimal coordinates and
 * closed forms; drift, redundancy, what is refused. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include "sim/bind/bind.h"
#include "sim/form/motion-series.h"
#include "sim/model/constraints.h"
#include "sim/plan/plan.h"

#include "sim/form/derived.h"
#include "sim/form/eliminated.h"
#include "sim/plan/form.h"

#include <math.h>

static qdot_expr
square(fixture *f, qdot_expr x)
{
    return times(f, x, x);
}

/* x, y of one bob on a rod of length 1; let go at the angle 2. */
static void
cartesian_pendulum(fixture *f)
{
    qdot_expr x, y, two;

    begin(f);
    two = qdot_expr_int(f->pool, 2);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    must(qdot_scene_particle(f->scene, "bob", parameter(f, "m"), pair(f, x, y)));
    must(qdot_scene_gravity(
        f->scene, pair(f, QDOT_ZERO, qdot_neg(f->pool, parameter(f, "g")))));
    must(qdot_scene_constraint(f->scene, "rod",
                               qdot_add(f->pool, square(f, x), square(f, y)), QDOT_ONE));
    set(f, "m", "2");
    set(f, "g", "9.81");
    f->q0[0] = qdot_fun1(f->pool, QDOT_SIN, two);
    f->q0[1] = qdot_neg(f->pool, qdot_fun1(f->pool, QDOT_COS, two));
    f->request.t1 = qdot_expr_int(f->pool, 10);
}

static void
cartesian_and_minimal_pendulum_agree(void **state)
{
    static const char *const methods[] = {"rk8pd", "dop853", "rkf45", "taylor"};
    fixture c, m;
    qdot_run *minimal;

    (void)state;
    pendulum(&m);
    m.request.t1 = qdot_expr_int(m.pool, 10);
    m.request.tol = 1e-14;
    m.request.method = "rk8pd";
    minimal = run(&m);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        const qdot_run_report *a = qdot_run_get_report(minimal), *b;
        double theta = a->q[0], omega = a->v[0], lambda, tolerance;
        qdot_run *cartesian;

        cartesian_pendulum(&c);
        c.request.method = methods[k];
        c.request.tol = 1e-13;
        cartesian = run(&c);
        b = qdot_run_get_report(cartesian);
        tolerance = 2 * (a->error + b->error) + 1e-14;
        assert_true(tolerance < 2e-10);
        assert_true(fabs(b->q[0] - sin(theta)) < tolerance);
        assert_true(fabs(b->q[1] + cos(theta)) < tolerance);
        assert_true(fabs(b->v[0] - omega * cos(theta)) < 4 * tolerance);
        /* m (-omega^2 - g cos theta) = 2 lambda, r = 1 */
        lambda = -(omega * omega + 9.81 * cos(theta));
        assert_int_equal(b->m, 1);
        assert_true(fabs(b->lambda[0] - lambda) < 100 * tolerance);
        assert_true(b->constraint_drift < 1e-15);
        assert_true(b->velocity_drift < 1e-14);
        assert_true(b->projections > 0);
        assert_true(b->energy_drift < 1e-11);
        qdot_run_free(cartesian);
        end(&c);
    }
    qdot_run_free(minimal);
    end(&m);
}

/* Left alone it drifts; damped it drifts less; projected it does not. */
static void
treatments_differ(void **state)
{
    double drift[3];

    (void)state;
    for (int k = 0; k < 3; k++) {
        fixture f;
        qdot_run *r;

        cartesian_pendulum(&f);
        f.request.method = "rk8pd";
        f.request.tol = 1e-9;
        f.request.t1 = qdot_expr_int(f.pool, 50);
        f.request.treatment = (qdot_run_treatment)k;
        r = run(&f);
        assert_int_equal(qdot_run_get_report(r)->treatment, k);
        drift[k] = qdot_run_get_report(r)->constraint_drift;
        qdot_run_free(r);
        end(&f);
    }
    assert_true(drift[QDOT_RUN_PROJECT] < 1e-15);
    assert_true(drift[QDOT_RUN_PROJECT] < 1e-3 * drift[QDOT_RUN_BAUMGARTE]);
    assert_true(drift[QDOT_RUN_BAUMGARTE] < 0.1 * drift[QDOT_RUN_NONE]);
}

/* The rod said twice: the same motion, each half of the multiplier. */
static void
redundant_constraints_change_nothing(void **state)
{
    fixture f;
    qdot_run *once, *twice;
    const qdot_run_report *a, *b;
    qdot_expr x, y, r2;

    (void)state;
    cartesian_pendulum(&f);
    f.request.method = "rk8pd";
    once = run(&f);
    x = f.scene->coordinates.at[0];
    y = f.scene->coordinates.at[1];
    r2 = qdot_add(f.pool, square(&f, x), square(&f, y));
    must(qdot_scene_constraint(f.scene, "again", r2, QDOT_ONE));
    twice = run(&f);
    a = qdot_run_get_report(once);
    b = qdot_run_get_report(twice);
    assert_int_equal(b->m, 2);
    assert_int_equal(b->independent, 1);
    assert_true(fabs(a->q[0] - b->q[0]) < 2 * (a->error + b->error));
    assert_true(fabs(b->lambda[0] - b->lambda[1]) < 1e-13);
    assert_true(fabs(a->lambda[0] - 2 * b->lambda[0]) < 100 * (a->error + b->error));
    qdot_run_free(once);
    qdot_run_free(twice);
    end(&f);
}

/* Every kind at once, on masses that couple and vary: a bead moved along its rod by
 * x = t^2/10, a velocity constraint that is not linear, an acceleration that is told. */
static void
all_kinds(fixture *f)
{
    qdot_expr q[5], v[5], M, drive;

    begin(f);
    for (int i = 0; i < 5; i++) {
        static const char *const names[] = {"a", "b", "c", "d", "e"};

        q[i] = coordinate(f, names[i]);
        v[i] = velocity(f, q[i]);
    }
    /* particles at (a + b^2/2, sin b) and (c, d + a c/3), (e, a): M holds q */
    M = times(f, QDOT_HALF, square(f, q[1]));
    must(qdot_scene_particle(f->scene, "p", QDOT_ONE,
                             pair(f, qdot_add(f->pool, q[0], M),
                                  qdot_fun1(f->pool, QDOT_SIN, q[1]))));
    M = qdot_add(f->pool, q[3], times(f, number(f, "0.3"), times(f, q[0], q[2])));
    must(qdot_scene_particle(f->scene, "r", number(f, "0.7"), pair(f, q[2], M)));
    must(qdot_scene_particle(f->scene, "s", number(f, "1.3"), pair(f, q[4], q[0])));
    must(qdot_scene_gravity(f->scene, pair(f, number(f, "0.2"), number(f, "-1"))));
    drive = times(f, number(f, "0.1"), square(f, QDOT_T));
    must(qdot_scene_constraint(
        f->scene, "moving", qdot_add(f->pool, q[0], times(f, q[1], q[4])), drive));
    must(qdot_scene_constraint(f->scene, "bent",
                               qdot_add(f->pool, square(f, v[2]), square(f, v[3])),
                               qdot_add(f->pool, QDOT_ONE, times(f, q[1], v[3]))));
    must(qdot_scene_constraint(
        f->scene, "told", qdot_symbol_jet(f->pool, q[1], 2),
        qdot_sub(f->pool, qdot_fun1(f->pool, QDOT_COS, QDOT_T),
                 times(f, q[2], qdot_symbol_jet(f->pool, q[3], 2)))));
    f->v0[2] = QDOT_ONE;
    f->v0[4] = number(f, "0.4");
    f->q0[4] = number(f, "0.5");
    f->request.t1 = number(f, "1.5");
}

static void
agree(fixture *f, double bound)
{
    qdot_run *taylor, *rk8pd;
    const qdot_run_report *a, *b;

    f->request.tol = 1e-13;
    f->request.method = "taylor";
    taylor = run(f);
    f->request.method = "rk8pd";
    rk8pd = run(f);
    a = qdot_run_get_report(taylor);
    b = qdot_run_get_report(rk8pd);
    assert_int_equal(a->status, QDOT_RUN_DONE);
    assert_true(a->steps < b->steps);
    for (size_t i = 0; i < a->n; i++)
        if (!(fmax(fabs(a->q[i] - b->q[i]), fabs(a->v[i] - b->v[i])) < bound))
            fail_msg("coordinate %zu: %.17g %.17g, %.17g %.17g", i, a->q[i], b->q[i],
                     a->v[i], b->v[i]);
    for (size_t k = 0; k < a->m; k++)
        assert_true(fabs(a->lambda[k] - b->lambda[k])
                    < 30 * bound * fmax(1, fabs(a->lambda[k])));
    qdot_run_free(taylor);
    qdot_run_free(rk8pd);
}

/* By series nothing is differentiated, by rk8pd all is, symbolically. */
static void
series_and_differentiated_constraints_agree(void **state)
{
    fixture f;

    (void)state;
    for (int k = 0; k < 3; k++) {
        all_kinds(&f);
        f.request.treatment = (qdot_run_treatment)k;
        agree(&f, 1e-11);
        end(&f);
    }
}

/* 440 periods: rounding is noise, and what it does to the energy grows as the square root
 * of the time (a drift of one last bit an order of a step would be 7e-14). */
static void
long_runs_do_not_drift(void **state)
{
    const qdot_run_report *report;
    fixture f;
    qdot_run *r;

    (void)state;
    cartesian_pendulum(&f);
    f.q0[0] = qdot_fun1(f.pool, QDOT_SIN, QDOT_ONE);
    f.q0[1] = qdot_neg(f.pool, qdot_fun1(f.pool, QDOT_COS, QDOT_ONE));
    f.request.t1 = qdot_expr_int(f.pool, 1000);
    f.request.tol = 1e-15;
    r = run(&f);
    report = qdot_run_get_report(r);
    assert_string_equal(report->method, "taylor");
    assert_true(report->constraint_drift < 1e-15);
    assert_true(report->energy_drift < 4e-14);
    assert_true(report->projections < report->steps / 3);
    qdot_run_free(r);
    end(&f);
}

/* Multipliers at the end: what is said of their errors holds, and is not much. */
static void
multipliers_state_their_errors(void **state)
{
    fixture f;
    qdot_run *coarse, *fine;
    const qdot_run_report *a, *b;
    double error;

    (void)state;
    cartesian_pendulum(&f);
    f.request.method = "rk8pd";
    f.request.tol = 1e-8;
    coarse = run(&f);
    f.request.tol = 1e-14;
    fine = run(&f);
    a = qdot_run_get_report(coarse);
    b = qdot_run_get_report(fine);
    error = fabs(a->lambda[0] - b->lambda[0]);
    assert_true(error > 10 * b->lambda_error[0]);
    assert_true(error < 3 * a->lambda_error[0] && a->lambda_error[0] < 100 * error);
    qdot_run_free(coarse);
    qdot_run_free(fine);
    end(&f);
}

static void
every_failed_allocation_is_survived(void **state)
{
    fixture f;

    (void)state;
    cartesian_pendulum(&f);
    survives_failed_allocations(&f);
    end(&f);
}

static void
refuses(fixture *f, qdot_status status, const char *message)
{
    qdot_run *r = NULL;

    assert_int_equal(qdot_run_new(f->scene, &f->request, &r), status);
    assert_null(r);
    if (!strstr(qdot_last_error()->message, message))
        fail_msg("%s", qdot_last_error()->message);
    end(f);
}

static void
what_cannot_be_held_is_refused(void **state)
{
    fixture f;
    qdot_expr x;

    (void)state;
    /* x'' = 0 and 2 x'' = 1: no start breaks them, no motion can do both */
    cartesian_pendulum(&f);
    x = qdot_symbol_jet(f.pool, f.scene->coordinates.at[0], 2);
    must(qdot_scene_constraint(f.scene, "a", x, QDOT_ZERO));
    must(qdot_scene_constraint(f.scene, "b", qdot_add(f.pool, x, x), QDOT_ONE));
    refuses(&f, QDOT_EINVAL, "contradicts the others");
}

/* A particle at (r cos phi, r sin phi, z) with r^2 + z^2 = 2 + t and z' = r phi' / 2. */
static void
winding(fixture *f)
{
    qdot_expr r, phi, z, at[3], two;

    begin(f);
    two = qdot_expr_int(f->pool, 2);
    r = coordinate(f, "r");
    phi = coordinate(f, "phi");
    z = coordinate(f, "z");
    at[0] = times(f, r, qdot_fun1(f->pool, QDOT_COS, phi));
    at[1] = times(f, r, qdot_fun1(f->pool, QDOT_SIN, phi));
    at[2] = z;
    must(qdot_scene_particle(f->scene, "p", two, qdot_vector(f->pool, 3, at)));
    must(qdot_scene_potential(f->scene, times(f, z, r)));
    must(qdot_scene_constraint(f->scene, "ball",
                               qdot_add(f->pool, square(f, r), square(f, z)),
                               qdot_add(f->pool, two, QDOT_T)));
    must(qdot_scene_constraint(
        f->scene, "screw", times(f, two, qdot_symbol_jet(f->pool, z, 1)),
        times(f, r, qdot_symbol_jet(f->pool, phi, 1))));
}

/* Off the constraints too, where damping counts. */
static void
slopes_are_those_of_the_right_hand_side(void **state)
{
    const double h = 1e-5;

    (void)state;
    for (int treatment = 0; treatment < 3; treatment++) {
        double y[6] = {1.1, 0.3, 0.8, 0.4, -0.7, 0.2}, t = 0.1, J[36], Jt[6], up[6], down[6];
        fixture f;
        qdot_plan *plan;
        qdot_bind *bind;
        qdot_ode_system system;

        winding(&f);
        f.request.method = "bsimp";
        f.request.treatment = (qdot_run_treatment)treatment;
        must(qdot_plan_new(f.scene, &f.request, &plan));
        must(qdot_bind_new(plan, false, &bind));
        system = qdot_bind_system(bind);
        must(system.jacobian(t, y, J, Jt, system.user));
        for (size_t j = 0; j <= 6; j++) {
            double *x = j < 6 ? &y[j] : &t, keep = *x;

            *x = keep + h;
            must(system.rhs(t, y, up, system.user));
            *x = keep - h;
            must(system.rhs(t, y, down, system.user));
            *x = keep;
            for (size_t i = 0; i < 6; i++) {
                double slope = (up[i] - down[i]) / (2 * h);
                double seen = j < 6 ? J[i * 6 + j] : Jt[i];

                assert_true(fabs(seen - slope) < 1e-7 * (1 + fabs(slope)));
            }
        }
        qdot_bind_free(bind);
        qdot_plan_free(plan);
        end(&f);
    }
}

static void
implicit_methods_agree(void **state)
{
    static const char *const methods[] = {"bsimp", "msbdf"};
    fixture f;
    qdot_run *r;
    double x;

    (void)state;
    cartesian_pendulum(&f);
    r = run(&f);
    x = qdot_run_get_report(r)->q[0];
    qdot_run_free(r);
    for (int k = 0; k < 2; k++) {
        const qdot_run_report *report;

        f.request.method = methods[k];
        f.request.tol = 1e-9;
        r = run(&f);
        report = qdot_run_get_report(r);
        assert_true(report->error < 1e-4);
        assert_true(fabs(report->q[0] - x) < 2 * report->error);
        assert_true(report->constraint_drift < (k == 0 ? 1e-15 : 1e-5));
        assert_int_equal(report->treatment,
                         k == 0 ? QDOT_RUN_PROJECT : QDOT_RUN_BAUMGARTE);
        qdot_run_free(r);
    }
    end(&f);
}

/* A bob on a sphere, its velocities tied too. */
static void
tied_bob(fixture *f)
{
    qdot_expr q[3], r2 = QDOT_ZERO;

    begin(f);
    q[0] = coordinate(f, "x");
    q[1] = coordinate(f, "y");
    q[2] = coordinate(f, "z");
    must(qdot_scene_particle(f->scene, "bob", parameter(f, "m"),
                             qdot_vector(f->pool, 3, q)));
    must(qdot_scene_gravity(
        f->scene, qdot_vector(f->pool, 3,
                              (qdot_expr[]){QDOT_ZERO, QDOT_ZERO,
                                            qdot_neg(f->pool, parameter(f, "g"))})));
    for (int i = 0; i < 3; i++)
        r2 = qdot_add(f->pool, r2, square(f, q[i]));
    must(qdot_scene_constraint(f->scene, "sphere", r2, QDOT_ONE));
    must(qdot_scene_constraint(f->scene, "blade", qdot_symbol_jet(f->pool, q[0], 1),
                               times(f, q[2], qdot_symbol_jet(f->pool, q[1], 1))));
    set(f, "m", "2");
    set(f, "g", "9.81");
}

/* That scene at a loose tolerance, by both of its series. */
typedef struct {
    qdot_plan *plan;
    qdot_bind *bind;
    qdot_motion_series *whole;
    const qdot_ode_series *series[2]; /* with multipliers eliminated; solved for */
} both;

/* A plan at that tolerance by multipliers eliminated beforehand, whatever is cheaper. */
static qdot_plan *
plan_eliminated(fixture *f)
{
    qdot_plan *p;

    f->request.tol = 1e-5;
    must(qdot_plan_new(f->scene, &f->request, &p));
    qdot_plan_drop_bordered(p);
    qdot_plan_free(p->eliminated);
    must(qdot_eliminated_make(p, f->request.tol, &p->eliminated));
    assert_non_null(p->eliminated);
    must(qdot_plan_measure(p->eliminated));
    p->form = QDOT_FORM_ELIMINATED;
    return p;
}

static void
both_begin(both *b, fixture *f)
{
    tied_bob(f);
    b->plan = plan_eliminated(f);
    must(qdot_bind_new(b->plan, false, &b->bind));
    must(qdot_motion_series_of_constraints(b->plan, false, &b->whole));
    b->series[0] = qdot_bind_system(b->bind).series;
    b->series[1] = qdot_motion_series_get(b->whole);
}

static void
both_expand(const both *b, double t, const double *y, double unit, int p)
{
    for (int k = 0; k < 2; k++) {
        must(b->series[k]->begin(t, y, unit, b->series[k]->user));
        must(b->series[k]->extend(p, b->series[k]->user));
    }
}

static void
both_end(both *b)
{
    qdot_motion_series_free(b->whole);
    qdot_bind_free(b->bind);
    qdot_plan_free(b->plan);
}

/* Multipliers eliminated beforehand or solved for at every order: one motion. */
static void
both_series_are_one(void **state)
{
    static const double y[] = {0.48, 0.6, 0.64, 0.32, 0.5, -0.70875};
    const size_t n = 3;
    const qdot_ode_series *const *series;
    qdot_plan *plan;
    fixture f;
    both b;

    (void)state;
    both_begin(&b, &f);
    series = b.series;
    both_expand(&b, 0.3, y, 0.5, 20);
    assert_true(series[0]->x != series[1]->x);
    for (size_t i = 0; i < 2 * n; i++)
        for (size_t k = 0; k < 20; k++) {
            double own = series[0]->x[i * series[0]->stride + k];
            double other = series[1]->x[i * series[1]->stride + k];

            assert_true(fabs(own - other) < 1e-13 * fmax(1, fabs(other)));
        }
    both_end(&b);
    /* to the last digits no elimination without a correction */
    f.request.tol = 1e-12;
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_null(plan->eliminated);
    qdot_plan_free(plan);
    end(&f);
}

/* A rod that is held has a constant S: nothing is divided by. Left alone it has not. */
static void
held_rods_are_not_measured(void **state)
{
    qdot_plan *plan;
    fixture f;
    size_t held;

    (void)state;
    cartesian_pendulum(&f);
    plan = plan_eliminated(&f);
    held = qdot_tape_operations(plan->eliminated->tape);
    qdot_plan_free(plan);
    f.request.treatment = QDOT_RUN_NONE;
    plan = plan_eliminated(&f);
    assert_true(held < qdot_tape_operations(plan->eliminated->tape));
    qdot_plan_free(plan);
    end(&f);
}

/* Where rows come near each other the form that knows of it takes over. */
static void
rows_nearly_dependent_are_not_eliminated(void **state)
{
    double y[] = {0, 0, 0, 0, 0, 0};
    const qdot_ode_series *const *series;
    fixture f;
    both b;

    (void)state;
    both_begin(&b, &f);
    series = b.series;
    /* the sphere's normal (x, y, z) beside the blade's (1, -z, 0) */
    y[2] = 0.1;
    y[0] = sqrt((1 - y[2] * y[2]) / (1 + y[2] * y[2]));
    y[1] = -y[2] * y[0];
    both_expand(&b, 0, y, 1, 12);
    for (size_t i = 0; i < 6; i++)
        for (size_t k = 0; k < 12; k++)
            assert_true(series[0]->x[i * series[0]->stride + k] ==
                        series[1]->x[i * series[1]->stride + k]);
    both_end(&b);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cartesian_and_minimal_pendulum_agree),
        cmocka_unit_test(treatments_differ),
        cmocka_unit_test(series_and_differentiated_constraints_agree),
        cmocka_unit_test(redundant_constraints_change_nothing),
        cmocka_unit_test(long_runs_do_not_drift),
        cmocka_unit_test(multipliers_state_their_errors),
        cmocka_unit_test(every_failed_allocation_is_survived),
        cmocka_unit_test(what_cannot_be_held_is_refused),
        cmocka_unit_test(slopes_are_those_of_the_right_hand_side),
        cmocka_unit_test(implicit_methods_agree),
        cmocka_unit_test(both_series_are_one),
        cmocka_unit_test(held_rods_are_not_measured),
        cmocka_unit_test(rows_nearly_dependent_are_not_eliminated),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
