/* Counted work, and companions that cost too much. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "ode/companion.h"
#include "ode/meter.h"
#include "ode/problems.h"

/* A run from 0 to 1 in a hundred steps of that work, ended. */
static void
make_run(qdot_ode_meter *m, double of_step)
{
    *m = (qdot_ode_meter){.beside = NULL};
    qdot_ode_meter_begin(m, 0, 1);
    for (int k = 1; k <= 100; k++)
        assert_int_equal(qdot_ode_meter_add(m, 0.01 * k, of_step), QDOT_OK);
    qdot_ode_meter_end(m);
}

static void
beside(qdot_ode_meter *m, const qdot_ode_meter *run, double allowance)
{
    *m = (qdot_ode_meter){.beside = run, .factor = 1.5, .allowance = allowance,
                           .early_factor = 1.5, .early = allowance};
    qdot_ode_meter_begin(m, 0, 1);
}

static void
what_costs_little_more_arrives(void **state)
{
    qdot_ode_meter run, m;
    double work;

    (void)state;
    make_run(&run, 1e6);
    beside(&m, &run, 1e6);
    for (int k = 1; k <= 100; k++)
        assert_int_equal(qdot_ode_meter_add(&m, 0.01 * k, 1.4e6), QDOT_OK);
    assert_false(m.over);
    assert_false(qdot_ode_meter_exceeds(&m, &work));
    assert_true(fabs(work / 1.4e8 - 1) < 1e-9);
}

static void
work_ends_at_its_limit(void **state)
{
    qdot_ode_meter m = {.most = 3e6};

    (void)state;
    qdot_ode_meter_begin(&m, 0, 1);
    for (int k = 1; k <= 3; k++)
        assert_int_equal(qdot_ode_meter_add(&m, 0.1 * k, 1e6), QDOT_OK);
    assert_int_equal(qdot_ode_meter_add(&m, 0.4, 1e6), QDOT_ELIMIT);
}

/* A run stopped half way: companions may have come far beyond by then, or not, and all is the same. */
static void
what_lies_beyond_the_end_does_not_count(void **state)
{
    qdot_ode_meter run = {.beside = NULL}, m;
    double work;

    (void)state;
    qdot_ode_meter_begin(&run, 0, 1);
    assert_int_equal(qdot_ode_meter_add(&run, 0.5, 1e6), QDOT_OK);
    qdot_ode_meter_end(&run);
    beside(&m, &run, 1e6);
    assert_int_equal(qdot_ode_meter_add(&m, 0.5, 1e6), QDOT_OK);
    assert_int_equal(qdot_ode_meter_add(&m, 0.9, 1e8), QDOT_OK);
    assert_false(m.over || qdot_ode_meter_exceeds(&m, &work));
    beside(&m, &run, 1e6);
    assert_int_equal(qdot_ode_meter_add(&m, 0.5, 1e8), QDOT_ELIMIT);
}

static void
what_goes_nowhere_is_given_up_early(void **state)
{
    qdot_ode_meter run, m;
    double work;
    int k = 0;

    (void)state;
    make_run(&run, 1e6);
    beside(&m, &run, 1e6);
    while (k < 1000 && qdot_ode_meter_add(&m, 1e-4 * k, 1e5) == QDOT_OK)
        k++;
    assert_true(m.over && k < 60); /* of 10,000 steps */
    assert_true(qdot_ode_meter_exceeds(&m, &work));
    assert_true(work <= m.work && m.work < 6e6);
    assert_false(qdot_ode_meter_is_stuck(&m));
}

/* One that has gone on before the run came there is judged by the same marks. */
static void
the_faster_thread_changes_nothing(void **state)
{
    qdot_ode_meter run = {.beside = NULL}, late, early;
    double by_late, by_early;

    (void)state;
    qdot_ode_meter_begin(&run, 0, 1);
    beside(&early, &run, 1e6);
    for (int k = 1; k <= 100; k++)
        assert_int_equal(qdot_ode_meter_add(&early, 0.01 * k, 1e7), QDOT_OK);
    make_run(&run, 1e6);
    beside(&late, &run, 1e6);
    for (int k = 1; k <= 100 && !late.over; k++)
        (void)(qdot_ode_meter_add(&late, 0.01 * k, 1e7) == QDOT_OK);
    assert_true(late.over && !early.over);
    assert_true(qdot_ode_meter_exceeds(&late, &by_late));
    assert_true(qdot_ode_meter_exceeds(&early, &by_early));
    assert_true(by_late == by_early);
}

static void
what_stands_still_is_told(void **state)
{
    qdot_ode_meter run, m;
    qdot_status status = QDOT_OK;

    (void)state;
    make_run(&run, 1e5);
    beside(&m, &run, 1e7);
    for (int k = 1; k <= 30; k++)
        assert_int_equal(qdot_ode_meter_add(&m, 0.01 * k, 1e5), QDOT_OK);
    for (int k = 0; k < 1000 && status == QDOT_OK; k++)
        status = qdot_ode_meter_add(&m, 0.3 + 1e-9 * k, 1e5);
    assert_int_equal(status, QDOT_ELIMIT);
    assert_true(qdot_ode_meter_is_stuck(&m));
}

/* Companions of a run whose work is said to be `work`. */
static qdot_companion_estimate
estimate(double work, double t, bool threaded, double *limit)
{
    const qdot_ode_method *method = qdot_ode_method_find("rk8pd");
    qdot_ode_meter run = {.beside = NULL};
    qdot_ode_options options = {.tol = 1e-9, .meter = &run};
    qdot_companion_request request = {.system = &pendulum.system,
                                      .twin = &pendulum.system,
                                      .method = method,
                                      .tol = 1e-9,
                                      .t1 = t,
                                      .y0 = pendulum.y0,
                                      .meter = &run,
                                      .threaded = threaded};
    double y[4];
    qdot_ode_result r;
    qdot_companion *c;
    qdot_companion_estimate e;

    memcpy(y, pendulum.y0, sizeof y);
    qdot_ode_meter_begin(&run, 0, t);
    if (work > 0)
        assert_int_equal(qdot_ode_meter_add(&run, t, work), QDOT_OK);
    else
        assert_int_equal(qdot_ode_integrate(&pendulum.system, method, &options, 0, t, y, &r),
                         QDOT_OK);
    qdot_ode_meter_end(&run);
    assert_int_equal(qdot_companion_start(&request, &c), QDOT_OK);
    qdot_companion_limit(c, 1000);
    qdot_companion_finish(c, t, y, NULL, &e);
    *limit = QDOT_COMPANION_MOST * run.work + 2 * QDOT_COMPANION_LEAST;
    return e;
}

static void
companions_keep_to_their_bound(void **state)
{
    double limit;

    (void)state;
    for (int threaded = 0; threaded < 2; threaded++) {
        qdot_companion_estimate e = estimate(0, 300, threaded, &limit);

        assert_true(e.known);
        assert_true(e.work > limit / 3 && e.work < limit);
        e = estimate(1e3, 1e6, threaded, &limit);
        assert_true(!e.known && isnan(e.error));
        assert_true(e.work < 1.2 * limit);
        assert_non_null(strstr(e.result.reason, "times the work of this one"));
    }
}

/* The ways beside each kind of method. */
static void
ways_follow_the_method(void **state)
{
    static const struct {
        const char *method, *partner;
        qdot_companion_way ways[QDOT_COMPANION_WAYS];
        int n;
    } rows[] = {
        {"rk8pd", "rk8pd", {QDOT_COMPANION_PARTNER, QDOT_COMPANION_COARSE}, 2},
        {"msbdf", "radau", {QDOT_COMPANION_PARTNER, QDOT_COMPANION_COARSE}, 2},
        /* bsimp goes over what is narrow, and finer runs of it do so too */
        {"bsimp", "radau", {QDOT_COMPANION_PARTNER, QDOT_COMPANION_FINER, QDOT_COMPANION_COARSE}, 3},
        {"radau", "radau", {QDOT_COMPANION_FINER, QDOT_COMPANION_COARSE}, 2},
    };

    (void)state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const qdot_ode_method *method = qdot_ode_method_find(rows[k].method);
        qdot_companion_way way = QDOT_COMPANION_SERIES;
        qdot_companion_plan plan;
        int n = 0;

        for (;; way++, n++) {
            way = qdot_companion_way_from(way, 1, &pendulum.system, method, 1e-6, &plan);
            if (way == QDOT_COMPANION_WAYS)
                break;
            assert_int_equal(way, rows[k].ways[n]);
            assert_true((plan.tol > 1e-6) == (way == QDOT_COMPANION_COARSE));
            assert_ptr_equal(plan.method, way == QDOT_COMPANION_PARTNER
                                              ? qdot_ode_method_find(rows[k].partner)
                                              : method);
        }
        assert_int_equal(n, rows[k].n);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_costs_little_more_arrives),
        cmocka_unit_test(work_ends_at_its_limit),
        cmocka_unit_test(what_lies_beyond_the_end_does_not_count),
        cmocka_unit_test(what_goes_nowhere_is_given_up_early),
        cmocka_unit_test(the_faster_thread_changes_nothing),
        cmocka_unit_test(what_stands_still_is_told),
        cmocka_unit_test(companions_keep_to_their_bound),
        cmocka_unit_test(ways_follow_the_method),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
