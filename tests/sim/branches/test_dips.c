/* Test functions that come near 0 between points of a curve: told, and only these. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>

#include "base/memory.h"
#include "sim/branches/dips.h"

typedef struct {
    qdot_path x;
    qdot_path_point a;
    qdot_dips d;
} walk;

static void
walk_begin(walk *w)
{
    assert_int_equal(qdot_path_begin(&w->x, 1), QDOT_OK);
    w->x.weight[0] = w->x.weight[1] = 1;
    assert_int_equal(qdot_path_point_begin(&w->x, &w->a), QDOT_OK);
    assert_int_equal(qdot_dips_begin(&w->x, &w->d), QDOT_OK);
    w->a.t[1] = 1;
}

static void
walk_end(walk *w)
{
    qdot_dips_end(&w->d);
    qdot_path_point_end(&w->a);
    qdot_path_end(&w->x);
}

/* Points from `from` to `to` by `step`, the determinant (s - 1)^2 + left there; the first answer that is
 * not NONE. */
static qdot_dips_answer
along(walk *w, double from, double to, double step, double left, double *at)
{
    size_t place;

    for (double s = from; s < to; s += step) {
        qdot_dips_answer answer;

        w->a.det = (s - 1) * (s - 1) + left;
        answer = qdot_dips_look(&w->x, &w->d, &w->a, s, &place);
        *at = s;
        if (answer != QDOT_DIPS_NONE)
            return answer;
        qdot_dips_add(&w->x, &w->d, &w->a, s, 0);
    }
    return QDOT_DIPS_NONE;
}

/* The minimum of 1e-6 is as narrow as 1e-3: seen by steps of 0.01, followed by steps of 1e-4. */
static void
a_dip_is_refined_until_it_is_smooth(void **state)
{
    walk w;
    double at;

    (void)state;
    walk_begin(&w);
    assert_int_equal(along(&w, 0.9, 1.1, 0.01, 1e-6, &at), QDOT_DIPS_AGAIN);
    assert_true(w.d.careful < 0.003 && w.d.gone[0] < 1 && at > 1 && w.d.until == at);
    walk_end(&w);
    walk_begin(&w);
    assert_int_equal(along(&w, 0.999, 1.001, 1e-4, 1e-6, &at), QDOT_DIPS_NONE);
    walk_end(&w);
}

static void
what_falls_or_rises_is_none(void **state)
{
    walk w;
    double at;

    (void)state;
    walk_begin(&w);
    assert_int_equal(along(&w, 0, 0.99, 0.01, 0, &at), QDOT_DIPS_NONE);
    walk_end(&w);
    walk_begin(&w);
    assert_int_equal(along(&w, 1.01, 3, 0.01, 0, &at), QDOT_DIPS_NONE);
    walk_end(&w);
}

/* Also where both middle points are equally far from it. */
static void
a_double_zero_is_told_at_the_end(void **state)
{
    walk w;
    double at;

    (void)state;
    walk_begin(&w);
    assert_int_equal(along(&w, 0.905, 1.1, 0.01, 0, &at), QDOT_DIPS_AGAIN);
    walk_end(&w);
    walk_begin(&w);
    w.d.most[0] = 1;
    assert_int_equal(along(&w, 1 - 4.5e-8, 1 + 1e-6, 1e-8, 0, &at), QDOT_DIPS_ZERO);
    walk_end(&w);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dip_is_refined_until_it_is_smooth),
        cmocka_unit_test(what_falls_or_rises_is_none),
        cmocka_unit_test(a_double_zero_is_told_at_the_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
