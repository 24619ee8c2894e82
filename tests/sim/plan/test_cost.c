/* test_cost.c -- the models of costs: what they say of each form, and that the plan decides by them. */
#include "expr/build.h"
#include "expr/exact.h"
#include "sim/scenes.h"

#include <math.h>

#include "num/kinds.h"
#include "ode/taylor.h"
#include "sim/bind/bind.h"
#include "sim/form/derived.h"
#include "sim/plan/cost.h"
#include "sim/plan/plan.h"

static const qdot_work some = {.coordinates = 3,
                               .length = 20,
                               .convolutions = 9,
                               .calls = 4,
                               .operations = 30,
                               .unknowns = 3,
                               .squares = 9,
                               .cubes = 27,
                               .factored = 3,
                               .factored_cubes = 27,
                               .filled = 8,
                               .nodes = 3,
                               .vectors = 6,
                               .products = 20,
                               .begun = 15,
                               .code = true};

typedef qdot_ode_cost of_work(const qdot_work *);

static of_work *const models[] = {qdot_cost_explicit, qdot_cost_implicit, qdot_cost_tree,
                                  qdot_cost_lanes};

/* Twice the work costs more, at every order; twice of it at most. */
static void
more_work_costs_more(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof models / sizeof *models; k++) {
        qdot_work more = some;
        qdot_ode_cost a, b;

        more.convolutions *= 2;
        more.vectors *= 2;
        more.calls *= 2;
        a = models[k](&some);
        b = models[k](&more);
        assert_true(b.kernels[0] > a.kernels[0] && b.kernels[0] < 2 * a.kernels[0]);
        assert_true(b.kernels[1] >= a.kernels[1] && b.kernels[1] < 2 * a.kernels[1]);
        assert_true(b.kernels[2] > a.kernels[2] && b.kernels[2] <= 2 * a.kernels[2]);
        assert_true(qdot_cost_steps(&b) > qdot_cost_steps(&a));
        assert_true(qdot_cost_steps(&b) < 2 * qdot_cost_steps(&a));
    }
}

/* Where code is made it costs less than kernels; without it there is none to choose by. */
static void
code_is_cheaper_than_kernels(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof models / sizeof *models; k++) {
        const qdot_ode_cost c = models[k](&some), kernels = qdot_cost_of_kernels(&c);
        qdot_work without = some;

        without.code = false;
        assert_true(kernels.code[0] == 0);
        if (c.code[0] > 0)
            assert_true(qdot_cost_steps(&c) < qdot_cost_steps(&kernels));
        if (models[k] != qdot_cost_lanes)
            assert_true(models[k](&without).code[0] == 0);
    }
}

/* A full M of 40 coordinates: its entries alone are less than all of it. */
static void
a_lower_bound_is_below_the_whole(void **state)
{
    const double n = 40, entries = n * (n - 1);
    const qdot_work w = {.coordinates = n,
                         .length = 3 * n,
                         .convolutions = entries + 5 * n,
                         .calls = 2 * n,
                         .unknowns = n,
                         .squares = n * n,
                         .cubes = n * n * n,
                         .factored = n,
                         .factored_cubes = n * n * n};
    const qdot_ode_cost whole = qdot_cost_explicit(&w),
                        least = qdot_cost_least(40, entries);

    (void)state;
    for (int k = 0; k < 3; k++)
        assert_true(least.kernels[k] < whole.kernels[k]);
    assert_true(qdot_cost_steps(&least) > 0.5 * qdot_cost_steps(&whole));
}

/* --- the plan ------------------------------------------------------------------------- */

/* A bob on a rod, in x and y. */
static void
rod(fixture *f)
{
    qdot_expr two, x, y;

    begin(f);
    two = qdot_expr_int(f->pool, 2);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    must(qdot_scene_particle(f->scene, "bob", parameter(f, "m"), pair(f, x, y)));
    must(qdot_scene_gravity(f->scene,
                            pair(f, QDOT_ZERO, qdot_neg(f->pool, parameter(f, "g")))));
    must(qdot_scene_constraint(
        f->scene, "rod",
        qdot_add(f->pool, qdot_pow(f->pool, x, two), qdot_pow(f->pool, y, two)),
        QDOT_ONE));
    set(f, "m", "2");
    set(f, "g", "9.81");
    f->request.method = "taylor";
}

/* What a plan says of costs is what its series, and those of a companion, are given. */
static void
series_take_the_costs_of_the_plan(void **state)
{
    const double tols[] = {1e-4, 1e-12};

    (void)state;
    for (size_t k = 0; k < 4; k++) {
        qdot_plan *plan;
        fixture f;

        if (k < 2)
            rod(&f);
        else
            pendulum(&f);
        f.request.method = "taylor";
        f.request.tol = tols[k % 2];
        must(qdot_plan_new(f.scene, &f.request, &plan));
        for (int shaken = 0; shaken < 2; shaken++) {
            qdot_bind *bind;
            const qdot_ode_series *series;

            must(qdot_bind_new(plan, shaken, &bind));
            series = qdot_bind_system(bind).series;
            assert_memory_equal(&series->cost, &plan->expansions,
                                sizeof plan->expansions);
            qdot_bind_free(bind);
        }
        qdot_plan_free(plan);
        end(&f);
    }
}

/* Of the forms that fit the one with the least cost at the tolerance of the run. */
static void
constraints_take_the_cheapest_form(void **state)
{
    fixture f;
    qdot_plan *plan;
    double projection;

    (void)state;
    rod(&f);
    f.request.tol = 1e-12;
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_int_equal(plan->form, QDOT_FORM_CONSTRAINED);
    projection = qdot_cost_projection(plan);
    assert_true(projection > 0 && projection < plan->expansions.kernels[0]);
    qdot_plan_free(plan);
    f.request.tol = 1e-5;
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_int_equal(plan->form, plan->eliminated ? QDOT_FORM_ELIMINATED
                                 : plan->bordered ? QDOT_FORM_BORDERED
                                                  : QDOT_FORM_CONSTRAINED);
    assert_int_not_equal(plan->form, QDOT_FORM_CONSTRAINED);
    assert_false(plan->eliminated && plan->bordered);
    qdot_plan_free(plan);
    f.request.treatment = QDOT_RUN_NONE;
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_true(qdot_cost_projection(plan) == 0);
    qdot_plan_free(plan);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_work_costs_more),
        cmocka_unit_test(code_is_cheaper_than_kernels),
        cmocka_unit_test(a_lower_bound_is_below_the_whole),
        cmocka_unit_test(series_take_the_costs_of_the_plan),
        cmocka_unit_test(constraints_take_the_cheapest_form),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
