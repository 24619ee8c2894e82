/* test_walk.c -- passes over expressions, and the count of operations. */
#include "expr/kit.h"

static void
every_reachable_node_stands_once_children_first(void **state)
{
    (void)state;
    for (int trial = 0; trial < 500; trial++) {
        formula f = formula_random(STEPS, 0);
        qdot_expr e = formula_build(&f, &p);
        qdot_walk w;

        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        assert_int_equal(qdot_walk_begin(p.pool, e, &w), QDOT_OK);
        assert_int_equal(w.at[w.n - 1], e);
        for (size_t i = 0; i < w.n; i++) {
            assert_true(i == 0 || w.at[i - 1] < w.at[i]);
            assert_int_equal(qdot_walk_index(&w, w.at[i]), i);
            assert_int_equal(w.value[i], 0);
            for (uint32_t k = 0; k < qdot_expr_count(p.pool, w.at[i]); k++)
                assert_true(qdot_walk_index(&w, qdot_expr_arg(p.pool, w.at[i], k)) < i);
        }
        assert_true(qdot_walk_index(&w, QDOT_NIL) == SIZE_MAX);
        qdot_walk_end(&w);
    }
}

static void
a_walk_from_several_roots_is_their_union(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], roots[] = {x, QDOT_NIL, a, x};
    qdot_walk w;

    (void)state;
    assert_int_equal(qdot_walk_begin_n(p.pool, 4, roots, &w), QDOT_OK);
    assert_int_equal(w.n, 2);
    qdot_walk_set(&w, x, 7);
    assert_int_equal(qdot_walk_get(&w, x), 7);
    qdot_walk_end(&w);
    assert_int_equal(qdot_walk_begin(p.pool, QDOT_NIL, &w), QDOT_OK);
    assert_int_equal(w.n, 0);
    qdot_walk_end(&w);
}

static void
by_height_each_node_stands_behind_lower_ones(void **state)
{
    (void)state;
    for (int trial = 0; trial < 500; trial++) {
        formula f = formula_random(STEPS, 0), g = formula_random(STEPS, 0);
        qdot_expr roots[] = {formula_build(&f, &p), QDOT_NIL, formula_build(&g, &p)};
        qdot_walk w, all;
        uint64_t last = 0;

        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        assert_int_equal(qdot_walk_begin_n(p.pool, 3, roots, &all), QDOT_OK);
        assert_int_equal(qdot_walk_begin_by_height(p.pool, 3, roots, &w), QDOT_OK);
        assert_int_equal(w.n, all.n);
        for (size_t i = 0; i < w.n; i++) {
            uint64_t height = 0;

            assert_true(qdot_walk_index(&all, w.at[i]) != SIZE_MAX);
            assert_int_equal(qdot_walk_index(&w, w.at[i]), i);
            assert_int_equal(w.value[i], 0);
            for (uint32_t k = 0; k < qdot_expr_count(p.pool, w.at[i]); k++) {
                const uint64_t child =
                    qdot_walk_get(&all, qdot_expr_arg(p.pool, w.at[i], k));

                height = child >= height ? child + 1 : height;
            }
            qdot_walk_set(&all, w.at[i], height);
            assert_true(height >= last);
            last = height;
        }
        qdot_walk_end(&w);
        qdot_walk_end(&all);
    }
}

/* A sum of products of functions, which are made forwards or backwards. */
static qdot_expr
sum_made(place *at, bool backwards)
{
    enum { TERMS = SYMBOLS * 4 };
    static const qdot_fun_id function[] = {QDOT_SIN, QDOT_TANH, QDOT_EXP, QDOT_COS};
    qdot_expr sum = QDOT_ZERO;

    for (int i = 0; i < TERMS; i++) {
        int k = backwards ? TERMS - 1 - i : i;
        qdot_expr x = at->symbol[k / 4], y = at->symbol[(k / 4 + k % 4 + 1) % SYMBOLS];
        qdot_expr f = qdot_fun1(at->pool, function[k % 4], x);

        sum = qdot_add(at->pool, sum, qdot_mul(at->pool, f, qdot_mul(at->pool, y, f)));
    }
    return sum;
}

static void
by_height_it_does_not_matter_when_nodes_were_made(void **state)
{
    place other;
    qdot_walk a, b;
    int moved = 0;

    (void)state;
    place_open(&other);
    assert_int_equal(
        qdot_walk_begin_by_height(p.pool, 1, (qdot_expr[]){sum_made(&p, false)}, &a),
        QDOT_OK);
    assert_int_equal(
        qdot_walk_begin_by_height(other.pool, 1, (qdot_expr[]){sum_made(&other, true)}, &b),
        QDOT_OK);
    assert_int_equal(a.n, b.n);
    for (size_t i = 0; i < a.n; i++) {
        assert_string_equal(text_of(p.pool, a.at[i], QDOT_PLAIN),
                            text_of(other.pool, b.at[i], QDOT_PLAIN));
        for (size_t k = 0; k < i; k++)
            moved += (a.at[k] < a.at[i]) != (b.at[k] < b.at[i]);
    }
    assert_true(moved > 100);
    qdot_walk_end(&a);
    qdot_walk_end(&b);
    place_close(&other);
}

static void
contains_agrees_with_the_walk(void **state)
{
    (void)state;
    for (int trial = 0; trial < 500; trial++) {
        formula f = formula_random(STEPS, 0);
        qdot_expr e = formula_build(&f, &p),
                  x = 1 + random_below((uint32_t)qdot_pool_count(p.pool) - 1);
        qdot_walk w;

        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        if (trial % 2)
            x = p.symbol[random_below(SYMBOLS)];
        assert_int_equal(qdot_walk_begin(p.pool, e, &w), QDOT_OK);
        assert_int_equal(qdot_expr_contains(p.pool, e, x),
                         qdot_walk_index(&w, x) != SIZE_MAX);
        assert_int_equal(qdot_expr_contains_any(p.pool, e, 2, (qdot_expr[]){QDOT_NIL, x}), qdot_expr_contains(p.pool, e, x));
        assert_int_equal(qdot_expr_is_in_any(p.pool, x, 2, (qdot_expr[]){QDOT_NIL, e}), qdot_expr_contains(p.pool, e, x));
        qdot_walk_end(&w);
    }
    assert_false(qdot_expr_contains_any(p.pool, p.symbol[0], 0, NULL));
    {
        const qdot_expr a = p.symbol[0], b = p.symbol[1], sine = qdot_fun1(p.pool, QDOT_SIN, qdot_mul(p.pool, a, a)),
                        e = qdot_add(p.pool, b, qdot_mul(p.pool, b, sine));

        assert_true(qdot_expr_has_function_of(p.pool, e, 2, (qdot_expr[]){b, a}));
        assert_false(qdot_expr_has_function_of(p.pool, e, 1, &b));
        assert_false(qdot_expr_has_function_of(p.pool, qdot_mul(p.pool, a, b), 2, (qdot_expr[]){a, b}));
        assert_false(qdot_expr_has_function_of(p.pool, QDOT_NIL, 1, &a));
    }
}

static void
atoms_stand_in_canonical_order(void **state)
{
    qdot_expr x = p.symbol[5], e = qdot_mul(p.pool, p.symbol[6], x), s = x;
    uint32_t f;

    (void)state;
    e = qdot_add(p.pool, e,
                 qdot_mul(p.pool, qdot_mul(p.pool, QDOT_PI, p.symbol[1]), p.symbol[0]));
    assert_prints(p.pool, qdot_expr_atoms(p.pool, e, true), "[a, b, x, x']");
    assert_int_equal(qdot_ufun_declare(p.pool, "f", 1, &s, &f), QDOT_OK);
    e = qdot_ufun_apply(p.pool, f, &s, NULL);
    assert_prints(p.pool, qdot_expr_atoms(p.pool, e, true), "[x, f(x)]");
    assert_prints(p.pool, qdot_expr_atoms(p.pool, e, false), "[x]");
}

static void
operations_are_counted(void **state)
{
    qdot_pool *pool = p.pool;
    qdot_expr x = p.symbol[5], a = p.symbol[0], b = p.symbol[1], m = p.symbol[2], two;
    qdot_expr v = p.symbol[6];

    (void)state;
    two = qdot_expr_int(pool, 2);
    const struct {
        qdot_expr e;
        uint64_t size;
    } rows[] = {
        {x, 0},
        {two, 0},
        {QDOT_HALF, 1},
        {qdot_neg(pool, x), 1},
        {qdot_pow_int(pool, x, -1), 1},
        {qdot_pow_int(pool, x, 2), 1},
        {qdot_pow_int(pool, x, -2), 2},
        {qdot_sqrt(pool, x), 1},
        {qdot_pow(pool, x, qdot_expr_ratio(pool, 3, 2)), 1},
        {qdot_pow(pool, x, qdot_expr_ratio(pool, 2, 3)), 1},
        {qdot_pow(pool, x, a), 1},
        {qdot_div(pool, a, b), 1},
        {qdot_mul(pool, a, b), 1},
        {qdot_add(pool, a, b), 1},
        {qdot_sub(pool, a, b), 1},
        {qdot_sub(pool, qdot_neg(pool, a), b), 2},
        {qdot_sub(pool, QDOT_ONE, a), 1},
        {qdot_mul(pool, two, x), 1},
        {qdot_mul(pool, qdot_expr_ratio(pool, 3, 2), x), 2},
        {qdot_div(pool, QDOT_ONE, qdot_mul(pool, a, b)), 2},
        {qdot_div(pool, QDOT_MINUS_ONE, a), 2},
        {qdot_mul(pool, QDOT_HALF, qdot_mul(pool, m, qdot_pow_int(pool, v, 2))), 3},
        {qdot_fun1(pool, QDOT_SIN, qdot_add(pool, a, x)), 2},
        {qdot_vector(pool, 2,
                     (qdot_expr[]){qdot_add(pool, a, x), qdot_mul(pool, two, x)}),
         2},
        {qdot_rel(pool, QDOT_EQ, qdot_add(pool, a, x), QDOT_ZERO), 1},
        {QDOT_NIL, 0},
    };

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (qdot_expr_size(pool, rows[i].e) != rows[i].size)
            fail_msg("%s has %d operations, not %d", text_of(pool, rows[i].e, QDOT_PLAIN),
                     (int)qdot_expr_size(pool, rows[i].e), (int)rows[i].size);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(every_reachable_node_stands_once_children_first),
        TEST(a_walk_from_several_roots_is_their_union),
        TEST(by_height_each_node_stands_behind_lower_ones),
        TEST(by_height_it_does_not_matter_when_nodes_were_made),
        TEST(contains_agrees_with_the_walk),
        TEST(atoms_stand_in_canonical_order),
        TEST(operations_are_counted),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
