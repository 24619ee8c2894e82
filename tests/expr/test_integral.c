/* test_integral.c -- integrals that stand as they are: their variable, their ends, derivatives, numbers. */
#include "expr/kit.h"

#include "expr/constant.h"
#include "expr/integral.h"

static qdot_expr x, y, a;

static void
name_symbols(void)
{
    a = qdot_symbol_get(p.pool, QDOT_PARAM, "a");
    x = qdot_symbol_get(p.pool, QDOT_FORMAL, "x");
    y = qdot_symbol_get(p.pool, QDOT_FORMAL, "y");
}

/* sin(a u^3), not to be integrated by a formula. */
static qdot_expr
wave(qdot_expr u)
{
    return qdot_fun1(p.pool, QDOT_SIN, times(a, qdot_pow_int(p.pool, u, 3)));
}

static void
the_name_of_the_variable_does_not_matter(void **state)
{
    qdot_expr e, f;

    (void)state;
    name_symbols();
    e = qdot_integral(p.pool, wave(x), x, QDOT_ZERO, y);
    assert_int_equal(e, qdot_integral(p.pool, wave(y), y, QDOT_ZERO, y));
    assert_false(qdot_expr_contains(p.pool, e, x));
    assert_true(qdot_expr_contains(p.pool, e, y));
    assert_prints(p.pool, e, "integral(sin(a*x^3), x, 0, y)");
    /* what is put in is not captured, and the name gives way to it */
    f = qdot_subs(p.pool, e, 1, &a, &x);
    assert_true(qdot_expr_contains(p.pool, f, x));
    assert_prints(p.pool, f, "integral(sin(x*u^3), u, 0, y)");
    assert_int_equal(qdot_subs(p.pool, f, 1, &x, &a), e);
    assert_int_equal(qdot_integral_open(p.pool, e, x), wave(x));
}

static void
ends_and_constants_are_canonical(void **state)
{
    qdot_expr e;

    (void)state;
    name_symbols();
    e = qdot_integral(p.pool, wave(x), x, QDOT_ZERO, QDOT_ONE);
    assert_int_equal(qdot_integral(p.pool, wave(x), x, QDOT_ONE, QDOT_ZERO), qdot_neg(p.pool, e));
    assert_int_equal(qdot_integral(p.pool, wave(x), x, a, a), QDOT_ZERO);
    assert_int_equal(qdot_integral(p.pool, times(y, wave(x)), x, QDOT_ZERO, QDOT_ONE), times(y, e));
    assert_int_equal(qdot_integral(p.pool, y, x, a, QDOT_ONE), times(y, qdot_sub(p.pool, QDOT_ONE, a)));
    refuses(qdot_integral(p.pool, y, x, a, QDOT_INFINITY), QDOT_EDOMAIN);
    refuses(qdot_integral(p.pool, wave(x), x, a, qdot_add(p.pool, QDOT_INFINITY, QDOT_ONE)), QDOT_EDOMAIN);
    refuses(qdot_integral(p.pool, wave(x), QDOT_PI, QDOT_ZERO, QDOT_ONE), QDOT_ETYPE);
    assert_true(qdot_expr_is_constant(
        p.pool, qdot_integral(p.pool, qdot_fun1(p.pool, QDOT_SIN, qdot_pow_int(p.pool, x, 3)), x, QDOT_ZERO, QDOT_INFINITY)));
}

static void
derivatives_are_those_of_Leibniz(void **state)
{
    qdot_expr e, inner, d;

    (void)state;
    name_symbols();
    e = qdot_integral(p.pool, wave(x), x, a, qdot_pow_int(p.pool, y, 2));
    assert_prints(p.pool, qdot_diff(p.pool, e, y), "2*y*sin(a*y^6)");
    assert_int_equal(qdot_diff(p.pool, e, x), QDOT_ZERO);
    d = qdot_add(p.pool,
                 qdot_integral(p.pool,
                               times(qdot_pow_int(p.pool, x, 3), qdot_fun1(p.pool, QDOT_COS, times(a, qdot_pow_int(p.pool, x, 3)))),
                               x, a, qdot_pow_int(p.pool, y, 2)),
                 qdot_neg(p.pool, qdot_fun1(p.pool, QDOT_SIN, qdot_pow_int(p.pool, a, 4))));
    assert_int_equal(qdot_diff(p.pool, e, a), d);
    /* an inner integral whose end is the outer variable */
    inner = qdot_integral(p.pool, wave(y), y, QDOT_ZERO, x);
    e = qdot_integral(p.pool, times(inner, wave(x)), x, QDOT_ZERO, y);
    assert_prints(p.pool, e, "integral(sin(a*x^3)*integral(sin(a*y^3), y, 0, x), x, 0, y)");
    assert_int_equal(qdot_diff(p.pool, e, y),
                     times(qdot_integral(p.pool, wave(x), x, QDOT_ZERO, y), wave(y)));
}

static void
what_was_not_found_has_its_derivative(void **state)
{
    const qdot_expr two = number(2, 1);
    qdot_expr e;

    (void)state;
    name_symbols();
    e = qdot_integral_unfound(p.pool, times(number(3, 1), wave(x)), x);
    assert_prints(p.pool, e, "3*integral(sin(a*x^3), x)");
    assert_int_equal(qdot_diff(p.pool, e, x), times(number(3, 1), wave(x)));
    assert_int_equal(qdot_subs(p.pool, e, 1, &x, &y), qdot_integral_unfound(p.pool, times(number(3, 1), wave(y)), y));
    refuses(qdot_subs(p.pool, e, 1, &x, &two), QDOT_EDOMAIN);
    refuses(qdot_subs(p.pool, e, 1, &x, &a), QDOT_EDOMAIN);
}

/* The number of the integral of f over x, from lo to hi. */
static double
number_of(qdot_expr f, qdot_expr lo, qdot_expr hi)
{
    double value = NAN;

    if (qdot_constant_double(p.pool, qdot_integral(p.pool, f, x, lo, hi), &value) != QDOT_OK)
        return NAN;
    return value;
}

static void
numbers_are_those_of_known_integrals(void **state)
{
    const qdot_expr minus = qdot_neg(p.pool, QDOT_INFINITY);
    qdot_expr square;

    (void)state;
    name_symbols();
    square = qdot_pow_int(p.pool, x, 2);
    assert_true(number_of(qdot_fun1(p.pool, QDOT_EXP, qdot_neg(p.pool, square)), QDOT_ZERO, QDOT_ONE) == 0x1.7e5fbb9495fb8p-1);
    assert_false(qdot_constant_estimated_taken(p.pool));
    assert_true(number_of(qdot_fun1(p.pool, QDOT_EXP, qdot_neg(p.pool, square)), minus, QDOT_INFINITY) == 0x1.c5bf891b4ef6bp0); /* sqrt(pi) */
    assert_true(qdot_constant_estimated_taken(p.pool));
    assert_true(number_of(qdot_pow(p.pool, x, number(-1, 2)), QDOT_ZERO, QDOT_ONE) == 2);
    assert_true(number_of(qdot_fun1(p.pool, QDOT_ABS, qdot_sub(p.pool, x, QDOT_HALF)), QDOT_ZERO, QDOT_ONE) == 0.25);
    assert_true(number_of(qdot_div(p.pool, QDOT_ONE, qdot_add(p.pool, QDOT_ONE, square)), QDOT_ZERO, QDOT_INFINITY) ==
                acos(-1) / 2);
    /* singular at the end 1/3, and within at 1/3 */
    assert_true(fabs(number_of(qdot_pow(p.pool, qdot_sub(p.pool, number(1, 3), x), number(-1, 2)), QDOT_ZERO, number(1, 3)) -
                     2 / sqrt(3)) < 1e-15);
    assert_true(fabs(number_of(qdot_fun1(p.pool, QDOT_LOG, qdot_fun1(p.pool, QDOT_ABS, qdot_sub(p.pool, x, number(1, 3)))),
                               QDOT_ZERO, QDOT_ONE) -
                     (log(1.0 / 3) / 3 + 2 * log(2.0 / 3) / 3 - 1)) < 1e-15);
    assert_true(isnan(number_of(qdot_pow_int(p.pool, qdot_fun1(p.pool, QDOT_ABS, x), -1), QDOT_MINUS_ONE, QDOT_ONE)));
    /* int_0^1 dx int_0^x x y^2 dy = 1/15; of cos(x y) e^-x over y from 0 to 1, x from 0: pi/4 */
    assert_true(number_of(qdot_integral(p.pool, times(x, qdot_pow_int(p.pool, y, 2)), y, QDOT_ZERO, x), QDOT_ZERO, QDOT_ONE) ==
                1.0 / 15);
    assert_true(number_of(times(qdot_fun1(p.pool, QDOT_EXP, qdot_neg(p.pool, x)),
                                qdot_integral(p.pool, qdot_fun1(p.pool, QDOT_COS, times(x, y)), y, QDOT_ZERO, QDOT_ONE)),
                          QDOT_ZERO, QDOT_INFINITY) == acos(-1) / 4);
    assert_true(isnan(number_of(qdot_div(p.pool, QDOT_ONE, x), QDOT_ZERO, QDOT_ONE)));
    assert_true(isnan(number_of(qdot_div(p.pool, QDOT_ONE, x), QDOT_MINUS_ONE, QDOT_ONE)));
    assert_true(isnan(number_of(qdot_sqrt(p.pool, x), QDOT_MINUS_ONE, QDOT_ONE)));
    /* i i = -1, but neither root is real */
    assert_true(isnan(number_of(times(qdot_sqrt(p.pool, qdot_sub(p.pool, number(-2, 1), x)),
                                      qdot_sqrt(p.pool, qdot_sub(p.pool, number(-3, 1), x))),
                                QDOT_ZERO, QDOT_ONE)));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        MOVED_TEST(the_name_of_the_variable_does_not_matter),
        MOVED_TEST(ends_and_constants_are_canonical),
        MOVED_TEST(derivatives_are_those_of_Leibniz),
        MOVED_TEST(what_was_not_found_has_its_derivative),
        MOVED_TEST(numbers_are_those_of_known_integrals),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
