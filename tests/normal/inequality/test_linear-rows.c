/* test_linear-rows.c -- linear questions: by elimination as by cells, and where cells cannot tell. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "normal/inequality/linear-rows.h"
#include "normal/number.h"
#include "normal/pairs.h"

enum { QUESTIONS = 300, MOST = 5 };

static qdot_expr
linear(pairs *g, unsigned symbols)
{
    qdot_expr sum = QDOT_ZERO;

    for (unsigned i = 0; i <= symbols; i++) {
        const int64_t numerator = (int64_t)pairs_random(g, 7) - 3; /* drawn in this order by every compiler */
        const int64_t denominator = 1 + (int64_t)pairs_random(g, i == 0 ? 3 : 2);
        const qdot_expr factor = num(g, numerator, denominator);

        sum = add(g, sum, i == 0 ? factor : mul(g, factor, g->any[i - 1]));
    }
    return sum;
}

static qdot_cells
by_rows(pairs *g, qdot_expr e, size_t n, const qdot_cells_condition *condition)
{
    qdot_cells result;

    assert_int_equal(qdot_linear_decide(g->pool, e, n, condition, &result), QDOT_OK);
    return result;
}

/* Random conditions that are strict: cells decide them too, but for e > 0 beside e >= 0. */
static void
rows_and_cells_agree(void **state)
{
    int seen[QDOT_CELLS_ZERO + 1] = {0};
    pairs g;

    (void)state;
    pairs_begin(&g, 7);
    for (int k = 0; k < QUESTIONS; k++) {
        qdot_cells_condition condition[MOST];
        const size_t n = 1 + pairs_random(&g, MOST - 1);
        const unsigned symbols = 1 + pairs_random(&g, 3);
        const qdot_expr e = linear(&g, symbols);
        qdot_cells rows, cells;
        int64_t work = 30000000;
        qdot_expr at;

        for (size_t i = 0; i < n; i++)
            condition[i] = (qdot_cells_condition){linear(&g, symbols), false};
        rows = by_rows(&g, e, n, condition);
        assert_int_equal(qdot_cells_decide(g.pool, e, n, condition, &work, &cells, &at), QDOT_OK);
        seen[rows]++;
        if (cells == QDOT_CELLS_UNKNOWN || e == QDOT_ZERO) /* cells are not asked of 0 */
            continue;
        if (cells == QDOT_CELLS_NOT_NEGATIVE && rows == QDOT_CELLS_POSITIVE)
            continue;
        if (cells == QDOT_CELLS_ZERO)
            cells = QDOT_CELLS_NOT_NEGATIVE;
        assert_int_equal(rows, cells);
    }
    assert_true(seen[QDOT_CELLS_EMPTY] > 10 && seen[QDOT_CELLS_POSITIVE] > 10 && seen[QDOT_CELLS_NEGATIVE] > 10);
    qdot_pool_free(g.pool);
}

/* The sum of two angles below pi: 2 pi - u - v is 0 only where both ends belong to them. */
static void
strict_ends_are_told_from_weak_ones(void **state)
{
    qdot_expr u, v, e;
    pairs g;

    (void)state;
    pairs_begin(&g, 7);
    u = g.any[0];
    v = g.any[1];
    e = sub(&g, num(&g, 2, 1), add(&g, u, v));
    for (int i = 0; i < 4; i++) {
        const qdot_cells_condition ends[2] = {{sub(&g, QDOT_ONE, u), i & 1}, {sub(&g, QDOT_ONE, v), i & 2}};

        assert_int_equal(by_rows(&g, e, 2, ends), i == 3 ? QDOT_CELLS_NOT_NEGATIVE : QDOT_CELLS_POSITIVE);
        assert_int_equal(by_rows(&g, e, 1, ends), QDOT_CELLS_NEGATIVE);
    }
    qdot_pool_free(g.pool);
}

static void
what_is_not_linear_is_not_decided(void **state)
{
    qdot_cells_condition one;
    qdot_expr u, v;
    pairs g;

    (void)state;
    pairs_begin(&g, 7);
    u = g.any[0];
    v = g.any[1];
    one = (qdot_cells_condition){u, false};
    assert_int_equal(by_rows(&g, mul(&g, u, v), 1, &one), QDOT_CELLS_UNKNOWN);
    assert_int_equal(by_rows(&g, fun(&g, QDOT_FLOOR, u), 1, &one), QDOT_CELLS_UNKNOWN);
    one.gap = mul(&g, u, u);
    assert_int_equal(by_rows(&g, v, 1, &one), QDOT_CELLS_UNKNOWN);
    qdot_pool_free(g.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_and_cells_agree),
                                       cmocka_unit_test(strict_ends_are_told_from_weak_ones),
                                       cmocka_unit_test(what_is_not_linear_is_not_decided)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
