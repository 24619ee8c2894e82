/* test_taylor.c -- runs by Taylor series: both forms of the equations, references, what
 * has no series. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "series/lanes-code.h"
#include "sim/form/motion-of-residual.h"
#include "sim/form/motion-series.h"
#include "sim/form/residual.h"
#include "sim/form/tree-series.h"
#include "sim/plan/plan.h"

enum { P = 24 };

/* A run of the scene by a method under a tolerance; the caller frees it. */
static qdot_run *
run_by(fixture *f, const char *method, double tol)
{
    qdot_run *r;

    f->request.method = method;
    f->request.tol = tol;
    must(qdot_run_new(f->scene, &f->request, &r));
    return r;
}

/* Both end in the same state, within `bound` and what they state. */
static void
agrees_with_rk8pd(fixture *f, double bound)
{
    qdot_run *taylor = run_by(f, "taylor", 1e-14), *rk8pd = run_by(f, "rk8pd", 1e-13);
    const qdot_run_report *a = qdot_run_get_report(taylor);
    const qdot_run_report *b = qdot_run_get_report(rk8pd);

    assert_string_equal(a->method, "taylor");
    assert_int_equal(a->status, QDOT_RUN_DONE);
    assert_int_equal(b->status, QDOT_RUN_DONE);
    for (size_t i = 0; i < a->n; i++) {
        double dq = fabs(a->q[i] - b->q[i]) / fmax(1, fabs(b->q[i]));
        double dv = fabs(a->v[i] - b->v[i]) / fmax(1, fabs(b->v[i]));

        if (!(fmax(dq, dv) <= bound && fmax(dq, dv) <= 3 * (a->error + b->error)))
            fail_msg("coordinate %zu: %g, stated %g and %g", i, fmax(dq, dv), a->error,
                     b->error);
    }
    assert_true(a->steps < b->steps);
    qdot_run_free(taylor);
    qdot_run_free(rk8pd);
}

/* About one state every coefficient of `b` is that of `a`, which is expanded. */
static void
series_agree(const qdot_ode_series *a, const qdot_ode_series *b, size_t n,
             const double *y, double t, int p)
{
    must(b->begin(t, y, 0.125, b->user));
    must(b->extend(p, b->user));
    for (size_t i = 0; i < n; i++) {
        double size = 0;

        for (int k = 0; k <= p; k++) {
            double x = a->x[i * a->stride + (size_t)k],
                   z = b->x[i * b->stride + (size_t)k];

            size = fmax(size, fabs(x));
            if (!(fabs(x - z) <= 1e-12 * (1e-3 + size)))
                fail_msg("component %zu, order %d: %.17g and %.17g", i, k, x, z);
        }
    }
}

/* The program of the residual, by kernels and as machine code. */
static void
stages_agree(const qdot_plan *plan, const qdot_residual *residual,
             const qdot_ode_series *a, const double *y, double t)
{
    qdot_motion motion;
    qdot_motion_series *stages;
    const qdot_ode_series *b;
    const char *why;

    must(qdot_motion_of_residual(plan, residual, &motion));
    must(qdot_motion_series_of_residual(plan, &motion, residual->masses, false, &stages));
    b = qdot_motion_series_get(stages);
    series_agree(a, b, 2 * plan->n, y, t, P);
    assert_int_equal(qdot_motion_series_code(stages, &why), 0);
    assert_non_null(why);
    assert_true((b->code.write != NULL) == qdot_lanes_may_be_code());
    if (b->code.write) {
        must(b->code.write(P, P, b->code.user));
        assert_true(b->code.there(P, b->code.user));
        assert_false(b->code.there(P - 1, b->code.user));
        assert_true(qdot_motion_series_code(stages, &why) > 0);
        series_agree(a, b, 2 * plan->n, y, t, P);
        series_agree(a, b, 2 * plan->n, y, t, P - 1); /* kernels */
        b->code.drop(b->code.user);
        assert_false(b->code.there(P, b->code.user));
        series_agree(a, b, 2 * plan->n, y, t, P);
    }
    qdot_motion_series_free(stages);
    qdot_motion_clear(&motion);
}

/* Both forms. */
static void
forms_agree(fixture *f, const double *y, double t)
{
    qdot_residual *residual;
    qdot_motion_series *direct;
    qdot_tree_series *tree;
    qdot_plan *plan;
    const qdot_ode_series *a;

    f->request.method = "taylor";
    must(qdot_plan_new(f->scene, &f->request, &plan));
    must(qdot_motion_series_new(plan, false, &direct));
    must(qdot_residual_new(f->scene, plan, &residual));
    assert_non_null(residual);
    must(qdot_residual_programs(residual));
    must(qdot_tree_series_new(plan, residual, false, &tree));
    a = qdot_motion_series_get(direct);
    must(a->begin(t, y, 0.125, a->user));
    must(a->extend(P, a->user));
    if (tree)
        series_agree(a, qdot_tree_series_get(tree), 2 * plan->n, y, t, P);
    stages_agree(plan, residual, a, y, t);
    qdot_motion_series_free(direct);
    qdot_tree_series_free(tree);
    qdot_residual_free(residual);
    qdot_plan_free(plan);
}

static void
both_forms_of_a_chain_agree(void **state)
{
    const double y[] = {0.3, -1.2, 2, 0.7, 1.1, 0.4, -0.3, 0.9, -1.4, 0.2};
    fixture f;

    (void)state;
    chain(&f, 5);
    forms_agree(&f, y, 0);
    end(&f);
}

/* Dampers, forces that hold time and velocities, a particle that follows no other. */
static void
rough_scene(fixture *f)
{
    qdot_expr c, v, t, sine;
    qdot_torque torque = {.body = -1};

    chain(f, 3);
    c = parameter(f, "c");
    v = velocity(f, f->scene->coordinates.at[0]);
    must(qdot_scene_dissipation(f->scene, times(f, c, times(f, v, v))));
    t = times(f, number(f, "1.7"), QDOT_T);
    sine = qdot_fun1(f->pool, QDOT_SIN, t);
    torque.torque = times(f, number(f, "0.4"), sine);
    torque.coordinate = f->scene->coordinates.at[2];
    must(qdot_scene_torque(f->scene, &torque));
    set(f, "c", "0.2");
}

static void
both_forms_agree_with_friction_and_time(void **state)
{
    const double y[] = {0.3, -1.2, 2, 0.4, -0.3, 0.9};
    fixture f;

    (void)state;
    rough_scene(&f);
    forms_agree(&f, y, 0.8);
    end(&f);
}

static void
a_chain_takes_the_residual_and_a_pendulum_does_not(void **state)
{
    qdot_text text = {0};
    fixture f;

    (void)state;
    chain(&f, 8);
    f.request.method = "taylor";
    must(qdot_run_plan(f.scene, &f.request, &text));
    assert_non_null(
        strstr(qdot_text_str(&text), "d'Alembert's residual, 32 convolutions"));
    assert_non_null(strstr(qdot_text_str(&text), "order: "));
    qdot_text_clear(&text);
    end(&f);
    pendulum(&f);
    f.request.method = "taylor";
    must(qdot_run_plan(f.scene, &f.request, &text));
    assert_non_null(strstr(qdot_text_str(&text), "form: M q'' = f, 2 convolutions"));
    qdot_text_clear(&text);
    end(&f);
}

static void
runs_agree_with_runge_kutta(void **state)
{
    fixture f;

    (void)state;
    chain(&f, 4);
    for (int i = 0; i < 4; i++)
        f.q0[i] = number(&f, i % 2 ? "0.8" : "-0.5");
    f.request.t1 = qdot_expr_int(f.pool, 3);
    agrees_with_rk8pd(&f, 1e-11);
    f.request.t1 = qdot_expr_int(f.pool, -2);
    agrees_with_rk8pd(&f, 1e-11);
    end(&f);
    rough_scene(&f);
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 6);
    agrees_with_rk8pd(&f, 1e-11);
    end(&f);
}

/* Masses 1 and 1 at x and x + y: M is constant and full. */
static void
a_constant_matrix_is_factored_once(void **state)
{
    qdot_expr x, y, m;
    qdot_run *r;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    m = parameter(&f, "m");
    must(qdot_scene_particle(f.scene, "a", m, x));
    must(qdot_scene_particle(f.scene, "b", m, qdot_add(f.pool, x, y)));
    must(qdot_scene_potential(f.scene, qdot_add(f.pool, qdot_pow_int(f.pool, x, 4),
                                                qdot_fun1(f.pool, QDOT_COSH, y))));
    set(&f, "m", "1");
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 10);
    agrees_with_rk8pd(&f, 1e-11);
    r = run_by(&f, "taylor", 1e-12);
    assert_true(qdot_run_get_report(r)->factorizations <= 2);
    qdot_run_free(r);
    end(&f);
}

static void
values_between_steps_are_as_accurate(void **state)
{
    double a[50], b[50], times_[50];
    qdot_run *taylor, *rk8pd;
    qdot_expr q;
    fixture f;

    (void)state;
    chain(&f, 3);
    f.q0[1] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 4);
    q = f.scene->coordinates.at[1];
    for (int i = 0; i < 50; i++)
        times_[i] = 4 * i / 50.0;
    taylor = run_by(&f, "taylor", 1e-13);
    rk8pd = run_by(&f, "rk8pd", 1e-13);
    must(qdot_run_values(taylor, 1, &q, 50, times_, a, NULL));
    must(qdot_run_values(rk8pd, 1, &q, 50, times_, b, NULL));
    for (int i = 0; i < 50; i++)
        if (!(fabs(a[i] - b[i]) < 1e-11))
            fail_msg("t = %g: %.17g and %.17g", times_[i], a[i], b[i]);
    qdot_run_free(taylor);
    qdot_run_free(rk8pd);
    end(&f);
}

static void
what_switches_is_located(void **state)
{
    qdot_expr x;
    double time = 2, value, error;
    qdot_run *r;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(f.scene, qdot_fun1(f.pool, QDOT_ABS, x)));
    f.q0[0] = QDOT_ONE;
    f.request.method = "taylor";
    f.request.t1 = qdot_expr_int(f.pool, 3);
    r = run(&f);
    must(qdot_run_values(r, 1, &x, 1, &time, &value, &error));
    assert_int_equal(qdot_run_get_report(r)->pieces, 2);
    /* down to 0 at sqrt 2, up again from there with the speed sqrt 2 */
    assert_float_equal(value, (2 - sqrt(2)) * (2 - sqrt(2)) / 2 - sqrt(2) * (2 - sqrt(2)),
                       1e-15);
    assert_true(error < 1e-14);
    qdot_run_free(r);
    end(&f);
}

/* Terms of an oscillator are the same numbers in every step, but for its state: roundings
 * that are, too, would add up. In 4.6e4 steps inverses of small integers made 4.5e-13 of it,
 * a random walk makes 3e-14. */
static void
the_energy_of_an_oscillator_does_not_drift(void **state)
{
    static const int frequencies[] = {1, 2};

    (void)state;
    for (int k = 0; k < 2; k++) {
        qdot_expr x;
        qdot_run *r;
        fixture f;

        begin(&f);
        x = coordinate(&f, "x");
        must(qdot_scene_particle(f.scene, "a", QDOT_ONE, x));
        must(qdot_scene_potential(
            f.scene, qdot_mul(f.pool,
                              qdot_expr_ratio(f.pool, frequencies[k] * frequencies[k], 2),
                              qdot_mul(f.pool, x, x))));
        f.q0[0] = QDOT_ONE;
        f.request.t1 = qdot_expr_int(f.pool, 50000 / frequencies[k]);
        r = run_by(&f, "taylor", 1e-15);
        if (!(qdot_run_get_report(r)->energy_drift < 2e-13))
            fail_msg("frequency %d: %g", frequencies[k], qdot_run_get_report(r)->energy_drift);
        qdot_run_free(r);
        end(&f);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_forms_of_a_chain_agree),
        cmocka_unit_test(both_forms_agree_with_friction_and_time),
        cmocka_unit_test(a_chain_takes_the_residual_and_a_pendulum_does_not),
        cmocka_unit_test(runs_agree_with_runge_kutta),
        cmocka_unit_test(a_constant_matrix_is_factored_once),
        cmocka_unit_test(values_between_steps_are_as_accurate),
        cmocka_unit_test(what_switches_is_located),
        cmocka_unit_test(the_energy_of_an_oscillator_does_not_drift),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
