/* test_memo.c -- answers are found again as long as nothing that they depend on has changed. */
#include "expr/kit.h"

#include "expr/memo.h"

static void
an_answer_is_found_again(void **state)
{
    const qdot_expr question = qdot_list(p.pool, 2, (qdot_expr[]){p.symbol[0], p.symbol[1]});
    double answer = 2.385, found = 0;

    (void)state;
    assert_false(qdot_memo_find(p.pool, question, QDOT_MEMO_LESS, &found, sizeof found));
    qdot_memo_keep(p.pool, question, QDOT_MEMO_LESS, &answer, sizeof answer);
    assert_true(qdot_memo_find(p.pool, question, QDOT_MEMO_LESS, &found, sizeof found));
    assert_true(found == answer);
    assert_false(qdot_memo_find(p.pool, question, QDOT_MEMO_LESS | 1, &found, sizeof found));
    assert_false(qdot_memo_find(p.pool, p.symbol[0], QDOT_MEMO_LESS, &found, sizeof found));
    qdot_memo_keep(p.pool, QDOT_NIL, QDOT_MEMO_LESS, &answer, sizeof answer);
    assert_false(qdot_memo_find(p.pool, QDOT_NIL, QDOT_MEMO_LESS, &found, sizeof found));
}

static void
a_domain_that_changes_makes_it_unknown(void **state)
{
    const qdot_expr x = qdot_symbol_get(p.pool, QDOT_PARAM, "width");
    double answer = 2.385;

    (void)state;
    qdot_memo_keep(p.pool, x, QDOT_MEMO_LESS, &answer, sizeof answer);
    qdot_symbol_domain(p.pool, x, QDOT_NIL, false, QDOT_NIL, false); /* as it is */
    assert_true(qdot_memo_find(p.pool, x, QDOT_MEMO_LESS, &answer, sizeof answer));
    qdot_symbol_domain(p.pool, x, QDOT_ZERO, true, QDOT_NIL, false);
    assert_false(qdot_memo_find(p.pool, x, QDOT_MEMO_LESS, &answer, sizeof answer));
}

static void
nothing_is_found_or_kept_within_limited_work(void **state)
{
    const qdot_expr a = p.symbol[0], b = p.symbol[1];
    double answer = 2.385;
    uint64_t before;

    (void)state;
    qdot_memo_keep(p.pool, a, QDOT_MEMO_LESS, &answer, sizeof answer);
    before = qdot_pool_budget(p.pool, 1000);
    assert_false(qdot_memo_find(p.pool, a, QDOT_MEMO_LESS, &answer, sizeof answer));
    qdot_memo_keep(p.pool, b, QDOT_MEMO_LESS, &answer, sizeof answer);
    (void)qdot_pool_budget(p.pool, before);
    assert_true(qdot_memo_find(p.pool, a, QDOT_MEMO_LESS, &answer, sizeof answer));
    assert_false(qdot_memo_find(p.pool, b, QDOT_MEMO_LESS, &answer, sizeof answer));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(an_answer_is_found_again),
        TEST(a_domain_that_changes_makes_it_unknown),
        TEST(nothing_is_found_or_kept_within_limited_work),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
