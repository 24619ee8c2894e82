/* test_elliptic-forms.c -- integrands whose integrals are elliptic, and such as are not. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/calculus.h"
#include "normal/calculus/elliptic-forms.h"
#include "normal/prove/decide.h"

static void
forms_differentiate_back(void **state)
{
    static const char *const forms[] = {
        "1/sqrt(1 - m*sin(x)^2)",
        "c*sqrt(1 - k*sin(2*x + phi)^2)",
        "1/sqrt(a + b*cos(x))",
        "sqrt(a + b*sin(3*x))",
        "1/sqrt(1 + a*cos(x)^2)",
        "1/((1 - k*sin(x)^2)*sqrt(1 - m*sin(x)^2))",
        "p/((2 + cos(x))*sqrt(3 + 2*cos(x)))",
        "1/(sqrt(1 - x^2)*sqrt(1 - m*x^2))",
        "sqrt(1 - m*x^2)/sqrt(a - b*x^2)",
        "1/(sqrt(1 + x^2)*sqrt(4 - x^2))",
    };
    qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        qdot_expr e = text_read(pool, forms[i]);
        qdot_expr F = qdot_elliptic_antiderivative(pool, e, x, NULL);

        if (F == QDOT_NIL)
            fail_msg("%s: not known", forms[i]);
        if (!qdot_is_zero(pool, qdot_sub(pool, qdot_diff(pool, F, x), e), NULL))
            fail_msg("%s: its derivative is another", forms[i]);
    }
}

static void
other_integrands_are_left(void **state)
{
    static const char *const others[] = {"1/sqrt(p + k*cos(x))", "1/sqrt(1 - m*sin(x^2)^2)", "1/sqrt(cos(x))", "x",
                                         "sin(x)/sqrt(1 - m*sin(x)^2)", "1/(sqrt(1 + x^2)*sqrt(4 + x^2))", "exp(x)"};
    qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (qdot_elliptic_antiderivative(pool, text_read(pool, others[i]), x, NULL) != QDOT_NIL)
            fail_msg("%s: has no such integral", others[i]);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(forms_differentiate_back, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(other_integrands_are_left, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
