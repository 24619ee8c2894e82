/* test_far.c -- runs far from t = 0 against the same ones from 0 on: a ball comes to rest on a table, also where the
 * pull changes with time; what is asked and told is in t, the scene stays as it is declared. */
#include "expr/build.h"
#include "expr/exact.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

static const char *const starts[] = {"0", "1000000", "100000000", "1000000000", "-1000000000"};
enum { STARTS = sizeof starts / sizeof *starts, BOUNCES = 4 };

/* What a run from t0 on tells, times less t0. */
typedef struct {
    double height, error, most, mean, bounces[BOUNCES], first;
    qdot_run_status status;
} told;

/* A ball falls from 1 on a table and bounces with 4/5 of its speed, under the pull 10 + change (t - t0); the run is of
 * length 12, at one time is the ball asked for. */
static void
watch_ball(const char *start, const char *change, double at, told *of)
{
    qdot_event floor = {.name = (char *)"floor", .right = QDOT_ZERO, .way = -1};
    const qdot_run_occurrence *list;
    qdot_expr t0, y, v, sum, pull;
    qdot_run *r = NULL;
    uint64_t version;
    fixture f;
    double t, from;
    size_t n;

    begin(&f);
    t0 = number(&f, start);
    from = atof(start);
    y = coordinate(&f, "y");
    v = velocity(&f, y);
    must(qdot_scene_particle(f.scene, "ball", QDOT_ONE, y));
    pull = qdot_add(f.pool, qdot_expr_int(f.pool, 10),
                    times(&f, number(&f, change), qdot_sub(f.pool, QDOT_T, t0)));
    must(qdot_scene_torque(f.scene, &(qdot_torque){.coordinate = y, .torque = qdot_neg(f.pool, pull)}));
    floor.left = y;
    must(qdot_vec_push(&floor.targets, v));
    must(qdot_vec_push(&floor.values, times(&f, number(&f, "-0.8"), v)));
    must(qdot_scene_event(f.scene, &floor));
    qdot_free(floor.targets.at);
    qdot_free(floor.values.at);
    f.q0[0] = QDOT_ONE;
    f.request.t0 = t0;
    f.request.t1 = qdot_add(f.pool, t0, qdot_expr_int(f.pool, 12));
    version = f.scene->version;
    must(qdot_run_new(f.scene, &f.request, &r));
    assert_true(f.scene->version == version && f.scene->torques.at[0].torque == qdot_neg(f.pool, pull));
    of->status = qdot_run_get_report(r)->status;
    assert_true(qdot_run_get_report(r)->t0 == from && qdot_run_get_report(r)->t1 == from + 12);
    of->first = qdot_run_times(r, &n)[0] - from;
    t = from + at;
    must(qdot_run_values(r, 1, &y, 1, &t, &of->height, &of->error));
    sum = qdot_add(f.pool, y, qdot_sub(f.pool, QDOT_T, t0));
    must(qdot_run_range(r, QDOT_RANGE_MAX, sum, from, from + at, &of->most, &t));
    must(qdot_run_range(r, QDOT_RANGE_MEAN, y, from + 12, from, &of->mean, &t));
    must(qdot_run_occurrences(r, &list, &n));
    assert_true(n > BOUNCES);
    for (int i = 0; i < BOUNCES; i++) {
        of->bounces[i] = list[i].t - from;
        assert_true(list[i].error >= 0x1p-53 * fabs(list[i].t) && list[i].error <= 0x1p-50 * fabs(from) + 1e-9);
        /* behind the bounce at its own time, however rounded */
        must(qdot_run_values(r, 1, &v, 1, &list[i].t, &t, NULL));
        assert_true(t > 0);
    }
    qdot_run_free(r);
    end(&f);
}

static void
far_runs_are_those_near_zero(void **state)
{
    static const char *const changes[] = {"0", "0.25"};

    (void)state;
    for (int c = 0; c < 2; c++)
        for (double at = 0.5; at < 12; at += 1.25) {
            told near, far;

            watch_ball(starts[0], changes[c], at, &near);
            assert_int_equal(near.status, QDOT_RUN_DONE);
            for (int k = 1; k < STARTS; k++) {
                watch_ball(starts[k], changes[c], at, &far);
                assert_int_equal(far.status, QDOT_RUN_DONE);
                assert_true(far.first == 0);
                if (!(fabs(far.height - near.height) <= far.error + near.error)
                    || !(fabs(far.most - near.most) <= 1e-14 * (1 + at)) || !(fabs(far.mean - near.mean) <= 1e-14))
                    fail_msg("from %s at %g: %.17g +- %g, %.17g, %.17g; from 0: %.17g +- %g, %.17g, %.17g", starts[k],
                             at, far.height, far.error, far.most, far.mean, near.height, near.error, near.most,
                             near.mean);
                for (int i = 0; i < BOUNCES; i++)
                    assert_true(fabs(far.bounces[i] - near.bounces[i]) <= 0x1p-52 * fabs(atof(starts[k])));
            }
        }
}

static void
texts_tell_the_time(void **state)
{
    qdot_error before;
    fixture f;
    qdot_run *r;
    qdot_expr q;
    double t = 1e9 + 2, value;

    (void)state;
    pendulum(&f);
    q = f.scene->coordinates.at[0];
    f.request.t0 = number(&f, "1000000000");
    f.request.t1 = number(&f, "1000000001");
    r = run(&f);
    assert_int_equal(qdot_run_values(r, 1, &q, 1, &t, &value, NULL), QDOT_EDOMAIN);
    before = *qdot_last_error();
    assert_string_equal(before.message, "t = 1000000002 is outside the run, which covers 1000000000 to 1000000001");
    t = 1e9;
    must(qdot_run_values(r, 1, &q, 1, &t, &value, NULL));
    qdot_run_free(r);
    end(&f);
}

static void
is_put_back_after_failed_allocations(void **state)
{
    fixture f;

    (void)state;
    pendulum(&f);
    must(qdot_scene_torque(f.scene, &(qdot_torque){.coordinate = f.scene->coordinates.at[0], .torque = QDOT_T}));
    f.request.t0 = number(&f, "1000000000");
    f.request.t1 = number(&f, "1000000001");
    survives_failed_allocations(&f);
    assert_true(f.scene->torques.at[0].torque == QDOT_T);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(far_runs_are_those_near_zero),
        cmocka_unit_test(texts_tell_the_time),
        cmocka_unit_test(is_put_back_after_failed_allocations),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
