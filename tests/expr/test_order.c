/* test_order.c -- the canonical order is a total order; signs are sound. */
#include "expr/kit.h"

/* Random expressions, some that share a shape: undefined functions beside elementary ones. */
static qdot_expr
any(uint32_t function)
{
    formula f = formula_random(3 + (int)random_below(12), 0);
    qdot_expr e = formula_build(&f, &p);

    if (qdot_pool_check(p.pool) != QDOT_OK)
        return any(function);
    switch (random_below(8)) {
    case 0: return qdot_ufun_apply(p.pool, function, &e, (uint32_t[]){random_below(3)});
    case 1: return qdot_fun(p.pool, QDOT_ATAN2, 2, (qdot_expr[]){e, p.symbol[5]});
    case 2: return 1 + random_below((uint32_t)qdot_pool_count(p.pool) - 1);
    default: return e;
    }
}

static int
sign_of(int d)
{
    return (d > 0) - (d < 0);
}

static void
comparison_is_a_total_order(void **state)
{
    uint32_t function = 0, unused;

    (void)state;
    /* an undefined function of the same number as atan2 has */
    for (int i = 0; i <= QDOT_ATAN2; i++)
        assert_int_equal(qdot_ufun_declare(p.pool, (char[]){(char)('A' + i), '\0'}, 1,
                                           &p.symbol[5],
                                           i == QDOT_ATAN2 ? &function : &unused),
                         QDOT_OK);
    assert_int_equal(function, QDOT_ATAN2);
    for (int trial = 0; trial < 20000; trial++) {
        qdot_expr a = any(function), b = any(function), c = any(function);
        int ab = qdot_expr_compare(p.pool, a, b), bc = qdot_expr_compare(p.pool, b, c);

        assert_int_equal(ab == 0, a == b);
        assert_int_equal(sign_of(ab), -sign_of(qdot_expr_compare(p.pool, b, a)));
        if (ab <= 0 && bc <= 0)
            assert_true(qdot_expr_compare(p.pool, a, c) <= 0);
    }
}

/* atan2(x, 0) and an undefined function of the same number, whose order of derivative is 0: the
 * same args. Built either way round, among other nodes. */
static void
an_undefined_function_is_no_elementary_one(void **state)
{
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        qdot_expr x, a = QDOT_NIL, b = QDOT_NIL;
        uint32_t function = 0;

        close_place(state);
        open_place(state);
        x = p.symbol[5];
        for (int i = 0; i <= QDOT_ATAN2; i++)
            assert_int_equal(qdot_ufun_declare(p.pool, (char[]){(char)('A' + i), '\0'}, 1,
                                               &x, &function),
                             QDOT_OK);
        for (int i = 0; i < 2; i++)
            if (i == turn)
                a = qdot_fun(p.pool, QDOT_ATAN2, 2, (qdot_expr[]){x, QDOT_ZERO});
            else
                b = qdot_ufun_apply(p.pool, function, &x, NULL);
        assert_true(qdot_expr_compare(p.pool, a, b) < 0);
        assert_true(qdot_expr_compare(p.pool, b, a) > 0);
        assert_prints(p.pool, qdot_add(p.pool, b, a), "atan2(x, 0) + J(x)");
    }
}

static void
factors_and_terms_stand_as_in_a_book(void **state)
{
    qdot_expr a = p.symbol[0], m = p.symbol[2], x = p.symbol[5], v = p.symbol[6], e;
    qdot_expr acceleration = qdot_symbol_jet(p.pool, x, 2);

    (void)state;
    e = qdot_product(p.pool, 5, (qdot_expr[]){v, x, QDOT_T, m, QDOT_PI});
    assert_prints(p.pool, e, "pi*m*t*x*x'");
    e = qdot_sum(p.pool, 4, (qdot_expr[]){a, x, v, acceleration});
    assert_prints(p.pool, e, "x'' + x' + x + a");
    e = qdot_sum(p.pool, 3, (qdot_expr[]){QDOT_ONE, x, qdot_pow_int(p.pool, x, 2)});
    assert_prints(p.pool, e, "x^2 + x + 1");
    e = qdot_mul(p.pool, qdot_pow_int(p.pool, m, 2), qdot_add(p.pool, a, p.symbol[1]));
    assert_prints(p.pool, e, "(a + b)*m^2");
}

static uint8_t
sign(qdot_expr e)
{
    return qdot_expr_node(p.pool, e)->sign;
}

static void
signs_follow_from_domains(void **state)
{
    qdot_expr m = p.symbol[2], n = p.symbol[3], k = p.symbol[4], x = p.symbol[5];
    qdot_expr theta = p.symbol[7], alpha = p.symbol[8];

    (void)state;
    assert_int_equal(sign(m), QDOT_POS);
    assert_int_equal(sign(n), QDOT_NEG);
    assert_int_equal(sign(k), QDOT_GE0);
    assert_int_equal(sign(x), 0);
    assert_int_equal(sign(QDOT_ZERO), QDOT_GE0 | QDOT_LE0);
    assert_int_equal(sign(qdot_mul(p.pool, m, n)), QDOT_NEG);
    assert_int_equal(sign(qdot_add(p.pool, m, k)), QDOT_POS);
    assert_int_equal(sign(qdot_sub(p.pool, n, k)), QDOT_NEG);
    assert_int_equal(sign(qdot_pow_int(p.pool, x, 2)), QDOT_GE0);
    assert_int_equal(sign(qdot_add(p.pool, qdot_pow_int(p.pool, x, 2), QDOT_ONE)),
                     QDOT_POS);
    assert_int_equal(sign(qdot_fun1(p.pool, QDOT_SIN, theta)), QDOT_POS);
    assert_int_equal(sign(qdot_fun1(p.pool, QDOT_COS, alpha)), QDOT_GE0);
    assert_int_equal(sign(qdot_fun1(p.pool, QDOT_COS, theta)), 0);
    assert_int_equal(sign(qdot_fun1(p.pool, QDOT_EXP, x)), QDOT_POS);
    assert_int_equal(sign(qdot_sqrt(p.pool, m)), QDOT_POS);
}

static void
no_sign_is_claimed_that_a_point_refutes(void **state)
{
    int claimed = 0;

    (void)state;
    for (int trial = 0; trial < 20000; trial++) {
        formula f = formula_random(3 + (int)random_below(15), 0);
        qdot_expr e = formula_build(&f, &p);

        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        for (int where = 0; where < 5; where++) {
            bool claims = true;

            place_move(&p);
            (void)node_value(&p, e, &claims);
            if (!claims)
                fail_msg("%s", text_of(p.pool, e, QDOT_PLAIN));
        }
        claimed += sign(e) != 0;
    }
    assert_true(claimed > 2000);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(comparison_is_a_total_order),
        TEST(an_undefined_function_is_no_elementary_one),
        TEST(factors_and_terms_stand_as_in_a_book),
        TEST(signs_follow_from_domains),
        TEST(no_sign_is_claimed_that_a_point_refutes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
