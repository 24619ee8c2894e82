/* test_pulses.c -- forces that act for less than a step, seen in one look at the step. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/bind/bind.h"
#include "sim/plan/plan.h"

/* A particle in a well exp(-(x/w)^2), w = 1e-3, or w^2/(x^2 + w^2), w = 1e-9, of depth 1. */
static void
well(fixture *f, bool gaussian)
{
    qdot_expr x, w = number(f, gaussian ? "0.001" : "0.000000001"), s;

    x = coordinate(f, "x");
    s = times(f, x, x);
    must(qdot_scene_particle(f->scene, "p", QDOT_ONE, pair(f, x, QDOT_ZERO)));
    w = times(f, w, w);
    must(qdot_scene_potential(
        f->scene,
        qdot_neg(f->pool, gaussian ? qdot_fun1(f->pool, QDOT_EXP,
                                               qdot_neg(f->pool, qdot_div(f->pool, s, w)))
                                   : qdot_div(f->pool, w, qdot_add(f->pool, s, w)))));
    f->request.method = "dop853";
}

/* The force F(x, x') on a particle. */
static void
pushed(fixture *f, qdot_expr (*force)(fixture *, qdot_expr x, qdot_expr v))
{
    qdot_expr x = coordinate(f, "x");

    must(qdot_scene_particle(f->scene, "p", QDOT_ONE, pair(f, x, QDOT_ZERO)));
    must(qdot_scene_force(f->scene,
                          &(qdot_force){.force = pair(f, force(f, x, velocity(f, x)), QDOT_ZERO),
                                        .point = pair(f, x, QDOT_ZERO),
                                        .on = "p"}));
    f->request.method = "dop853";
}

/* tanh(10^6 u) */
static qdot_expr
steep(fixture *f, qdot_expr u)
{
    return qdot_fun1(f->pool, QDOT_TANH, times(f, number(f, "1000000"), u));
}

static qdot_expr
friction(fixture *f, qdot_expr x, qdot_expr v)
{
    (void)x;
    return qdot_neg(f->pool, steep(f, v));
}

/* large for |v| < 10^-6 alone */
static qdot_expr
gate(fixture *f, qdot_expr x, qdot_expr v)
{
    (void)x;
    return times(f, number(f, "1000"),
                 qdot_sub(f->pool, QDOT_ONE, times(f, steep(f, v), steep(f, v))));
}

/* nearly the same by its two sides */
static qdot_expr
slit(fixture *f, qdot_expr x, qdot_expr v)
{
    (void)x;
    return qdot_sub(f->pool, steep(f, qdot_add(f->pool, v, number(f, "0.001"))),
                    times(f, number(f, "1.01"),
                          steep(f, qdot_sub(f->pool, v, number(f, "0.001")))));
}

/* 0 where it begins, and soon after */
static qdot_expr
push_off(fixture *f, qdot_expr x, qdot_expr v)
{
    (void)v;
    return times(f, times(f, number(f, "1000000000000"), x),
                 qdot_sub(f->pool, QDOT_ONE, steep(f, x)));
}

/* What is found on the step of 1 in that scene. */
static qdot_ode_look
look_at(fixture *f, const double *y, const double *y_end)
{
    qdot_ode_look step = {.t_end = 1, .tol = 1e-9, .y = y, .y_end = y_end, .until = 1};
    qdot_ode_system system;
    qdot_plan *plan;
    qdot_bind *bind;

    must(qdot_plan_new(f->scene, &f->request, &plan));
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    assert_non_null(system.look);
    must(system.look(&step, system.user));
    qdot_bind_free(bind);
    qdot_plan_free(plan);
    end(f);
    return step;
}

/* From x = from to x = to through a well. */
static qdot_ode_look
look(bool gaussian, double from, double to)
{
    fixture f;

    begin(&f);
    well(&f, gaussian);
    return look_at(&f, (double[]){from, to - from}, (double[]){to, to - from});
}

static qdot_ode_look
look_at_push(qdot_expr (*force)(fixture *, qdot_expr x, qdot_expr v), double x0, double v0,
             double x1, double v1)
{
    fixture f;

    begin(&f);
    pushed(&f, force);
    return look_at(&f, (double[]){x0, v0}, (double[]){x1, v1});
}

/* A force that only grows on the way of a step, and hardly differs at its ends, is nothing to look
 * at; what grows and falls again is. */
static void
what_goes_one_way_shows_at_the_ends(void **state)
{
    qdot_ode_look there, back;

    (void)state;
    there = look_at_push(friction, 0, -0.5, -0.25, -2e-5); /* which is not felt yet */
    assert_true(there.until == 1 && there.evaluations == 0);
    assert_true(look_at_push(friction, 0, -0.5, 0, 0.5).evaluations > 0);
    back = look_at_push(friction, 0, -0.1, 0.1, -0.1); /* in between it comes back */
    assert_true(back.until < 1 && back.evaluations > 0);
    assert_true(look_at_push(friction, 0, -0.1, -0.1, -0.11).evaluations == 0);
    assert_true(look_at_push(gate, 0, -0.5, 0, 0.5).until < 1);
    assert_true(look_at_push(slit, 0, -0.5, 0, 0.5).until < 1);
    assert_true(look_at_push(push_off, 0, 1, 1, 1).until < 1);
}

static void
a_step_ends_where_a_pulse_begins(void **state)
{
    (void)state;
    for (int gaussian = 0; gaussian < 2; gaussian++) {
        const double w = gaussian ? 1e-3 : 1e-9;
        const qdot_ode_look step = look(gaussian, -3, 4);
        const double x = -3 + 7 * step.until;

        assert_true(step.until < 3.0 / 7 && step.until > 0);
        assert_true(x < -w && x > -1000 * w);
    }
    /* nor is it longer than what begins there at once */
    assert_true(look(true, -3e-3, 1).until < 5e-3);
}

static void
what_a_step_does_not_meet_is_left_alone(void **state)
{
    (void)state;
    for (int gaussian = 0; gaussian < 2; gaussian++) {
        assert_true(look(gaussian, -3, -0.5).until == 1);
        assert_true(look(gaussian, 0.1, 7).until == 1);
    }
    /* it looks well resolved */
    assert_true(look(true, -1e-3, 1e-3).until == 1);
}

static void
nothing_hides_in_a_spring(void **state)
{
    qdot_ode_system system;
    qdot_plan *plan;
    qdot_bind *bind;
    qdot_expr x;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    must(qdot_scene_potential(f.scene, times(&f, x, x)));
    f.request.method = "dop853";
    must(qdot_plan_new(f.scene, &f.request, &plan));
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    assert_null(system.look);
    qdot_bind_free(bind);
    qdot_plan_free(plan);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_ends_where_a_pulse_begins),
        cmocka_unit_test(what_a_step_does_not_meet_is_left_alone),
        cmocka_unit_test(what_goes_one_way_shows_at_the_ends),
        cmocka_unit_test(nothing_hides_in_a_spring),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
