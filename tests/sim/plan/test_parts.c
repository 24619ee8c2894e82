/* test_parts.c -- coordinates that know nothing of each other take steps of their own. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/bind/bind.h"
#include "sim/plan/parts.h"
#include "sim/plan/plan.h"

/* A mass on a spring along each coordinate of `names`; k as many decimals. */
static void
oscillators(fixture *f, size_t n, const char *const *names, const char *const *stiffness)
{
    begin(f);
    for (size_t i = 0; i < n; i++) {
        qdot_expr x = coordinate(f, names[i]), k = number(f, stiffness[i]);

        must(qdot_scene_particle(f->scene, names[i], QDOT_ONE, pair(f, x, QDOT_ZERO)));
        must(qdot_scene_potential(
            f->scene, times(f, times(f, QDOT_HALF, k), qdot_pow_int(f->pool, x, 2))));
        f->q0[i] = QDOT_ONE;
    }
}

static qdot_run *
run_of(fixture *f, const char *method, double tol)
{
    qdot_run *run;

    f->request.method = method;
    f->request.tol = tol;
    must(qdot_run_new(f->scene, &f->request, &run));
    assert_int_equal(qdot_run_get_report(run)->status, QDOT_RUN_DONE);
    return run;
}

/* The slow one takes as few steps as it does alone. */
static void
a_slow_and_a_fast_one(void **state)
{
    static const char *const names[] = {"x", "y"}, *const stiffness[] = {"1", "1000000"};
    static const char *const methods[] = {"taylor", "dop853", "rk8pd"};
    fixture f;

    (void)state;
    for (size_t m = 0; m < 3; m++) {
        const qdot_run_report *r;
        size_t alone[2], both;
        qdot_run *run;
        qdot_expr e[4];
        const double times[] = {0.37, 2.9, 1.1};
        double values[12], errors[12];

        for (size_t i = 0; i < 2; i++) {
            oscillators(&f, 1, names + i, stiffness + i);
            f.request.t1 = qdot_expr_int(f.pool, 3);
            run = run_of(&f, methods[m], 1e-10);
            alone[i] = qdot_run_get_report(run)->steps;
            qdot_run_free(run);
            end(&f);
        }
        oscillators(&f, 2, names, stiffness);
        f.request.t1 = qdot_expr_int(f.pool, 3);
        run = run_of(&f, methods[m], 1e-10);
        r = qdot_run_get_report(run);
        both = r->steps;
        assert_int_equal(both, alone[0] + alone[1]);
        assert_true(r->n_parts > 0 && r->parts[0].steps > 0);
        assert_true(fabs(r->q[0] - cos(3)) <= 3 * r->error);
        assert_true(fabs(r->q[1] - cos(3000)) <= 3 * r->error);
        assert_true(fabs(r->v[1] + 1000 * sin(3000)) <= 3000 * r->error);
        for (size_t i = 0; i < 2; i++) {
            e[i] = f.scene->coordinates.at[i];
            e[2 + i] = qdot_symbol_jet(f.pool, e[i], 2);
        }
        must(qdot_run_values(run, 4, e, 3, times, values, errors));
        for (size_t k = 0; k < 3; k++) {
            assert_true(fabs(values[4 * k] - cos(times[k])) <= 1e-9);
            assert_true(fabs(values[4 * k + 1] - cos(1000 * times[k]))
                        <= 3 * errors[4 * k + 1] + 1e-9);
            assert_true(fabs(values[4 * k + 2] + values[4 * k]) <= 1e-12);
            assert_true(fabs(values[4 * k + 3] + 1e6 * values[4 * k + 1]) <= 1e-6);
        }
        qdot_run_free(run);
        end(&f);
    }
}

/* Three, of which two hold on to each other by a force, a bound or nothing at all. */
static void
what_hangs_together_stays(void **state)
{
    static const char *const names[] = {"x", "y", "z"},
                             *const stiffness[] = {"1", "2", "3"};
    qdot_plan *plan;
    fixture f;

    (void)state;
    oscillators(&f, 3, names, stiffness);
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_int_equal(plan->n_parts, 3);
    qdot_plan_free(plan);
    must(qdot_scene_potential(f.scene, times(&f, f.scene->coordinates.at[0],
                                             f.scene->coordinates.at[2])));
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_int_equal(plan->n_parts, 2);
    assert_int_equal(plan->parts[0]->n, 2);
    assert_int_equal(plan->parts[0]->place[1], 2);
    assert_int_equal(plan->parts[1]->place[0], 1);
    qdot_plan_free(plan);
    must(qdot_scene_dissipation(
        f.scene, times(&f, velocity(&f, f.scene->coordinates.at[0]),
                       velocity(&f, f.scene->coordinates.at[1]))));
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_int_equal(plan->n_parts, 0);
    qdot_plan_free(plan);
    end(&f);
}

/* One that meets a singularity ends all, and all of it is there up to then. */
static void
the_first_to_end_ends_all(void **state)
{
    const qdot_run_report *r;
    double value, t;
    qdot_run *run;
    qdot_expr x, y;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    must(qdot_scene_particle(f.scene, "b", QDOT_ONE, pair(&f, y, QDOT_ZERO)));
    must(qdot_scene_potential(
        f.scene, times(&f, QDOT_HALF, qdot_pow_int(f.pool, x, 2))));
    must(qdot_scene_potential( /* y^2 = 1 - t^2 */
        f.scene, qdot_neg(f.pool, times(&f, QDOT_HALF, qdot_pow_int(f.pool, y, -2)))));
    f.q0[0] = f.q0[1] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 5);
    f.request.method = "taylor";
    must(qdot_run_new(f.scene, &f.request, &run));
    r = qdot_run_get_report(run);
    assert_int_equal(r->status, QDOT_RUN_FAILED);
    t = 1;
    assert_true(fabs(r->t1 - t) < 1e-6);
    assert_true(fabs(r->q[0] - cos(r->t1)) < 1e-10);
    must(qdot_run_values(run, 1, &x, 1, (double[]){0.9}, &value, NULL));
    assert_true(fabs(value - cos(0.9)) < 1e-10);
    qdot_run_free(run);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slow_and_a_fast_one),
        cmocka_unit_test(what_hangs_together_stays),
        cmocka_unit_test(the_first_to_end_ends_all),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
