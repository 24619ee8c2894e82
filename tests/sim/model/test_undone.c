/* test_undone.c -- what undoes an event, against the event itself. */
#include "expr/build.h"
#include "sim/scenes.h"

#include "expr/elementary.h"
#include "sim/model/substitute.h"
#include "sim/model/undone.h"

typedef struct {
    fixture f;
    qdot_expr x, y, v, w; /* coordinates and their velocities */
} place;

static void
begin_place(place *s)
{
    *s = (place){0};
    begin(&s->f);
    s->x = coordinate(&s->f, "x");
    s->y = coordinate(&s->f, "y");
    s->v = velocity(&s->f, s->x);
    s->w = velocity(&s->f, s->y);
}

static qdot_expr
sum(place *s, const char *a, qdot_expr x, const char *b, qdot_expr y)
{
    return qdot_add(s->f.pool, times(&s->f, number(&s->f, a), x), times(&s->f, number(&s->f, b), y));
}

/* `then` of what was before gives the state behind. */
static void
assert_undone(place *s, qdot_expr f, size_t n, const qdot_expr *targets, const qdot_expr *values)
{
    qdot_undone out;

    assert_true(qdot_undone_find(s->f.pool, f, n, targets, values, &out) == QDOT_OK);
    assert_null(out.why);
    for (size_t i = 0; i < n; i++)
        assert_int_equal(qdot_substitute(s->f.pool, values[i], n, targets, out.values), targets[i]);
    qdot_undone_clear(&out);
}

static void
assert_lost(place *s, qdot_expr f, size_t n, const qdot_expr *targets, const qdot_expr *values, bool nowhere)
{
    qdot_undone out;

    assert_true(qdot_undone_find(s->f.pool, f, n, targets, values, &out) == QDOT_OK);
    assert_non_null(out.why);
    assert_int_equal(out.function == QDOT_NIL, nowhere);
    qdot_undone_clear(&out);
}

static void
linear_changes_are_inverted(void **state)
{
    place s;
    qdot_expr targets[2], values[2];

    (void)state;
    begin_place(&s);
    targets[0] = s.v;
    targets[1] = s.w;
    values[0] = times(&s.f, number(&s.f, "-0.37"), s.v);
    assert_undone(&s, s.x, 1, targets, values);
    values[0] = sum(&s, "0.28", s.v, "-1.7", s.w); /* both at once */
    values[1] = sum(&s, "-0.41", s.v, "2.3", s.x);
    assert_undone(&s, s.x, 2, targets, values);
    values[0] = sum(&s, "3", s.v, "1", times(&s.f, s.w, s.w)); /* one behind the other */
    values[1] = sum(&s, "-2", s.w, "5", s.y);
    assert_undone(&s, s.x, 2, targets, values);
    end(&s.f);
}

static void
the_event_tells_what_then_forgets(void **state)
{
    place s;
    qdot_undone out;
    qdot_expr f, zero = QDOT_ZERO;

    (void)state;
    begin_place(&s);
    f = qdot_sub(s.f.pool, s.x, QDOT_ONE);
    assert_true(qdot_undone_find(s.f.pool, f, 1, &s.x, &zero, &out) == QDOT_OK); /* x = 1 then x = 0 */
    assert_null(out.why);
    assert_int_equal(out.values[0], QDOT_ONE);
    assert_int_equal(out.function, s.x);
    qdot_undone_clear(&out);
    assert_true(qdot_undone_find(s.f.pool, s.x, 1, &s.x, &zero, &out) == QDOT_OK); /* x = 0 then x = 0 */
    assert_null(out.why);
    assert_int_equal(out.values[0], s.x);
    assert_int_equal(out.function, s.x);
    qdot_undone_clear(&out);
    end(&s.f);
}

static void
others_are_lost(void **state)
{
    place s;
    qdot_expr targets[2], values[2];

    (void)state;
    begin_place(&s);
    targets[0] = s.v;
    values[0] = QDOT_ZERO;
    assert_lost(&s, s.x, 1, targets, values, false);
    values[0] = qdot_fun1(s.f.pool, QDOT_ABS, s.v);
    assert_lost(&s, s.x, 1, targets, values, false);
    values[0] = qdot_add(s.f.pool, s.v, qdot_fun1(s.f.pool, QDOT_SIGN, s.v)); /* its slope is 1 */
    assert_lost(&s, s.x, 1, targets, values, false);
    targets[1] = s.w;
    values[0] = sum(&s, "2", s.v, "3", s.w); /* dependent */
    values[1] = sum(&s, "4", s.v, "6", s.w);
    assert_lost(&s, s.x, 2, targets, values, false);
    targets[0] = s.x;
    targets[1] = s.y;
    values[0] = values[1] = QDOT_ZERO;
    assert_lost(&s, qdot_sub(s.f.pool, s.x, s.y), 2, targets, values, true);
    end(&s.f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_changes_are_inverted),
        cmocka_unit_test(the_event_tells_what_then_forgets),
        cmocka_unit_test(others_are_lost),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
