/* test_dimensions.c -- dimensions inferred from expressions; contradictions leave no trace; groups by their rank. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "dimensions/dimensions.h"
#include "expr/expr.h"

static qdot_pool *pool;
static qdot_dimensions *d;

static int
open_pool(void **state)
{
    (void)state;
    pool = qdot_pool_new();
    d = qdot_dimensions_new(pool, NULL, NULL);
    return d == NULL;
}

static int
close_pool(void **state)
{
    (void)state;
    qdot_dimensions_free(d);
    qdot_pool_free(pool);
    return 0;
}

static qdot_expr
param(const char *name)
{
    return qdot_symbol_get(pool, QDOT_PARAM, name);
}

static qdot_expr
coord(const char *name)
{
    return qdot_symbol_get(pool, QDOT_COORD, name);
}

static void
fix(qdot_expr e, int m, int kg, int s)
{
    const int exponent[QDOT_BASES] = {m, kg, s};

    assert_int_equal(qdot_dimensions_fix(d, e, qdot_dimension_make(exponent), "%s, not %s"), QDOT_OK);
}

static void
is(qdot_expr e, const char *words)
{
    qdot_text text = {0};

    qdot_dimensions_words(d, e, &text);
    assert_string_equal(qdot_text_str(&text), words);
    qdot_text_clear(&text);
}

/* L = m x'^2/2 - k x^2/2 + F x */
static void
a_lagrangian_tells_the_rest(void **state)
{
    const qdot_expr m = param("m"), k = param("k"), F = param("F"), x = coord("x"), two = qdot_expr_int(pool, 2);
    const qdot_expr v = qdot_symbol_jet(pool, x, 1);
    const qdot_expr L = qdot_add(pool, qdot_mul(pool, F, x),
                                 qdot_sub(pool, qdot_mul(pool, m, qdot_pow(pool, v, two)),
                                          qdot_mul(pool, k, qdot_pow(pool, x, two))));

    (void)state;
    assert_int_equal(qdot_dimensions_visit(d, L), QDOT_OK);
    fix(m, 0, 1, 0);
    is(k, "a stiffness");
    fix(x, 1, 0, 0);
    is(F, "a force");
    is(L, "an energy");
    is(qdot_symbol_of(pool, QDOT_MOMENTUM, x), "a momentum");
    is(qdot_symbol_jet(pool, x, 2), "an acceleration");
}

static void
a_contradiction_is_told_and_leaves_no_trace(void **state)
{
    const qdot_expr m = param("m"), g = param("g"), l = param("l"), f = qdot_mul(pool, m, g);
    size_t rank;

    (void)state;
    fix(m, 0, 1, 0);
    fix(g, 1, 0, -2);
    fix(l, 1, 0, 0);
    rank = qdot_dimensions_rank(d);
    assert_int_equal(qdot_dimensions_join(d, f, l, "%s is added to %s"), QDOT_ETYPE);
    assert_string_equal(qdot_last_error()->message, "a force is added to a length");
    assert_int_equal(qdot_dimensions_visit(d, qdot_fun1(pool, QDOT_SIN, l)), QDOT_ETYPE);
    assert_string_equal(qdot_last_error()->message, "the argument of sin is a length, not a number");
    assert_int_equal(qdot_dimensions_rank(d), rank);
    is(f, "a force");
}

static void
zero_has_every_dimension(void **state)
{
    const qdot_expr l = param("l");

    (void)state;
    fix(l, 1, 0, 0);
    assert_int_equal(qdot_dimensions_join(d, l, QDOT_ZERO, "%s %s"), QDOT_OK);
    assert_int_equal(qdot_dimensions_join(d, l, QDOT_ONE, "%s %s"), QDOT_ETYPE);
}

static void
roots_have_rational_exponents(void **state)
{
    const qdot_expr l = param("l"), g = param("g");

    (void)state;
    fix(l, 1, 0, 0);
    fix(qdot_pow(pool, qdot_div(pool, l, g), QDOT_HALF), 0, 0, 1);
    is(g, "an acceleration");
    is(qdot_pow(pool, l, QDOT_HALF), "a quantity in m^(1/2)");
}

/* if(x > y, x, -y) + z: x, y and z are of one dimension. */
static void
the_sides_of_a_condition_are_of_one_dimension(void **state)
{
    const qdot_expr x = coord("x"), y = coord("y"), z = coord("z");
    const qdot_expr larger[] = {qdot_rel(pool, QDOT_LT, y, x), x, qdot_neg(pool, y)};
    const qdot_expr smaller[] = {qdot_rel(pool, QDOT_LT, x, param("m")), x, y};

    (void)state;
    fix(z, 1, 0, 0);
    fix(param("m"), 0, 1, 0);
    assert_int_equal(qdot_dimensions_visit(d, qdot_add(pool, qdot_fun(pool, QDOT_IF, 3, larger), z)), QDOT_OK);
    is(x, "a length");
    is(y, "a length");
    assert_int_equal(qdot_dimensions_visit(d, qdot_fun(pool, QDOT_IF, 3, smaller)), QDOT_ETYPE);
    assert_string_equal(qdot_last_error()->message, "a length is compared with a mass");
}

/* Random monomials: every group has no dimension, and there are n - rank of them (by floating elimination). */
static void
groups_are_a_basis(void **state)
{
    (void)state;
    srand(38);
    for (int trial = 0; trial < 200; trial++) {
        enum { MOST = 8 };
        const size_t n = 1 + (size_t)rand() % MOST;
        qdot_expr x[MOST];
        int exponent[MOST][QDOT_BASES] = {{0}};
        double a[3][MOST];
        size_t count, rank = 0;
        int32_t *power;

        qdot_dimensions_free(d);
        d = qdot_dimensions_new(pool, NULL, NULL);
        for (size_t i = 0; i < n; i++) {
            char name[16];

            snprintf(name, sizeof name, "x%zu", i);
            x[i] = param(name);
            for (int b = 0; b < 3; b++)
                a[b][i] = exponent[i][b] = rand() % 7 - 3;
            assert_int_equal(qdot_dimensions_fix(d, x[i], qdot_dimension_make(exponent[i]), "%s %s"), QDOT_OK);
        }
        for (size_t k = 0; k < n && rank < 3; k++) {
            size_t row = rank;

            while (row < 3 && a[row][k] * a[row][k] < 1e-9)
                row++;
            if (row == 3)
                continue;
            for (size_t i = 0; i < n; i++) {
                const double swap = a[row][i];

                a[row][i] = a[rank][i];
                a[rank][i] = swap;
            }
            for (size_t r = rank + 1; r < 3; r++) {
                const double factor = a[r][k] / a[rank][k];

                for (size_t i = 0; i < n; i++)
                    a[r][i] -= factor * a[rank][i];
            }
            rank++;
        }
        assert_int_equal(qdot_dimensions_groups(d, n, x, &count, &power), QDOT_OK);
        assert_int_equal(count, n - rank);
        for (size_t k = 0; k < count; k++)
            for (int b = 0; b < 3; b++) {
                int64_t sum = 0;

                for (size_t i = 0; i < n; i++)
                    sum += (int64_t)power[k * n + i] * exponent[i][b];
                assert_int_equal(sum, 0);
            }
        qdot_free(power);
    }
}

int
main(void)
{
#define TEST(t) cmocka_unit_test_setup_teardown(t, open_pool, close_pool)
    const struct CMUnitTest tests[] = {
        TEST(a_lagrangian_tells_the_rest), TEST(a_contradiction_is_told_and_leaves_no_trace),
        TEST(zero_has_every_dimension),    TEST(roots_have_rational_exponents),
        TEST(the_sides_of_a_condition_are_of_one_dimension), TEST(groups_are_a_basis),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
