/* test_clocks.c -- events at multiples of two periods, near t = 0 and far from it, against integers: every occurrence
 * once, those of one instant in the order of their statements. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>

/* What the two events do to the velocity: their order matters. */
static long
acted(int event, long v)
{
    return event == 0 ? -v : v + 1;
}

/* x at the time `length` hundredths after `since`: it starts at 0, at rest; the periods in hundredths. */
static double
place(long since, long length, const long periods[2])
{
    long x = 0, v = 0;

    for (long t = since + 1; t <= since + length; t++) {
        x += v;
        for (int k = 0; k < 2; k++)
            if (t % periods[k] == 0)
                v = acted(k, v);
    }
    return (double)x / 100;
}

static qdot_expr
hundredths(fixture *f, long n)
{
    return qdot_div(f->pool, qdot_expr_int(f->pool, n), qdot_expr_int(f->pool, 100));
}

/* sin(pi t/period) = 0, or as a remainder. */
static qdot_expr
clock_of(fixture *f, long period, bool remainder)
{
    qdot_expr t = qdot_symbol_get(f->pool, QDOT_TIME, "t"), of[2] = {t, hundredths(f, period)};

    if (remainder)
        return qdot_fun(f->pool, QDOT_MOD, 2, of);
    return qdot_fun1(f->pool, QDOT_SIN, times(f, QDOT_PI, qdot_div(f->pool, of[0], of[1])));
}

static void
add_event(fixture *f, int k, long period, bool remainder, qdot_expr v)
{
    char name[] = {'e', (char)('0' + k), '\0'};
    qdot_event event = {.name = name, .left = clock_of(f, period, remainder), .right = QDOT_ZERO};

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
    static const long periods[][2] = {{30, 10}, {10, 30}, {35, 70}, {300, 100}, {20, 30}, {5, 15}};
    static const char *const methods[] = {"auto", "dop853", "radau"};

    (void)state;
    for (int k = 0; k < 36; k++) {
        const long *p = periods[k % 6], since = k % 12 < 6 ? 0 : k < 12 ? 100000000 : 1000000, length = 401;
        const double truth = place(since, length, p);
        qdot_expr x;
        fixture f;
        qdot_run *r;

        begin(&f);
        x = coordinate(&f, "x");
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
        for (int e = 0; e < 2; e++)
            add_event(&f, e, p[e], (k + e) % 2 == 0, velocity(&f, x));
        f.request.t0 = hundredths(&f, since);
        f.request.t1 = hundredths(&f, since + length);
        f.request.method = methods[k / 12];
        r = run(&f);
        assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
        if (!(fabs(qdot_run_get_report(r)->q[0] - truth) < 1e-9))
            fail_msg("periods %ld, %ld from %ld by %s: %.17g, truth %.17g", p[0], p[1], since, f.request.method,
                     qdot_run_get_report(r)->q[0], truth);
        qdot_run_free(r);
        end(&f);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clocks_act_once_and_in_order),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
