/* test_written.c -- when code is written, kept and dropped, of a series that only counts. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "ode/companion.h"
#include "ode/taylor.h"
#include "ode/written.h"

/* Code that is there, code that lies there from before; calls. */
typedef struct {
    bool there, kept, refused;
    int written, taken, dropped, most;
} counts;

static qdot_status
write_it(int p, int most, void *user)
{
    counts *c = user;

    (void)p;
    c->written++;
    c->most = most;
    c->there = !c->refused;
    return QDOT_OK;
}

static bool
take_it(int p, int most, void *user)
{
    counts *c = user;

    (void)p;
    c->most = most;
    c->taken++;
    c->there = c->kept;
    return c->kept;
}

static bool
is_there(int p, void *user)
{
    (void)p;
    return ((counts *)user)->there;
}

static void
drop_it(void *user)
{
    counts *c = user;

    c->there = false;
    c->dropped++;
}

static qdot_ode_series
series_of(counts *c)
{
    return (qdot_ode_series){.cost.worth = 300,
                             .code = {.write = write_it,
                                      .take = take_it,
                                      .there = is_there,
                                      .drop = drop_it,
                                      .user = c}};
}

/* The first step leaves so many: whether code is there, and whether it is expanded again. */
static void
after_first(counts *c, double left, bool there, bool again)
{
    const qdot_ode_series series = series_of(c);
    qdot_ode_written w = qdot_ode_written_begin(&series, 20, 20, 0);
    bool said;

    assert_true(w.first);
    assert_int_equal(c->taken, 1);
    assert_int_equal(qdot_ode_written_first(&w, left, &said), QDOT_OK);
    assert_int_equal(c->there, there);
    assert_int_equal(said, again);
    assert_false(w.first);
}

static void
what_lay_there_changes_nothing(void **state)
{
    (void)state;
    for (int kept = 0; kept < 2; kept++) {
        counts few = {.kept = kept}, many = few, none = few;

        after_first(&many, 11, true, !kept);
        assert_int_equal(many.written, !kept);
        after_first(&few, 9, false, kept);
        assert_int_equal(few.written, 0);
        assert_int_equal(few.dropped, kept);
        after_first(&none, -1, false, kept); /* all at once */
    }
}

static void
later_steps_say_it_too(void **state)
{
    counts c = {0};
    const qdot_ode_series series = series_of(&c);
    qdot_ode_written w = qdot_ode_written_begin(&series, 20, 20, 0);
    bool again;

    (void)state;
    assert_int_equal(qdot_ode_written_first(&w, 5, &again), QDOT_OK);
    assert_int_equal(qdot_ode_written_next(&w, 1, 29), QDOT_OK);
    assert_int_equal(c.written, 0);
    assert_int_equal(qdot_ode_written_next(&w, 1, 31), QDOT_OK);
    assert_int_equal(c.written, 1);
    assert_int_equal(qdot_ode_written_next(&w, 2, 1000), QDOT_OK);
    assert_int_equal(c.written, 1);
}

/* worth 300 of order 20: 15 steps; the first step says 9, half as many again as are left. */
static void
steps_of_runs_before_count(void **state)
{
    (void)state;
    for (int past = 0; past < 8; past++) {
        counts c = {0};
        const qdot_ode_series series = series_of(&c);
        qdot_ode_written w = qdot_ode_written_begin(&series, 20, 20, past);
        bool again;

        assert_int_equal(qdot_ode_written_first(&w, 6, &again), QDOT_OK);
        assert_int_equal(c.written, past > 6);
        assert_int_equal(again, past > 6);
    }
}

static void
what_cannot_be_written_is_not_expanded_again(void **state)
{
    counts c = {.refused = true};

    (void)state;
    after_first(&c, 1000, false, false);
    assert_int_equal(c.written, 1);
}

/* A run and its companions ask for code up to the same order, at most the highest that there is. */
static void
companions_share_it(void **state)
{
    (void)state;
    for (int most = 0; most < 48; most += 12) {
        counts c = {0};
        qdot_ode_series series = series_of(&c);
        const qdot_ode_system system = {.n = 1, .series = &series};
        const double tol = 1e-10;
        double theirs;
        int highest;
        qdot_ode_written w;
        bool again;

        series.most = 48 - most / 2;
        series.cost.kernels[0] = most;
        series.cost.kernels[1] = series.cost.kernels[2] = 1;
        theirs = qdot_companion_tolerance(&system, qdot_ode_method_find("taylor"), tol);
        highest = qdot_ode_taylor_highest(&system, tol, false, 0);
        assert_true(highest >= qdot_ode_taylor_order(&series, tol, false, 0));
        for (int more = 1; more <= QDOT_COMPANION_ORDERS; more++) {
            assert_int_equal(qdot_ode_taylor_highest(&system, theirs, false, more), highest);
            assert_true(highest >= qdot_ode_taylor_order(&series, theirs, false, more));
        }
        w = qdot_ode_written_begin(&series, 20, highest, 0);
        assert_int_equal(c.most, highest);
        c.most = 0;
        assert_int_equal(qdot_ode_written_first(&w, 1000, &again), QDOT_OK);
        assert_int_equal(c.most, highest);
    }
}

static void
where_it_is_or_cannot_be_nothing_is_asked(void **state)
{
    counts c = {.there = true};
    qdot_ode_series series = series_of(&c);
    qdot_ode_written w = qdot_ode_written_begin(&series, 20, 20, 0);

    (void)state;
    assert_false(w.first);
    assert_int_equal(qdot_ode_written_next(&w, 10, 1e9), QDOT_OK);
    series = (qdot_ode_series){.most = 20};
    w = qdot_ode_written_begin(&series, 20, 20, 0);
    assert_false(w.first);
    assert_int_equal(qdot_ode_written_next(&w, 10, 1e9), QDOT_OK);
    assert_int_equal(c.taken + c.written + c.dropped, 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_lay_there_changes_nothing),
        cmocka_unit_test(later_steps_say_it_too),
        cmocka_unit_test(steps_of_runs_before_count),
        cmocka_unit_test(companions_share_it),
        cmocka_unit_test(what_cannot_be_written_is_not_expanded_again),
        cmocka_unit_test(where_it_is_or_cannot_be_nothing_is_asked),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
