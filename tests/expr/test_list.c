/* test_list.c -- a list and more members. */
#include "expr/kit.h"

#include "expr/list.h"

static void
members_stand_in_their_order(void **state)
{
    qdot_expr a = p.symbol[0], b = p.symbol[1], more[] = {b, a, b};
    qdot_expr list = qdot_list_appended(p.pool, QDOT_NIL, 1, &a);

    (void)state;
    assert_int_equal(list, qdot_list(p.pool, 1, &a));
    list = qdot_list_appended(p.pool, list, 3, more);
    assert_int_equal(list, qdot_list(p.pool, 4, (qdot_expr[]){a, b, a, b}));
    assert_int_equal(qdot_list_appended(p.pool, list, 0, NULL), list);
    assert_int_equal(qdot_list_appended(p.pool, QDOT_NIL, 0, NULL), qdot_list(p.pool, 0, NULL));
}

static void
only_members_are_had(void **state)
{
    qdot_expr a = p.symbol[0], b = p.symbol[1], sum = qdot_add(p.pool, a, b);
    qdot_expr list = qdot_list(p.pool, 2, (qdot_expr[]){b, sum});

    (void)state;
    assert_true(qdot_list_has(p.pool, list, b));
    assert_true(qdot_list_has(p.pool, list, sum));
    assert_false(qdot_list_has(p.pool, list, a)); /* only within a member */
    assert_false(qdot_list_has(p.pool, QDOT_NIL, a));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(members_stand_in_their_order),
        TEST(only_members_are_had),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
