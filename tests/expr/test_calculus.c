/* test_calculus.c -- derivatives against differences, substitution against evaluation. */
#include "expr/kit.h"

static qdot_expr
symbol(int i)
{
    return p.symbol[i];
}

/* f at value[k] + h. */
static long double
moved_value(const formula *f, int k, long double h)
{
    long double v[STEPS], kept = p.value[k], value;

    p.value[k] += h;
    value = formula_value(f, &p, v);
    for (int i = 0; i < f->n; i++)
        if (!isfinite(v[i]))
            value = NAN;
    p.value[k] = kept;
    return value;
}

static void
derivatives_are_limits_of_differences(void **state)
{
    int compared = 0;

    (void)state;
    for (int trial = 0; trial < 20000; trial++) {
        formula f = formula_random(4 + (int)random_below(10), SMOOTH);
        qdot_expr e = formula_build(&f, &p), d;
        int k = (int)random_below(SYMBOLS);
        const long double h = 1e-4L;
        long double near4, near2, near1, wanted, seen;

        d = qdot_diff(p.pool, e, symbol(k));
        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        place_move(&p);
        near4 = (moved_value(&f, k, 4 * h) - moved_value(&f, k, -4 * h)) / (8 * h);
        near2 = (moved_value(&f, k, 2 * h) - moved_value(&f, k, -2 * h)) / (4 * h);
        near1 = (moved_value(&f, k, h) - moved_value(&f, k, -h)) / (2 * h);
        wanted = (4 * near1 - near2) / 3;
        /* only where the differences have converged themselves */
        if (!near(wanted, (4 * near2 - near4) / 3, 1e-9L))
            continue;
        seen = node_value(&p, d, NULL);
        if (isnan(seen))
            continue;
        if (!near(seen, wanted, 1e-7L))
            fail_msg("d/d%s %s is %.12Lg, not %.12Lg",
                     text_of(p.pool, symbol(k), QDOT_PLAIN),
                     text_of(p.pool, e, QDOT_PLAIN), seen, wanted);
        compared++;
    }
    assert_true(compared > 3000);
}

static void
substitution_is_evaluation_elsewhere(void **state)
{
    int compared = 0;

    (void)state;
    for (int trial = 0; trial < 5000; trial++) {
        static const int free_symbols[] = {0, 1, 5, 6};
        formula f = formula_random(4 + (int)random_below(12), 0),
                g = formula_random(5, SMOOTH);
        qdot_expr e = formula_build(&f, &p), to[2], from[2];
        long double v[STEPS], at, wanted, seen, kept;
        int k = free_symbols[random_below(4)], other = free_symbols[random_below(4)];
        bool fine = true;

        to[0] = formula_build(&g, &p);
        to[1] = symbol(k);
        from[0] = symbol(k);
        from[1] = symbol(other);
        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        e = qdot_subs(p.pool, e, k == other ? 1 : 2, from, to);
        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        place_move(&p);
        seen = node_value(&p, e, NULL);
        at = formula_value(&g, &p, v);
        for (int i = 0; i < g.n; i++)
            fine &= isfinite(v[i]);
        kept = p.value[k];
        p.value[k] = at;
        if (k != other)
            p.value[other] = kept; /* all at once: other gets the old value of k */
        wanted = formula_value(&f, &p, v);
        for (int i = 0; i < f.n; i++)
            fine &= isfinite(v[i]);
        if (!fine)
            continue;
        if (!near(seen, wanted, 1e-9L))
            fail_msg("%s is %.18Lg, not %.18Lg", text_of(p.pool, e, QDOT_PLAIN), seen,
                     wanted);
        compared++;
    }
    assert_true(compared > 500);
}

static void
many_replacements_are_as_one_by_one(void **state)
{
    qdot_expr e = QDOT_ZERO, from[SYMBOLS], to[SYMBOLS], wanted = QDOT_ZERO;

    (void)state;
    for (int i = 0; i < SYMBOLS; i++) {
        from[i] = symbol(i);
        to[i] = qdot_fun1(p.pool, QDOT_COSH, symbol((i + 1) % SYMBOLS));
        e = qdot_add(p.pool, e, qdot_pow_int(p.pool, from[i], i + 2));
        wanted = qdot_add(p.pool, wanted, qdot_pow_int(p.pool, to[i], i + 2));
    }
    assert_int_equal(qdot_subs(p.pool, e, SYMBOLS, from, to), wanted);
}

static void
what_a_substitution_undefines_is_told(void **state)
{
    qdot_expr x = symbol(5), e = qdot_pow_int(p.pool, x, -1), zero = QDOT_ZERO;

    (void)state;
    assert_int_equal(qdot_subs(p.pool, e, 1, &x, &zero), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
    e = qdot_sqrt(p.pool, x);
    zero = QDOT_MINUS_ONE;
    assert_int_equal(qdot_subs(p.pool, e, 1, &x, &zero), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
}

static void
time_derivatives_count_the_jets_on(void **state)
{
    qdot_expr x = symbol(5), v = symbol(6), a = qdot_symbol_jet(p.pool, x, 2);
    qdot_expr e = qdot_ddt(p.pool, qdot_mul(p.pool, x, v));

    (void)state;
    assert_int_equal(qdot_ddt(p.pool, x), v);
    assert_int_equal(qdot_ddt(p.pool, v), a);
    assert_int_equal(qdot_ddt(p.pool, QDOT_T), QDOT_ONE);
    assert_int_equal(qdot_ddt(p.pool, symbol(0)), QDOT_ZERO);
    assert_int_equal(
        e, qdot_add(p.pool, qdot_mul(p.pool, x, a), qdot_pow_int(p.pool, v, 2)));
    e = qdot_ddt(p.pool, qdot_symbol_of(p.pool, QDOT_MOMENTUM, x));
    assert_int_equal(e, QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
    /* where nothing depends on it, a multiplier does no harm */
    e = qdot_symbol_get(p.pool, QDOT_MULTIPLIER, "lambda[rod]");
    assert_int_equal(qdot_ddt(p.pool, e), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
}

static void
differentials_are_linear(void **state)
{
    qdot_expr r = symbol(5), theta = symbol(7),
              e = qdot_mul(p.pool, r, qdot_fun1(p.pool, QDOT_COS, theta));

    (void)state;
    assert_prints(p.pool, qdot_differential(p.pool, e),
                  "cos(theta)*dx - x*sin(theta)*dtheta");
    assert_prints(p.pool, qdot_differential(p.pool, qdot_mul(p.pool, r, QDOT_T)),
                  "x*dt + t*dx");
    assert_int_equal(qdot_differential(p.pool, symbol(6)), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_EDOMAIN);
}

static void
partial_derivatives_commute(void **state)
{
    int compared = 0;

    (void)state;
    for (int trial = 0; trial < 3000; trial++) {
        formula f = formula_random(4 + (int)random_below(8), SMOOTH);
        qdot_expr e = formula_build(&f, &p), xy, yx;
        bool fine = true;
        long double v[STEPS];

        xy = qdot_diff(p.pool, qdot_diff(p.pool, e, symbol(5)), symbol(0));
        yx = qdot_diff(p.pool, qdot_diff(p.pool, e, symbol(0)), symbol(5));
        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        place_move(&p);
        (void)formula_value(&f, &p, v);
        for (int i = 0; i < f.n; i++)
            fine &= isfinite(v[i]);
        if (!fine || !isfinite(node_value(&p, xy, NULL)) ||
            !isfinite(node_value(&p, yx, NULL)))
            continue;
        assert_true(near(node_value(&p, xy, NULL), node_value(&p, yx, NULL), 1e-7L));
        compared++;
    }
    assert_true(compared > 500);
}

/* --- undefined functions ---------------------------------------------------------------------- */

typedef struct {
    uint32_t f, g;
    qdot_expr s;
} functions;

static functions
declare(void)
{
    functions u;

    u.s = qdot_symbol_get(p.pool, QDOT_COORD, "s");
    assert_int_equal(qdot_ufun_declare(p.pool, "f", 1, &u.s, &u.f), QDOT_OK);
    assert_int_equal(qdot_ufun_declare(p.pool, "g", 2, (qdot_expr[]){u.s, QDOT_T}, &u.g),
                     QDOT_OK);
    return u;
}

static void
undefined_functions_obey_the_chain_rule(void **state)
{
    functions u = declare();
    qdot_expr x = symbol(5), square = qdot_pow_int(p.pool, x, 2);
    qdot_expr e = qdot_ufun_apply(p.pool, u.f, &square, NULL);

    (void)state;
    assert_int_equal(qdot_diff(p.pool, e, x),
                     qdot_product(p.pool, 3,
                                  (qdot_expr[]){qdot_expr_int(p.pool, 2), x,
                                                qdot_ufun_apply(p.pool, u.f, &square,
                                                                (uint32_t[]){1})}));
    e = qdot_ufun_apply(p.pool, u.g, (qdot_expr[]){u.s, QDOT_T}, NULL);
    assert_prints(p.pool, qdot_ddt(p.pool, e), "diff(g(s, t), s)*s' + diff(g(s, t), t)");
}

static void
mixed_partials_have_one_form(void **state)
{
    functions u = declare();
    qdot_expr e = qdot_ufun_apply(p.pool, u.g, (qdot_expr[]){u.s, QDOT_T}, NULL);
    qdot_expr st = qdot_diff(p.pool, qdot_diff(p.pool, e, u.s), QDOT_T);

    (void)state;
    assert_int_equal(qdot_diff(p.pool, qdot_diff(p.pool, e, QDOT_T), u.s), st);
    assert_prints(p.pool, st, "diff(diff(g(s, t), s), t)");
}

static void
arguments_of_derivatives_are_replaced_not_orders(void **state)
{
    functions u = declare();
    qdot_expr e = qdot_ufun_apply(p.pool, u.f, &u.s, (uint32_t[]){2}),
              two = qdot_expr_int(p.pool, 2);
    qdot_expr a = symbol(0), three = qdot_expr_int(p.pool, 3), g;

    (void)state;
    assert_prints(p.pool, qdot_subs(p.pool, e, 1, &u.s, &a), "f''(a)");
    assert_int_equal(qdot_subs(p.pool, e, 1, &two, &three), e);
    g = qdot_ufun_apply(p.pool, u.g, (qdot_expr[]){u.s, QDOT_T}, (uint32_t[]){1, 0});
    assert_prints(p.pool, qdot_subs(p.pool, g, 1, &u.s, &a),
                  "subs(diff(g(s, t), s), s = a)");
    a = qdot_vector(p.pool, 2, (qdot_expr[]){a, a});
    assert_int_equal(qdot_subs(p.pool, e, 1, &u.s, &a), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
}

static void
derivatives_map_over_values(void **state)
{
    qdot_expr x = symbol(5), a = symbol(0), one = qdot_pow_int(p.pool, x, 2), e, d;

    (void)state;
    e = qdot_list(p.pool, 2,
                  (qdot_expr[]){qdot_vector(p.pool, 2, (qdot_expr[]){one, a}),
                                qdot_rel(p.pool, QDOT_EQ, one, x)});
    assert_prints(p.pool, qdot_diff(p.pool, e, x), "[(2*x, 0), 2*x = 1]");
    assert_prints(p.pool, qdot_diff(p.pool, e, symbol(1)), "[(0, 0), 0 = 0]");
    d = qdot_fun(p.pool, QDOT_IF, 3,
                 (qdot_expr[]){qdot_rel(p.pool, QDOT_LT, x, a), one, a});
    assert_prints(p.pool, qdot_diff(p.pool, d, x), "if(x < a, 2*x, 0)");
    assert_int_equal(qdot_diff(p.pool, qdot_rel(p.pool, QDOT_LT, x, a), x), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
    assert_int_equal(qdot_diff(p.pool, one, one), QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ETYPE);
}

/* --- depth ------------------------------------------------------------------------------------- */

static void
a_million_levels_are_no_depth(void **state)
{
    enum { LEVELS = 1000000 };
    qdot_expr x = symbol(5), a = symbol(0), e = x, d;
    qdot_text out = {0};

    (void)state;
    for (int i = 0; i < LEVELS; i++)
        e = qdot_add(p.pool, qdot_fun1(p.pool, QDOT_SIN, e), i % 2 ? a : QDOT_ONE);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
    assert_int_equal(qdot_print(p.pool, e, QDOT_PLAIN, &out), QDOT_OK);
    assert_true(out.n > 8 * (size_t)LEVELS);
    qdot_text_clear(&out);
    assert_int_equal(qdot_expr_size(p.pool, e), 2 * LEVELS);
    assert_true(qdot_expr_contains(p.pool, e, x));
    assert_false(qdot_expr_contains(p.pool, e, symbol(1)));
    assert_int_equal(qdot_subs(p.pool, e, 1, &x, &x), e);
    d = qdot_subs(p.pool, e, 1, &x, &a);
    assert_true(d != QDOT_NIL && !qdot_expr_contains(p.pool, d, x));
    /* its derivative is a product of a million cosines: past any budget, and said so */
    (void)qdot_pool_budget(p.pool, 100000);
    assert_int_equal(qdot_diff(p.pool, e, x), QDOT_NIL);
    (void)qdot_pool_budget(p.pool, UINT64_MAX);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ELIMIT);
}

/* 2^200 as a tree, 200 nodes as they are kept. */
static void
shared_parts_are_derived_once(void **state)
{
    qdot_expr x = symbol(5), e = x, d;

    (void)state;
    for (int i = 0; i < 200; i++)
        e = qdot_add(p.pool, qdot_pow_int(p.pool, e, 2), qdot_fun1(p.pool, QDOT_SIN, e));
    assert_true(qdot_expr_size(p.pool, e) == UINT64_MAX);
    d = qdot_diff(p.pool, e, x);
    assert_int_not_equal(d, QDOT_NIL);
    assert_int_equal(qdot_subs(p.pool, d, 1, &x, (qdot_expr[]){QDOT_ZERO}), QDOT_ONE);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(derivatives_are_limits_of_differences),
        TEST(substitution_is_evaluation_elsewhere),
        TEST(many_replacements_are_as_one_by_one),
        TEST(what_a_substitution_undefines_is_told),
        TEST(time_derivatives_count_the_jets_on),
        TEST(differentials_are_linear),
        TEST(partial_derivatives_commute),
        TEST(undefined_functions_obey_the_chain_rule),
        TEST(mixed_partials_have_one_form),
        TEST(arguments_of_derivatives_are_replaced_not_orders),
        TEST(derivatives_map_over_values),
        TEST(a_million_levels_are_no_depth),
        TEST(shared_parts_are_derived_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
