/* test_start.c -- starts brought onto constraints, against closed forms. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "sim/start/start.h"

typedef struct {
    fixture f;
    qdot_expr x, y;
    bool q_named[MOST_COORDINATES], v_named[MOST_COORDINATES];
    double y0[2 * MOST_COORDINATES], low[2 * MOST_COORDINATES];
    qdot_text notice;
} start;

/* A bob of mass m on a rod: x^2 + y^2 = L^2, m = L = 1. */
static void
cartesian(start *s)
{
    fixture *f = &s->f;
    qdot_expr two;

    memset(s, 0, sizeof *s);
    begin(f);
    two = qdot_expr_int(f->pool, 2);
    s->x = coordinate(f, "x");
    s->y = coordinate(f, "y");
    must(qdot_scene_particle(f->scene, "bob", parameter(f, "m"), pair(f, s->x, s->y)));
    must(qdot_scene_constraint(f->scene, "rod",
                               qdot_add(f->pool, qdot_pow(f->pool, s->x, two),
                                        qdot_pow(f->pool, s->y, two)),
                               qdot_pow(f->pool, parameter(f, "L"), two)));
    set(f, "m", "1");
    set(f, "L", "1");
    f->request.q_named = s->q_named;
    f->request.v_named = s->v_named;
}

/* Only what the start reads of a plan. */
static qdot_status
settle(start *s)
{
    fixture *f = &s->f;
    size_t n = f->scene->coordinates.n;
    qdot_expr inputs[3 * MOST_COORDINATES + 1];
    char *names[MOST_COORDINATES];
    qdot_plan plan = {.pool = f->pool,
                      .n = n,
                      .inputs = inputs,
                      .names = names,
                      .n_values = f->request.n_values,
                      .symbols = f->symbols,
                      .values = f->values};
    qdot_domains domains = {0};
    qdot_status status;

    for (size_t i = 0; i < n; i++) {
        inputs[i] = f->scene->coordinates.at[i];
        inputs[n + i] = velocity(f, inputs[i]);
        inputs[2 * n + 1 + i] = qdot_symbol_jet(f->pool, inputs[i], 2);
        names[i] = (char *)qdot_expr_symbol(f->pool, inputs[i])->name;
    }
    inputs[2 * n] = QDOT_T;
    status = qdot_domains_find(&plan, &domains);
    if (status == QDOT_OK)
        status = qdot_start_settle(f->scene, &plan, &f->request, &domains, s->y0, s->low,
                                   &s->notice);
    qdot_domains_clear(&domains);
    return status;
}



static void
finish(start *s)
{
    qdot_text_clear(&s->notice);
    end(&s->f);
}

/* --- what is kept and what is solved for --------------------------------------------- */

static void
unnamed_velocity_is_solved_for(void **state)
{
    start s;

    (void)state;
    cartesian(&s);
    s.q_named[0] = s.q_named[1] = s.v_named[0] = true;
    s.y0[0] = 0.6;
    s.low[0] = 0.6L - (long double)0.6;
    s.y0[1] = -0.8;
    s.low[1] = -(0.8L - (long double)0.8);
    s.y0[2] = 1;
    must(settle(&s));
    assert_true(s.y0[0] == 0.6 && s.y0[1] == -0.8 && s.y0[2] == 1);
    assert_true(s.y0[3] == 0.75);
    assert_int_equal(s.notice.n, 0);
    finish(&s);
}

/* sqrt(3)/2 in two doubles: the named 1/2 does not move, and what a double leaves over
 * stands beside it. */
static void
solution_has_two_doubles(void **state)
{
    const long double root = 0.866025403784438646763723170752936183L;
    qdot_expr y;
    start s;

    (void)state;
    cartesian(&s);
    y = s.y;
    qdot_symbol_domain(s.f.pool, y, QDOT_NIL, true, QDOT_ZERO, true);
    s.q_named[0] = true;
    s.y0[0] = 0.5;
    must(settle(&s));
    assert_true(s.y0[0] == 0.5 && s.low[0] == 0);
    assert_true(s.y0[1] == -(double)root);
    assert_true(fabsl((long double)s.low[1] + (root - (long double)(double)root)) < 2e-19L);
    finish(&s);
}

static void
equally_near_answers_ask_for_one_more(void **state)
{
    start s;

    (void)state;
    cartesian(&s);
    s.q_named[0] = true;
    s.y0[0] = 0.6;
    assert_int_equal(settle(&s), QDOT_EINVAL);
    assert_non_null(strstr(qdot_last_error()->message, "equally near: y = "));
    assert_non_null(strstr(qdot_last_error()->hint, "start y = "));
    finish(&s);
}

/* --- least change -------------------------------------------------------------------- */

/* Onto the ellipse x^2 + y^2 = 1 in the metric of M: with masses that differ by direction
 * the foot of the perpendicular is elsewhere than on the ray. Here M is a multiple of 1,
 * so that the ray is right. */
static void
all_move_least_along_the_ray(void **state)
{
    start s;

    (void)state;
    cartesian(&s);
    s.q_named[0] = s.q_named[1] = true;
    s.y0[0] = 3;
    s.y0[1] = -4;
    must(settle(&s));
    assert_true(fabs(s.y0[0] - 0.6) < 2e-16 && fabs(s.y0[1] + 0.8) < 2e-16);
    assert_non_null(strstr(qdot_text_str(&s.notice), "constraint rod"));
    assert_non_null(strstr(qdot_text_str(&s.notice), "x from 3 to 0.6 (by -2.4)"));
    finish(&s);
}

/* x - y = 1 from (0, 0) with weights 1 and 3: lambda shares the way as 3 to 1. */
static void
metric_is_that_of_the_masses(void **state)
{
    fixture *f;
    start s;

    (void)state;
    memset(&s, 0, sizeof s);
    f = &s.f;
    begin(f);
    s.x = coordinate(f, "x");
    s.y = coordinate(f, "y");
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, s.x));
    must(qdot_scene_particle(f->scene, "b", qdot_expr_int(f->pool, 3), s.y));
    must(qdot_scene_constraint(f->scene, "apart", qdot_sub(f->pool, s.x, s.y), QDOT_ONE));
    f->request.q_named = f->request.v_named = (bool[]){true, true};
    must(settle(&s));
    if (fabs(s.y0[0] - 0.75) > 3e-16 || fabs(s.y0[1] + 0.25) > 3e-16)
        fail_msg("%.17g, %.17g", s.y0[0], s.y0[1]);
    finish(&s);
}

static void
exactly_refuses(void **state)
{
    start s;

    (void)state;
    cartesian(&s);
    s.q_named[0] = s.q_named[1] = true;
    s.y0[0] = 2;
    s.f.request.exactly = true;
    assert_int_equal(settle(&s), QDOT_EINVAL);
    assert_non_null(strstr(qdot_last_error()->message, "rod: left - right is 3"));
    finish(&s);
}

/* --- constraints that cannot --------------------------------------------------------- */

static void
contradictory_constraints_are_named(void **state)
{
    fixture *f;
    start s;

    (void)state;
    cartesian(&s);
    f = &s.f;
    must(qdot_scene_constraint(f->scene, "slide", s.x, s.y));
    must(qdot_scene_constraint(f->scene, "far", s.x, qdot_expr_int(f->pool, 3)));
    s.q_named[0] = s.q_named[1] = true;
    assert_int_equal(settle(&s), QDOT_EINVAL);
    assert_non_null(strstr(qdot_last_error()->message, "rod and far"));
    finish(&s);
}

/* A second constraint that says the same changes nothing. */
static void
redundant_constraints_are_no_hindrance(void **state)
{
    qdot_expr two;
    start s;

    (void)state;
    cartesian(&s);
    two = qdot_expr_int(s.f.pool, 2);
    must(qdot_scene_constraint(
        s.f.scene, "again", times(&s.f, two, qdot_pow(s.f.pool, s.x, two)),
        qdot_sub(s.f.pool, two, times(&s.f, two, qdot_pow(s.f.pool, s.y, two)))));
    s.q_named[0] = s.q_named[1] = true;
    s.y0[0] = 3;
    s.y0[1] = -4;
    must(settle(&s));
    assert_true(fabs(s.y0[0] - 0.6) < 2e-16 && fabs(s.y0[1] + 0.8) < 2e-16);
    finish(&s);
}

/* At the dead point x = L the slope by y is 0: Newton's method only creeps there. */
static void
dead_point_is_found(void **state)
{
    start s;

    (void)state;
    cartesian(&s);
    s.q_named[0] = true;
    s.y0[0] = 1;
    s.y0[1] = 0;
    must(settle(&s));
    assert_true(s.y0[0] == 1 && fabs(s.y0[1]) < 1e-16);
    finish(&s);
}

/* --- exact zeros ---------------------------------------------------------------------- */

/* At theta = -pi/2 the slope of y' + cos(theta) x' = 0 by x' is 0, and 6e-17 in doubles: it asks nothing of
 * x', which is left to x' = 1. The first digit beside it does. */
static void
vanishing_slope_asks_for_nothing(void **state)
{
    (void)state;
    for (int beside = 0; beside < 2; beside++) {
        start s;
        fixture *f = &s.f;
        qdot_expr theta, right;

        memset(&s, 0, sizeof s);
        begin(f);
        s.x = coordinate(f, "x");
        s.y = coordinate(f, "y");
        theta = coordinate(f, "theta");
        right = qdot_neg(f->pool, times(f, number(f, "0.5"), QDOT_PI));
        must(qdot_scene_particle(f->scene, "a", QDOT_ONE, pair(f, s.x, s.y)));
        must(qdot_scene_constraint(
            f->scene, "slope",
            qdot_add(f->pool, velocity(f, s.y),
                     times(f, qdot_fun1(f->pool, QDOT_COS, theta), velocity(f, s.x))),
            QDOT_ZERO));
        must(qdot_scene_constraint(f->scene, "drive", velocity(f, s.x), QDOT_ONE));
        f->request.q_named = s.q_named;
        f->request.v_named = s.v_named;
        s.q_named[2] = s.v_named[1] = true;
        s.y0[2] = -0x1.921fb54442d18p+0;
        s.low[2] = -0x1.1a62633145c07p-54;
        f->q0[2] = right;
        if (beside) {
            f->q0[2] = qdot_neg(f->pool, number(f, "1.5"));
            s.y0[2] = -1.5;
            s.low[2] = 0;
        }
        must(settle(&s));
        assert_true((s.notice.n > 0) == beside);
        assert_true(s.y0[3] == 1 && fabs(s.y0[4] + beside * cos(1.5)) < 1e-16);
        finish(&s);
    }
}

/* --- moving constraints ---------------------------------------------------------------*/

/* x = sin(t) at t0 = 1: position and velocity follow. */
static void
moving_constraint_gives_the_velocity(void **state)
{
    fixture *f;
    start s;

    (void)state;
    memset(&s, 0, sizeof s);
    f = &s.f;
    begin(f);
    s.x = coordinate(f, "x");
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, s.x));
    must(qdot_scene_constraint(f->scene, "drive", s.x,
                               qdot_fun1(f->pool, QDOT_SIN, QDOT_T)));
    f->request.q_named = s.q_named;
    f->request.v_named = s.v_named;
    f->request.t0 = QDOT_ONE;
    must(settle(&s));
    assert_true(fabs(s.y0[0] - sin(1)) < 2e-16 && fabs(s.y0[1] - cos(1)) < 2e-16);
    finish(&s);
}

/* --- whatever happens ---------------------------------------------------------------- */

/* Two bobs on rods, named values at random and far off: what comes out keeps the rods, and
 * the way there is along M^-1 A^T lambda, so that no nearer point is beside it. */
static void
least_changes_are_perpendicular(void **state)
{
    (void)state;
    srand(7);
    for (int trial = 0; trial < 40; trial++) {
        static bool all[] = {true, true, true, true};
        double far = 0, across = 0, x, y, from[2];
        start s;

        cartesian(&s);
        s.f.request.q_named = s.f.request.v_named = all;
        for (int i = 0; i < 2; i++)
            s.y0[i] = from[i] = 4.0 * rand() / RAND_MAX - 2;
        must(settle(&s));
        x = s.y0[0];
        y = s.y0[1];
        assert_true(fabs((x - 1) * (x + 1) + y * y) < 4e-16);
        for (int i = 0; i < 2; i++)
            far += (s.y0[i] - from[i]) * (s.y0[i] - from[i]);
        across = (x - from[0]) * -y + (y - from[1]) * x;
        assert_true(fabs(across) < 1e-14 * (1 + far));
        assert_true(x * from[0] + y * from[1] > 0);
        finish(&s);
    }
}

/* An allocation that fails, each in turn: an error, nothing lost, and at last the answer. */
static void
no_memory_is_an_error(void **state)
{
    qdot_status status = QDOT_ENOMEM;

    (void)state;
    for (int64_t n = 0; status != QDOT_OK; n++) {
        start s;

        cartesian(&s);
        s.q_named[0] = s.q_named[1] = true;
        s.y0[0] = 3;
        s.y0[1] = -4;
        qdot_memory_fail_at(n);
        status = settle(&s);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        finish(&s);
        assert_true(n < 100000);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unnamed_velocity_is_solved_for),
        cmocka_unit_test(solution_has_two_doubles),
        cmocka_unit_test(equally_near_answers_ask_for_one_more),
        cmocka_unit_test(all_move_least_along_the_ray),
        cmocka_unit_test(metric_is_that_of_the_masses),
        cmocka_unit_test(exactly_refuses),
        cmocka_unit_test(contradictory_constraints_are_named),
        cmocka_unit_test(redundant_constraints_are_no_hindrance),
        cmocka_unit_test(dead_point_is_found),
        cmocka_unit_test(vanishing_slope_asks_for_nothing),
        cmocka_unit_test(moving_constraint_gives_the_velocity),
        cmocka_unit_test(least_changes_are_perpendicular),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
