/* test_pulses.c -- forces that act for less than a step, seen in one look at the step. */
#include "scenes.h"

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

/* What is found on the step of 1 from x = from to x = to. */
static qdot_ode_look
look(bool gaussian, double from, double to)
{
    const double y[] = {from, to - from}, y_end[] = {to, to - from};
    qdot_ode_look step = {.t_end = 1, .tol = 1e-9, .y = y, .y_end = y_end, .until = 1};
    qdot_ode_system system;
    qdot_plan *plan;
    qdot_bind *bind;
    fixture f;

    begin(&f);
    well(&f, gaussian);
    must(qdot_plan_new(f.scene, &f.request, &plan));
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    assert_non_null(system.look);
    must(system.look(&step, system.user));
    qdot_bind_free(bind);
    qdot_plan_free(plan);
    end(&f);
    return step;
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
        cmocka_unit_test(nothing_hides_in_a_spring),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
