/* test_sign.c -- signs that are proved by structure: roots of equations in their order. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/build.h"
#include "expr/symbol.h"
#include "normal/inequality/sign.h"

/* a and b are positive. */
static int
sign_of(const char *text, const char *condition)
{
    const qdot_expr gap = condition == NULL ? QDOT_NIL : text_read(pool, condition);
    const qdot_expr relation = gap == QDOT_NIL ? QDOT_NIL : qdot_rel(pool, QDOT_LT, QDOT_ZERO, gap);
    const qdot_facts facts = {.n_conditions = gap != QDOT_NIL, .conditions = &relation};
    int sign = 7;

    assert_int_equal(qdot_sign(pool, text_read(pool, text), &facts, &sign), QDOT_OK);
    return sign;
}

static void
roots_are_ordered(void **state)
{
    (void)state;
    assert_int_equal(sign_of("acos(-a/(a + b)) - acos(a/(a + b))", NULL), 1);
    assert_int_equal(sign_of("log(a + b) - log(a)", NULL), 1);
    assert_int_equal(sign_of("sqrt(a) - sqrt(a + b)", NULL), -1);
    assert_int_equal(sign_of("log(a + 2*b) - log(a + b) - log(2) + log(3)", NULL), 1);
    assert_int_equal(sign_of("2*acos(a/b)", "b - a"), 1);
}

static void
roots_beside_numbers(void **state)
{
    (void)state;
    assert_int_equal(sign_of("a - sqrt(a^2 - b)", "a^2 - b"), 1);
    assert_int_equal(sign_of("a - sqrt(a^2 + b)", NULL), -1);
    assert_int_equal(sign_of("a^2 - b^2 - a*sqrt(a^2 - b^2)", "a - b"), -1);
    assert_int_equal(sign_of("a*(a + sqrt(a^2 - b^2))/b^2 - 1", "a - b"), 1);
}

/* What is asked of a polynomial is asked of it without the factors whose signs are known. */
static void
factors_are_left_out(void **state)
{
    (void)state;
    assert_int_equal(sign_of("a^2*b^2 - b^4", "a - b"), 1);
    assert_int_equal(sign_of("b^3 - a*b^2", "a - b"), -1);
}

/* c g + r of a condition 0 < g: where c and r have one sign. */
static void
a_condition_is_a_summand(void **state)
{
    (void)state;
    assert_int_equal(sign_of("2*u*a^2*b + 4*a*b^3", "u*a^2*b + a*b^3"), 1);
    assert_int_equal(sign_of("2*u*a^2*b + 4*a*b^3", "u*a + b^2"), 1);
    assert_int_equal(sign_of("-3*u*a*b - 4*a*b^3 - a", "u*a*b + a*b^3"), -1);
    assert_int_equal(sign_of("2*u*a*b + a*b^3", "u*a*b + a*b^3"), 0);
}

static void
symbols_have_the_sign_of_their_bounds(void **state)
{
    const qdot_expr x = qdot_symbol_get(pool, QDOT_PARAM, "x1"), y = qdot_symbol_get(pool, QDOT_PARAM, "y1"),
                    bound = text_read(pool, "a*b");
    int sign;

    (void)state;
    qdot_symbol_domain(pool, x, bound, true, QDOT_NIL, false);
    qdot_symbol_domain(pool, y, QDOT_NIL, false, qdot_neg(pool, bound), true);
    assert_int_equal(qdot_sign(pool, x, NULL, &sign), QDOT_OK);
    assert_int_equal(sign, 1);
    assert_int_equal(qdot_sign(pool, y, NULL, &sign), QDOT_OK);
    assert_int_equal(sign, -1);
}

/* Nothing is concluded where both signs occur. */
static void
what_depends_is_not_known(void **state)
{
    (void)state;
    assert_int_equal(sign_of("sqrt(a) - sqrt(b)", NULL), 0);
    assert_int_equal(sign_of("a - sqrt(b)", NULL), 0);
    assert_int_equal(sign_of("log(a)", NULL), 0);
    assert_int_equal(sign_of("acos(a) - acos(b)", NULL), 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(roots_are_ordered, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(roots_beside_numbers, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(factors_are_left_out, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(a_condition_is_a_summand, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(symbols_have_the_sign_of_their_bounds, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(what_depends_is_not_known, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
