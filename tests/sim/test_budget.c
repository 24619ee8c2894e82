/* test_budget.c -- what is spent on the error of a run, in counted work, beside the run. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>

#include "ode/companion.h"

/* A meter is read when work has grown by an eighth, and is exceeded by as much. */
static const double a_mark = 1.125;

/* The error's work is there, and keeps to its bound. */
static void
keeps_to_budget(fixture *f, const char *method, double tol, bool known)
{
    const qdot_run_report *report;
    qdot_run *r;

    f->request.method = method;
    f->request.tol = tol;
    must(qdot_run_new(f->scene, &f->request, &r));
    report = qdot_run_get_report(r);
    assert_true(report->work > 0 && report->estimate_work > 0.01 * report->work);
    if (report->estimate_work
        > a_mark * (QDOT_COMPANION_MOST * report->work + 2 * QDOT_COMPANION_LEAST))
        fail_msg("%s, tol %g: the run %g, its error %g", method, tol, report->work,
                 report->estimate_work);
    if (known)
        assert_false(isnan(report->error));
    qdot_run_free(r);
}

/* With a horizon, for which the states that the companions went through are used. */
static void
of_chaos(void **state)
{
    static const char *const methods[] = {"taylor", "dop853", "radau"};

    (void)state;
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
        for (double tol = 1e-4; tol > 1e-15; tol /= 100) {
            fixture f;

            chain(&f, 2);
            f.q0[0] = f.q0[1] = qdot_expr_int(f.pool, 2);
            f.request.t1 = qdot_expr_int(f.pool, 60);
            keeps_to_budget(&f, methods[k], tol, false);
            end(&f);
        }
}

/* Without one, by every tolerance that a person asks for: known as well. */
static void
of_small_swings(void **state)
{
    static const char *const methods[] = {"taylor", "dop853", "radau", "bsimp"};

    (void)state;
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
        for (double tol = 1e-4; tol > 1e-13; tol /= 100) {
            fixture f;

            chain(&f, 2);
            f.q0[0] = number(&f, "0.2");
            f.request.t1 = qdot_expr_int(f.pool, 300);
            keeps_to_budget(&f, methods[k], tol, true);
            end(&f);
        }
}

/* An event that changes nothing: the companions of the end's error have met it, too, and tell that of its
 * times. */
static void
of_an_event(void **state)
{
    static const char *const methods[] = {"taylor", "dop853", "radau"};

    (void)state;
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        fixture f;
        qdot_event lowest = {.name = (char *)"lowest", .right = QDOT_ZERO};
        const qdot_run_occurrence *list;
        double spent;
        qdot_run *r;
        size_t n;

        chain(&f, 2);
        lowest.left = qdot_symbol_get(f.pool, QDOT_COORD, "theta[1]");
        must(qdot_scene_event(f.scene, &lowest));
        f.q0[0] = number(&f, "0.2");
        f.request.t1 = qdot_expr_int(f.pool, 60);
        f.request.tol = 1e-9;
        f.request.method = methods[k];
        must(qdot_run_new(f.scene, &f.request, &r));
        spent = qdot_run_get_report(r)->estimate_work;
        must(qdot_run_occurrences(r, &list, &n));
        assert_true(n > 10 && list[n - 1].error < 1e-6);
        assert_true(qdot_run_get_report(r)->estimate_work == spent);
        assert_true(spent <= a_mark * (QDOT_COMPANION_MOST * qdot_run_get_report(r)->work
                                       + 2 * QDOT_COMPANION_LEAST));
        qdot_run_free(r);
        end(&f);
    }
}

/* A run of one step, beside which a moved companion swings all the time: within the least. */
static void
at_rest(void **state)
{
    fixture f;

    (void)state;
    chain(&f, 1);
    f.request.t1 = qdot_expr_int(f.pool, 20);
    keeps_to_budget(&f, "taylor", 1e-12, true);
    end(&f);
}

/* A stiff layer by a method that steps over it: series, which do not, would cost many times the run, and
 * only the meter keeps them from it. */
static void
of_a_layer(void **state)
{
    fixture f;
    qdot_expr x, v, s, force;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    v = velocity(&f, x);
    s = qdot_fun1(f.pool, QDOT_TANH, times(&f, number(&f, "100000"), v));
    force = times(&f, number(&f, "10000"), qdot_sub(f.pool, QDOT_ONE, times(&f, s, s)));
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    must(qdot_scene_force(f.scene,
                          &(qdot_force){.force = pair(&f, qdot_sub(f.pool, force, x), QDOT_ZERO),
                                        .point = pair(&f, x, QDOT_ZERO),
                                        .on = "p"}));
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 10);
    keeps_to_budget(&f, "dop853", 1e-4, false);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_chaos),
        cmocka_unit_test(of_small_swings),
        cmocka_unit_test(of_an_event),
        cmocka_unit_test(at_rest),
        cmocka_unit_test(of_a_layer),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
