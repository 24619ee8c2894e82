/* test_expand.c -- multiplying out, collecting, coefficients. */
#include "expr/kit.h"

/* Whether a product in e holds a sum, or a whole power of one. */
static bool
holds_brackets(qdot_expr e)
{
    qdot_walk w;
    bool found = false;
    int64_t k;

    assert_int_equal(qdot_walk_begin(p.pool, e, &w), QDOT_OK);
    for (size_t i = 0; i < w.n; i++)
        for (uint32_t n = 1; n < qdot_expr_count(p.pool, w.at[i]); n += 2)
            found |=
                qdot_expr_kind(p.pool, w.at[i]) == QDOT_PROD &&
                qdot_expr_kind(p.pool, qdot_expr_arg(p.pool, w.at[i], n)) == QDOT_SUM &&
                qdot_expr_to_int(p.pool, qdot_expr_arg(p.pool, w.at[i], n + 1), &k) &&
                k > 0;
    qdot_walk_end(&w);
    return found;
}

static void
expanding_keeps_the_value_and_leaves_no_brackets(void **state)
{
    int compared = 0;

    (void)state;
    for (int trial = 0; trial < 4000; trial++) {
        formula f = formula_random(4 + (int)random_below(9), RATIONAL);
        qdot_expr e = formula_build(&f, &p), flat = qdot_expand(p.pool, e);
        long double v[STEPS], wanted;
        bool fine = true;

        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        assert_false(holds_brackets(flat));
        assert_int_equal(qdot_expand(p.pool, flat), flat);
        place_move(&p);
        wanted = formula_value(&f, &p, v);
        for (int i = 0; i < f.n; i++)
            fine &= isfinite(v[i]);
        if (!fine)
            continue;
        if (!near(node_value(&p, flat, NULL), wanted, 1e-6L))
            fail_msg("%s from %s", text_of(p.pool, flat, QDOT_PLAIN),
                     text_of(p.pool, e, QDOT_PLAIN));
        compared++;
    }
    assert_true(compared > 500);
}

static void
binomials_are_multiplied_out(void **state)
{
    qdot_expr sum = qdot_add(p.pool, p.symbol[0], p.symbol[1]), e;

    (void)state;
    e = qdot_expand(p.pool, qdot_pow_int(p.pool, sum, 3));
    assert_prints(p.pool, e, "a^3 + b^3 + 3*a*b^2 + 3*a^2*b");
    e = qdot_expand(p.pool, qdot_pow_int(p.pool, sum, 40));
    assert_int_equal(qdot_expr_count(p.pool, e), 1 + 2 * 41);
    e = qdot_expand(p.pool, qdot_div(p.pool, sum, qdot_pow_int(p.pool, sum, 2)));
    assert_prints(p.pool, e, "1/(a + b)");
    e = qdot_expand(p.pool, qdot_mul(p.pool, qdot_expr_int(p.pool, 2), sum));
    assert_prints(p.pool, e, "2*a + 2*b");
}

static void
what_would_be_too_long_is_refused(void **state)
{
    qdot_expr sum = qdot_sum(p.pool, SYMBOLS, p.symbol);

    (void)state;
    assert_int_equal(qdot_expand(p.pool, qdot_pow_int(p.pool, sum, 1000)), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ELIMIT);
}

static void
collecting_sorts_by_powers(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], b = p.symbol[1], e;

    (void)state;
    e = qdot_mul(p.pool, qdot_add(p.pool, x, a),
                 qdot_add(p.pool, qdot_mul(p.pool, x, b), QDOT_ONE));
    e = qdot_collect(p.pool, e, x);
    assert_prints(p.pool, e, "b*x^2 + (a*b + 1)*x + a");
    e = qdot_collect(p.pool, qdot_rel(p.pool, QDOT_EQ, e, qdot_mul(p.pool, a, x)), x);
    assert_prints(p.pool, e, "b*x^2 + (a*b + 1)*x + a = a*x");
}

static void
coefficients_rebuild_the_polynomial(void **state)
{
    qdot_expr x = p.symbol[5];

    (void)state;
    for (int trial = 0; trial < 300; trial++) {
        qdot_expr c[5], e = QDOT_ZERO;

        for (int i = 0; i < 5; i++) {
            c[i] = qdot_mul(p.pool, qdot_expr_int(p.pool, (int64_t)random_below(5) - 2),
                            p.symbol[random_below(3)]);
            e = qdot_add(p.pool, e, qdot_mul(p.pool, c[i], qdot_pow_int(p.pool, x, i)));
        }
        for (int i = 0; i < 5; i++)
            assert_int_equal(qdot_coefficient(p.pool, e, x, i), c[i]);
        assert_int_equal(qdot_coefficient(p.pool, e, x, 5), QDOT_ZERO);
    }
}

static void
what_is_no_polynomial_has_no_coefficients(void **state)
{
    qdot_expr x = p.symbol[5], e[3];

    (void)state;
    e[0] = qdot_fun1(p.pool, QDOT_SIN, x);
    e[1] = qdot_sqrt(p.pool, x);
    e[2] = qdot_add(p.pool, x, qdot_pow_int(p.pool, x, -1));
    for (int i = 0; i < 3; i++) {
        assert_int_equal(qdot_coefficient(p.pool, e[i], x, 1), QDOT_NIL);
        assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(expanding_keeps_the_value_and_leaves_no_brackets),
        TEST(binomials_are_multiplied_out),
        TEST(what_would_be_too_long_is_refused),
        TEST(collecting_sorts_by_powers),
        TEST(coefficients_rebuild_the_polynomial),
        TEST(what_is_no_polynomial_has_no_coefficients),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
