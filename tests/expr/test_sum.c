/* test_sum.c -- sums: like terms, order, and random formulas against their values. */
#include "expr/spec.h"

static void
every_constructor_keeps_the_value(void **state)
{
    place p;
    int compared = 0, refused = 0;

    (void)state;
    place_open(&p);
    for (int trial = 0; trial < 30000; trial++) {
        formula f = formula_random(4 + (int)random_below(STEPS - 4), 0);
        qdot_expr e = formula_build(&f, &p);
        qdot_status status = qdot_pool_check(p.pool);

        for (int where = 0; where < 3; where++) {
            long double v[STEPS], wanted, seen;
            bool claims = true, steps = true;

            place_move(&p);
            wanted = formula_value(&f, &p, v);
            for (int i = 0; i < f.n; i++)
                steps &= isfinite(v[i]);
            if (status != QDOT_OK) {
                /* refused as a whole: some step has no value anywhere */
                assert_true(status == QDOT_EDOMAIN || status == QDOT_ELIMIT);
                if (steps) {
                    formula_show(&f, v);
                    fail_msg("refused: %s", qdot_last_error()->message);
                }
                refused++;
                continue;
            }
            if (!steps)
                continue;
            seen = node_value(&p, e, &claims);
            if (!near(seen, wanted, 1e-9L))
                fail_msg("%s is %.18Lg, not %.18Lg", text_of(p.pool, e, QDOT_PLAIN), seen,
                         wanted);
            if (!claims)
                fail_msg("%s: a sign is claimed that it has not",
                         text_of(p.pool, e, QDOT_PLAIN));
            compared++;
        }
    }
    assert_true(compared > 5000 && refused > 100);
    place_close(&p);
}

/* A sum of products of the symbols, terms and factors in a shuffled order and grouping. */
static qdot_expr
shuffled(const place *p, int n, const int *factors, bool shuffle)
{
    qdot_expr terms[16];

    for (int i = 0; i < n; i++) {
        qdot_expr e[4];

        for (int k = 0; k < 4; k++)
            e[k] = factors[4 * i + k] < SYMBOLS
                       ? p->symbol[factors[4 * i + k]]
                       : qdot_expr_ratio(p->pool, factors[4 * i + k] - SYMBOLS - 2, 3);
        for (int k = 3; shuffle && k > 0; k--) {
            int j = (int)random_below((uint32_t)k + 1);
            qdot_expr swap = e[k];

            e[k] = e[j];
            e[j] = swap;
        }
        terms[i] = shuffle && random_below(2)
                       ? qdot_mul(p->pool, qdot_mul(p->pool, e[0], e[1]),
                                  qdot_mul(p->pool, e[2], e[3]))
                       : qdot_product(p->pool, 4, e);
    }
    for (int i = n - 1; shuffle && i > 0; i--) {
        int j = (int)random_below((uint32_t)i + 1);
        qdot_expr swap = terms[i];

        terms[i] = terms[j];
        terms[j] = swap;
    }
    if (shuffle && random_below(2)) {
        qdot_expr sum = QDOT_ZERO;

        for (int i = 0; i < n; i++)
            sum = random_below(2) ? qdot_add(p->pool, sum, terms[i])
                                  : qdot_add(p->pool, terms[i], sum);
        return sum;
    }
    return qdot_sum(p->pool, (size_t)n, terms);
}

static void
order_of_building_does_not_matter(void **state)
{
    place p;

    (void)state;
    place_open(&p);
    for (int trial = 0; trial < 2000; trial++) {
        int factors[64], n = 1 + (int)random_below(16);
        qdot_expr e;

        for (int i = 0; i < 4 * n; i++)
            factors[i] = (int)random_below(SYMBOLS + 5);
        e = shuffled(&p, n, factors, false);
        for (int again = 0; again < 4; again++)
            assert_int_equal(shuffled(&p, n, factors, true), e);
    }
    assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
    place_close(&p);
}

/* 300 terms in any order, many of them alike: the long way of sorting. */
static void
long_sums_are_canonical_too(void **state)
{
    place p;
    qdot_expr term[300], first = QDOT_NIL, chain = QDOT_ZERO;

    (void)state;
    place_open(&p);
    for (int i = 0; i < 300; i++)
        term[i] = qdot_mul(p.pool, qdot_expr_int(p.pool, i % 7 - 3),
                           qdot_mul(p.pool, qdot_pow_int(p.pool, p.symbol[0], 1 + i % 97),
                                    p.symbol[i % 3]));
    for (int trial = 0; trial < 20; trial++) {
        qdot_expr e;

        for (int i = 299; i > 0; i--) {
            int j = (int)random_below((uint32_t)i + 1);
            qdot_expr swap = term[i];

            term[i] = term[j];
            term[j] = swap;
        }
        e = qdot_sum(p.pool, 300, term);
        assert_true(trial == 0 || e == first);
        first = e;
    }
    for (int i = 0; i < 300; i++)
        chain = qdot_add(p.pool, chain, term[i]);
    assert_int_equal(chain, first);
    place_close(&p);
}

static void
like_terms_meet(void **state)
{
    place p;
    qdot_expr x, y, two, e;

    (void)state;
    place_open(&p);
    x = p.symbol[5];
    y = p.symbol[7];
    two = qdot_expr_int(p.pool, 2);
    assert_int_equal(qdot_add(p.pool, x, x), qdot_mul(p.pool, two, x));
    assert_int_equal(qdot_sub(p.pool, x, x), QDOT_ZERO);
    e = qdot_mul(p.pool, two, qdot_add(p.pool, x, y));
    assert_prints(p.pool, e, "2*(x + theta)");
    assert_prints(p.pool, qdot_sub(p.pool, e, x), "x + 2*theta");
    assert_int_equal(qdot_add(p.pool, e, QDOT_ZERO), e);
    assert_int_equal(qdot_sum(p.pool, 3, (qdot_expr[]){QDOT_ZERO, e, QDOT_ZERO}), e);
    assert_int_equal(qdot_sum(p.pool, 0, NULL), QDOT_ZERO);
    place_close(&p);
}

static void
the_negative_of_a_sum_is_a_sum(void **state)
{
    place p;
    qdot_expr d, e;

    (void)state;
    place_open(&p);
    d = qdot_sub(p.pool, p.symbol[5], p.symbol[7]);
    e = qdot_sub(p.pool, p.symbol[7], p.symbol[5]);
    assert_int_equal(qdot_neg(p.pool, d), e);
    assert_int_equal(qdot_neg(p.pool, e), d);
    assert_int_equal(
        qdot_mul(p.pool, qdot_expr_int(p.pool, -2), qdot_mul(p.pool, QDOT_HALF, d)), e);
    place_close(&p);
}

/* sum (1 + sin(k x))/k + 1/d: its exact bounds are fractions of a thousand digits, which are not carried on. */
static void
bounds_of_long_sums_are_short_and_sound(void **state)
{
    enum { TERMS = 3000 };
    static qdot_expr term[2 * TERMS + 1];
    const int64_t d[] = {1000000000, -1000000000};

    (void)state;
    for (int i = 0; i < 2; i++) {
        place p;
        qdot_expr e;

        place_open(&p);
        for (int64_t k = 1; k <= TERMS; k++) {
            qdot_expr kx = qdot_mul(p.pool, qdot_expr_int(p.pool, k), p.symbol[5]);

            term[2 * k - 2] = qdot_expr_ratio(p.pool, 1, k);
            term[2 * k - 1] = qdot_mul(p.pool, term[2 * k - 2], qdot_fun1(p.pool, QDOT_SIN, kx));
        }
        term[2 * TERMS] = qdot_expr_ratio(p.pool, d[i] < 0 ? -1 : 1, llabs(d[i]));
        e = qdot_sum(p.pool, 2 * TERMS + 1, term);
        assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
        assert_int_equal(qdot_expr_node(p.pool, e)->sign, d[i] > 0 ? QDOT_GE0 | QDOT_NE0 : 0);
        place_close(&p);
    }
}

/* 0 < x < pi: pi - x > 0; 2 x < 7, but 2 x - 6 may have either sign; asin(y) + pi/2 >= 0. */
static void
bounds_that_are_multiples_of_pi_are_exact(void **state)
{
    place p;
    qdot_expr x, e;

    (void)state;
    place_open(&p);
    x = qdot_symbol_get(p.pool, QDOT_PARAM, "angle");
    qdot_symbol_domain(p.pool, x, QDOT_ZERO, true, QDOT_PI, true);
    e = qdot_sub(p.pool, QDOT_PI, x);
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_GE0 | QDOT_NE0);
    e = qdot_sub(p.pool, x, QDOT_PI);
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_LE0 | QDOT_NE0);
    e = qdot_add(p.pool, qdot_add(p.pool, x, x), qdot_expr_int(p.pool, -7));
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_LE0 | QDOT_NE0); /* 2 pi < 7 */
    e = qdot_add(p.pool, qdot_add(p.pool, x, x), qdot_expr_int(p.pool, -6));
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, 0);
    e = qdot_add(p.pool, qdot_fun1(p.pool, QDOT_ASIN, p.symbol[5]), qdot_div(p.pool, QDOT_PI, qdot_expr_int(p.pool, 2)));
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_GE0);
    place_close(&p);
}

/* b > a > 0: b - a > 0, b - 2 a may have either sign, a - b < 0, b + a > 0. */
static void
a_symbol_is_bounded_by_another(void **state)
{
    place p;
    qdot_expr a, b, e;

    (void)state;
    place_open(&p);
    a = qdot_symbol_get(p.pool, QDOT_PARAM, "inner");
    b = qdot_symbol_get(p.pool, QDOT_PARAM, "outer");
    qdot_symbol_domain(p.pool, a, QDOT_ZERO, true, QDOT_NIL, false);
    qdot_symbol_domain(p.pool, b, a, true, QDOT_NIL, false);
    e = qdot_sub(p.pool, b, a);
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_GE0 | QDOT_NE0);
    e = qdot_sub(p.pool, a, b);
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_LE0 | QDOT_NE0);
    e = qdot_sub(p.pool, e, a);
    assert_int_equal(qdot_expr_node(p.pool, e)->sign & QDOT_GE0, 0); /* -b */
    e = qdot_sub(p.pool, b, qdot_add(p.pool, a, a));
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, 0);
    e = qdot_sub(p.pool, qdot_add(p.pool, b, b), a);
    assert_int_equal(qdot_expr_node(p.pool, e)->sign, QDOT_GE0 | QDOT_NE0);
    place_close(&p);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_constructor_keeps_the_value),
        cmocka_unit_test(order_of_building_does_not_matter),
        cmocka_unit_test(long_sums_are_canonical_too),
        cmocka_unit_test(like_terms_meet),
        cmocka_unit_test(bounds_of_long_sums_are_short_and_sound),
        cmocka_unit_test(bounds_that_are_multiples_of_pi_are_exact),
        cmocka_unit_test(a_symbol_is_bounded_by_another),
        cmocka_unit_test(the_negative_of_a_sum_is_a_sum),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
