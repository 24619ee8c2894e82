/* test_product.c -- products, powers and roots: what is taken out, what is refused. */
#include "expr/kit.h"

static qdot_expr
power(qdot_expr b, int64_t n, int64_t d)
{
    return qdot_pow(p.pool, b, number(n, d));
}

static void
a_root_of_a_square_is_an_absolute_value(void **state)
{
    qdot_expr x = p.symbol[5], m = p.symbol[2], n = p.symbol[3], k = p.symbol[4];

    (void)state;
    assert_prints(p.pool, qdot_sqrt(p.pool, power(x, 2, 1)), "abs(x)");
    assert_int_equal(qdot_sqrt(p.pool, power(m, 2, 1)), m);
    assert_int_equal(qdot_sqrt(p.pool, power(k, 2, 1)), k);
    assert_int_equal(qdot_sqrt(p.pool, power(n, 2, 1)), qdot_neg(p.pool, n));
    assert_int_equal(qdot_sqrt(p.pool, times(number(4, 1), power(n, 2, 1))),
                     times(number(-2, 1), n));
    assert_int_equal(qdot_sqrt(p.pool, power(x, 4, 1)), power(x, 2, 1));
    assert_int_equal(power(qdot_sqrt(p.pool, x), 2, 1), x);
    assert_int_equal(qdot_sqrt(p.pool, qdot_sqrt(p.pool, x)), power(x, 1, 4));
    assert_prints(p.pool, qdot_sqrt(p.pool, times(m, x)), "sqrt(m*x)");
    assert_prints(p.pool, qdot_sqrt(p.pool, times(p.symbol[0], p.symbol[1])),
                  "sqrt(a*b)");
}

static void
powers_of_products_settle(void **state)
{
    qdot_expr ab = times(p.symbol[0], p.symbol[1]);

    (void)state;
    assert_int_equal(power(times(number(3, 1), qdot_sqrt(p.pool, number(2, 1))), 2, 1),
                     number(18, 1));
    assert_int_equal(power(times(number(2, 1), qdot_sqrt(p.pool, ab)), 2, 1),
                     times(number(4, 1), ab));
    assert_int_equal(power(power(ab, 3, 1), 2, 1), power(ab, 6, 1));
    assert_int_equal(times(power(ab, 3, 1), power(ab, -3, 1)), QDOT_ONE);
}

static void
roots_of_numbers_have_one_form(void **state)
{
    qdot_expr two = number(2, 1), root2 = qdot_sqrt(p.pool, two);

    (void)state;
    assert_prints(p.pool, qdot_sqrt(p.pool, number(8, 1)), "2*sqrt(2)");
    assert_prints(p.pool, qdot_sqrt(p.pool, QDOT_HALF), "1/2*sqrt(2)");
    assert_int_equal(power(number(4, 1), 1, 4), root2);
    assert_int_equal(power(number(8, 1), 2, 3), number(4, 1));
    assert_int_equal(power(number(8, 27), -2, 3), number(9, 4));
    assert_int_equal(times(root2, qdot_sqrt(p.pool, number(6, 1))),
                     times(two, qdot_sqrt(p.pool, number(3, 1))));
    assert_int_equal(qdot_product(p.pool, 4, (qdot_expr[]){root2, root2, root2, root2}),
                     number(4, 1));
    assert_int_equal(power(power(number(12, 1), 1, 4), 2, 1),
                     qdot_sqrt(p.pool, number(12, 1)));
    /* a product of two primes past 64 bits, times 4: only the 4 is seen */
    assert_prints(
        p.pool,
        qdot_sqrt(p.pool, times(number(4, 1), times(number(4611686018427387847, 1),
                                                    number(4611686018427387817, 1)))),
        "2*sqrt(21267647932558653302378126310941659999)");
}

static void
odd_roots_end(void **state)
{
    qdot_expr big = qdot_pow_int(p.pool, number(3, 1), 3000),
              e = power(number(2, 1), 3, 10007);

    (void)state;
    assert_prints(p.pool, e, "2^(3/10007)");
    assert_int_equal(qdot_pow_int(p.pool, e, 10007), number(8, 1));
    e = power(big, 7, 9973);
    assert_int_equal(qdot_pow_int(p.pool, e, 9973), qdot_pow_int(p.pool, big, 7));
    assert_int_equal(
        times(power(number(2, 1), 10006, 10007), power(number(2, 1), 1, 10007)),
        number(2, 1));
}

static void
exponentials_are_one(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], ex = qdot_fun1(p.pool, QDOT_EXP, x);

    (void)state;
    assert_int_equal(times(ex, qdot_fun1(p.pool, QDOT_EXP, qdot_neg(p.pool, x))),
                     QDOT_ONE);
    assert_prints(p.pool, times(ex, qdot_fun1(p.pool, QDOT_EXP, a)), "exp(x + a)");
    assert_prints(p.pool, qdot_div(p.pool, a, ex), "a*exp(-x)");
    assert_int_equal(times(power(a, 2, 1), qdot_pow(p.pool, a, x)),
                     qdot_pow(p.pool, a, qdot_add(p.pool, x, number(2, 1))));
}

static void
numbers_have_a_limit(void **state)
{
    qdot_expr ten = number(10, 1), big, e;
    char *digits = malloc(1000002);

    (void)state;
    refuses(qdot_pow(p.pool, ten, qdot_pow_int(p.pool, ten, 10)), QDOT_ELIMIT);
    refuses(qdot_pow(p.pool, ten, qdot_pow_int(p.pool, ten, 30)), QDOT_ELIMIT);
    refuses(qdot_pow(p.pool, number(-3, 7), qdot_pow_int(p.pool, ten, 10)), QDOT_ELIMIT);
    big = qdot_pow_int(p.pool, ten, 600000);
    refuses(times(big, big), QDOT_ELIMIT);
    refuses(times(times(big, p.symbol[5]), times(big, p.symbol[0])), QDOT_ELIMIT);
    refuses(qdot_pow_int(p.pool, times(big, p.symbol[5]), 2), QDOT_ELIMIT);
    e = times(big, qdot_pow_int(p.pool, ten, -600000));
    assert_int_equal(e, QDOT_ONE);
    /* unity has powers of any height */
    assert_int_equal(qdot_pow(p.pool, QDOT_MINUS_ONE, qdot_pow_int(p.pool, ten, 30)),
                     QDOT_ONE);
    memset(digits, '7', 1000001);
    assert_int_not_equal(qdot_expr_decimal(p.pool, digits, 1000000), QDOT_NIL);
    refuses(qdot_expr_decimal(p.pool, digits, 1000001), QDOT_ELIMIT);
    refuses(qdot_expr_decimal(p.pool, "1e1000001", 9), QDOT_ELIMIT);
    free(digits);
}

static void
decimals_are_exact(void **state)
{
    (void)state;
    assert_int_equal(qdot_expr_decimal(p.pool, "9.81", 4), number(981, 100));
    assert_int_equal(qdot_expr_decimal(p.pool, "1e-3", 4), number(1, 1000));
    assert_int_equal(qdot_expr_decimal(p.pool, "2.50E+2", 7), number(250, 1));
    assert_int_equal(qdot_expr_decimal(p.pool, "007", 3), number(7, 1));
    assert_prints(p.pool, times(qdot_expr_decimal(p.pool, "9.81", 4), p.symbol[2]),
                  "9.81*m");
}

static void
what_is_undefined_is_refused(void **state)
{
    qdot_expr x = p.symbol[5];

    (void)state;
    refuses(qdot_div(p.pool, QDOT_ONE, QDOT_ZERO), QDOT_EDOMAIN);
    refuses(qdot_pow_int(p.pool, QDOT_ZERO, -1), QDOT_EDOMAIN);
    refuses(power(QDOT_ZERO, -1, 2), QDOT_EDOMAIN);
    refuses(qdot_div(p.pool, x, qdot_sub(p.pool, x, x)), QDOT_EDOMAIN);
    refuses(qdot_sqrt(p.pool, QDOT_MINUS_ONE), QDOT_EDOMAIN);
    refuses(power(number(-8, 1), 1, 3), QDOT_EDOMAIN);
    refuses(qdot_sqrt(p.pool, times(number(-2, 1), p.symbol[2])), QDOT_EDOMAIN);
    refuses(qdot_expr_ratio(p.pool, 1, 0), QDOT_EDOMAIN);
    /* real where x is 0 */
    assert_int_not_equal(qdot_sqrt(p.pool, qdot_neg(p.pool, power(x, 2, 1))), QDOT_NIL);
    assert_int_equal(power(QDOT_ZERO, 1, 2), QDOT_ZERO);
}

static void
only_numbers_multiply(void **state)
{
    qdot_expr v = qdot_vector(p.pool, 2, (qdot_expr[]){QDOT_ONE, QDOT_ONE}),
              x = p.symbol[5];

    (void)state;
    refuses(times(v, x), QDOT_ETYPE);
    refuses(times(QDOT_ONE, v), QDOT_ETYPE);
    refuses(qdot_pow(p.pool, v, x), QDOT_ETYPE);
    refuses(qdot_add(p.pool, x, QDOT_TRUE), QDOT_ETYPE);
    refuses(qdot_add(p.pool, QDOT_ZERO, v), QDOT_ETYPE);
}

/* 1 + a or one of a - b, b - a ... */
static qdot_expr
difference(uint32_t i, uint32_t j)
{
    return i == j ? qdot_add(p.pool, p.symbol[i], QDOT_ONE)
                  : qdot_sub(p.pool, p.symbol[i], p.symbol[j]);
}

static void
differences_meet_whichever_way_they_stand(void **state)
{
    qdot_expr ab = difference(0, 1), ba = difference(1, 0), x = p.symbol[5];

    (void)state;
    assert_int_equal(times(ab, ba), qdot_neg(p.pool, power(ab, 2, 1)));
    assert_int_equal(power(ab, 2, 1), power(ba, 2, 1));
    assert_int_equal(qdot_div(p.pool, ab, ba), QDOT_MINUS_ONE);
    assert_int_equal(times(times(x, ba), ab),
                     qdot_neg(p.pool, times(x, power(ab, 2, 1))));
    assert_prints(p.pool, times(x, ba), "(b - a)*x");
    assert_int_equal(times(times(x, ba), qdot_sqrt(p.pool, ba)),
                     times(x, power(ba, 3, 2)));
}

/* Products of powers of numbers and symbols, in any order and grouping. */
static void
products_are_canonical(void **state)
{
    (void)state;
    for (int trial = 0; trial < 2000; trial++) {
        qdot_expr e[12], first = QDOT_NIL;
        int n = 2 + (int)random_below(11);

        for (int i = 0; i < n; i++) {
            uint32_t what = random_below(4);
            uint32_t first_symbol = random_below(3), second_symbol = random_below(3);
            qdot_expr base =
                what == 0   ? number(1 + (int64_t)random_below(9), 1 + (int64_t)random_below(4))
                : what == 1 ? difference(first_symbol, second_symbol)
                            : p.symbol[random_below(SYMBOLS)];

            e[i] = power(base, (int64_t)random_below(9) - 4,
                         what == 3 && base == p.symbol[2] ? 2 : 1);
            if (what == 0 && random_below(2))
                e[i] = qdot_sqrt(p.pool, e[i]);
            /* a - b and b - a cannot both have a root */
            if (what == 1 && first_symbol >= second_symbol && random_below(4) == 0)
                e[i] = power(base, 2 * (int64_t)random_below(3) - 1, 2);
        }
        for (int again = 0; again < 4; again++) {
            qdot_expr product = QDOT_ONE;

            for (int i = n - 1; i > 0; i--) {
                int j = (int)random_below((uint32_t)i + 1);
                qdot_expr swap = e[i];

                e[i] = e[j];
                e[j] = swap;
            }
            if (again % 2)
                product = qdot_product(p.pool, (size_t)n, e);
            for (int i = 0; again % 2 == 0 && i < n; i++)
                product = times(product, e[i]);
            assert_true(again == 0 || product == first);
            first = product;
        }
    }
    assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_root_of_a_square_is_an_absolute_value),
        TEST(powers_of_products_settle),
        TEST(roots_of_numbers_have_one_form),
        TEST(odd_roots_end),
        TEST(exponentials_are_one),
        TEST(numbers_have_a_limit),
        TEST(decimals_are_exact),
        TEST(what_is_undefined_is_refused),
        TEST(only_numbers_multiply),
        TEST(differences_meet_whichever_way_they_stand),
        TEST(products_are_canonical),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
