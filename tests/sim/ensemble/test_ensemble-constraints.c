/* test_ensemble-constraints.c -- members under constraints against runs of their own. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/ensembles.h"

#include "base/memory.h"
#include "num/kinds.h"

enum { MEMBERS = 11, COMPONENTS = 8 };

static qdot_expr
squared(fixture *f, qdot_expr e)
{
    return qdot_pow_int(f->pool, e, 2);
}

static void
gravity(fixture *f, qdot_expr direction)
{
    must(qdot_scene_gravity(f->scene, direction));
    set(f, "g", "9.81");
}

static qdot_expr
down(fixture *f)
{
    return qdot_neg(f->pool, parameter(f, "g"));
}

/* Particles on rods of lengths l and 1, the first at the origin. */
static void
rods(fixture *f, int n)
{
    static const char *const names[] = {"x", "y", "u", "w"};
    qdot_expr from[2] = {QDOT_ZERO, QDOT_ZERO};

    begin(f);
    for (int i = 0; i < n; i++) {
        const qdot_expr x = coordinate(f, names[2 * i]), y = coordinate(f, names[2 * i + 1]);
        const qdot_expr d = qdot_add(f->pool, squared(f, qdot_sub(f->pool, x, from[0])),
                                     squared(f, qdot_sub(f->pool, y, from[1])));

        must(qdot_scene_particle(f->scene, i ? "b" : "a", QDOT_ONE, pair(f, x, y)));
        must(qdot_scene_constraint(f->scene, i ? "second" : "first", d,
                                   i ? QDOT_ONE : squared(f, parameter(f, "l"))));
        from[0] = x;
        from[1] = y;
    }
    gravity(f, pair(f, QDOT_ZERO, down(f)));
}

/* At angle a of the first rod, and b of the second one. */
static void
rods_start(int n, double l, size_t m, double *y)
{
    const double a = 0.1 * (double)(m + 1), v = 0.5 - 0.1 * (double)m, b = 0.3, w = 0.2;

    y[0] = l * sin(a);
    y[1] = -l * cos(a);
    y[2 * n] = v * l * cos(a);
    y[2 * n + 1] = v * l * sin(a);
    if (n == 1)
        return;
    y[2] = y[0] + sin(b);
    y[3] = y[1] - cos(b);
    y[6] = y[4] + w * cos(b);
    y[7] = y[5] + w * sin(b);
}

static void
rod(fixture *f)
{
    rods(f, 1);
    set(f, "l", "1");
}

static void
rod_start(size_t m, double *y)
{
    rods_start(1, 1, m, y);
}

static void
two_rods(fixture *f)
{
    rods(f, 2);
    set(f, "l", "1");
}

static void
two_rods_start(size_t m, double *y)
{
    rods_start(2, 1, m, y);
}

/* A bead on x = cos z, y = sin z. */
static void
helix(fixture *f)
{
    qdot_expr x, y, z;

    begin(f);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    z = coordinate(f, "z");
    must(qdot_scene_particle(f->scene, "bead", QDOT_ONE,
                             qdot_vector(f->pool, 3, (qdot_expr[]){x, y, z})));
    must(qdot_scene_constraint(f->scene, "c", x, qdot_fun1(f->pool, QDOT_COS, z)));
    must(qdot_scene_constraint(f->scene, "s", y, qdot_fun1(f->pool, QDOT_SIN, z)));
    gravity(f, qdot_vector(f->pool, 3, (qdot_expr[]){QDOT_ZERO, QDOT_ZERO, down(f)}));
}

static void
helix_start(size_t m, double *y)
{
    const double z = 0.2 * (double)m, v = 1 - 0.1 * (double)m;

    y[0] = cos(z);
    y[1] = sin(z);
    y[2] = z;
    y[3] = -v * sin(z);
    y[4] = v * cos(z);
    y[5] = v;
}

/* A skate on a slope, of two particles one behind the other: it does not slip sideways. */
static void
skate(fixture *f)
{
    qdot_expr x, y, a, s, c;

    begin(f);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    a = coordinate(f, "a");
    s = qdot_fun1(f->pool, QDOT_SIN, a);
    c = qdot_fun1(f->pool, QDOT_COS, a);
    must(qdot_scene_particle(f->scene, "blade", QDOT_ONE, pair(f, x, y)));
    must(qdot_scene_particle(f->scene, "front", QDOT_ONE,
                             pair(f, qdot_add(f->pool, x, c), qdot_add(f->pool, y, s))));
    must(qdot_scene_constraint(f->scene, "edge", times(f, velocity(f, x), s),
                               times(f, velocity(f, y), c)));
    gravity(f, pair(f, QDOT_ONE, QDOT_ZERO));
}

static void
skate_start(size_t m, double *y)
{
    const double a = 0.3 + 0.1 * (double)m, v = 0.4 + 0.05 * (double)m;

    y[0] = y[1] = 0;
    y[2] = a;
    y[3] = v * cos(a);
    y[4] = v * sin(a);
    y[5] = 1.5 - 0.2 * (double)m;
}

/* A ring about two rods that does not slip: constraints of both kinds. */
static void
rod_and_wheel(fixture *f)
{
    qdot_expr x, y, a;

    rod(f);
    x = f->scene->coordinates.at[0];
    y = f->scene->coordinates.at[1];
    a = coordinate(f, "a");
    must(qdot_scene_particle(f->scene, "mark", QDOT_ONE,
                             pair(f, qdot_add(f->pool, x, qdot_fun1(f->pool, QDOT_COS, a)), y)));
    must(qdot_scene_constraint(f->scene, "rolls", velocity(f, a),
                               qdot_add(f->pool, QDOT_ONE, times(f, x, velocity(f, y)))));
}

static void
rod_and_wheel_start(size_t m, double *y)
{
    double z[4];

    rods_start(1, 1, m, z);
    y[0] = z[0];
    y[1] = z[1];
    y[2] = 0.4;
    y[3] = z[2];
    y[4] = z[3];
    y[5] = 1 + z[0] * z[3];
}

typedef struct {
    const char *name;
    void (*make)(fixture *f);
    void (*start)(size_t m, double *y);
} scene;

static const scene scenes[] = {
    {"a rod", rod, rod_start},
    {"two rods", two_rods, two_rods_start},
    {"a helix", helix, helix_start},
    {"a skate", skate, skate_start},
    {"a rod and a wheel", rod_and_wheel, rod_and_wheel_start},
};

static void
members_are_runs_of_their_own(void **state)
{
    (void)state;
    for (size_t c = 0; c < sizeof scenes / sizeof *scenes; c++) {
        double start[MEMBERS * COMPONENTS], y[MEMBERS * COMPONENTS], want[COMPONENTS];
        qdot_ensemble_result results[MEMBERS];
        qdot_ensemble *e;
        size_t n;
        fixture f;

        scenes[c].make(&f);
        n = 2 * f.scene->coordinates.n;
        f.request.t1 = qdot_expr_int(f.pool, c % 2 ? 2 : -2);
        f.request.tol = 1e-13;
        for (size_t m = 0; m < MEMBERS; m++)
            scenes[c].start(m, start + n * m);
        memcpy(y, start, sizeof y);
        e = prepare(&f, 0, NULL);
        must(qdot_ensemble_run(e, MEMBERS, y, NULL, true, results));
        for (size_t m = 0; m < MEMBERS; m++) {
            double stated, d;

            if (results[m].reason)
                fail_msg("%s, member %zu: %s", scenes[c].name, m, results[m].reason);
            assert_int_equal(results[m].status, QDOT_RUN_DONE);
            assert_true(results[m].rejected <= 5);
            stated = alone(&f, start + m * n, want);
            d = distance(y + m * n, want, n);
            if (!(d <= 4 * (stated + results[m].error) && d < 1e-11))
                fail_msg("%s, member %zu: %.3g apart, stated %.3g and %.3g", scenes[c].name, m, d,
                         stated, results[m].error);
        }
        qdot_ensemble_free(e);
        end(&f);
    }
}

/* A rod is as long as it was however coarse the steps are, and its end moves across it. */
static void
holds(const double *y, size_t n)
{
    const double *v = y + n;

    if (!(fabs(y[0] * y[0] + y[1] * y[1] - 1) < 2e-15 && fabs(y[0] * v[0] + y[1] * v[1]) < 1e-14))
        fail_msg("off by %.3g, %.3g", y[0] * y[0] + y[1] * y[1] - 1, y[0] * v[0] + y[1] * v[1]);
}

/* What is stated of a coarse run is no less than what separates it from a fine one; in which lane
 * a member runs changes no bit. */
static void
statements_are_honest_and_lanes_alike(void **state)
{
    (void)state;
    for (size_t c = 0; c < sizeof scenes / sizeof *scenes; c++) {
        double y[2][MEMBERS * COMPONENTS], single[COMPONENTS];
        qdot_ensemble_result results[2][MEMBERS], result;
        qdot_ensemble *e[2];
        size_t n;
        fixture f;

        scenes[c].make(&f);
        n = 2 * f.scene->coordinates.n;
        f.request.t1 = qdot_expr_int(f.pool, 2);
        for (int fine = 0; fine < 2; fine++) {
            f.request.tol = fine ? 1e-14 : 1e-6;
            for (size_t m = 0; m < MEMBERS; m++)
                scenes[c].start(m, y[fine] + n * m);
            e[fine] = prepare(&f, 0, NULL);
            must(qdot_ensemble_run(e[fine], MEMBERS, y[fine], NULL, true, results[fine]));
        }
        for (size_t m = 0; m < MEMBERS; m++) {
            const double d = distance(y[0] + n * m, y[1] + n * m, n);

            if (!(d <= results[0][m].error + results[1][m].error && results[0][m].error < 1e-3))
                fail_msg("%s, member %zu: off by %.3g, stated %.3g", scenes[c].name, m, d,
                         results[0][m].error);
            if (c < 2)
                holds(y[0] + n * m, n / 2);
            scenes[c].start(m, single);
            must(qdot_ensemble_run(e[0], 1, single, NULL, false, &result));
            assert_memory_equal(single, y[0] + n * m, n * sizeof *single);
            assert_int_equal(result.steps, results[0][m].steps);
        }
        qdot_ensemble_free(e[0]);
        qdot_ensemble_free(e[1]);
        end(&f);
    }
}

/* The length of the first of two rods, which is a parameter of the constraint, and g. */
static void
parameters_are_each_members_own(void **state)
{
    double parameters[MEMBERS * 2], y[MEMBERS * COMPONENTS], want[COMPONENTS];
    qdot_ensemble_result results[MEMBERS];
    qdot_expr varied[2];
    qdot_ensemble *e;
    fixture f;

    (void)state;
    rods(&f, 2);
    f.request.t1 = qdot_expr_int(f.pool, 2);
    f.request.tol = 1e-13;
    f.request.n_values = 0;
    varied[0] = parameter(&f, "l");
    varied[1] = parameter(&f, "g");
    for (size_t m = 0; m < MEMBERS; m++) {
        parameters[2 * m] = 0.5 + 0.125 * (double)m;
        parameters[2 * m + 1] = 9 + 0.25 * (double)m;
        rods_start(2, parameters[2 * m], m, y + COMPONENTS * m);
    }
    e = prepare(&f, 2, varied);
    must(qdot_ensemble_run(e, MEMBERS, y, parameters, true, results));
    for (size_t m = 0; m < MEMBERS; m++) {
        double start[COMPONENTS], stated, d;

        f.request.n_values = 0;
        for (size_t i = 0; i < 2; i++) {
            char text[32];

            snprintf(text, sizeof text, "%.6f", parameters[2 * m + i]);
            set(&f, i ? "g" : "l", text);
        }
        rods_start(2, parameters[2 * m], m, start);
        if (results[m].reason)
            fail_msg("member %zu: %s", m, results[m].reason);
        stated = alone(&f, start, want);
        d = distance(y + COMPONENTS * m, want, COMPONENTS);
        if (!(d <= 4 * (stated + results[m].error) && d < 1e-11))
            fail_msg("member %zu: %.3g apart, stated %.3g and %.3g", m, d, stated,
                     results[m].error);
    }
    qdot_ensemble_free(e);
    end(&f);
}

static void
told(const qdot_ensemble_result *r, const char *word)
{
    assert_int_equal(r->status, QDOT_RUN_FAILED);
    assert_true(isnan(r->error));
    assert_true(r->t == 0);
    if (!r->reason || !strstr(r->reason, word))
        fail_msg("%s", r->reason ? r->reason : "no reason");
}

/* Members whose starts break a constraint stay where they are, the others run; where a constraint
 * repeats another all are told. */
static void
starts_that_cannot_be_are_told(void **state)
{
    for (int again = 0; again < 2; again++) {
        double y[3 * 4], before[3 * 4];
        qdot_ensemble_result results[3];
        qdot_ensemble *e;
        fixture f;

        (void)state;
        rod(&f);
        if (again)
            must(qdot_scene_constraint(f.scene, "again", f.scene->constraints.at[0].f, QDOT_ZERO));
        for (size_t m = 0; m < 3; m++)
            rod_start(m, y + 4 * m);
        y[4] += 1e-3;
        y[8 + 3] += 1e-3;
        memcpy(before, y, sizeof y);
        e = prepare(&f, 0, NULL);
        must(qdot_ensemble_run(e, 3, y, NULL, true, results));
        if (again)
            told(&results[0], "not independent");
        else
            assert_int_equal(results[0].status, QDOT_RUN_DONE);
        told(&results[1], "the start breaks the constraint first");
        told(&results[2], "the time derivative");
        assert_memory_equal(y + 4, before + 4, 8 * sizeof *y);
        assert_true(again == (y[0] == before[0]));
        qdot_ensemble_free(e);
        end(&f);
    }
}

/* A rod that becomes shorter until it has no length, and turns ever faster. */
static void
a_constraint_that_loses_its_direction_is_told(void **state)
{
    double y[2 * 4] = {1, 0, -1, 0.5, /**/ 0, 1, 0.7, -1}, before[2 * 4];
    qdot_ensemble_result results[2];
    qdot_ensemble *e;
    qdot_expr x, z;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    z = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, pair(&f, x, z)));
    must(qdot_scene_constraint(f.scene, "winch", qdot_add(f.pool, squared(&f, x), squared(&f, z)),
                               squared(&f, qdot_sub(f.pool, QDOT_ONE, QDOT_T))));
    f.request.t1 = qdot_expr_int(f.pool, 2);
    memcpy(before, y, sizeof y);
    e = prepare(&f, 0, NULL);
    must(qdot_ensemble_run(e, 2, y, NULL, true, results));
    for (size_t m = 0; m < 2; m++) {
        assert_int_equal(results[m].status, QDOT_RUN_FAILED);
        assert_non_null(strstr(results[m].reason, "not independent"));
        assert_true(results[m].t > 0.9 && results[m].t <= 1);
        /* angular momentum, on the way */
        assert_true(fabs(y[4 * m] * y[4 * m + 3] - y[4 * m + 1] * y[4 * m + 2]
                         - before[4 * m] * before[4 * m + 3]
                         + before[4 * m + 1] * before[4 * m + 2]) < 1e-6);
    }
    qdot_ensemble_free(e);
    end(&f);
}

static void
every_failed_allocation_is_survived(void **state)
{
    bool done = false;

    (void)state;
    for (int64_t k = 0; !done; k += 1 + k / 16) {
        double y[2 * 6], g[2] = {9, 10};
        qdot_ensemble_result results[2];
        qdot_ensemble *e = NULL;
        qdot_expr varied;
        qdot_status status;
        fixture f;

        rod_and_wheel(&f);
        varied = parameter(&f, "g");
        f.request.n_values = 0;
        set(&f, "l", "1");
        f.request.q0 = f.request.v0 = NULL;
        rod_and_wheel_start(0, y);
        rod_start(1, y + 6); /* breaks them */
        y[10] = y[11] = 0;
        qdot_memory_fail_at(k);
        status = qdot_ensemble_new(f.scene, &f.request, 1, &varied, &e);
        if (status == QDOT_OK)
            status = qdot_ensemble_run(e, 2, y, g, true, results);
        done = went_well(k, status);
        qdot_ensemble_free(e);
        (void)!qdot_pool_check(f.pool);
        end(&f);
    }
}

/* The same by vectors of every kind of processor that this one can be. */
static void
so_it_is_by_every_kind_of_vectors(void **state)
{
    for (size_t kind = 0; kind < 2; kind++) {
        qdot_kind_limit(kind);
        members_are_runs_of_their_own(state);
        statements_are_honest_and_lanes_alike(state);
        parameters_are_each_members_own(state);
    }
    qdot_kind_limit(2);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_are_runs_of_their_own),
        cmocka_unit_test(statements_are_honest_and_lanes_alike),
        cmocka_unit_test(parameters_are_each_members_own),
        cmocka_unit_test(so_it_is_by_every_kind_of_vectors),
        cmocka_unit_test(starts_that_cannot_be_are_told),
        cmocka_unit_test(a_constraint_that_loses_its_direction_is_told),
        cmocka_unit_test(every_failed_allocation_is_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
