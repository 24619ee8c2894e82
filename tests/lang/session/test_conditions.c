/* test_conditions.c -- conditions of runs compared, and the studies kept under them. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "lang/session/conditions.h"
#include "mech/scene/scene.h"

enum { PARAMETER = 11, VALUE, START, RATE, FROM, TO, OTHER };

/* Of one coordinate and one parameter; the items are numbers here, nobody looks inside. */
static const qdot_expr symbol[] = {PARAMETER}, value[] = {VALUE}, q0[] = {START},
                       v0[] = {RATE};

static qdot_run_request
request(void)
{
    return (qdot_run_request){.n_values = 1,
                              .symbols = symbol,
                              .values = value,
                              .q0 = q0,
                              .v0 = v0,
                              .t0 = FROM,
                              .t1 = TO,
                              .tol = 1e-6,
                              .method = "dop853"};
}

typedef struct {
    qdot_pool *pool;
    qdot_scene *scene;
} scene;

static scene
begin(void)
{
    scene s = {.pool = qdot_pool_new()};

    s.scene = qdot_scene_new(s.pool);
    assert_non_null(s.scene);
    assert_int_equal(qdot_vec_push(&s.scene->coordinates, START), QDOT_OK);
    return s;
}

static void
end(scene *s)
{
    qdot_scene_free(s->scene);
    qdot_pool_free(s->pool);
}

static qdot_conditions
take(const scene *s, const qdot_run_request *r)
{
    qdot_conditions c = {0};

    assert_int_equal(qdot_conditions_take(s->scene, r, &c), QDOT_OK);
    return c;
}

/* Whether a request under the conditions of r, changed by `change`, is told from r. */
static void
differs(void (*change)(scene *, qdot_run_request *))
{
    scene s = begin();
    qdot_run_request r = request();
    qdot_conditions a = take(&s, &r), b;

    change(&s, &r);
    b = take(&s, &r);
    assert_false(qdot_conditions_same(&a, &b));
    qdot_conditions_clear(&a);
    qdot_conditions_clear(&b);
    end(&s);
}

static const qdot_expr other[] = {OTHER};
static const bool none[] = {false};

static void
later_end(scene *s, qdot_run_request *r)
{
    (void)s;
    r->t1 = OTHER;
}

static void
other_value(scene *s, qdot_run_request *r)
{
    (void)s;
    r->values = other;
}

static void
no_value(scene *s, qdot_run_request *r)
{
    (void)s;
    r->n_values = 0;
}

static void
other_start(scene *s, qdot_run_request *r)
{
    (void)s;
    r->v0 = other;
}

static void
start_not_named(scene *s, qdot_run_request *r)
{
    (void)s;
    r->q_named = none;
}

static void
changed_scene(scene *s, qdot_run_request *r)
{
    (void)r;
    s->scene->version++;
}

static void
what_changes_the_motion_counts(void **state)
{
    (void)state;
    differs(later_end);
    differs(other_value);
    differs(no_value);
    differs(other_start);
    differs(start_not_named);
    differs(changed_scene);
}

static void
method_and_tolerance_do_not_count(void **state)
{
    scene s = begin();
    qdot_run_request r = request();
    qdot_conditions a = take(&s, &r), b;

    (void)state;
    r.method = "taylor";
    r.tol = 1e-12;
    b = take(&s, &r);
    assert_true(qdot_conditions_same(&a, &b));
    qdot_conditions_clear(&a);
    qdot_conditions_clear(&b);
    end(&s);
}

static void
request_gives_them_back(void **state)
{
    scene s = begin();
    const qdot_run_request r = request();
    qdot_conditions a = take(&s, &r), b;
    const qdot_run_request again = qdot_conditions_request(&a);

    (void)state;
    assert_int_equal(again.symbols[0], PARAMETER);
    assert_int_equal(again.values[0], VALUE);
    assert_true(again.q_named[0]); /* a NULL names all */
    b = take(&s, &again);
    assert_true(qdot_conditions_same(&a, &b));
    qdot_conditions_clear(&a);
    qdot_conditions_clear(&b);
    end(&s);
}

/* The latest study under the same conditions is found; of many the oldest goes. */
static void
latest_studies_are_kept(void **state)
{
    scene s = begin();
    qdot_run_request r = request();
    qdot_kept_studies studies = {0};
    qdot_conditions wanted;

    (void)state;
    for (int k = 0; k < 9; k++) {
        qdot_workprecision w = {.ref_err = k};
        qdot_conditions c;

        r.t1 = k == 8 ? TO + 7 : (qdot_expr)(TO + k);
        c = take(&s, &r);
        assert_int_equal(qdot_studies_keep(&studies, &c, &w), QDOT_OK);
        assert_int_equal(c.q0.n, 0);
    }
    r.t1 = TO + 7;
    wanted = take(&s, &r);
    assert_true(qdot_studies_find(&studies, &wanted)->ref_err == 8);
    wanted.t1 = TO;
    assert_null(qdot_studies_find(&studies, &wanted));
    wanted.t1 = TO + 1;
    assert_non_null(qdot_studies_find(&studies, &wanted));
    qdot_conditions_clear(&wanted);
    qdot_studies_clear(&studies);
    assert_int_equal(studies.n, 0);
    end(&s);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_changes_the_motion_counts),
        cmocka_unit_test(method_and_tolerance_do_not_count),
        cmocka_unit_test(request_gives_them_back),
        cmocka_unit_test(latest_studies_are_kept),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
