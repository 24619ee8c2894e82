/* test_sign.c -- signs that are proved by structure: roots of equations in their order. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/build.h"
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
        cmocka_unit_test_setup_teardown(what_depends_is_not_known, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
