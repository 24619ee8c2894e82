/* test_clocks.c -- events at multiples of two periods, near t = 0 and far from it, against integers: every occurrence
 * once, those of one instant in the order of their statements. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <inttypes.h>
#include <math.h>

/* What the two events do to the velocity: their order matters. */
static int64_t
acted(int event, int64_t v)
{
    return event == 0 ? -v : v + 1;
}

/* x at the time `length` hundredths after `since`: it starts at 0, at rest; the periods in hundredths. */
static double
place(int64_t since, int64_t length, const int64_t periods[2])
{
    int64_t x = 0, v = 0;

    for (int64_t t = since + 1; t <= since + length; t++) {
        x += v;
        for (int k = 0; k < 2; k++)
            if (t % periods[k] == 0)
                v = acted(k, v);
    }
    return (double)x / 100;
}

static qdot_expr
hundredths(fixture *f, int64_t n)
{
    return qdot_div(f->pool, qdot_expr_int(f->pool, n), qdot_expr_int(f->pool, 100));
}

/* sin(pi t/period) = 0, or as a remainder. */
static qdot_expr
clock_of(fixture *f, int64_t period, bool remainder)
{
    qdot_expr t = qdot_symbol_get(f->pool, QDOT_TIME, "t"), of[2] = {t, hundredths(f, period)};

    if (remainder)
        return qdot_fun(f->pool, QDOT_MOD, 2, of);
    return qdot_fun1(f->pool, QDOT_SIN, times(f, QDOT_PI, qdot_div(f->pool, of[0], of[1])));
}

static void
add_event(fixture *f, int k, qdot_expr clock, qdot_expr v)
{
    char name[] = {'e', (char)('0' + k), '\0'};
    qdot_event event = {.name = name, .left = clock, .right = QDOT_ZERO};

    must(qdot_vec_push(&event.targets, v));
    must(qdot_vec_push(&event.values,
                       k == 0 ? qdot_neg(f->pool, v) : qdot_add(f->pool, v, QDOT_ONE)));
    must(qdot_scene_event(f->scene, &event));
    qdot_free(event.targets.at);
    qdot_free(event.values.at);
}

static void
clocks_act_once_and_in_order(void **state)
{
    static const int64_t periods[][2] = {{30, 10}, {10, 30}, {35, 70}, {300, 100}, {20, 30}, {5, 15}};
    static const char *const methods[] = {"auto", "dop853", "radau"};

    (void)state;
    for (int k = 0; k < 36; k++) {
        const int64_t *p = periods[k % 6], since = k % 12 < 6 ? 0 : k < 12 ? 100000000 : 1000000, length = 401;
        const double truth = place(since, length, p);
        qdot_expr x;
        fixture f;
        qdot_run *r;

        begin(&f);
        x = coordinate(&f, "x");
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
        for (int e = 0; e < 2; e++)
            add_event(&f, e, clock_of(&f, p[e], (k + e) % 2 == 0), velocity(&f, x));
        f.request.t0 = hundredths(&f, since);
        f.request.t1 = hundredths(&f, since + length);
        f.request.method = methods[k / 12];
        r = run(&f);
        assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
        if (!(fabs(qdot_run_get_report(r)->q[0] - truth) < 1e-9))
            fail_msg("periods %" PRId64 ", %" PRId64 " from %" PRId64 " by %s: %.17g, truth %.17g", p[0], p[1], since, f.request.method,
                     qdot_run_get_report(r)->q[0], truth);
        qdot_run_free(r);
        end(&f);
    }
}

/* t - 1 */
static qdot_expr
since_1(fixture *f)
{
    return qdot_sub(f->pool, qdot_symbol_get(f->pool, QDOT_TIME, "t"), QDOT_ONE);
}

/* Rounding of sin(t - 1) - (t - 1) moves its root by more than 1e-5; so long before it comes the other event. */
static void
flat_clocks_move_no_others(void **state)
{
    static const char *const methods[] = {"auto", "dop853"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        const qdot_run_occurrence *list;
        fixture f;
        qdot_expr x;
        qdot_event flat = {.name = "flat", .right = QDOT_ZERO};
        qdot_run *r;
        size_t n;

        begin(&f);
        x = coordinate(&f, "x");
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
        flat.left = qdot_sub(f.pool, qdot_fun1(f.pool, QDOT_SIN, since_1(&f)), since_1(&f));
        must(qdot_scene_event(f.scene, &flat));
        add_event(&f, 1, qdot_add(f.pool, since_1(&f), qdot_div(f.pool, QDOT_ONE, qdot_expr_int(f.pool, 100000))),
                  velocity(&f, x));
        f.request.t0 = hundredths(&f, 30);
        f.request.t1 = qdot_expr_int(f.pool, 2);
        f.request.method = methods[k];
        r = run(&f);
        must(qdot_run_occurrences(r, &list, &n));
        assert_int_equal(n, 2);
        assert_string_equal(list[0].event, "e1");
        assert_true(fabs(list[0].t - 0.99999) < 1e-15);
        assert_true(fabs(list[1].t - 1) <= list[1].error);
        qdot_run_free(r);
        end(&f);
    }
}

/* 1/(t - 1)^n changes its sign through infinity, where a step or half of it ends. */
static void
poles_of_clocks_are_no_events(void **state)
{
    static const char *const methods[] = {"auto", "dop853", "radau"};

    (void)state;
    for (int k = 0; k < 9; k++) {
        fixture f;
        qdot_expr x, pole;
        qdot_run *r;

        begin(&f);
        x = coordinate(&f, "x");
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
        pole = qdot_div(f.pool, QDOT_ONE, qdot_pow(f.pool, since_1(&f), qdot_expr_int(f.pool, 1 + 2 * (k / 3))));
        add_event(&f, 1, pole, velocity(&f, x));
        f.request.t1 = qdot_expr_int(f.pool, 2);
        f.request.method = methods[k % 3];
        r = run(&f);
        assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
        assert_true(qdot_run_get_report(r)->q[0] == 0);
        qdot_run_free(r);
        end(&f);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clocks_act_once_and_in_order),
        cmocka_unit_test(flat_clocks_move_no_others),
        cmocka_unit_test(poles_of_clocks_are_no_events),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
