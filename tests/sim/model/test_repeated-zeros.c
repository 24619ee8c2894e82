/* test_repeated-zeros.c -- in place of functions with jumps stand those without that have the same zeros. */
#include "expr/build.h"
#include "expr/exact.h"
#include "sim/scenes.h"

#include "expr/elementary.h"
#include "sim/model/repeated-zeros.h"

typedef struct {
    fixture f;
    qdot_expr x, half;
} place;

static void
begin_place(place *s)
{
    *s = (place){0};
    begin(&s->f);
    s->x = coordinate(&s->f, "x");
    s->half = QDOT_HALF;
}

static qdot_repeated
repeated(place *s, qdot_expr g)
{
    qdot_repeated out;

    assert_true(qdot_repeated_zeros(s->f.pool, g, &out) == QDOT_OK);
    return out;
}

/* mod(x, 2) */
static qdot_expr
modulo(place *s)
{
    const qdot_expr args[] = {s->x, qdot_expr_int(s->f.pool, 2)};

    return qdot_fun(s->f.pool, QDOT_MOD, 2, args);
}

static void
mod_is_a_sine(void **state)
{
    place s;
    qdot_pool *pool;
    qdot_repeated out;
    qdot_expr phase;

    (void)state;
    begin_place(&s);
    pool = s.f.pool;
    out = repeated(&s, modulo(&s));
    phase = qdot_mul(pool, QDOT_PI, qdot_mul(pool, s.half, s.x));
    assert_true(out.touches && out.turn == QDOT_NIL && !out.half);
    assert_int_equal(out.u, qdot_fun1(pool, QDOT_SIN, phase));
    out = repeated(&s, qdot_sub(pool, modulo(&s), s.half));
    assert_true(!out.touches && out.turn != QDOT_NIL && qdot_expr_is_function(pool, out.u, QDOT_SIN));
    /* it never is 2, and a moving level is left alone */
    out = repeated(&s, qdot_sub(pool, modulo(&s), qdot_expr_int(pool, 2)));
    assert_int_equal(out.u, QDOT_ONE);
    out = repeated(&s, qdot_sub(pool, modulo(&s), s.x));
    assert_int_equal(out.u, qdot_sub(pool, modulo(&s), s.x));
    end(&s.f);
}

static void
others_have_simple_zeros(void **state)
{
    place s;
    qdot_pool *pool;
    qdot_repeated out;
    qdot_expr g, args[2];

    (void)state;
    begin_place(&s);
    pool = s.f.pool;
    out = repeated(&s, qdot_sub(pool, qdot_fun1(pool, QDOT_TAN, s.x), qdot_expr_int(pool, 2)));
    assert_true(qdot_expr_is_function(pool, out.u, QDOT_SIN) && out.turn != QDOT_NIL && !out.half);
    out = repeated(&s, qdot_sub(pool, qdot_fun1(pool, QDOT_FLOOR, s.x), s.half));
    assert_int_equal(out.u, QDOT_ONE); /* nowhere */
    g = qdot_sub(pool, qdot_fun1(pool, QDOT_FLOOR, s.x), QDOT_ONE);
    assert_true(repeated(&s, g).u != g);
    args[0] = s.x;
    args[1] = coordinate(&s.f, "y");
    g = qdot_fun(pool, QDOT_ATAN2, 2, args);
    out = repeated(&s, g);
    assert_int_equal(out.u, s.x);
    assert_true(out.half && !out.touches);
    out = repeated(&s, qdot_sub(pool, g, QDOT_PI));
    assert_true(out.half && out.touches);
    assert_int_equal(repeated(&s, qdot_add(pool, g, QDOT_PI)).u, QDOT_ONE);
    assert_int_equal(repeated(&s, s.x).u, s.x);
    end(&s.f);
}

/* Powers and moduli are taken off first: (mod(x, 2) - 1/2)^3, |mod(x, 2) - 1/2|, x^4. */
static void
powers_are_watched_by_their_base(void **state)
{
    place s;
    qdot_pool *pool;
    qdot_repeated once, out;
    qdot_expr g;

    (void)state;
    begin_place(&s);
    pool = s.f.pool;
    g = qdot_sub(pool, modulo(&s), s.half);
    once = repeated(&s, g);
    assert_true(qdot_watched_zeros(pool, qdot_pow_int(pool, g, 3), &out) == QDOT_OK);
    assert_true(out.u == once.u && out.turn == once.turn && !out.touches);
    assert_true(qdot_watched_zeros(pool, qdot_fun1(pool, QDOT_ABS, g), &out) == QDOT_OK);
    assert_true(out.u == once.u && out.turn == once.turn && out.touches);
    assert_true(qdot_watched_zeros(pool, qdot_pow_int(pool, s.x, 4), &out) == QDOT_OK);
    assert_true(out.u == s.x && out.turn == QDOT_NIL && out.touches && !out.half);
    assert_true(qdot_watched_zeros(pool, s.x, &out) == QDOT_OK);
    assert_true(out.u == s.x && !out.touches);
    /* the jump is where it touches 0, whatever the power */
    assert_true(qdot_watched_zeros(pool, qdot_pow_int(pool, modulo(&s), 3), &out) == QDOT_OK);
    assert_true(out.u == repeated(&s, modulo(&s)).u && out.touches);
    end(&s.f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mod_is_a_sine),
        cmocka_unit_test(others_have_simple_zeros),
        cmocka_unit_test(powers_are_watched_by_their_base),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
