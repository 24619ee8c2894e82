/* test_pool.c -- the pool: interning, the first cause, symbols, budget, Ctrl-C, no memory. */
#include "expr/kit.h"

#include <inttypes.h>

static void
first_ids_are_the_constants(void **state)
{
    (void)state;
    assert_int_equal(qdot_expr_int(p.pool, 0), QDOT_ZERO);
    assert_int_equal(qdot_expr_int(p.pool, 1), QDOT_ONE);
    assert_int_equal(qdot_expr_int(p.pool, -1), QDOT_MINUS_ONE);
    assert_int_equal(qdot_expr_ratio(p.pool, 3, 6), QDOT_HALF);
    assert_int_equal(qdot_symbol_get(p.pool, QDOT_CONST, "pi"), QDOT_PI);
    assert_int_equal(qdot_symbol_get(p.pool, QDOT_CONST, "true"), QDOT_TRUE);
    assert_int_equal(qdot_symbol_get(p.pool, QDOT_CONST, "false"), QDOT_FALSE);
    assert_int_equal(qdot_symbol_get(p.pool, QDOT_TIME, "t"), QDOT_T);
}

static void
built_alike_is_the_same_id(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], list, e[2];
    size_t count;

    (void)state;
    for (int i = 0; i < 2; i++)
        e[i] = qdot_fun1(p.pool, QDOT_SIN,
                         qdot_add(p.pool, qdot_mul(p.pool, a, x), QDOT_HALF));
    assert_int_equal(e[0], e[1]);
    list = qdot_list(p.pool, 0, NULL);
    assert_int_equal(qdot_list(p.pool, 0, NULL), list);
    count = qdot_pool_count(p.pool);
    (void)qdot_vector(p.pool, 2, (qdot_expr[]){a, x});
    assert_int_equal(qdot_pool_count(p.pool), count + 1);
    (void)qdot_vector(p.pool, 2, (qdot_expr[]){a, x});
    assert_int_equal(qdot_pool_count(p.pool), count + 1);
}

/* The rational of a number stays where it is, and what it is, whatever is made later. */
static void
numbers_stay_where_they_are(void **state)
{
    const qdot_expr third = qdot_expr_ratio(p.pool, 1, 3), big = qdot_pow_int(p.pool, qdot_expr_int(p.pool, 3), 99);
    const fmpq *small_one = qdot_expr_rational(p.pool, third), *large_one = qdot_expr_rational(p.pool, big);

    (void)state;
    for (int64_t i = 0; i < 50000; i++)
        (void)qdot_expr_ratio(p.pool, i, 100003);
    assert_ptr_equal(qdot_expr_rational(p.pool, third), small_one);
    assert_ptr_equal(qdot_expr_rational(p.pool, big), large_one);
    assert_true(fmpq_cmp_si(large_one, 1000000) > 0 && fmpz_get_si(fmpq_denref(small_one)) == 3);
}

/* 200,000 numbers of all sizes: the table grows, every one is found again. */
static void
numbers_are_interned_by_value(void **state)
{
    qdot_expr big = qdot_pow_int(p.pool, qdot_expr_int(p.pool, 10), 50);

    (void)state;
    for (int64_t i = 0; i < 100000; i++) {
        qdot_expr a = qdot_expr_ratio(p.pool, i - 5000, 1 + i % 7);
        qdot_expr b = qdot_add(p.pool, big, a);

        assert_int_equal(qdot_expr_ratio(p.pool, 3 * (i - 5000), 3 * (1 + i % 7)), a);
        assert_int_equal(qdot_sub(p.pool, b, big), a);
        assert_int_equal(qdot_add(p.pool, a, big), b);
    }
    assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
}

static void
children_have_smaller_ids(void **state)
{
    (void)state;
    for (int trial = 0; trial < 300; trial++) {
        formula f = formula_random(STEPS, 0);

        (void)formula_build(&f, &p);
        (void)!qdot_pool_check(p.pool);
    }
    for (qdot_expr e = 1; e < qdot_pool_count(p.pool); e++)
        for (uint32_t i = 0; i < qdot_expr_count(p.pool, e); i++)
            assert_true(qdot_expr_arg(p.pool, e, i) < e &&
                        qdot_expr_arg(p.pool, e, i) != QDOT_NIL);
}

static void
nil_absorbs_and_the_first_cause_is_kept(void **state)
{
    qdot_expr x = p.symbol[5], e = qdot_div(p.pool, x, QDOT_ZERO);

    (void)state;
    assert_int_equal(e, QDOT_NIL);
    assert_true(qdot_pool_failed(p.pool));
    e = qdot_add(p.pool, e, x);
    e = qdot_fun1(p.pool, QDOT_SIN, qdot_mul(p.pool, e, qdot_neg(p.pool, e)));
    assert_int_equal(qdot_vector(p.pool, 2, (qdot_expr[]){e, x}), QDOT_NIL);
    assert_int_equal(qdot_diff(p.pool, e, x), QDOT_NIL);
    assert_int_equal(qdot_subs(p.pool, e, 1, &x, &e), QDOT_NIL);
    assert_int_equal(qdot_expand(p.pool, e), QDOT_NIL);
    assert_int_equal(qdot_coefficient(p.pool, e, x, 0), QDOT_NIL);
    assert_int_equal(qdot_symbol_jet(p.pool, e, 1), QDOT_NIL);
    /* a second cause does not hide the first */
    assert_int_equal(qdot_fun1(p.pool, QDOT_LOG, QDOT_ZERO), QDOT_NIL);
    (void)qdot_fail(QDOT_EIO, "something else");
    assert_int_equal(qdot_pool_fail(p.pool), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
    assert_string_equal(qdot_last_error()->message, "division by zero");
    /* and is forgotten: the pool works again */
    assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
    assert_int_equal(qdot_sub(p.pool, x, x), QDOT_ZERO);
}

static void
a_budget_bounds_the_work(void **state)
{
    qdot_expr e = p.symbol[5];
    uint64_t before = qdot_pool_budget(p.pool, 1000);
    int i = 0;

    (void)state;
    assert_true(before == UINT64_MAX);
    for (; i < 5000 && e != QDOT_NIL; i++)
        e = qdot_add(p.pool, qdot_fun1(p.pool, QDOT_SIN, e), p.symbol[0]);
    assert_true(i >= 100 && i <= 1001);
    assert_int_equal(qdot_pool_budget(p.pool, UINT64_MAX), 0);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ELIMIT);
    assert_int_not_equal(qdot_fun1(p.pool, QDOT_COS, p.symbol[5]), QDOT_NIL);
}

static void
an_interrupt_stops_and_leaves_the_pool_sound(void **state)
{
    qdot_expr x = p.symbol[5], e = qdot_fun1(p.pool, QDOT_SIN, x);
    qdot_text out = {0};

    (void)state;
    qdot_interrupt_set();
    assert_int_equal(qdot_diff(p.pool, e, x), QDOT_NIL);
    assert_int_equal(qdot_print(p.pool, e, QDOT_PLAIN, &out), QDOT_EINTR);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EINTR);
    qdot_interrupt_clear();
    qdot_text_clear(&out);
    assert_prints(p.pool, qdot_diff(p.pool, e, x), "cos(x)");
}

static void
jets_count_on(void **state)
{
    qdot_expr x = p.symbol[5], v = p.symbol[6], a = qdot_symbol_jet(p.pool, v, 1);

    (void)state;
    assert_int_equal(qdot_symbol_jet(p.pool, x, 2), a);
    assert_int_equal(qdot_symbol_jet(p.pool, x, 0), x);
    assert_string_equal(qdot_expr_symbol(p.pool, a)->name, "x''");
    assert_int_equal(qdot_expr_symbol(p.pool, a)->base, x);
    assert_int_equal(qdot_expr_node(p.pool, a)->holds, QDOT_HAS_ACCELERATION);
    assert_int_equal(qdot_expr_node(p.pool, v)->holds, QDOT_HAS_VELOCITY);
    assert_true(qdot_expr_is_coordinate(p.pool, x) &&
                !qdot_expr_is_coordinate(p.pool, v));
    assert_int_equal(qdot_symbol_jet(p.pool, p.symbol[0], 1), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
}

static void
symbols_of_a_coordinate_are_named_after_it(void **state)
{
    qdot_expr theta = p.symbol[7];

    (void)state;
    assert_prints(p.pool, qdot_symbol_of(p.pool, QDOT_DIFFERENTIAL, theta), "dtheta");
    assert_prints(p.pool, qdot_symbol_of(p.pool, QDOT_DIFFERENTIAL, QDOT_T), "dt");
    assert_prints(p.pool, qdot_symbol_of(p.pool, QDOT_MOMENTUM, theta), "p[theta]");
    assert_prints(p.pool, qdot_symbol_of(p.pool, QDOT_DELTA, theta), "delta[theta]");
    assert_int_equal(qdot_symbol_of(p.pool, QDOT_MOMENTUM, QDOT_T), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
}

static void
classes_are_name_spaces(void **state)
{
    qdot_expr param = qdot_symbol_get(p.pool, QDOT_PARAM, "q");
    qdot_expr formal = qdot_symbol_get(p.pool, QDOT_FORMAL, "q");

    (void)state;
    assert_int_not_equal(param, formal);
    assert_int_equal(qdot_symbol_get(p.pool, QDOT_PARAM, "q"), param);
    assert_true(qdot_expr_is_class(p.pool, formal, QDOT_FORMAL));
    assert_int_equal(qdot_sub(p.pool, param, formal) == QDOT_ZERO, 0);
}

static void
functions_are_declared_once(void **state)
{
    qdot_expr s = qdot_symbol_get(p.pool, QDOT_FORMAL, "s"), st[] = {s, QDOT_T};
    uint32_t f, g, h;

    (void)state;
    assert_int_equal(qdot_ufun_declare(p.pool, "x", 1, &s, &f), QDOT_OK);
    assert_int_equal(qdot_ufun_declare(p.pool, "x", 1, &s, &g), QDOT_OK);
    assert_int_equal(qdot_ufun_declare(p.pool, "x", 2, st, &h), QDOT_OK);
    assert_int_equal(f, g);
    assert_int_not_equal(f, h);
    assert_int_equal(qdot_ufun_get(p.pool, h)->arity, 2);
    assert_int_equal(qdot_ufun_apply(p.pool, h, (qdot_expr[]){s, QDOT_TRUE}, NULL),
                     QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
}

static void
relations_of_numbers_are_decided(void **state)
{
    qdot_expr x = p.symbol[5], open = qdot_rel(p.pool, QDOT_LT, x, QDOT_ONE), both;

    (void)state;
    assert_int_equal(qdot_rel(p.pool, QDOT_LE, QDOT_ONE, QDOT_ONE), QDOT_TRUE);
    assert_int_equal(qdot_rel(p.pool, QDOT_LT, QDOT_ONE, QDOT_ONE), QDOT_FALSE);
    assert_int_equal(
        qdot_expr_kind(p.pool, qdot_rel(p.pool, QDOT_EQ, QDOT_ONE, QDOT_ONE)), QDOT_REL);
    both = qdot_logic(p.pool, QDOT_AND, 2, (qdot_expr[]){open, QDOT_TRUE});
    assert_int_equal(both, open);
    both = qdot_logic(p.pool, QDOT_OR, 2, (qdot_expr[]){open, QDOT_TRUE});
    assert_int_equal(both, QDOT_TRUE);
    assert_int_equal(qdot_logic(p.pool, QDOT_NOT, 1, &both), QDOT_FALSE);
    assert_int_equal(qdot_logic(p.pool, QDOT_AND, 2, (qdot_expr[]){x, open}), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
}

/* A little of everything. */
static qdot_status
workload(qdot_pool *pool)
{
    qdot_expr m = qdot_symbol_get(pool, QDOT_PARAM, "mass"), x, theta, s, e, many[6],
              from[6], to[6];
    qdot_text out = {0};
    uint32_t f;
    qdot_status status;

    qdot_symbol_domain(pool, m, QDOT_ZERO, true, QDOT_NIL, false);
    x = qdot_symbol_get(pool, QDOT_COORD, "x");
    theta = qdot_symbol_get(pool, QDOT_COORD, "theta");
    s = qdot_symbol_get(pool, QDOT_FORMAL, "s");
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_ufun_declare(pool, "f", 1, &s, &f));
    for (int i = 0; i < 6; i++) {
        many[i] = qdot_mul(
            pool, qdot_expr_ratio(pool, i + 1, 7),
            qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, qdot_expr_int(pool, i + 1), theta)));
        from[i] = many[i];
        to[i] = qdot_pow_int(pool, x, i);
    }
    from[0] = x;
    e = qdot_mul(pool, qdot_sum(pool, 6, many), qdot_sqrt(pool, qdot_mul(pool, m, x)));
    e = qdot_add(pool, e, qdot_mul(pool, qdot_product(pool, 6, many), QDOT_HALF));
    e = qdot_add(pool, e, qdot_ufun_apply(pool, f, &theta, NULL));
    e = qdot_ddt(pool, e);
    e = qdot_subs(pool, e, 6, from, to);
    e = qdot_expand(pool, qdot_mul(pool, e, qdot_pow_int(pool, qdot_add(pool, x, m), 2)));
    e = qdot_collect(pool, e, m);
    e = qdot_value_mul(pool, e, qdot_vector(pool, 6, many));
    e = qdot_list(pool, 2, (qdot_expr[]){e, qdot_symbol_of(pool, QDOT_DIFFERENTIAL, x)});
    e = qdot_list(pool, 2, (qdot_expr[]){e, qdot_expr_atoms(pool, e, true)});
    e = qdot_list(pool, 2, (qdot_expr[]){e, qdot_expr_decimal(pool, "3.14159", 7)});
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_print(pool, e, QDOT_UNICODE, &out);
    qdot_text_clear(&out);
    return status;
}

/* Every allocation fails once: the answer is QDOT_ENOMEM, the pool can be freed, and until then
 * used. */
static void
no_memory_is_told_wherever_it_happens(void **state)
{
    int64_t n = 0;
    bool passed = false;

    (void)state;
    for (; !passed && n < 100000; n++) {
        qdot_pool *pool;
        qdot_status status = QDOT_ENOMEM;

        qdot_memory_fail_at(n);
        pool = qdot_pool_new();
        if (pool != NULL)
            status = workload(pool);
        qdot_memory_fail_at(-1);
        if (status != QDOT_OK && status != QDOT_ENOMEM)
            fail_msg("call %" PRId64 ": %d, %s", n, status, qdot_last_error()->message);
        passed = status == QDOT_OK;
        if (pool != NULL) {
            qdot_expr x = qdot_symbol_get(pool, QDOT_COORD, "x");

            assert_int_equal(qdot_pool_check(pool), QDOT_OK);
            assert_int_equal(qdot_diff(pool, qdot_pow_int(pool, x, 2), x),
                             qdot_mul(pool, qdot_expr_int(pool, 2), x));
        }
        qdot_pool_free(pool);
    }
    assert_true(passed && n > 100);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(first_ids_are_the_constants),
        TEST(built_alike_is_the_same_id),
        TEST(numbers_stay_where_they_are),
        TEST(numbers_are_interned_by_value),
        TEST(children_have_smaller_ids),
        TEST(nil_absorbs_and_the_first_cause_is_kept),
        TEST(a_budget_bounds_the_work),
        TEST(an_interrupt_stops_and_leaves_the_pool_sound),
        TEST(jets_count_on),
        TEST(symbols_of_a_coordinate_are_named_after_it),
        TEST(classes_are_name_spaces),
        TEST(functions_are_declared_once),
        TEST(relations_of_numbers_are_decided),
        cmocka_unit_test(no_memory_is_told_wherever_it_happens),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
