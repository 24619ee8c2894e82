/* test_ensemble.c -- members against runs of their own. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/ensembles.h"

#include <stdlib.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "num/kinds.h"

/* More members than lanes, of ends that take different numbers of steps. */
static void
members_are_runs_of_their_own(void **state)
{
    static const int links[] = {1, 2, 5}; /* five: by the residual */

    (void)state;
    for (size_t c = 0; c < sizeof links / sizeof *links; c++)
        for (int back = 0; back < 2; back++) {
            enum { MEMBERS = 11 };
            double start[MEMBERS * 10], y[MEMBERS * 10], want[10];
            qdot_ensemble_result results[MEMBERS];
            size_t n;
            qdot_ensemble *e;
            fixture f;

            chain(&f, links[c]);
            n = 2 * f.scene->coordinates.n;
            f.request.t1 = qdot_expr_int(f.pool, back ? -2 : 3);
            f.request.tol = 1e-13;
            for (size_t m = 0; m < MEMBERS; m++)
                for (size_t i = 0; i < n; i++)
                    start[m * n + i] = i < n / 2 ? 0.1 + 0.12 * (double)m
                                                 : 0.3 - 0.07 * (double)(m + i);
            memcpy(y, start, sizeof y);
            e = prepare(&f, 0, NULL);
            must(qdot_ensemble_run(e, MEMBERS, y, NULL, true, results));
            for (size_t m = 0; m < MEMBERS; m++) {
                double stated = alone(&f, start + m * n, want), d;

                assert_int_equal(results[m].status, QDOT_RUN_DONE);
                assert_null(results[m].reason);
                assert_true(results[m].t == (back ? -2 : 3));
                assert_true(results[m].steps >= 4 && results[m].steps <= 200);
                assert_true(results[m].rejected <= 5);
                d = distance(y + m * n, want, n);
                if (!(d <= 4 * (stated + results[m].error) && d < 1e-11))
                    fail_msg("%d links, member %zu: %.3g apart, stated %.3g and %.3g",
                             links[c], m, d, stated, results[m].error);
            }
            qdot_ensemble_free(e);
            end(&f);
        }
}

/* In which lane and beside whom a member runs is nothing to it. */
static void
companions_in_other_lanes_change_no_bit(void **state)
{
    enum { MEMBERS = 19 };
    double start[MEMBERS * 4], y[MEMBERS * 4], single[4];
    qdot_ensemble_result results[MEMBERS], result;
    qdot_ensemble *e;
    fixture f;

    (void)state;
    chain(&f, 2);
    f.request.t1 = qdot_expr_int(f.pool, 4);
    for (size_t i = 0; i < MEMBERS * 4; i++)
        start[i] = i % 4 < 2 ? 0.2 + 0.13 * (double)(i / 4) : 0;
    memcpy(y, start, sizeof y);
    e = prepare(&f, 0, NULL);
    must(qdot_ensemble_run(e, MEMBERS, y, NULL, false, results));
    for (size_t m = 0; m < MEMBERS; m++) {
        memcpy(single, start + 4 * m, sizeof single);
        must(qdot_ensemble_run(e, 1, single, NULL, false, &result));
        assert_memory_equal(single, y + 4 * m, sizeof single);
        assert_int_equal(result.steps, results[m].steps);
        assert_true(isnan(result.error));
    }
    must(qdot_ensemble_run(e, 0, single, NULL, true, &result));
    qdot_ensemble_free(e);
    end(&f);
}

/* A driven pendulum, m l^2 q'' = -m g l sin q + A cos(w t): l, A and w of each member. */
static void
parameters_are_each_members_own(void **state)
{
    enum { MEMBERS = 10 };
    static const char *const names[] = {"l", "A", "w"};
    qdot_expr q, varied[3], force;
    double parameters[MEMBERS * 3], y[MEMBERS * 2], want[2];
    qdot_ensemble_result results[MEMBERS];
    qdot_ensemble *e;
    fixture f;

    (void)state;
    chain(&f, 1);
    q = f.scene->coordinates.at[0];
    force = qdot_mul(f.pool, parameter(&f, "w"), QDOT_T);
    force = qdot_fun1(f.pool, QDOT_COS, force);
    must(qdot_scene_torque(
        f.scene, &(qdot_torque){.coordinate = q,
                                .torque = times(&f, parameter(&f, "A"), force)}));
    f.request.t1 = qdot_expr_int(f.pool, 5);
    f.request.tol = 1e-13;
    f.request.n_values = 0;
    set(&f, "m", "1");
    set(&f, "g", "9.81");
    for (int i = 0; i < 3; i++)
        varied[i] = parameter(&f, names[i]);
    for (size_t m = 0; m < MEMBERS; m++) {
        parameters[3 * m] = 0.5 + 0.125 * (double)m;
        parameters[3 * m + 1] = 0.25 * (double)m;
        parameters[3 * m + 2] = 2 - 0.125 * (double)m;
        y[2 * m] = 0.5;
        y[2 * m + 1] = -0.25;
    }
    e = prepare(&f, 3, varied);
    must(qdot_ensemble_run(e, MEMBERS, y, parameters, true, results));
    for (size_t m = 0; m < MEMBERS; m++) {
        const double start[2] = {0.5, -0.25};
        double stated, d;

        f.request.n_values = 2;
        for (size_t i = 0; i < 3; i++) {
            char text[32];

            snprintf(text, sizeof text, "%.6f", parameters[3 * m + i]);
            set(&f, names[i], text);
        }
        stated = alone(&f, start, want);
        d = distance(y + 2 * m, want, 2);
        if (!(d <= 4 * (stated + results[m].error) && d < 1e-11))
            fail_msg("member %zu: %.3g apart, stated %.3g and %.3g", m, d, stated,
                     results[m].error);
    }
    qdot_ensemble_free(e);
    end(&f);
}

/* Fall into a centre that attracts with 1/r^2, beside members that go round it. */
static void
a_member_that_fails_harms_no_other(void **state)
{
    enum { MEMBERS = 9 };
    double y[MEMBERS * 4], before[MEMBERS * 4], want[4];
    qdot_ensemble_result results[MEMBERS];
    qdot_expr x, z, r;
    qdot_ensemble *e;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    z = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, z)));
    r = qdot_sqrt(f.pool, qdot_add(f.pool, qdot_pow_int(f.pool, x, 2),
                                   qdot_pow_int(f.pool, z, 2)));
    must(qdot_scene_potential(f.scene,
                              qdot_neg(f.pool, qdot_div(f.pool, QDOT_ONE, r))));
    f.request.t1 = qdot_expr_int(f.pool, 3);
    for (size_t m = 0; m < MEMBERS; m++) {
        y[4 * m] = 1;
        y[4 * m + 1] = y[4 * m + 2] = 0;
        y[4 * m + 3] = m == 2 ? 0 : 0.8 + 0.05 * (double)m;
    }
    y[4 * 5] = y[4 * 5 + 1] = 0; /* starts in the centre */
    memcpy(before, y, sizeof y);
    e = prepare(&f, 0, NULL);
    must(qdot_ensemble_run(e, MEMBERS, y, NULL, true, results));
    for (size_t m = 0; m < MEMBERS; m++) {
        if (m != 2 && m != 5) {
            assert_int_equal(results[m].status, QDOT_RUN_DONE);
            alone(&f, before + 4 * m, want);
            assert_true(distance(y + 4 * m, want, 4) < 1e-10);
            continue;
        }
        assert_int_equal(results[m].status, QDOT_RUN_FAILED);
        assert_non_null(results[m].reason);
        assert_true(isnan(results[m].error));
        for (int i = 0; i < 4; i++)
            assert_true(isfinite(y[4 * m + (size_t)i]));
    }
    assert_true(results[5].t == 0);
    /* pi/(2 sqrt 2), the time of the fall */
    assert_true(fabs(results[2].t - M_PI / sqrt(8)) < 1e-6);
    qdot_ensemble_free(e);
    end(&f);
}

/* Series that end: free fall, rest; one that vanishes in five of six orders. */
static void
series_that_end_are_followed(void **state)
{
    double y[3 * 4] = {0, 0, 1, 2, /**/ 0, 0, 0, 0, /**/ 0.5, 1, 0.3, -1};
    qdot_ensemble_result results[3];
    qdot_expr x, z, V;
    qdot_ensemble *e;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    z = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, z)));
    V = qdot_mul(f.pool, qdot_expr_ratio(f.pool, 1, 6), qdot_pow_int(f.pool, x, 6));
    must(qdot_scene_potential(f.scene, qdot_add(f.pool, V, z)));
    f.request.t1 = qdot_expr_int(f.pool, 2);
    e = prepare(&f, 0, NULL);
    must(qdot_ensemble_run(e, 3, y, NULL, true, results));
    for (int m = 0; m < 3; m++) {
        const double y0[] = {0, 0, 1}, v0[] = {2, 0, -1};

        assert_int_equal(results[m].status, QDOT_RUN_DONE);
        assert_true(fabs(y[4 * m + 1] - (y0[m] + 2 * v0[m] - 2)) < 1e-14);
        assert_true(fabs(y[4 * m + 3] - (v0[m] - 2)) < 1e-14);
    }
    /* from x = 0, x' = 1: energy, and the value that an own run has */
    assert_true(fabs(y[2] * y[2] / 2 + pow(y[0], 6) / 6 - 0.5) < 1e-13);
    assert_true(y[4] == 0 && y[6] == 0);
    {
        double want[4];

        alone(&f, (double[]){0, 0, 1, 2}, want);
        assert_true(distance(y, want, 4) < 1e-12);
    }
    qdot_ensemble_free(e);
    end(&f);
}

/* A particle about a centre, its angle before or behind its distance. */
static void
centre(fixture *f, bool angle_first)
{
    qdot_expr q[2], r, theta;

    q[0] = coordinate(f, "c[1]");
    q[1] = coordinate(f, "c[2]");
    r = q[angle_first];
    theta = q[!angle_first];
    must(qdot_scene_particle(
        f->scene, "p", QDOT_ONE,
        pair(f, times(f, r, qdot_fun1(f->pool, QDOT_COS, theta)),
             times(f, r, qdot_fun1(f->pool, QDOT_SIN, theta)))));
    must(qdot_scene_potential(f->scene, qdot_neg(f->pool, qdot_pow_int(f->pool, r, -1))));
}

/* Two links in a field of their own, V = -2 cos a - cos b. */
static void
two_links(fixture *f)
{
    qdot_expr at = QDOT_ZERO, height = QDOT_ZERO;

    for (int i = 0; i < 2; i++) {
        const qdot_expr q = coordinate(f, i == 0 ? "a" : "b");
        const qdot_expr cosine = qdot_fun1(f->pool, QDOT_COS, q);

        at = qdot_add(f->pool, at, qdot_fun1(f->pool, QDOT_SIN, q));
        height = qdot_sub(f->pool, height, cosine);
        must(qdot_scene_particle(f->scene, i == 0 ? "u" : "w", QDOT_ONE,
                                 pair(f, at, height)));
        must(qdot_scene_potential(f->scene, height));
    }
}

/* Orbits, alone and beside two links, whose M is solved for: the momentum r^2 theta' is
 * as it was however coarse the steps are, and the members are runs of their own. */
static void
momenta_of_cyclic_angles_are_kept(void **state)
{
    (void)state;
    for (int scene = 0; scene < 4; scene++)
        for (int fine = 0; fine < 2; fine++) {
            enum { MEMBERS = 11 };
            const size_t links = scene < 2 ? 0 : 2, first = scene % 2, n = links + 2;
            const size_t r = links + first, theta = links + !first;
            double start[MEMBERS * 8], y[MEMBERS * 8], want[8];
            qdot_ensemble_result results[MEMBERS];
            qdot_ensemble *e;
            fixture f;

            begin(&f);
            if (links > 0)
                two_links(&f);
            centre(&f, first);
            f.request.t1 = qdot_expr_int(f.pool, 3);
            f.request.tol = fine ? 1e-13 : 1e-4;
            for (size_t m = 0; m < MEMBERS; m++) {
                double *s = start + 2 * n * m;

                memset(s, 0, 2 * n * sizeof *s);
                for (size_t i = 0; i < links; i++)
                    s[i] = 0.3 + 0.05 * (double)m;
                s[r] = 0.7 + 0.03 * (double)m;
                s[n + r] = 0.1;
                s[n + theta] = m == 7 ? 0 : (m % 2 ? -1 : 1) * (1.1 - 0.04 * (double)m);
            }
            start[2 * n * 7 + n + r] = 3; /* away from the centre for good */
            memcpy(y, start, sizeof y);
            e = prepare(&f, 0, NULL);
            must(qdot_ensemble_run(e, MEMBERS, y, NULL, true, results));
            for (size_t m = 0; m < MEMBERS; m++) {
                const double *s = start + 2 * n * m, *z = y + 2 * n * m;
                const double p = s[r] * s[r] * s[n + theta];
                double d, stated;

                assert_int_equal(results[m].status, QDOT_RUN_DONE);
                if (fabs(z[r] * z[r] * z[n + theta] - p) > 1e-15 * fabs(p))
                    fail_msg("scene %d, member %zu: %.17g for %.17g", scene, m,
                             z[r] * z[r] * z[n + theta], p);
                if (!fine)
                    continue;
                stated = alone(&f, s, want);
                d = distance(z, want, 2 * n);
                if (!(d <= 4 * (stated + results[m].error) && d < 1e-11))
                    fail_msg("scene %d, member %zu: %.3g apart, stated %.3g and %.3g", scene,
                             m, d, stated, results[m].error);
            }
            qdot_ensemble_free(e);
            end(&f);
        }
}

/* L = (x'^2 + z'^2/x - x^2)/2: p_z = z'/x is undefined where x = 0, and a member that starts
 * there stays as it was. A momentum that was found is no velocity of a member that fails. */
static void
members_without_momenta_go_nowhere(void **state)
{
    enum { MEMBERS = 3 };
    double y[MEMBERS * 4] = {1, 0, 0.1, 0.5, /**/ 0, 0, 0.1, 0.5, /**/ 2, 0, -9, 0};
    qdot_ensemble_result results[MEMBERS];
    qdot_expr x, z, L;
    qdot_ensemble *e;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    z = coordinate(&f, "z");
    L = qdot_div(f.pool, qdot_pow_int(f.pool, velocity(&f, z), 2), x);
    L = qdot_add(f.pool, L, qdot_pow_int(f.pool, velocity(&f, x), 2));
    L = qdot_sub(f.pool, L, qdot_pow_int(f.pool, x, 2));
    must(qdot_scene_lagrangian(f.scene, times(&f, QDOT_HALF, L)));
    f.request.t1 = qdot_expr_ratio(f.pool, 1, 2);
    e = prepare(&f, 0, NULL);
    must(qdot_ensemble_run(e, MEMBERS, y, NULL, true, results));
    assert_int_equal(results[0].status, QDOT_RUN_DONE);
    assert_true(fabs(y[3] - 0.5 * y[0]) < 1e-15);
    assert_int_equal(results[1].status, QDOT_RUN_FAILED);
    assert_true(results[1].t == 0);
    assert_true(y[4] == 0 && y[5] == 0 && y[6] == 0.1 && y[7] == 0.5);
    assert_int_equal(results[2].status, QDOT_RUN_DONE);
    qdot_ensemble_free(e);
    end(&f);
}

static void
refused(fixture *f, size_t n, const qdot_expr *varied, qdot_status status,
        const char *word)
{
    qdot_ensemble *e;

    assert_int_equal(qdot_ensemble_new(f->scene, &f->request, n, varied, &e), status);
    assert_null(e);
    if (!strstr(qdot_last_error()->message, word))
        fail_msg("%s", qdot_last_error()->message);
    (void)!qdot_pool_check(f->pool);
}

static void
what_cannot_be_is_refused(void **state)
{
    double y[2] = {0.1, NAN};
    qdot_ensemble_result result;
    qdot_ensemble *e;
    qdot_expr l;
    fixture f;

    (void)state;
    chain(&f, 1);
    l = parameter(&f, "l");
    refused(&f, 0, NULL, QDOT_EINVAL, "own starts");
    f.request.q0 = f.request.v0 = NULL;
    refused(&f, 1, &l, QDOT_EINVAL, "l is given");
    f.request.method = "dop853";
    refused(&f, 0, NULL, QDOT_EINVAL, "dop853");
    f.request.method = "taylor";
    refused(&f, 2, (qdot_expr[]){parameter(&f, "k"), parameter(&f, "k")}, QDOT_EINVAL,
            "k is given twice");
    f.request.n_values = 2; /* no g */
    refused(&f, 0, NULL, QDOT_EUNSET, "g has no value");
    f.request.n_values = 3;
    e = prepare(&f, 0, NULL);
    assert_int_equal(qdot_ensemble_run(e, 1, y, NULL, false, &result), QDOT_EINVAL);
    qdot_ensemble_free(e);
    must(qdot_scene_event(f.scene, &(qdot_event){.name = (char *)"stopper",
                                                 .left = f.scene->coordinates.at[0],
                                                 .right = QDOT_ZERO,
                                                 .stop = true}));
    refused(&f, 0, NULL, QDOT_ENOTBUILT, "the event stopper");
    must(qdot_scene_remove(f.scene, "stopper"));
    must(qdot_scene_constraint(f.scene, "pin", f.scene->coordinates.at[0], QDOT_ZERO));
    f.request.treatment = QDOT_RUN_BAUMGARTE;
    refused(&f, 0, NULL, QDOT_ENOTBUILT, "constraints by another treatment");
    end(&f);
}

static void
survives(bool cyclic)
{
    bool done = false;

    for (int64_t k = 0; !done; k += 1 + k / 16) {
        double y[3 * 4] = {0.1, 0.2, 0, 0, 0.3, 0.4, 0, 0, 0.5, 0.6, 0, 0};
        qdot_ensemble_result results[3];
        qdot_ensemble *e = NULL;
        qdot_status status;
        fixture f;

        if (cyclic) {
            begin(&f);
            centre(&f, false);
        } else {
            chain(&f, 2);
        }
        f.request.q0 = f.request.v0 = NULL;
        qdot_memory_fail_at(k);
        status = qdot_ensemble_new(f.scene, &f.request, 0, NULL, &e);
        if (status == QDOT_OK)
            status = qdot_ensemble_run(e, 3, y, NULL, true, results);
        done = went_well(k, status);
        qdot_ensemble_free(e);
        (void)!qdot_pool_check(f.pool);
        end(&f);
    }
}

static void
every_failed_allocation_is_survived(void **state)
{
    (void)state;
    survives(false);
    survives(true);
}

/* The same by vectors of every kind of processor that this one can be. */
static void
so_it_is_by_every_kind_of_vectors(void **state)
{
    for (size_t kind = 0; kind < 2; kind++) {
        qdot_kind_limit(kind);
        members_are_runs_of_their_own(state);
        companions_in_other_lanes_change_no_bit(state);
        parameters_are_each_members_own(state);
        a_member_that_fails_harms_no_other(state);
        series_that_end_are_followed(state);
        momenta_of_cyclic_angles_are_kept(state);
    }
    qdot_kind_limit(2);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_are_runs_of_their_own),
        cmocka_unit_test(companions_in_other_lanes_change_no_bit),
        cmocka_unit_test(parameters_are_each_members_own),
        cmocka_unit_test(a_member_that_fails_harms_no_other),
        cmocka_unit_test(series_that_end_are_followed),
        cmocka_unit_test(momenta_of_cyclic_angles_are_kept),
        cmocka_unit_test(members_without_momenta_go_nowhere),
        cmocka_unit_test(so_it_is_by_every_kind_of_vectors),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(every_failed_allocation_is_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
