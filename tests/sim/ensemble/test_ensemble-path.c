/* test_ensemble-path.c -- the way of a member against that of a run of its own. */
#include "expr/exact.h"
#include "expr/symbol.h"
#include "sim/ensembles.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "sim/ensemble/path.h"

enum { MEMBERS = 9, MOST_STEPS = 100000 };

static const qdot_ensemble_watching kept = {.keep = true};

/* A double pendulum to t = 4 from rest; the last member starts at the lower place at rest. */
static void
starts(double *y)
{
    for (size_t i = 0; i < MEMBERS * 4; i++)
        y[i] = i % 4 < 2 && i / 4 + 1 < MEMBERS ? 0.2 + 0.23 * (double)(i / 4) + 0.1 * (double)(i % 4) : 0;
}

static qdot_run *
make_path(fixture *f, uint64_t most_steps, qdot_ensemble **e)
{
    qdot_run *r = NULL;

    chain(f, 2);
    f->request.t1 = qdot_expr_int(f->pool, 4);
    f->request.tol = 1e-12;
    *e = prepare(f, 0, NULL);
    must(qdot_ensemble_follow(*e, &kept, most_steps));
    must(qdot_ensemble_path_new(&(qdot_ensemble_path_of){*e, f->scene, &f->request, 0, NULL}, &r));
    return r;
}

/* Values between the steps and the largest velocity, each within both stated errors. */
static void
a_member_is_read_as_a_run(void **state)
{
    double y[MEMBERS * 4], from[MEMBERS * 4], t[5] = {0, 0.7, 2.385, 3.99, 4};
    qdot_ensemble_result results[MEMBERS];
    qdot_expr e[3];
    qdot_ensemble *ensemble;
    qdot_run *way;
    fixture f;

    (void)state;
    way = make_path(&f, MOST_STEPS, &ensemble);
    e[0] = f.scene->coordinates.at[0];
    e[1] = qdot_symbol_jet(f.pool, f.scene->coordinates.at[1], 1);
    e[2] = qdot_symbol_jet(f.pool, f.scene->coordinates.at[1], 2);
    starts(from);
    memcpy(y, from, sizeof y);
    must(qdot_ensemble_run(ensemble, MEMBERS, y, NULL, true, results));
    for (size_t m = 0; m < MEMBERS; m++) {
        double is[15], off[15], want[15], own[15], most[2][2];
        qdot_run *alone;
        bool there;

        must(qdot_ensemble_path_take(ensemble, m, way, &there));
        assert_true(there);
        for (size_t i = 0; i < 4; i++)
            *(i < 2 ? &f.q0[i] : &f.v0[i - 2]) = qdot_expr_of_double(f.pool, from[4 * m + i]);
        f.request.q0 = f.q0;
        f.request.v0 = f.v0;
        f.request.method = "taylor";
        alone = run(&f);
        must(qdot_run_values(way, 3, e, 5, t, is, off));
        must(qdot_run_values(alone, 3, e, 5, t, want, own));
        for (size_t i = 0; i < 15; i++)
            if (!(fabs(is[i] - want[i]) <= 4 * (off[i] + own[i]) + 1e-15 && off[i] < 1e-9))
                fail_msg("member %zu, %zu: %.17g for %.17g, stated %.3g and %.3g", m, i, is[i], want[i], off[i], own[i]);
        for (size_t k = 0; k < 2; k++)
            must(qdot_run_range(k == 0 ? way : alone, QDOT_RANGE_MAX, e[1], 0.5, 3.5, &most[k][0],
                                &most[k][1]));
        assert_true(fabs(most[0][0] - most[1][0]) <= 4 * (most[0][1] + most[1][1]) + 1e-15);
        f.request.q0 = f.request.v0 = NULL;
        qdot_run_free(alone);
    }
    qdot_run_free(way);
    qdot_ensemble_free(ensemble);
    end(&f);
}

/* Of whom a step was refused, too many of them, there is no way to read. */
static void
a_member_that_is_left_has_no_way(void **state)
{
    double y[MEMBERS * 4];
    qdot_ensemble_result results[MEMBERS];
    qdot_ensemble *ensemble;
    qdot_run *way;
    size_t gone = 0;
    fixture f;

    (void)state;
    way = make_path(&f, 3, &ensemble);
    starts(y);
    must(qdot_ensemble_run(ensemble, MEMBERS, y, NULL, true, results));
    for (size_t m = 0; m < MEMBERS; m++) {
        bool there;

        must(qdot_ensemble_path_take(ensemble, m, way, &there));
        assert_int_equal(there, !qdot_ensemble_left(ensemble, m) && results[m].status == QDOT_RUN_DONE);
        gone += !there;
    }
    assert_true(gone > 0);
    qdot_run_free(way);
    qdot_ensemble_free(ensemble);
    end(&f);
}

static void
lives_on_without_memory(void **state)
{
    (void)state;
    for (int64_t k = 0;; k++) {
        double y[MEMBERS * 4];
        qdot_ensemble_result results[MEMBERS];
        qdot_ensemble *ensemble;
        qdot_run *way;
        bool there = false;
        qdot_status status;
        fixture f;

        way = make_path(&f, MOST_STEPS, &ensemble);
        starts(y);
        must(qdot_ensemble_run(ensemble, MEMBERS, y, NULL, true, results));
        qdot_run_free(way);
        way = NULL;
        qdot_memory_fail_at(k);
        status = qdot_ensemble_path_new(&(qdot_ensemble_path_of){ensemble, f.scene, &f.request, 0, NULL}, &way);
        if (status == QDOT_OK)
            status = qdot_ensemble_path_take(ensemble, 1, way, &there);
        status = went_well(k, status) ? QDOT_OK : QDOT_ENOMEM;
        assert_true(status != QDOT_OK || there);
        qdot_run_free(way);
        qdot_ensemble_free(ensemble);
        end(&f);
        if (status == QDOT_OK)
            break;
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_member_is_read_as_a_run),
        cmocka_unit_test(a_member_that_is_left_has_no_way),
        cmocka_unit_test(lives_on_without_memory),
    };

    return cmocka_run_group_tests_name("ensemble path", tests, NULL, NULL);
}
