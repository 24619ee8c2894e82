/* test_workprecision.c -- the ladder of an oscillator, whose end is known. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "ode/method.h"
#include "sim/study/workprecision.h"

/* x'' = -x, or with a force that shakes it, from x = 1 to t = 5. */
static void
oscillator(fixture *f, bool shaken)
{
    qdot_expr x;

    begin(f);
    x = coordinate(f, "x");
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(f->scene, times(f, number(f, "0.5"), times(f, x, x))));
    if (shaken)
        must(qdot_scene_potential(
            f->scene, times(f, x, qdot_fun1(f->pool, QDOT_COS, QDOT_T))));
    f->q0[0] = QDOT_ONE;
    f->request.t1 = qdot_expr_int(f->pool, 5);
}

static void
every_method_climbs_the_ladder(void **state)
{
    fixture f;
    qdot_workprecision w = {0};

    (void)state;
    oscillator(&f, false);
    must(qdot_workprecision_measure(f.scene, &f.request, &w));
    assert_int_equal(w.left_out.n, 0);
    assert_int_equal(w.n, 13 * qdot_ode_method_count());
    assert_true(w.ref_err > 0 && w.ref_err <= 0.5e-20);
    for (size_t k = 0; k < w.n; k++) {
        const qdot_workprecision_row *r = &w.rows[k];
        const qdot_ode_method *method = qdot_ode_method_at(k / 13);

        assert_string_equal(r->method, method->name);
        assert_true(r->tol == pow(10, -3 - (double)(k % 13))
                    || fabs(r->tol / pow(10, -3 - (double)(k % 13)) - 1) < 1e-12);
        assert_string_equal(r->status, "done");
        /* of order 2 more than ten thousand steps add up */
        if (!(r->err <= (method->order < 4 ? 1e5 : 3000) * r->tol + 1e-14))
            fail_msg("%s at tol %g: err %g", r->method, r->tol, r->err);
        assert_true(r->energy_err >= 0 && r->energy_err <= (method->order < 4 ? 1e5 : 3000) * r->tol + 1e-14);
        assert_true(fabs(r->scd + log10(fmax(r->err, 0x1p-60))) < 1e-12);
        assert_true(r->time_min > 0 && r->time_median >= r->time_min);
        assert_true(r->evals > 0 && r->steps > 0);
    }
    qdot_workprecision_clear(&w);
    end(&f);
}

/* Where the form of the equations depends on the tolerance (a mass on a rod: eliminated
 * down to 1e-9) a row takes the steps of a run at that tolerance. */
static void
rows_are_planned_as_runs_are(void **state)
{
    fixture f;
    qdot_workprecision w = {0};
    qdot_expr x, y, r2;
    size_t seen = 0;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "bob", QDOT_ONE, pair(&f, x, y)));
    must(qdot_scene_potential(f.scene, y));
    r2 = qdot_add(f.pool, times(&f, x, x), times(&f, y, y));
    must(qdot_scene_constraint(f.scene, "rod", r2, QDOT_ONE));
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 5);
    f.request.method = "taylor";
    must(qdot_workprecision_measure(f.scene, &f.request, &w));
    for (size_t k = 0; k < w.n; k++) {
        qdot_run *r;

        if (strcmp(w.rows[k].method, "taylor") != 0)
            continue;
        f.request.tol = w.rows[k].tol;
        r = run(&f);
        assert_int_equal(w.rows[k].steps, qdot_run_get_report(r)->steps);
        qdot_run_free(r);
        seen++;
    }
    assert_int_equal(seen, 13);
    qdot_workprecision_clear(&w);
    end(&f);
}

/* The error is that of a run from the same start, against the closed form. */
static void
errors_are_those_of_runs(void **state)
{
    fixture f;
    qdot_workprecision w = {0};

    (void)state;
    oscillator(&f, false);
    must(qdot_workprecision_measure(f.scene, &f.request, &w));
    for (size_t k = 0; k < w.n; k++) {
        const qdot_run_report *report;
        qdot_run *r;
        double err;

        if (k % 13 != 2) /* tol 1e-5 */
            continue;
        f.request.method = w.rows[k].method;
        f.request.tol = w.rows[k].tol;
        r = run(&f);
        report = qdot_run_get_report(r);
        err = fmax(fabs(report->q[0] - cos(5)), fabs(report->v[0] + sin(5)));
        if (fabs(err - w.rows[k].err) > 1e-14)
            fail_msg("%s: err %g, that of the run %g", w.rows[k].method, w.rows[k].err,
                     err);
        assert_int_equal(report->steps, w.rows[k].steps);
        assert_int_equal(report->rejected, w.rows[k].rejected);
        qdot_run_free(r);
    }
    qdot_workprecision_clear(&w);
    end(&f);
}

/* Before a step is accepted, equations that can hide a force within it - a quotient, a root, an
 * exponential, tanh - are looked at there: a row takes the steps of a run, and its errors are as small. */
static void
equations_that_can_hide_forces_are_looked_at(void **state)
{
    (void)state;
    for (int form = 0; form < 4; form++) {
        fixture f;
        qdot_workprecision w = {0};
        qdot_expr x, square;

        oscillator(&f, false);
        f.request.t1 = QDOT_ONE;
        x = qdot_symbol_get(f.pool, QDOT_COORD, "x");
        square = times(&f, x, x);
        must(qdot_scene_potential(
            f.scene, form == 0   ? qdot_fun1(f.pool, QDOT_EXP, qdot_neg(f.pool, square))
                     : form == 1 ? qdot_div(f.pool, QDOT_ONE, qdot_add(f.pool, QDOT_ONE, square))
                     : form == 2 ? qdot_sqrt(f.pool, qdot_add(f.pool, QDOT_ONE, square))
                                 : qdot_fun1(f.pool, QDOT_TANH, x)));
        must(qdot_workprecision_measure(f.scene, &f.request, &w));
        assert_int_equal(w.n, 13 * qdot_ode_method_count());
        for (size_t k = 2; k < w.n; k += 13) { /* tol 1e-5 */
            const qdot_run_report *report;
            qdot_run *r;

            assert_string_equal(w.rows[k].status, "done");
            assert_true(w.rows[k].err < 0.1);
            f.request.method = w.rows[k].method;
            f.request.tol = w.rows[k].tol;
            r = run(&f);
            report = qdot_run_get_report(r);
            assert_int_equal(report->steps, w.rows[k].steps);
            assert_int_equal(report->rejected, w.rows[k].rejected);
            qdot_run_free(r);
        }
        qdot_workprecision_clear(&w);
        end(&f);
    }
}

static void
without_conservation_there_is_no_energy_error(void **state)
{
    fixture f;
    qdot_workprecision w = {0};

    (void)state;
    oscillator(&f, true);
    f.request.t1 = QDOT_ONE;
    must(qdot_workprecision_measure(f.scene, &f.request, &w));
    for (size_t k = 0; k < w.n; k++)
        assert_true(isnan(w.rows[k].energy_err));
    qdot_workprecision_clear(&w);
    end(&f);
}

/* A budget that tight tolerances are beyond of: rows that say what they did not reach. */
static void
hopeless_runs_are_rows_that_say_so(void **state)
{
    fixture f;
    qdot_workprecision w = {.budget = 5e4};
    size_t failed = 0;

    (void)state;
    oscillator(&f, false);
    must(qdot_workprecision_measure(f.scene, &f.request, &w));
    assert_int_equal(w.n, 13 * qdot_ode_method_count());
    for (size_t k = 0; k < w.n; k++) {
        const qdot_workprecision_row *r = &w.rows[k];

        if (strcmp(r->status, "done") == 0) {
            assert_true(r->err < 1);
            continue;
        }
        failed++;
        assert_int_equal(strncmp(r->status, "failed: stopped at t = ", 23), 0);
        assert_true(isnan(r->err) && isnan(r->scd) && isnan(r->time_median));
    }
    assert_true(failed > 10 && failed < w.n);
    qdot_workprecision_clear(&w);
    end(&f);
}

/* States within steps that are looked at for an event, though it never comes, are counted as well. */
static void
looks_for_events_are_counted(void **state)
{
    fixture f;
    qdot_workprecision w = {.budget = 2e5};
    char name[] = "far";
    qdot_event e = {.name = name, .stop = true};
    size_t within = 0;

    (void)state;
    oscillator(&f, false);
    e.left = qdot_symbol_get(f.pool, QDOT_COORD, "x");
    e.right = qdot_expr_int(f.pool, 2);
    must(qdot_scene_event(f.scene, &e));
    must(qdot_workprecision_measure(f.scene, &f.request, &w));
    for (size_t k = 0; k < w.n; k++)
        within += strstr(w.rows[k].status, "within steps") != NULL;
    assert_true(within > 0 && within < w.n);
    qdot_workprecision_clear(&w);
    end(&f);
}

static void
what_cannot_be_compared_is_refused(void **state)
{
    fixture f;
    qdot_workprecision w = {0};

    (void)state;
    oscillator(&f, false);
    f.request.t1 = QDOT_ZERO;
    assert_int_equal(qdot_workprecision_measure(f.scene, &f.request, &w), QDOT_EINVAL);
    qdot_workprecision_clear(&w);
    f.request.t1 = QDOT_ONE;
    qdot_interrupt_set();
    assert_int_equal(qdot_workprecision_measure(f.scene, &f.request, &w), QDOT_EINTR);
    qdot_interrupt_clear();
    qdot_workprecision_clear(&w);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_climbs_the_ladder),
        cmocka_unit_test(rows_are_planned_as_runs_are),
        cmocka_unit_test(errors_are_those_of_runs),
        cmocka_unit_test(equations_that_can_hide_forces_are_looked_at),
        cmocka_unit_test(without_conservation_there_is_no_energy_error),
        cmocka_unit_test(hopeless_runs_are_rows_that_say_so),
        cmocka_unit_test(looks_for_events_are_counted),
        cmocka_unit_test(what_cannot_be_compared_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
