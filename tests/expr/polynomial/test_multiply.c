/* test_multiply.c -- products by FLINT against products term by term; what is too long; memory that ends and Ctrl-C. */
#include "expr/kit.h"

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/function.h"
#include "expr/polynomial/multiply.h"

/* A factor: a symbol, its inverse, a root, a function, a power with a symbol above. */
static qdot_expr
random_factor(void)
{
    qdot_expr x = p.symbol[random_below(SYMBOLS)], y = p.symbol[random_below(SYMBOLS)];

    switch (random_below(8)) {
    case 0: return qdot_pow_int(p.pool, x, -1 - (int64_t)random_below(3));
    case 1: return qdot_sqrt(p.pool, number(2 + (int64_t)random_below(8), 1));
    case 2: return qdot_fun1(p.pool, QDOT_SIN, x);
    case 3: return qdot_fun1(p.pool, QDOT_EXP, qdot_sub(p.pool, x, y));
    case 4: return qdot_fun1(p.pool, QDOT_ABS, x);
    case 5: return qdot_pow(p.pool, x, y);
    default: return x;
    }
}

static qdot_expr
random_sum(void)
{
    qdot_expr e = QDOT_ZERO;

    for (int i = 1 + (int)random_below(4); i > 0; i--) {
        qdot_expr term = number((int64_t)random_below(9) - 4, 1 + (int64_t)random_below(3));

        for (int k = (int)random_below(3); k > 0; k--)
            term = times(term, random_factor());
        e = qdot_add(p.pool, e, term);
    }
    return qdot_expand(p.pool, e);
}

/* (c a^k b + d a + 1/3) b^2 by FLINT. */
static qdot_expr
compute_by_items(qdot_expr a, qdot_expr b, uint64_t k, qdot_expr c, qdot_expr d)
{
    qdot_multiply_part parts[] = {
        {.e = a, .power = k}, {.e = b, .power = 1}, {.item = 0, .c = QDOT_ONE}, {.e = a, .c = d}, {.item = 1, .power = 1}, {.e = b, .power = 2},
    };
    qdot_multiply_item items[] = {
        {.c = c, .from = 0, .n = 2}, {.is_sum = true, .c = number(1, 3), .from = 2, .n = 2}, {.c = QDOT_ONE, .from = 4, .n = 2}};
    const qdot_multiply_list list = {.items = {items, 3, 3}, .parts = {parts, 6, 6}};

    return qdot_multiply_out(p.pool, &list, 2);
}

static void
both_ways_give_one_expression(void **state)
{
    int compared = 0;

    (void)state;
    for (int trial = 0; trial < 3000; trial++) {
        const qdot_expr a = random_sum(), b = random_sum(), c = number((int64_t)random_below(7) - 3, 2), d = number(1, 1 + (int64_t)random_below(3));
        const int64_t k = 1 + (int64_t)random_below(3);
        qdot_expr e = times(c, times(qdot_pow_int(p.pool, a, k), b));

        assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
        if (qdot_expr_kind(p.pool, a) != QDOT_SUM || qdot_expr_kind(p.pool, b) != QDOT_SUM)
            continue;
        e = qdot_expand(p.pool, e);
        e = qdot_add(p.pool, qdot_add(p.pool, e, qdot_expand(p.pool, times(d, a))), number(1, 3));
        e = qdot_expand(p.pool, times(qdot_expand(p.pool, times(e, b)), b));
        e = qdot_expand(p.pool, e); /* exp(u)*exp(u) by terms is exp(2*u), where 2*u is no sum */
        if (compute_by_items(a, b, (uint64_t)k, c, d) != e)
            fail_msg("%s: two products by terms and by FLINT", text_of(p.pool, qdot_sub(p.pool, e, compute_by_items(a, b, (uint64_t)k, c, d)), QDOT_PLAIN));
        compared++;
    }
    assert_true(compared > 300);
}

/* The power n of the sum of all symbols and 1. */
static qdot_expr
power_of_sum(int64_t n)
{
    return qdot_pow_int(p.pool, qdot_add(p.pool, qdot_sum(p.pool, SYMBOLS, p.symbol), QDOT_ONE), n);
}

static void
long_powers_have_all_terms(void **state)
{
    const qdot_expr e = qdot_expand(p.pool, power_of_sum(14));
    qdot_expr sum = e;

    (void)state;
    for (int i = 0; i < SYMBOLS; i++)
        sum = qdot_subs(p.pool, sum, 1, &p.symbol[i], (qdot_expr[]){QDOT_ONE});
    assert_int_equal(sum, qdot_pow_int(p.pool, number(SYMBOLS + 1, 1), 14));
    assert_int_equal((qdot_expr_count(p.pool, e) - 1) / 2 + 1, (uint32_t)(qdot_multiply_terms_of_power(SYMBOLS + 1, 14) + 0.5));
    assert_int_equal(qdot_expand(p.pool, qdot_sub(p.pool, power_of_sum(14), e)), QDOT_ZERO);
}

static void
what_is_needed_below_is_written_first(void **state)
{
    const qdot_expr e = power_of_sum(9), inner = qdot_expand(p.pool, e);

    (void)state;
    assert_int_equal(qdot_expand(p.pool, qdot_fun1(p.pool, QDOT_SIN, e)), qdot_fun1(p.pool, QDOT_SIN, inner));
    assert_int_equal(qdot_expand(p.pool, qdot_pow_int(p.pool, e, -1)), qdot_pow_int(p.pool, inner, -1));
    assert_int_equal(qdot_expand(p.pool, qdot_pow(p.pool, qdot_add(p.pool, e, QDOT_ONE), QDOT_HALF)),
                     qdot_pow(p.pool, qdot_add(p.pool, inner, QDOT_ONE), QDOT_HALF));
}

static void
the_limits_are_told_with_numbers(void **state)
{
    (void)state;
    assert_int_equal(qdot_expand(p.pool, qdot_pow_int(p.pool, qdot_add(p.pool, qdot_add(p.pool, p.symbol[0], p.symbol[1]), QDOT_ONE), 2000)), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ELIMIT);
    assert_string_equal(qdot_last_error()->message, "multiplied out it has up to 2003001 terms, and 1000000 are the most");
    (void)qdot_pool_budget(p.pool, 5000);
    refuses(qdot_expand(p.pool, power_of_sum(14)), QDOT_ELIMIT);
    (void)qdot_pool_budget(p.pool, UINT64_MAX);
}

/* At the n-th allocation `harm` is done, for every n until none is left. */
static void
after_harm_at_any_allocation(void (*harm)(int64_t n), qdot_status wanted)
{
    const qdot_expr e = qdot_mul(p.pool, power_of_sum(5), qdot_add(p.pool, power_of_sum(4), QDOT_ONE));
    int failures = 0;
    qdot_status status = wanted;

    for (int64_t n = 0; status != QDOT_OK; n += 1 + n / 20) {
        harm(n);
        (void)qdot_expand(p.pool, e);
        status = qdot_pool_check(p.pool);
        harm(-1);
        qdot_interrupt_clear();
        if (status != QDOT_OK && status != wanted)
            fail_msg("%d at allocation %d: %s", status, (int)n, qdot_last_error()->message);
        failures += status != QDOT_OK;
    }
    assert_true(failures > 10);
}

static void
memory_may_end_and_ctrl_c_be_pressed(void **state)
{
    (void)state;
    after_harm_at_any_allocation(qdot_memory_fail_at, QDOT_ENOMEM);
    after_harm_at_any_allocation(qdot_memory_press_at, QDOT_EINTR);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(both_ways_give_one_expression),
        TEST(long_powers_have_all_terms),
        TEST(what_is_needed_below_is_written_first),
        TEST(the_limits_are_told_with_numbers),
        TEST(memory_may_end_and_ctrl_c_be_pressed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
