/* test_separation.c -- expressions are divided into a function of one coordinate and one of the others, or not at all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "normal/text.h"

#include "mech/hamilton/separation-split.h"
#include "normal/prove/decide.h"

static qdot_pool *pool;

/* Whether e is divided: x with the momentum u, others y and z with v and w; the parts add up to e. */
static bool
is_split(const char *text, qdot_expr *own, qdot_expr *other)
{
    const qdot_expr oq[] = {text_read(pool, "y"), text_read(pool, "z")}, op[] = {text_read(pool, "v"), text_read(pool, "w")};
    const qdot_facts facts = {0};
    const qdot_split split = {pool, &facts, 2, text_read(pool, "x"), text_read(pool, "u"), oq, op};
    const qdot_expr e = text_read(pool, text);

    if (!qdot_split_sum(&split, e, own, other))
        return false;
    assert_true(qdot_split_is_own(&split, *own) && qdot_split_is_other(&split, *other));
    assert_true(qdot_is_zero(pool, qdot_sub(pool, qdot_add(pool, *own, *other), e), &facts));
    return true;
}

static void
sums_are_divided(void **state)
{
    static const char *const sums[] = {
        "x^2*u^2 + y*v^2 + 3 + z", "(x + y)*(x - y)", "(x^2 - y^2)/((x^2 - 1)*(1 - y^2))", "u^2*sin(y)^2 + u^2*cos(y)^2 + v^2",
        "(x*y + x + y*z*(y + 1))/(y + 1)", "(x + y)^2 - 2*x*y + u*x - z*w",
    };
    qdot_expr own, other;

    (void)state;
    pool = qdot_pool_new();
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++)
        if (!is_split(sums[i], &own, &other))
            fail_msg("%s: not divided", sums[i]);
    qdot_pool_free(pool);
}

static void
mixed_sums_are_not(void **state)
{
    static const char *const sums[] = {"x*y", "(x + y)^2", "u^2*y + x", "x/(x + y)", "sin(x + z)"};
    qdot_expr own, other;

    (void)state;
    pool = qdot_pool_new();
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++)
        if (is_split(sums[i], &own, &other))
            fail_msg("%s: divided", sums[i]);
    qdot_pool_free(pool);
}

static void
factors_are_found(void **state)
{
    qdot_expr q[2], none = QDOT_NIL;
    const qdot_facts facts = {0};
    qdot_split split;

    (void)state;
    pool = qdot_pool_new();
    q[0] = text_read(pool, "x");
    q[1] = text_read(pool, "y");
    split = (qdot_split){pool, &facts, 1, q[0], text_read(pool, "u"), &q[1], (qdot_expr[]){text_read(pool, "v")}};
    assert_int_equal(qdot_split_factor(&split, text_read(pool, "(x^2 - 1)/(1 - y^2)")), text_read(pool, "x^2 - 1"));
    assert_true(qdot_split_factor(&split, text_read(pool, "x*y + x + y + 1")) != none);
    assert_true(qdot_split_factor(&split, text_read(pool, "x + y")) == none);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_divided),
        cmocka_unit_test(mixed_sums_are_not),
        cmocka_unit_test(factors_are_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
