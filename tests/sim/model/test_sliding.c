/* test_sliding.c -- dry friction that holds: swings by all methods against the closed form; states
 * brought back onto the surfaces along which the motion slides. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "sim/course/stage.h"
#include "sim/model/sliding.h"

static const char *const methods[] = {"taylor", "dop853", "rk8pd", "rkf45",
                                      "msadams", "msbdf", "bsimp"};

/* Random numbers of 0 ... 1. */
static double
draw(uint32_t *random)
{
    *random = *random * 1664525u + 1013904223u;
    return (*random >> 8) / 16777216.0;
}

/* Where x'' + w^2 x = -F sign(x') comes to rest from x0 > F/w^2, and when. */
static double
rest(double w, double F, double x0, double *t)
{
    double x = x0;

    *t = 0;
    for (int side = 1; fabs(x) > F / (w * w); side = -side) {
        x = 2 * side * F / (w * w) - x; /* half a swing about side F/w^2 */
        *t += acos(-1) / w;
    }
    return x;
}

/* A block on a spring with dry friction: x'' + w^2 x = -F sign(x'). */
static void
swing(fixture *f, const char *w2, const char *F, const char *x0)
{
    qdot_expr x, v;

    begin(f);
    x = coordinate(f, "x");
    v = velocity(f, x);
    must(qdot_scene_particle(f->scene, "p", QDOT_ONE, x));
    must(qdot_scene_potential(
        f->scene, qdot_mul(f->pool, qdot_mul(f->pool, QDOT_HALF, number(f, w2)),
                           qdot_mul(f->pool, x, x))));
    must(qdot_scene_torque(
        f->scene,
        &(qdot_torque){.coordinate = x,
                       .torque = qdot_neg(f->pool,
                                          qdot_mul(f->pool, number(f, F),
                                                   qdot_fun1(f->pool, QDOT_SIGN, v)))}));
    f->q0[0] = number(f, x0);
    f->request.t1 = qdot_expr_int(f->pool, 60);
}

static void
swings_come_to_rest(void **state)
{
    uint32_t random = 20261126;

    (void)state;
    for (int seed = 0; seed < 28; seed++) {
        char w2[32], F[32], x0[32];
        const qdot_run_report *report;
        const double tol = seed % 7 == 5 ? 1e-6 : 1e-9;
        double x_end, t, value;
        qdot_expr friction;
        qdot_run *r = NULL;
        fixture f;

        snprintf(w2, sizeof w2, "%.3f", 0.5 + 3 * draw(&random));
        snprintf(F, sizeof F, "%.3f", 0.1 + 0.3 * draw(&random));
        snprintf(x0, sizeof x0, "%.3f", 1 + draw(&random));
        swing(&f, w2, F, x0);
        f.request.method = methods[seed % 7];
        f.request.tol = tol;
        must(qdot_run_new(f.scene, &f.request, &r));
        report = qdot_run_get_report(r);
        x_end = rest(sqrt(atof(w2)), atof(F), atof(x0), &t);
        assert_int_equal(report->status, QDOT_RUN_DONE);
        assert_true(report->v[0] == 0);
        assert_false(isnan(report->error));
        if (!(fabs(report->q[0] - x_end) <= 3 * report->error + 4e-16)
            || !(fabs(report->q[0] - x_end) < 1e4 * tol))
            fail_msg("w^2 = %s, F = %s, x0 = %s by %s: off by %.3g, stated %.3g", w2, F, x0,
                     f.request.method, report->q[0] - x_end, report->error);
        /* the spring is held by friction */
        friction = qdot_fun1(f.pool, QDOT_SIGN, velocity(&f, f.scene->coordinates.at[0]));
        must(qdot_run_values(r, 1, &friction, 1, (double[]){t + 1}, &value, NULL));
        if (!(fabs(-atof(F) * value - atof(w2) * x_end) < 1e4 * tol * atof(w2)))
            fail_msg("friction of %.17g, the spring %.17g", -atof(F) * value, atof(w2) * x_end);
        qdot_run_free(r);
        end(&f);
    }
}

/* sign(x' - 4 t y^2) and sign(x - y): rows of velocities, of positions and of their rates. */
static void
states_are_brought_back(void **state)
{
    fixture f;
    qdot_stage stage = {0};
    qdot_sliding_rows rows = {0};
    int64_t side[] = {QDOT_SIDE_SLIDES, QDOT_SIDE_SLIDES};
    double y[] = {1, 1.0000001, 2.0000003, 1.9999}, moved; /* x, y, x', y' */
    qdot_expr u[2], x, z;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    z = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
    must(qdot_scene_particle(f.scene, "q", QDOT_ONE, z));
    must(qdot_stage_begin(&stage, f.scene, &f.request));
    u[0] = qdot_sub(f.pool, velocity(&f, x),
                    qdot_mul(f.pool, qdot_expr_int(f.pool, 4),
                             qdot_mul(f.pool, QDOT_T, qdot_mul(f.pool, z, z))));
    u[1] = qdot_sub(f.pool, x, z);
    {
        qdot_surface two[] = {{.u = u[0]}, {.u = u[1]}};
        const qdot_switches both = {.pool = f.pool, .surfaces = {.at = two, .n = 2}};

        must(qdot_sliding_rows_make(stage.modes.at[0]->plan, &both, side, u, &rows));
    }
    assert_int_equal(rows.rows, 3);
    must(qdot_sliding_rows_keep(&rows, 2, 0.5, y, &moved));
    assert_true(moved > 1e-5 && moved < 1e-3);
    assert_true(fabs(y[0] - y[1]) < 1e-15);
    assert_true(fabs(y[2] - 2 * y[1] * y[1]) < 1e-14);
    assert_true(fabs(y[2] - y[3]) < 1e-14);
    must(qdot_sliding_rows_keep(&rows, 2, 0.5, y, &moved));
    assert_true(moved < 1e-14);
    qdot_sliding_rows_clear(&rows);
    qdot_stage_clear(&stage);
    end(&f);
}

/* x'' = -F sign(x - 1) + b x' from x = 1 with speed v. */
static void
relay(fixture *f, const char *F, const char *b, const char *v)
{
    qdot_expr x;

    begin(f);
    x = coordinate(f, "x");
    must(qdot_scene_particle(f->scene, "p", QDOT_ONE, x));
    must(qdot_scene_torque(
        f->scene,
        &(qdot_torque){
            .coordinate = x,
            .torque = qdot_sub(f->pool, qdot_mul(f->pool, number(f, b), velocity(f, x)),
                               qdot_mul(f->pool, number(f, F),
                                        qdot_fun1(f->pool, QDOT_SIGN,
                                                  qdot_sub(f->pool, x, QDOT_ONE))))}));
    f->q0[0] = QDOT_ONE;
    f->v0[0] = number(f, v);
    f->request.t1 = QDOT_ONE;
}

/* A relay entered so slowly that the rounding of x hides its swings slides by every method; that its speed
 * stays is stated. Faster, it is followed. */
static void
a_relay_slides_where_rounding_hides_its_swings(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        const qdot_run_report *report;
        qdot_run *r = NULL;
        fixture f;

        relay(&f, k % 2 ? "1" : "2.5", "0", k % 3 ? "0.00000001" : "-0.00000003");
        f.request.method = methods[k];
        f.request.tol = 1e-9;
        must(qdot_run_new(f.scene, &f.request, &r));
        report = qdot_run_get_report(r);
        assert_int_equal(report->status, QDOT_RUN_DONE);
        assert_true(report->q[0] == 1 && report->v[0] == 0);
        if (!(report->error >= (k % 3 ? 1e-8 : 3e-8) && report->error < 1e-7))
            fail_msg("%s states %.3g", methods[k], report->error);
        qdot_run_free(r);
        end(&f);
    }
}

/* Where its speed grows tenfold it does not stay: that is told. */
static void
a_relay_that_grows_does_not_slide(void **state)
{
    const qdot_run_report *report;
    qdot_run *r = NULL;
    fixture f;

    (void)state;
    relay(&f, "1", "20", "0.000000001");
    must(qdot_run_new(f.scene, &f.request, &r));
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_FAILED);
    qdot_run_free(r);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(swings_come_to_rest),
        cmocka_unit_test(states_are_brought_back),
        cmocka_unit_test(a_relay_slides_where_rounding_hides_its_swings),
        cmocka_unit_test(a_relay_that_grows_does_not_slide),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
