/* test_longtime.c -- how the error of the energy of an anharmonic oscillator grows. */
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "ode/method.h"
#include "sim/study/longtime.h"

/* x'' = -x - x^3, or with a force that shakes it, from x = 1 to t = 3000. */
static void
oscillator(fixture *f, bool shaken)
{
    qdot_expr x, square;

    begin(f);
    x = coordinate(f, "x");
    square = times(f, x, x);
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(f->scene, times(f, number(f, "0.5"), square)));
    must(qdot_scene_potential(f->scene, times(f, number(f, "0.25"), times(f, square, square))));
    if (shaken)
        must(qdot_scene_potential(
            f->scene, times(f, x, qdot_fun1(f->pool, QDOT_COS, QDOT_T))));
    f->q0[0] = QDOT_ONE;
    f->request.t1 = qdot_expr_int(f->pool, 3000);
}

static void
a_power_is_fitted(void **state)
{
    double x[20], y[20], slope, error;

    (void)state;
    for (int i = 0; i < 20; i++) {
        x[i] = pow(1.4, i);
        y[i] = 3e-12 * pow(x[i], 0.5) * (i % 2 ? 1.1 : 0.9);
    }
    qdot_longtime_fit(20, x, y, &slope, &error);
    assert_true(fabs(slope - 0.5) < 0.02);
    assert_true(error > 0.001 && error < 0.03);
    qdot_longtime_fit(3, x, y, &slope, &error);
    assert_true(isnan(slope) && isnan(error));
    y[4] = 0;
    qdot_longtime_fit(20, x, y, &slope, &error);
    assert_true(isnan(slope) && isnan(error));
}

static void
symplectic_methods_do_not_drift(void **state)
{
    fixture f;
    qdot_longtime l = {.tol = 1e-5};
    size_t still = 0, drifting = 0;

    (void)state;
    oscillator(&f, false);
    must(qdot_longtime_measure(f.scene, &f.request, &l));
    assert_int_equal(l.n, qdot_ode_method_count());
    assert_int_equal(l.left_out.n, 0);
    assert_string_equal(l.chosen->name, "taylor");
    assert_true(l.chosen_tol == 1e-5 && !l.chosen_long);
    for (size_t k = 0; k < l.n; k++) {
        const qdot_longtime_row *r = l.rows + k;

        assert_string_equal(r->method, qdot_ode_method_at(k)->name);
        if (strcmp(r->status, "done") != 0)
            fail_msg("%s: %s", r->method, r->status);
        assert_true(r->n > 10 && r->t[r->n - 1] == 3000 && r->steps > 0);
        for (size_t i = 0; i < r->n; i++)
            assert_true(r->error[i] <= r->largest && (i == 0 || r->t[i] > r->t[i - 1]));
        if (qdot_ode_method_at(k)->geometric) {
            if (!(fabs(r->growth) < 0.1 && r->growth_error < 0.2))
                fail_msg("%s: t^%g +- %g", r->method, r->growth, r->growth_error);
            still++;
        } else if (strcmp(r->method, "rk8pd") == 0 || strcmp(r->method, "rkf45") == 0) {
            if (!(fabs(r->growth - 1) < 0.1))
                fail_msg("%s: t^%g +- %g", r->method, r->growth, r->growth_error);
            drifting++;
        }
    }
    assert_true(still >= 6 && drifting == 2);
    qdot_longtime_clear(&l);
    end(&f);
}

/* Without a tolerance a method of low order takes one that its budget allows. */
static void
the_tolerance_fits_the_budget(void **state)
{
    fixture f;
    qdot_longtime l = {.method = "verlet", .budget = 3e7};

    (void)state;
    oscillator(&f, false);
    must(qdot_longtime_measure(f.scene, &f.request, &l));
    assert_int_equal(l.n, 1);
    assert_string_equal(l.rows[0].status, "done");
    assert_true(l.rows[0].tol > 1e-11 && l.rows[0].tol < 1e-3);
    qdot_longtime_clear(&l);
    l = (qdot_longtime){.method = "verlet", .budget = 1e4};
    must(qdot_longtime_measure(f.scene, &f.request, &l));
    assert_non_null(strstr(l.rows[0].status, "failed: at tol 1e-04 it would take"));
    assert_true(isnan(l.rows[0].growth));
    qdot_longtime_clear(&l);
    end(&f);
}

static void
what_has_no_energy_is_refused(void **state)
{
    fixture f;
    qdot_longtime l = {.tol = 1e-5};

    (void)state;
    oscillator(&f, true);
    assert_int_equal(qdot_longtime_measure(f.scene, &f.request, &l), QDOT_EFAILED);
    assert_int_equal(l.n, 0);
    qdot_longtime_clear(&l);
    end(&f);
}

static void
an_interrupt_leaves_nothing_behind(void **state)
{
    fixture f;
    qdot_longtime l = {.tol = 1e-5};

    (void)state;
    oscillator(&f, false);
    qdot_interrupt_flag = 1;
    assert_int_equal(qdot_longtime_measure(f.scene, &f.request, &l), QDOT_EINTR);
    qdot_interrupt_clear();
    assert_false(l.interrupted);
    qdot_longtime_clear(&l);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_power_is_fitted),
        cmocka_unit_test(symplectic_methods_do_not_drift),
        cmocka_unit_test(the_tolerance_fits_the_budget),
        cmocka_unit_test(what_has_no_energy_is_refused),
        cmocka_unit_test(an_interrupt_leaves_nothing_behind),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
