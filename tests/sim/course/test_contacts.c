/* test_contacts.c -- bounces without end against the closed form: on a table of any height, between blocks of any
 * mass; a longer run says the same; on plates that are driven, until these fall away. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

/* Random numbers of 0 ... 1. */
static double
draw(uint32_t *random)
{
    *random = *random * 1664525u + 1013904223u;
    return (*random >> 8) / 16777216.0;
}

/* The height at t of a ball that starts at `drop` above a table; *rest: when it comes to rest. */
static long double
height(long double drop, long double g, long double e, long double t, long double *rest)
{
    long double v = 0, y = drop, since = 0;

    *rest = sqrtl(2 * drop / g) * (1 + 2 * e / (1 - e));
    if (t >= *rest)
        return 0;
    for (;;) {
        const long double fall = (v + sqrtl(v * v + 2 * g * y)) / g;

        if (since + fall >= t)
            return y + v * (t - since) - g * (t - since) * (t - since) / 2;
        since += fall;
        v = e * (g * fall - v);
        y = 0;
    }
}

/* x of so many decimal digits as a script has it. */
static long double
written(const char *format, double x)
{
    char text[64];

    snprintf(text, sizeof text, format, x);
    return strtold(text, NULL);
}

static qdot_expr
decimal(fixture *f, const char *format, double x)
{
    char text[64];

    snprintf(text, sizeof text, format, x);
    return number(f, text);
}

/* y at the start of a run to `last`, its end or there at t. */
static double
value_at(fixture *f, qdot_expr what, double last, double t, double *error)
{
    qdot_run *r = NULL;
    double value;

    f->request.t1 = decimal(f, "%.5f", last);
    must(qdot_run_new(f->scene, &f->request, &r));
    assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
    must(qdot_run_values(r, 1, &what, 1, &t, &value, error));
    qdot_run_free(r);
    return value;
}

static void
balls_rest_on_tables(void **state)
{
    static const double tables[] = {0, 1, 7.3, -2, 1000, 0.1};
    uint32_t random = 36;

    (void)state;
    for (int seed = 0; seed < 24; seed++) {
        const double table = tables[seed % 6], drop = 0.1 + round(1000 * draw(&random)) / 1000,
                     e = 0.3 + 0.1 * (seed % 7);
        qdot_event floor = {.name = (char *)"floor", .way = -1};
        long double rest, truth;
        double t, value, again, error, other;
        qdot_expr y, v;
        fixture f;

        begin(&f);
        y = coordinate(&f, "y");
        v = velocity(&f, y);
        must(qdot_scene_particle(f.scene, "ball", QDOT_ONE, y));
        must(qdot_scene_potential(f.scene, times(&f, qdot_expr_int(f.pool, 10), y)));
        floor.left = y;
        floor.right = decimal(&f, "%.1f", table);
        must(qdot_vec_push(&floor.targets, v));
        must(qdot_vec_push(&floor.values, times(&f, decimal(&f, "%.1f", -e), v)));
        must(qdot_scene_event(f.scene, &floor));
        qdot_free(floor.targets.at);
        qdot_free(floor.values.at);
        f.q0[0] = qdot_add(f.pool, floor.right, decimal(&f, "%.3f", drop));
        (void)height(written("%.3f", drop), 10, written("%.1f", e), 0, &rest);
        t = ceil(1000 * (double)rest * (seed % 3 == 0 ? 0.9 : 1.2)) / 1000;
        truth = written("%.1f", table)
                + height(written("%.3f", drop), 10, written("%.1f", e), written("%.3f", t), &rest);
        value = value_at(&f, y, t, t, &error);
        again = value_at(&f, y, 4 * t, t, &other);
        if (!(fabsl(value - truth) <= 3 * error + 0x1p-52 * fabs(table)) || !(fabsl(value - truth) < 1e-11))
            fail_msg("table %g, drop %g, e = %g: %.17g at %g, truth %.17Lg, stated %g", table, drop, e, value, t,
                     truth, error);
        if (t > (double)rest)
            assert_true(value == again);
        assert_true(fabs(value - again) <= 3 * (error + other));
        end(&f);
    }
}

/* y = 0 falling then y' = -e y'. */
static void
bounce(fixture *f, const char *name, qdot_expr y, qdot_expr e)
{
    qdot_event floor = {.name = (char *)name, .way = -1, .left = y, .right = QDOT_ZERO};
    const qdot_expr v = velocity(f, y);

    must(qdot_vec_push(&floor.targets, v));
    must(qdot_vec_push(&floor.values, qdot_neg(f->pool, times(f, e, v))));
    must(qdot_scene_event(f->scene, &floor));
    qdot_free(floor.targets.at);
    qdot_free(floor.values.at);
}

/* Two balls of one height land at the same instants: moved alike they still do, and the error covers what rounding did. */
static void
balls_land_together(void **state)
{
    uint32_t random = 48;

    (void)state;
    for (int seed = 0; seed < 24; seed++) {
        const double drop = 0.5 + round(100 * draw(&random)) / 100, fall = 0.7 + 0.05 * (seed % 5);
        long double truth, rest;
        double value, error, t;
        qdot_expr y, z, e;
        fixture f;

        begin(&f);
        y = coordinate(&f, "y");
        z = coordinate(&f, "z");
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, y));
        must(qdot_scene_particle(f.scene, "q", qdot_expr_int(f.pool, 2), z));
        must(qdot_scene_potential(
            f.scene, times(&f, qdot_expr_int(f.pool, 4), qdot_add(f.pool, y, times(&f, qdot_expr_int(f.pool, 2), z)))));
        e = decimal(&f, "%.2f", fall);
        bounce(&f, "a", y, e);
        bounce(&f, "b", z, e);
        f.q0[0] = f.q0[1] = decimal(&f, "%.2f", drop);
        (void)height(written("%.2f", drop), 4, written("%.2f", fall), 0, &rest);
        t = floor(100 * 0.8 * (double)rest) / 100;
        truth = height(written("%.2f", drop), 4, written("%.2f", fall), written("%.2f", t), &rest);
        value = value_at(&f, y, t, t, &error);
        if (!(fabsl(value - truth) <= 1.5L * error) || !(error < 1e-11))
            fail_msg("drop %g, e = %g: %.17g at %g, truth %.17Lg, stated %g", drop, fall, value, t, truth, error);
        end(&f);
    }
}

/* A block of mass m is pushed by a force of 1 against another of mass M ahead of it. */
static void
pushed_blocks_go_on_as_one(void **state)
{
    static const int masses[][2] = {{1, 1}, {2, 5}, {1, 100}, {100, 1}, {3, 2}};

    (void)state;
    for (int k = 0; k < 5; k++) {
        const int m = masses[k][0], M = masses[k][1];
        qdot_event hit = {.name = (char *)"hit", .right = QDOT_ZERO, .way = -1};
        qdot_expr q[2], v[2], to[2], mean, turned;
        double value, error, t;
        fixture f;

        begin(&f);
        for (int i = 0; i < 2; i++) {
            q[i] = coordinate(&f, i == 0 ? "x" : "y");
            v[i] = velocity(&f, q[i]);
            must(qdot_scene_particle(f.scene, i == 0 ? "p" : "q", qdot_expr_int(f.pool, masses[k][i]), q[i]));
        }
        must(qdot_scene_torque(f.scene, &(qdot_torque){.coordinate = q[0], .torque = QDOT_ONE}));
        mean = qdot_div(f.pool,
                        qdot_add(f.pool, times(&f, qdot_expr_int(f.pool, m), v[0]),
                                 times(&f, qdot_expr_int(f.pool, M), v[1])),
                        qdot_expr_int(f.pool, m + M));
        turned = qdot_div(f.pool, times(&f, QDOT_HALF, qdot_sub(f.pool, v[1], v[0])), qdot_expr_int(f.pool, m + M));
        to[0] = qdot_add(f.pool, mean, times(&f, qdot_expr_int(f.pool, M), turned));
        to[1] = qdot_sub(f.pool, mean, times(&f, qdot_expr_int(f.pool, m), turned));
        hit.left = qdot_sub(f.pool, q[1], q[0]);
        for (int i = 0; i < 2; i++) {
            must(qdot_vec_push(&hit.targets, v[i]));
            must(qdot_vec_push(&hit.values, to[i]));
        }
        must(qdot_scene_event(f.scene, &hit));
        qdot_free(hit.targets.at);
        qdot_free(hit.values.at);
        f.q0[1] = QDOT_HALF;
        t = ceil(sqrt(m) * 3 * 1.1);
        value = value_at(&f, q[0], t, t, &error);
        if (!(fabs(value - (M * 0.5 + t * t / 2) / (m + M)) <= 3 * error + 0x1p-51 * fabs(value))
            || !(error < 1e-10))
            fail_msg("masses %d, %d: %.17g, truth %.17g, stated %g", m, M, value, (M * 0.5 + t * t / 2) / (m + M),
                     error);
        value = value_at(&f, v[1], t, t, &error);
        assert_true(fabs(value - t / (m + M)) <= 3 * error + 0x1p-51 * fabs(value));
        end(&f);
    }
}

/* A ball starts on a plate A sin(w t) and with it: it leaves where sin(w t) = g/(A w^2), in a parabola. */
static void
balls_ride_on_driven_plates(void **state)
{
    static const char *const sizes[] = {"0.1", "0.25", "0.3"};
    static const int rates[] = {15, 11, 20};

    (void)state;
    for (int k = 0; k < 3; k++)
        for (int method = 0; method < 2; method++)
            for (double part = 0.5; part < 2; part += 0.4) {
                const double A = atof(sizes[k]);
                const int w = rates[k];
                const long double leaves = asinl(10 / (A * w * w)) / w;
                const double t = round(1e5 * (double)leaves * part) / 1e5;
                const long double d = t - leaves, truth = d < 0 ? A * sinl(w * (long double)t)
                                                               : A * sinl(w * leaves) + A * w * cosl(w * leaves) * d
                                                                     - 5 * d * d;
                qdot_event plate = {.name = (char *)"plate", .way = -1};
                qdot_expr y, v, speed, angle;
                double value, error;
                fixture f;

                begin(&f);
                y = coordinate(&f, "y");
                v = velocity(&f, y);
                must(qdot_scene_particle(f.scene, "ball", QDOT_ONE, y));
                must(qdot_scene_potential(f.scene, times(&f, qdot_expr_int(f.pool, 10), y)));
                angle = times(&f, qdot_expr_int(f.pool, w), QDOT_T);
                plate.left = y;
                plate.right = times(&f, number(&f, sizes[k]), qdot_fun1(f.pool, QDOT_SIN, angle));
                f.v0[0] = times(&f, number(&f, sizes[k]), qdot_expr_int(f.pool, w));
                speed = times(&f, f.v0[0], qdot_fun1(f.pool, QDOT_COS, angle));
                must(qdot_vec_push(&plate.targets, v));
                must(qdot_vec_push(&plate.values,
                                   qdot_sub(f.pool, times(&f, number(&f, "1.5"), speed), times(&f, QDOT_HALF, v))));
                must(qdot_scene_event(f.scene, &plate));
                qdot_free(plate.targets.at);
                qdot_free(plate.values.at);
                f.request.method = method == 0 ? "auto" : "taylor";
                value = value_at(&f, y, t, t, &error);
                if (!(fabsl(value - truth) <= 3 * error + 0x1p-52 * A) || !(fabsl(value - truth) < 1e-11))
                    fail_msg("%s sin(%d t), method %d: %.17g at %g, truth %.17Lg, stated %g", sizes[k], w, method, value,
                             t, truth, error);
                end(&f);
            }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_rest_on_tables),
        cmocka_unit_test(balls_land_together),
        cmocka_unit_test(pushed_blocks_go_on_as_one),
        cmocka_unit_test(balls_ride_on_driven_plates),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
