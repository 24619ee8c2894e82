/* test_antiderivative.c -- integrals are right when their derivatives are. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/calculus.h"
#include "normal/prove/decide.h"
#include "normal/integral/antiderivative.h"

static void
known_integrals_differentiate_back(void **state)
{
    static const char *const known[] = {
        "7",
        "x^3 - 2*x + k",
        "1/x",
        "1/(2*x + 3)^2",
        "sqrt(k*x + 1)",
        "sin(2*x + phi)*m",
        "cos(x)*sin(x)^3",
        "x^2*sin(3*x)",
        "x*exp(-x)",
        "x*exp(x^2)",
        "x/(x^2 + 1)",
        "x/sqrt(x^2 + 1)",
        "1/(x^5 + 1)", /* reciprocal of degree 4 */
        "x/(x^5 - a^5)",
        "1/(x^4 + 3*x^3 + 5*x^2 + 6*x + 4)",
        "(x^4 - 3*x^2 + 6)/(x^6 - 5*x^4 + 5*x^2 + 4)", /* residues i/2 and -i/2 (Bronstein 2.8) */
        "(8*x^9 + x^8 - 12*x^7 - 4*x^6 - 26*x^5 - 6*x^4 + 30*x^3 + 23*x^2 - 2*x - 7)/(x^10 - 2*x^8 - 2*x^7 - 4*x^6 + 7*x^4 + 10*x^3 + 3*x^2 - 4*x - 2)",
        "(6*x^5 + 6*x^4 - 8*x^3 - 18*x^2 + 8*x + 8)/(x^6 - 5*x^4 - 8*x^3 - 2*x^2 + 2*x + 1)", /* 1 + sqrt(3), 1 - sqrt(3) */
        "(3*x^2 + a)/(x^3 + a*x + k)", /* 1 everywhere */
        "a*(a - 2*x^3)/((x^3 + a)^2 + a^2*x^2)",
        "x^4/(x^10 + 1)",
        "1/(x^8 + 1)", /* roots of unity */
        "(x^2 + 3)/(x^10 + 1)",
        "x^3/(x^7 + 2)",
        "x/(x^8 + a^8)",
        "1/(x^6 + x^5 + x^4 + x^3 + x^2 + x + 1)",
        "x^2/(x^8 + 1)^2",
        "tan(x)",
        "sinh(x) + cosh(k*x)",
        "sin(x)/cos(x)^2",
        "exp(x)/(exp(x) + 1)",
        "log(x)/x",
        "1/sqrt(4/cosh(x)^2 - 1)", /* over the hyperbolic sine */
        "cosh(x)/sqrt(4 - cosh(x)^2)",
        "sin(x)^3*sqrt(1 + cos(x)^2)",
        "sin(2*x)/sqrt(2 + cos(x))",
        "x*sqrt((x + 1)/(x + 3))", /* over the root */
        "sqrt((x + 1)/(x + 3))/x",
        "exp(1/x)/x^3", /* rational times an exponential */
        "x*exp(k*x)/(1 + k*x)^2",
        "exp(x^3)*(3*x^3 - 1)/x^2",
        "exp(x/(1 + x))*(x^2 + 3*x + 1)/(1 + x)^2",
        "exp(x)*(x^2 + 1)/(x + 1)^2 + exp(2*x)*(2*x - 1)/x^2",
    };
    qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        qdot_expr e = text_read(pool, known[i]);
        qdot_expr F = qdot_antiderivative(pool, e, x, NULL);

        if (F == QDOT_NIL)
            fail_msg("%s: not known", known[i]);
        if (!qdot_is_zero(pool, qdot_sub(pool, qdot_diff(pool, F, x), e), NULL))
            fail_msg("%s: its derivative is another", known[i]);
    }
}

static void
what_the_table_lacks_is_nil(void **state)
{
    static const char *const unknown[] = {"exp(x^2)", "sin(x)/x", "1/log(x)",
                                          "sqrt(1 + x^3)", "exp(x)/x", "exp(1/x)/x", "exp(x)/(x + 1)^2"};
    qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++)
        if (qdot_antiderivative(pool, text_read(pool, unknown[i]), x, NULL) != QDOT_NIL)
            fail_msg("%s: has no such integral", unknown[i]);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
}

static void
a_callers_budget_is_kept(void **state)
{
    qdot_expr x = text_read(pool, "x"), e = text_read(pool, "x^2*sin(3*x)");
    uint64_t left;

    (void)state;
    (void)qdot_pool_budget(pool, 20);
    assert_true(qdot_antiderivative(pool, e, x, NULL) == QDOT_NIL);
    left = qdot_pool_budget(pool, UINT64_MAX);
    assert_true(left < 20);
    (void)qdot_pool_budget(pool, 1000000);
    assert_true(qdot_antiderivative(pool, e, x, NULL) != QDOT_NIL);
    left = qdot_pool_budget(pool, UINT64_MAX);
    assert_true(left < 1000000 && left > 900000);
    assert_true(qdot_antiderivative(pool, e, x, NULL) != QDOT_NIL);
    assert_true(qdot_pool_budget(pool, UINT64_MAX) == UINT64_MAX);
}

static void
potentials_of_exact_forms_only(void **state)
{
    qdot_expr x[2] = {text_read(pool, "x"), text_read(pool, "y")}, a[2], F;

    (void)state;
    a[0] = text_read(pool, "2*x*y + cos(x)");
    a[1] = text_read(pool, "x^2 - exp(y)");
    F = qdot_potential_of(pool, 2, x, a, NULL);
    assert_true(F != QDOT_NIL);
    assert_true(qdot_is_zero(
        pool, qdot_sub(pool, F, text_read(pool, "x^2*y + sin(x) - exp(y)")), NULL));
    a[1] = text_read(pool, "x^2 - exp(y) + x");
    assert_true(qdot_potential_of(pool, 2, x, a, NULL) == QDOT_NIL);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(known_integrals_differentiate_back, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(what_the_table_lacks_is_nil, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(a_callers_budget_is_kept, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(potentials_of_exact_forms_only, open_pool,
                                        close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
