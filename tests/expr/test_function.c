/* test_function.c -- elementary functions: special values, parity, inverse pairs, domains. */
#include "expr/kit.h"

#include "expr/elementary.h"
#include "expr/function-ball.h"

static qdot_expr
call(qdot_fun_id id, qdot_expr x)
{
    return qdot_fun1(p.pool, id, x);
}

static qdot_expr
of_pi(int64_t n, int64_t d)
{
    return qdot_mul(p.pool, qdot_expr_ratio(p.pool, n, d), QDOT_PI);
}

static bool
holds_function(qdot_expr e)
{
    return (qdot_expr_node(p.pool, e)->holds & QDOT_HAS_FUN) != 0;
}

static void
twelfths_of_pi_have_exact_values(void **state)
{
    (void)state;
    for (int id = QDOT_SIN; id <= QDOT_COT; id++)
        for (int64_t k = -30; k <= 30; k++) {
            bool pole = ((id == QDOT_TAN || id == QDOT_SEC) && (k - 6) % 12 == 0) ||
                        ((id == QDOT_CSC || id == QDOT_COT) && k % 12 == 0);
            long double x = k * acosl(-1) / 12;
            qdot_expr e = call((qdot_fun_id)id, of_pi(k, 12));

            if (pole) {
                refuses(e, QDOT_EDOMAIN);
                continue;
            }
            assert_false(holds_function(e));
            assert_true(near(node_value(&p, e, NULL), function_value((qdot_fun_id)id, &x),
                             1e-12L));
        }
    assert_prints(p.pool, call(QDOT_TAN, of_pi(1, 12)), "2 - sqrt(3)");
}

static void
inverse_functions_know_the_twelfths(void **state)
{
    (void)state;
    for (int64_t k = -6; k <= 6; k++) {
        qdot_expr angle = of_pi(k, 12);

        assert_int_equal(call(QDOT_ASIN, call(QDOT_SIN, angle)), angle);
        assert_int_equal(call(QDOT_ACOS, call(QDOT_SIN, angle)),
                         qdot_sub(p.pool, of_pi(1, 2), angle));
        if (llabs(k) < 6)
            assert_int_equal(call(QDOT_ATAN, call(QDOT_TAN, angle)), angle);
    }
}

static void
a_quarter_turn_changes_the_function(void **state)
{
    qdot_expr x = p.symbol[5];

    (void)state;
    for (int id = QDOT_SIN; id <= QDOT_COT; id++)
        for (int64_t k = -9; k <= 9; k++) {
            qdot_expr e = call((qdot_fun_id)id, qdot_add(p.pool, x, of_pi(k, 2)));
            long double at = p.value[5] + k * acosl(-1) / 2;

            assert_false(qdot_expr_contains(p.pool, e, QDOT_PI));
            assert_true(near(node_value(&p, e, NULL),
                             function_value((qdot_fun_id)id, &at), 1e-10L));
        }
}

static void
parity_is_applied(void **state)
{
    static const qdot_fun_id odd[] = {QDOT_SIN,   QDOT_TAN,   QDOT_CSC,  QDOT_COT,
                                      QDOT_ASIN,  QDOT_ATAN,  QDOT_SINH, QDOT_TANH,
                                      QDOT_ASINH, QDOT_ATANH, QDOT_SIGN};
    static const qdot_fun_id even[] = {QDOT_COS, QDOT_SEC, QDOT_COSH, QDOT_ABS};
    qdot_expr d = qdot_sub(p.pool, p.symbol[7], p.symbol[5]), minus = qdot_neg(p.pool, d);

    (void)state;
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        assert_int_equal(call(odd[i], minus), qdot_neg(p.pool, call(odd[i], d)));
    for (size_t i = 0; i < sizeof even / sizeof *even; i++)
        assert_int_equal(call(even[i], minus), call(even[i], d));
}

static void
inverse_pairs_cancel(void **state)
{
    static const qdot_fun_id pair[][2] = {
        {QDOT_SIN, QDOT_ASIN},   {QDOT_COS, QDOT_ACOS},   {QDOT_TAN, QDOT_ATAN},
        {QDOT_SINH, QDOT_ASINH}, {QDOT_COSH, QDOT_ACOSH}, {QDOT_TANH, QDOT_ATANH},
        {QDOT_EXP, QDOT_LOG},    {QDOT_ASINH, QDOT_SINH}, {QDOT_ATANH, QDOT_TANH},
        {QDOT_LOG, QDOT_EXP},
    };
    qdot_expr x = p.symbol[5];

    (void)state;
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++)
        assert_int_equal(call(pair[i][0], call(pair[i][1], x)), x);
    assert_int_equal(call(QDOT_ACOSH, call(QDOT_COSH, x)), call(QDOT_ABS, x));
    /* asin(sin x) is x only near 0 */
    assert_true(holds_function(call(QDOT_ASIN, call(QDOT_SIN, x))));
    assert_int_equal(
        call(QDOT_EXP, qdot_mul(p.pool, qdot_expr_int(p.pool, 3), call(QDOT_LOG, x))),
        qdot_pow_int(p.pool, x, 3));
}

static void
domains_are_kept(void **state)
{
    qdot_expr two = qdot_expr_int(p.pool, 2);

    (void)state;
    refuses(call(QDOT_LOG, QDOT_ZERO), QDOT_EDOMAIN);
    refuses(call(QDOT_LOG, QDOT_MINUS_ONE), QDOT_EDOMAIN);
    refuses(call(QDOT_TAN, of_pi(1, 2)), QDOT_EDOMAIN);
    refuses(call(QDOT_SEC, of_pi(-3, 2)), QDOT_EDOMAIN);
    refuses(call(QDOT_COT, QDOT_ZERO), QDOT_EDOMAIN);
    refuses(call(QDOT_ASIN, two), QDOT_EDOMAIN);
    refuses(call(QDOT_ACOS, qdot_expr_int(p.pool, -2)), QDOT_EDOMAIN);
    refuses(call(QDOT_ACOSH, QDOT_HALF), QDOT_EDOMAIN);
    refuses(call(QDOT_ATANH, QDOT_ONE), QDOT_EDOMAIN);
    refuses(qdot_fun(p.pool, QDOT_ATAN2, 2, (qdot_expr[]){QDOT_ZERO, QDOT_ZERO}),
            QDOT_EDOMAIN);
    refuses(qdot_fun(p.pool, QDOT_MOD, 2, (qdot_expr[]){two, QDOT_ZERO}), QDOT_EDOMAIN);
}

static void
arguments_are_counted(void **state)
{
    qdot_expr x[] = {p.symbol[5], p.symbol[0]};

    (void)state;
    refuses(qdot_fun(p.pool, QDOT_SIN, 2, x), QDOT_ETYPE);
    refuses(qdot_fun(p.pool, QDOT_ATAN2, 1, x), QDOT_ETYPE);
    refuses(qdot_fun(p.pool, QDOT_MIN, 0, x), QDOT_ETYPE);
    refuses(call(QDOT_SIN, qdot_vector(p.pool, 2, x)), QDOT_ETYPE);
    refuses(qdot_fun(p.pool, QDOT_IF, 3, (qdot_expr[]){x[0], x[0], x[1]}), QDOT_ETYPE);
}

static void
numbers_are_computed(void **state)
{
    qdot_expr seven = qdot_expr_int(p.pool, 7), three = qdot_expr_int(p.pool, -3);
    qdot_expr two[] = {seven, three};

    (void)state;
    assert_int_equal(qdot_fun(p.pool, QDOT_MIN, 2, two), three);
    assert_int_equal(qdot_fun(p.pool, QDOT_MAX, 2, two), seven);
    assert_int_equal(qdot_fun(p.pool, QDOT_MOD, 2, two), qdot_expr_int(p.pool, -2));
    assert_int_equal(call(QDOT_FLOOR, qdot_expr_ratio(p.pool, -7, 2)),
                     qdot_expr_int(p.pool, -4));
    assert_int_equal(call(QDOT_ABS, three), qdot_expr_int(p.pool, 3));
    assert_int_equal(call(QDOT_SIGN, three), QDOT_MINUS_ONE);
    assert_int_equal(
        qdot_fun(p.pool, QDOT_ATAN2, 2, (qdot_expr[]){QDOT_ONE, QDOT_MINUS_ONE}),
        of_pi(3, 4));
    assert_int_equal(
        qdot_fun(p.pool, QDOT_ATAN2, 2, (qdot_expr[]){QDOT_ZERO, QDOT_MINUS_ONE}),
        QDOT_PI);
}

static void
a_decided_condition_chooses(void **state)
{
    qdot_expr x = p.symbol[5], y = p.symbol[0];
    qdot_expr less = qdot_rel(p.pool, QDOT_LT, QDOT_ZERO, QDOT_ONE);
    qdot_expr open = qdot_rel(p.pool, QDOT_LT, x, y);

    (void)state;
    assert_int_equal(less, QDOT_TRUE);
    assert_int_equal(qdot_fun(p.pool, QDOT_IF, 3, (qdot_expr[]){less, x, y}), x);
    assert_int_equal(qdot_fun(p.pool, QDOT_IF, 3, (qdot_expr[]){open, x, x}), x);
    assert_prints(p.pool, qdot_fun(p.pool, QDOT_IF, 3, (qdot_expr[]){open, x, y}),
                  "if(x < a, x, a)");
}

static void
what_is_held_stays_whole(void **state)
{
    qdot_expr x, y, sum, held;

    (void)state;
    x = qdot_symbol_get(p.pool, QDOT_PARAM, "x");
    y = qdot_symbol_get(p.pool, QDOT_PARAM, "y");
    sum = qdot_add(p.pool, x, y);
    held = qdot_hold(p.pool, sum);
    assert_int_equal(qdot_hold(p.pool, x), x);
    assert_int_equal(qdot_hold(p.pool, held), held);
    assert_int_equal(qdot_sub(p.pool, held, held), QDOT_ZERO);
    assert_prints(p.pool, qdot_add(p.pool, held, x), "x + hold(x + y)");
    assert_int_equal(qdot_hold(p.pool, qdot_neg(p.pool, qdot_mul(p.pool, x, y))),
                     qdot_neg(p.pool, qdot_hold(p.pool, qdot_mul(p.pool, x, y))));
    assert_int_equal(qdot_diff(p.pool, held, x), QDOT_ONE);
    /* a value in place of y: nothing is left to hold */
    assert_int_equal(qdot_subs(p.pool, held, 1, &y, (qdot_expr[]){QDOT_ZERO}), x);
    assert_int_equal(qdot_subs(p.pool, held, 1, &y, &x), qdot_hold(p.pool, qdot_add(p.pool, x, x)));
}

static void
names_are_found(void **state)
{
    qdot_fun_id id;

    (void)state;
    for (int i = 0; i < QDOT_FUNCTION_COUNT; i++) {
        assert_true(qdot_fun_find(qdot_fun_name((qdot_fun_id)i), &id));
        assert_int_equal(id, i);
    }
    assert_false(qdot_fun_find("sine", &id));
}

static void
a_node_is_one_function_or_none(void **state)
{
    qdot_expr x = qdot_symbol_get(p.pool, QDOT_FORMAL, "x");

    (void)state;
    assert_true(qdot_expr_is_function(p.pool, call(QDOT_ABS, x), QDOT_ABS));
    assert_false(qdot_expr_is_function(p.pool, call(QDOT_ABS, x), QDOT_SIGN));
    assert_false(qdot_expr_is_function(p.pool, x, QDOT_ABS));
    /* a sum and a product with numbers for operations that are some function's */
    for (int id = 0; id < QDOT_FUNCTION_COUNT; id++) {
        assert_false(qdot_expr_is_function(p.pool, qdot_add(p.pool, x, QDOT_ONE), (qdot_fun_id)id));
        assert_false(qdot_expr_is_function(p.pool, qdot_mul(p.pool, x, x), (qdot_fun_id)id));
    }
}

static void
functions_are_found_from_the_inside(void **state)
{
    const qdot_fun_id ids[] = {QDOT_SIGN, QDOT_ABS};
    qdot_expr x = qdot_symbol_get(p.pool, QDOT_FORMAL, "x"), y = qdot_symbol_get(p.pool, QDOT_FORMAL, "y"),
              inner = call(QDOT_ABS, x), outer = call(QDOT_ABS, qdot_add(p.pool, y, inner)),
              e = qdot_add(p.pool, outer, call(QDOT_SIN, y));

    (void)state;
    assert_int_equal(qdot_expr_find_function(p.pool, e, 2, ids, QDOT_NIL), inner);
    assert_int_equal(qdot_expr_find_function(p.pool, e, 2, ids, y), outer);
    assert_int_equal(qdot_expr_find_function(p.pool, e, 1, ids, QDOT_NIL), QDOT_NIL);
    assert_int_equal(qdot_expr_find_function(p.pool, QDOT_NIL, 2, ids, QDOT_NIL), QDOT_NIL);
    assert_false(qdot_pool_failed(p.pool));
}

/* f(n/8) to a double; NAN: it has none. */
static double
ball_value(qdot_fun_ball *f, int n)
{
    arb_t y;
    double value = NAN;

    arb_init(y);
    arb_set_si(y, n);
    arb_mul_2exp_si(y, y, -3);
    f(y, y, 128);
    if (arb_is_finite(y) && arb_rel_accuracy_bits(y) > 50)
        value = arf_get_d(arb_midref(y), ARF_RND_NEAR);
    else if (arb_is_zero(y))
        value = 0;
    arb_clear(y);
    return value;
}

static double
end_value(const qdot_fun_end *end)
{
    return end->number * (end->angle ? acos(-1) / 2 : 1);
}

/* The balls (Arb) do not read the other columns. */
static void
facts_are_those_of_the_values(void **state)
{
    (void)state;
    for (int id = 0; id < QDOT_FUNCTION_COUNT; id++) {
        const qdot_fun_facts *f = qdot_fun_facts_of((qdot_fun_id)id);
        qdot_fun_ball *ball = qdot_fun_ball_of((qdot_fun_id)id);
        double before = NAN;

        if (f->least != 1 || f->most != 1) {
            assert_null(ball);
            continue;
        }
        assert_non_null(ball);
        for (int n = -40; n <= 40; n++) {
            double y = ball_value(ball, n), mirror = ball_value(ball, -n), lo, hi;

            if ((f->traits & QDOT_FUN_ENTIRE) && isnan(y))
                fail_msg("%s has no value at %g", f->name, n / 8.0);
            if (isnan(y))
                continue;
            if (((f->traits & QDOT_FUN_ODD) && mirror != -y) || ((f->traits & QDOT_FUN_EVEN) && mirror != y))
                fail_msg("parity of %s at %g", f->name, n / 8.0);
            if (((f->traits & QDOT_FUN_RISING) && before > y) || ((f->traits & QDOT_FUN_FALLING) && before < y))
                fail_msg("%s turns at %g", f->name, n / 8.0);
            before = y;
            lo = f->lo.known ? end_value(&f->lo) : -INFINITY;
            hi = f->hi.known ? end_value(&f->hi) : INFINITY;
            if (y < lo || y > hi || (fabs(n / 8.0) < 3 && ((f->lo.open && y == lo) || (f->hi.open && y == hi))))
                fail_msg("%s(%g) = %g beyond its range", f->name, n / 8.0, y);
            if (f->inverse != QDOT_FUNCTION_KINDS) { /* h(f(x)) = x, of an even f |x|; asin: of its own domain */
                qdot_fun_ball *back = qdot_fun_ball_of(f->inverse);
                double x = n / 8.0, again;
                arb_t v;

                arb_init(v);
                arb_set_si(v, n);
                arb_mul_2exp_si(v, v, -3);
                ball(v, v, 512);
                back(v, v, 512);
                again = arf_get_d(arb_midref(v), ARF_RND_NEAR);
                arb_clear(v);
                if (fabs(again - (f->traits & QDOT_FUN_EVEN ? fabs(x) : x)) > 1e-12)
                    fail_msg("%s is not undone at %g", f->name, x);
            }
        }
    }
}

/* Ends in doubles are no further in than the ends themselves, and hardly further out. */
static void
ends_hold_all_values(void **state)
{
    double lo, hi;

    (void)state;
    for (int id = 0; id < QDOT_FUNCTION_COUNT; id++) {
        qdot_fun_ends((qdot_fun_id)id, &lo, &hi);
        for (int k = -400; k <= 400 && qdot_fun_facts_of((qdot_fun_id)id)->most == 1; k++) {
            const long double x[2] = {k / 40.0L * (k % 5 == 0 ? 1e6L : 1)}, v = function_value((qdot_fun_id)id, x);

            assert_true(isnan(v) || (v >= lo && v <= hi));
        }
    }
    qdot_fun_ends(QDOT_ATAN, &lo, &hi);
    assert_true(hi > acosl(0) && hi < acosl(0) + 1e-15L && lo == -hi);
    qdot_fun_ends(QDOT_ACOS, &lo, &hi);
    assert_true(lo == 0 && hi > acosl(-1) && hi < acosl(-1) + 1e-15L);
    qdot_fun_ends(QDOT_EXP, &lo, &hi);
    assert_true(lo == 0 && hi == (double)INFINITY);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        MOVED_TEST(twelfths_of_pi_have_exact_values),
        MOVED_TEST(inverse_functions_know_the_twelfths),
        MOVED_TEST(a_quarter_turn_changes_the_function),
        MOVED_TEST(parity_is_applied),
        MOVED_TEST(inverse_pairs_cancel),
        MOVED_TEST(domains_are_kept),
        MOVED_TEST(arguments_are_counted),
        MOVED_TEST(numbers_are_computed),
        MOVED_TEST(a_decided_condition_chooses),
        MOVED_TEST(what_is_held_stays_whole),
        MOVED_TEST(names_are_found),
        MOVED_TEST(a_node_is_one_function_or_none),
        MOVED_TEST(functions_are_found_from_the_inside),
        MOVED_TEST(facts_are_those_of_the_values),
        MOVED_TEST(ends_hold_all_values),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
