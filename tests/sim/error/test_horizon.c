/* test_horizon.c -- where runs of chaotic scenes end to mean anything, against runs with
 * `digits`; and that regular scenes have no horizon. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "base/memory.h"

enum { LOOKS = 800 };

/* A companion starts half an ulp away, and errs as the run does: the horizon stated lies
 * before the true one, by what two such errors more take to grow: how much that is depends on the
 * rounding of the machine, by a sixth in a scene whose distances grow as slowly as here. Errors that chance to
 * be five times as large as what the companion begins with bring the true one forward, by a twentieth. */
static void
is_near(double stated, double expected, double tol)
{
    if (!(stated <= 1.05 * expected && stated >= 0.83 * expected))
        fail_msg("tol %g: stated %g, found %g", tol, stated, expected);
}

/* What the horizon is by its definition, with the exact motion in the place of the
 * companion: the first of the times [LOOKS] at which the run is V/10 away from it. */
static double
true_horizon(fixture *f, qdot_run *r, double until)
{
    const size_t n = f->scene->coordinates.n;
    double *own = qdot_calloc(2 * LOOKS * 2 * n, sizeof *own), *exact = own + LOOKS * 2 * n;
    double times[LOOKS], size = 0, found = NAN, t1 = qdot_run_get_report(r)->t1;
    qdot_expr state[2 * MOST_COORDINATES];
    qdot_run *precise;

    for (size_t i = 0; i < n; i++) {
        state[i] = f->scene->coordinates.at[i];
        state[n + i] = velocity(f, state[i]);
    }
    for (size_t k = 0; k < LOOKS; k++)
        times[k] = t1 * (double)k / (LOOKS - 1);
    must(qdot_run_values(r, 2 * n, state, LOOKS, times, own, NULL));
    for (size_t i = 0; i < 2 * n; i++) {
        double low = INFINITY, high = -INFINITY;

        for (size_t k = 0; k < LOOKS; k++) {
            low = fmin(low, own[k * 2 * n + i]);
            high = fmax(high, own[k * 2 * n + i]);
        }
        size = fmax(size, 0.5 * (high - low) / fmax(1, fmax(fabs(low), fabs(high))));
    }
    for (size_t k = 0; k < LOOKS; k++)
        times[k] = until * (double)k / (LOOKS - 1);
    must(qdot_run_values(r, 2 * n, state, LOOKS, times, own, NULL));
    f->request.digits = 12;
    f->request.t1 = qdot_expr_int(f->pool, (int64_t)ceil(until));
    must(qdot_run_new(f->scene, &f->request, &precise));
    must(qdot_run_values(precise, 2 * n, state, LOOKS, times, exact, NULL));
    for (size_t k = 0; k < LOOKS && isnan(found); k++)
        for (size_t i = 0; i < 2 * n; i++) {
            double y = own[k * 2 * n + i];

            if (fabs(y - exact[k * 2 * n + i]) >= 0.1 * size * fmax(1, fabs(y)))
                found = times[k];
        }
    qdot_run_free(precise);
    qdot_free(own);
    f->request.digits = 0;
    return found;
}

/* Both links let go at 2: chaos from the start. */
static void
of_a_double_pendulum(void **state)
{
    static const double tols[] = {1e-12, 1e-13, 1e-15, 1e-6};

    (void)state;
    for (size_t k = 0; k < sizeof tols / sizeof *tols; k++) {
        fixture f;
        qdot_run *r;
        const qdot_run_report *report;
        double expected;

        chain(&f, 2);
        f.q0[0] = f.q0[1] = qdot_expr_int(f.pool, 2);
        f.request.t1 = qdot_expr_int(f.pool, 100);
        f.request.tol = tols[k];
        r = run(&f);
        report = qdot_run_get_report(r);
        assert_int_equal(report->status, QDOT_RUN_DONE);
        assert_true(report->error > 0.5);
        expected = true_horizon(&f, r, 40);
        is_near(report->horizon, expected, tols[k]);
        qdot_run_free(r);
        end(&f);
    }
}

static void
henon_heiles(fixture *f, const char *speed)
{
    qdot_expr x, y;

    begin(f);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    must(qdot_scene_particle(f->scene, "p", QDOT_ONE, pair(f, x, y)));
    must(qdot_scene_potential(
        f->scene,
        qdot_add(f->pool,
                 times(f, number(f, "0.5"),
                       qdot_add(f->pool, times(f, x, x), times(f, y, y))),
                 qdot_sub(f->pool, times(f, times(f, x, x), y),
                          qdot_div(f->pool, qdot_pow_int(f->pool, y, 3),
                                   qdot_expr_int(f->pool, 3))))));
    f->q0[1] = number(f, "-0.15");
    f->v0[0] = number(f, speed);
}

/* At the energy of escape the whole plane is chaotic; at a twelfth nearly none of it. */
static void
of_henon_heiles(void **state)
{
    fixture f;
    qdot_run *r;
    double expected;

    (void)state;
    henon_heiles(&f, "0.54");
    f.request.t1 = qdot_expr_int(f.pool, 1000);
    r = run(&f);
    expected = true_horizon(&f, r, 600);
    is_near(qdot_run_get_report(r)->horizon, expected, f.request.tol);
    qdot_run_free(r);
    end(&f);
    henon_heiles(&f, "0.3");
    f.request.t1 = qdot_expr_int(f.pool, 1000);
    r = run(&f);
    assert_true(isnan(qdot_run_get_report(r)->horizon));
    assert_true(qdot_run_get_report(r)->error < 1e-8);
    qdot_run_free(r);
    end(&f);
}

/* Beyond it the error of a value is as large as the motion, at any time; before it what
 * it was; the energy keeps its own. */
static void
of_values(void **state)
{
    const double times[] = {10, 20, 40, 55, 63.7, 77, 90.123, 100};
    double values[16], errors[16], high, error;
    qdot_expr asked[2];
    fixture f;
    qdot_run *r;

    (void)state;
    chain(&f, 2);
    f.q0[0] = f.q0[1] = qdot_expr_int(f.pool, 2);
    f.request.t1 = qdot_expr_int(f.pool, 100);
    r = run(&f);
    asked[0] = qdot_fun1(f.pool, QDOT_SIN, f.scene->coordinates.at[0]);
    asked[1] = qdot_mech_energy(f.scene);
    must(qdot_run_values(r, 2, asked, 8, times, values, errors));
    assert_true(errors[0] < 1e-9);
    assert_true(errors[2] < 1e-4);
    for (size_t k = 2; k < 8; k++) {
        /* three sines: 5/4 a + 2 min(a, b) + b, a + b/2 <= 2 */
        assert_true(errors[2 * k] > 0.5 && errors[2 * k] <= 5.7);
        assert_true(errors[2 * k + 1] < 1e-10);
    }
    must(qdot_run_range(r, QDOT_RANGE_MEAN, asked[0], 0, 100, &high, &error));
    assert_true(error > 0.5);
    must(qdot_run_range(r, QDOT_RANGE_MEAN, asked[0], 0, 15, &high, &error));
    assert_true(error < 1e-7);
    qdot_run_free(r);
    end(&f);
}

/* A pendulum for 1000 s, and Kepler's ellipse with e = 0.9 in the plane, whose velocity
 * leaps at each pericentre: errors grow, but no digit is lost for good. */
static void
none_of_regular_scenes(void **state)
{
    static const double tols[] = {1e-15, 1e-12, 1e-8};

    (void)state;
    for (size_t k = 0; k < sizeof tols / sizeof *tols; k++) {
        fixture f;
        qdot_run *r;
        qdot_expr x, y;

        pendulum(&f);
        f.request.t1 = qdot_expr_int(f.pool, 1000);
        f.request.tol = tols[k];
        r = run(&f);
        assert_true(isnan(qdot_run_get_report(r)->horizon));
        qdot_run_free(r);
        end(&f);
        begin(&f);
        x = coordinate(&f, "x");
        y = coordinate(&f, "y");
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, y)));
        must(qdot_scene_potential(
            f.scene,
            qdot_neg(f.pool,
                     qdot_pow(f.pool,
                              qdot_add(f.pool, times(&f, x, x), times(&f, y, y)),
                              number(&f, "-0.5")))));
        f.q0[0] = number(&f, "0.1");
        f.v0[1] = number(&f, "4.358898943540673");
        f.request.t1 = qdot_expr_int(f.pool, 600);
        f.request.tol = tols[k];
        r = run(&f);
        assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
        assert_true(isnan(qdot_run_get_report(r)->horizon));
        qdot_run_free(r);
        end(&f);
    }
}

/* What does not move has none; what stands on its head and only rounding moves has. */
static void
of_rest(void **state)
{
    fixture f;
    qdot_run *r;

    (void)state;
    pendulum(&f);
    f.q0[0] = QDOT_ZERO;
    f.request.t1 = qdot_expr_int(f.pool, 100);
    r = run(&f);
    assert_true(isnan(qdot_run_get_report(r)->horizon));
    qdot_run_free(r);
    f.q0[0] = QDOT_PI;
    r = run(&f);
    /* 2^-53 e^(sqrt(9.81) t) reaches 1 at t = 11.7 */
    assert_true(qdot_run_get_report(r)->horizon > 9 && qdot_run_get_report(r)->horizon < 12);
    qdot_run_free(r);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_a_double_pendulum), cmocka_unit_test(of_henon_heiles),
        cmocka_unit_test(of_values),            cmocka_unit_test(none_of_regular_scenes),
        cmocka_unit_test(of_rest),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
