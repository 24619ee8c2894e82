/* test_tensor.c -- vectors, matrices, equations: algebra, shapes, entries. */
#include "expr/kit.h"

static qdot_expr
matrix(uint32_t rows, uint32_t columns)
{
    qdot_expr entry[36];

    for (uint32_t i = 0; i < rows * columns; i++)
        entry[i] = random_below(3) == 0
                       ? qdot_expr_int(p.pool, (int64_t)random_below(9) - 4)
                       : qdot_add(p.pool, p.symbol[random_below(SYMBOLS)],
                                  qdot_expr_int(p.pool, (int64_t)random_below(4)));
    return qdot_matrix(p.pool, rows, columns, entry);
}

static long double
entry(qdot_expr m, int64_t i, int64_t j)
{
    return node_value(&p, qdot_entry2(p.pool, m, i, j), NULL);
}

/* By elimination with pivots, in long double. */
static long double
determinant(qdot_expr m, int n)
{
    long double a[6][6], d = 1;

    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            a[i][j] = entry(m, i + 1, j + 1);
    for (int k = 0; k < n; k++) {
        int best = k;

        for (int i = k; i < n; i++)
            if (fabsl(a[i][k]) > fabsl(a[best][k]))
                best = i;
        if (a[best][k] == 0)
            return 0;
        for (int j = 0; j < n && best != k; j++) {
            long double swap = a[k][j];

            a[k][j] = a[best][j];
            a[best][j] = swap;
        }
        d *= best == k ? a[k][k] : -a[k][k];
        for (int i = k + 1; i < n; i++)
            for (int j = n - 1; j >= k; j--)
                a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    }
    return d;
}

static void
determinants_agree_with_elimination(void **state)
{
    (void)state;
    for (int trial = 0; trial < 60; trial++) {
        int n = 1 + (int)random_below(5);
        qdot_expr m = matrix((uint32_t)n, (uint32_t)n);

        assert_true(
            near(node_value(&p, qdot_det(p.pool, m), NULL), determinant(m, n), 1e-11L));
        assert_int_equal(qdot_det(p.pool, qdot_transpose(p.pool, m)) != QDOT_NIL, 1);
    }
}

static void
an_inverse_times_its_matrix_is_one(void **state)
{
    (void)state;
    for (int trial = 0; trial < 40; trial++) {
        int n = 2 + (int)random_below(3);
        qdot_expr m = matrix((uint32_t)n, (uint32_t)n), one;

        if (fabsl(determinant(m, n)) < 1e-3L)
            continue;
        one = qdot_value_mul(p.pool, m, qdot_value_pow(p.pool, m, QDOT_MINUS_ONE));
        assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
        for (int i = 1; i <= n; i++)
            for (int j = 1; j <= n; j++)
                assert_true(near(entry(one, i, j), i == j, 1e-9L));
    }
}

static void
products_agree_with_their_sums(void **state)
{
    qdot_expr a = matrix(3, 4), b = matrix(4, 2), ab = qdot_value_mul(p.pool, a, b);

    (void)state;
    for (int i = 1; i <= 3; i++)
        for (int j = 1; j <= 2; j++) {
            long double sum = 0;

            for (int k = 1; k <= 4; k++)
                sum += entry(a, i, k) * entry(b, k, j);
            assert_true(near(entry(ab, i, j), sum, 1e-12L));
        }
    assert_int_equal(qdot_value_pow(p.pool, matrix(1, 1), QDOT_ZERO),
                     qdot_matrix(p.pool, 1, 1, (qdot_expr[]){QDOT_ONE}));
}

static void
cross_products_are_perpendicular(void **state)
{
    qdot_expr u = qdot_vector(p.pool, 3, p.symbol),
              v = qdot_vector(p.pool, 3, p.symbol + 3), c;

    (void)state;
    c = qdot_cross(p.pool, u, v);
    assert_int_equal(qdot_expand(p.pool, qdot_dot(p.pool, c, u)), QDOT_ZERO);
    assert_int_equal(qdot_expand(p.pool, qdot_dot(p.pool, c, v)), QDOT_ZERO);
    u = qdot_vector(p.pool, 2, p.symbol);
    v = qdot_vector(p.pool, 2, p.symbol + 2);
    assert_prints(p.pool, qdot_cross(p.pool, u, v), "a*n - b*m");
    assert_int_equal(qdot_value_sub(p.pool, u, u),
                     qdot_vector(p.pool, 2, (qdot_expr[]){1, 1}));
}

static void
norms_are_lengths(void **state)
{
    qdot_expr m = p.symbol[2], x = p.symbol[5];
    qdot_expr v =
        qdot_vector(p.pool, 2,
                    (qdot_expr[]){qdot_mul(p.pool, qdot_expr_int(p.pool, 3), m),
                                  qdot_mul(p.pool, qdot_expr_int(p.pool, 4), m)});

    (void)state;
    assert_int_equal(qdot_norm(p.pool, v), qdot_mul(p.pool, qdot_expr_int(p.pool, 5), m));
    assert_prints(p.pool, qdot_norm(p.pool, x), "abs(x)");
}

static void
equations_are_worked_on_side_by_side(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], e = qdot_value_equation(p.pool, x, a), u,
              v;

    (void)state;
    assert_prints(p.pool, qdot_value_add(p.pool, e, e), "2*x = 2*a");
    assert_prints(p.pool, qdot_value_div(p.pool, e, a), "x/a = 1");
    assert_prints(p.pool, qdot_value_sub(p.pool, e, a), "x - a = 0");
    u = qdot_vector(p.pool, 2, (qdot_expr[]){x, a});
    v = qdot_vector(p.pool, 2, (qdot_expr[]){QDOT_ONE, x});
    assert_prints(p.pool, qdot_value_equation(p.pool, u, v), "(x, a) = (1, x)");
}

static void
shapes_that_differ_are_refused(void **state)
{
    qdot_expr two = qdot_vector(p.pool, 2, p.symbol),
              three = qdot_vector(p.pool, 3, p.symbol);
    qdot_expr m = matrix(2, 3), x = p.symbol[5];

    (void)state;
    refuses(qdot_value_add(p.pool, two, three), QDOT_ETYPE);
    assert_string_equal(qdot_last_error()->message,
                        "cannot add vectors of 2 and 3 components");
    refuses(qdot_value_add(p.pool, two, x), QDOT_ETYPE);
    refuses(qdot_value_mul(p.pool, two, two), QDOT_ETYPE);
    assert_string_equal(qdot_last_error()->hint, "dot(u, v) or cross(u, v)");
    refuses(qdot_value_mul(p.pool, m, two), QDOT_ETYPE);
    refuses(qdot_value_mul(p.pool, m, m), QDOT_ETYPE);
    refuses(qdot_value_div(p.pool, x, two), QDOT_ETYPE);
    refuses(qdot_value_pow(p.pool, m, qdot_expr_int(p.pool, 2)), QDOT_ETYPE);
    refuses(qdot_dot(p.pool, two, three), QDOT_ETYPE);
    refuses(qdot_cross(p.pool, two, three), QDOT_ETYPE);
    refuses(qdot_det(p.pool, m), QDOT_ETYPE);
    refuses(qdot_det(p.pool, x), QDOT_ETYPE);
    refuses(qdot_vector(p.pool, 1, &x), QDOT_ETYPE);
    refuses(qdot_vector(p.pool, 2, (qdot_expr[]){two, x}), QDOT_ETYPE);
    refuses(qdot_inverse(p.pool, qdot_matrix(p.pool, 2, 2, (qdot_expr[]){x, x, x, x})),
            QDOT_ESINGULAR);
}

static void
entries_are_counted_from_one(void **state)
{
    qdot_expr v = qdot_vector(p.pool, 3, p.symbol), m = matrix(2, 3);
    qdot_expr row = qdot_matrix(p.pool, 1, 3, p.symbol);

    (void)state;
    assert_int_equal(qdot_entry(p.pool, v, 3), p.symbol[2]);
    assert_int_equal(qdot_entry(p.pool, row, 2), p.symbol[1]);
    assert_int_equal(qdot_entry(p.pool, qdot_entry(p.pool, m, 2), 3),
                     qdot_entry2(p.pool, m, 2, 3));
    refuses(qdot_entry(p.pool, v, 0), QDOT_EDOMAIN);
    refuses(qdot_entry(p.pool, v, 4), QDOT_EDOMAIN);
    refuses(qdot_entry(p.pool, m, 4294967297), QDOT_EDOMAIN);
    refuses(qdot_entry2(p.pool, m, 3, 1), QDOT_EDOMAIN);
    refuses(qdot_entry2(p.pool, m, 1, -1), QDOT_EDOMAIN);
    refuses(qdot_entry(p.pool, p.symbol[5], 1), QDOT_ETYPE);
}

static qdot_expr
squared(qdot_pool *pool, qdot_expr e, void *user)
{
    ++*(int *)user;
    return qdot_pow_int(pool, e, 2);
}

static void
maps_reach_every_scalar(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], e;
    int calls = 0;

    (void)state;
    e = qdot_list(p.pool, 2,
                  (qdot_expr[]){qdot_rel(p.pool, QDOT_EQ, x, a),
                                qdot_vector(p.pool, 2, (qdot_expr[]){a, QDOT_ONE})});
    assert_prints(p.pool, qdot_value_map(p.pool, e, squared, &calls),
                  "[x^2 = a^2, (a^2, 1)]");
    assert_int_equal(calls, 4);
    e = qdot_list(p.pool, 0, NULL);
    assert_int_equal(qdot_value_map(p.pool, e, squared, &calls), e);
    /* lists within lists, deeper than any C stack */
    for (int i = 0; i < 300000; i++)
        e = qdot_list(p.pool, 1, &e);
    assert_int_equal(qdot_value_map(p.pool, e, squared, &calls), e);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        MOVED_TEST(determinants_agree_with_elimination),
        MOVED_TEST(an_inverse_times_its_matrix_is_one),
        MOVED_TEST(products_agree_with_their_sums),
        MOVED_TEST(cross_products_are_perpendicular),
        MOVED_TEST(norms_are_lengths),
        MOVED_TEST(equations_are_worked_on_side_by_side),
        MOVED_TEST(shapes_that_differ_are_refused),
        MOVED_TEST(entries_are_counted_from_one),
        MOVED_TEST(maps_reach_every_scalar),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
