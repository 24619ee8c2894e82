/* test_ensemble-doubts.c -- steps of a lane that a run alone has to be asked about. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include "sim/plan/plan.h"
#include "sim/ensemble/doubts.h"

/* From x = -3 at a speed of 7. */
static qdot_status
go_straight(double t, double *y, void *user)
{
    (void)user;
    y[0] = -3 + 7 * t;
    y[1] = 7;
    return QDOT_OK;
}

static qdot_ensemble_doubts *
doubts_of(fixture *f, qdot_plan **plan)
{
    qdot_ensemble_doubts *d;

    f->request.method = "taylor";
    must(qdot_plan_new(f->scene, &f->request, plan));
    must(qdot_ensemble_doubts_new(*plan, &d));
    return d;
}

static bool
is_doubtful(qdot_ensemble_doubts *d, double a, double b, const double *from, const double *to)
{
    qdot_pulses_step step = {
        .a = a, .b = b, .tol = 1e-9, .from = from, .to = to, .read = go_straight};
    bool doubtful;

    must(qdot_ensemble_doubts_look(d, &step, &doubtful));
    return doubtful;
}

/* A well exp(-(1000 x)^2). */
static void
a_step_over_a_narrow_force(void **state)
{
    const double at[][2] = {{-3, 7}, {-0.2, 7}, {4, 7}};
    qdot_ensemble_doubts *d;
    qdot_plan *plan;
    fixture f;
    qdot_expr x, u;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    u = times(&f, number(&f, "1000000"), times(&f, x, x));
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    must(qdot_scene_potential(
        f.scene, qdot_neg(f.pool, qdot_fun1(f.pool, QDOT_EXP, qdot_neg(f.pool, u)))));
    d = doubts_of(&f, &plan);
    assert_non_null(d);
    must(qdot_ensemble_doubts_begin(d));
    assert_false(is_doubtful(d, 0, 0.4, at[0], at[1]));
    assert_true(is_doubtful(d, 0, 1, at[0], at[2]));
    qdot_ensemble_doubts_free(d);
    qdot_plan_free(plan);
    end(&f);
}

/* Of y^2 = x^3 nothing is left at 0; a new member knows nothing of the one before. */
static void
a_place_near_a_cusp(void **state)
{
    const double far[] = {1, 1, -1, -1.5}, near[] = {1e-6, 1e-9, -1, -0.0015};
    qdot_ensemble_doubts *d;
    qdot_plan *plan;
    fixture f;
    qdot_expr x, y;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, y)));
    must(qdot_scene_constraint(f.scene, "c", times(&f, y, y), times(&f, x, times(&f, x, x))));
    d = doubts_of(&f, &plan);
    assert_non_null(d);
    for (int member = 0; member < 2; member++) {
        must(qdot_ensemble_doubts_begin(d));
        assert_false(is_doubtful(d, 0, 1, far, near));
        assert_true(is_doubtful(d, 1, 2, near, far));
    }
    qdot_ensemble_doubts_free(d);
    qdot_plan_free(plan);
    end(&f);
}

static void
nothing_to_look_at(void **state)
{
    qdot_plan *plan;
    fixture f;

    (void)state;
    chain(&f, 1);
    assert_null(doubts_of(&f, &plan));
    qdot_plan_free(plan);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_over_a_narrow_force),
        cmocka_unit_test(a_place_near_a_cusp),
        cmocka_unit_test(nothing_to_look_at),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
