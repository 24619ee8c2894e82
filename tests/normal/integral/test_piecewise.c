/* test_piecewise.c -- antiderivatives of what has kinks or steps: slopes, and no jumps, at points of a grid. */
#include <math.h>
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "normal/integral/antiderivative.h"
#include "normal/integral/piecewise.h"

static double
value_at(qdot_expr e, qdot_expr x, int64_t i, int64_t n)
{
    const qdot_expr at = qdot_expr_ratio(pool, i, n);
    double y = NAN;

    assert_int_equal(qdot_constant_double(pool, qdot_subs(pool, e, 1, &x, &at), &y), QDOT_OK);
    return y;
}

/* The midpoint rule over many short pieces against the change of F. */
static void
changes_are_areas(void **state)
{
    static const char *const known[] = {"mod(x, 1)",
                                        "floor(x)",
                                        "x*floor(2*x - 1/3)^2",
                                        "mod(1 - x, 3/2)*x",
                                        "sin(mod(x, 2))",
                                        "cos(x)*mod(sin(x), 1)",
                                        "abs(sin(2*x)) + x",
                                        "min(cos(x), 0)",
                                        "abs(x^3 - x)",
                                        "max(x, x^2, 1/3)",
                                        "sign(x - 1)*x",
                                        "abs(mod(x, 2) - 1)",
                                        "exp(-abs(x - 1/3))*sign(x)"};
    enum { PARTS = 240, FROM = -3, TO = 3 };
    const qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const qdot_expr e = text_read(pool, known[i]), F = qdot_antiderivative(pool, e, x, NULL);
        double area = 0, before;

        if (F == QDOT_NIL)
            fail_msg("%s: not known", known[i]);
        before = value_at(F, x, FROM, 1);
        for (int64_t k = FROM * PARTS; k < TO * PARTS; k++) {
            area += value_at(e, x, 2 * k + 1, 2 * PARTS) / PARTS;
            if (fabs(value_at(F, x, k + 1, PARTS) - before - area) > 0.05)
                fail_msg("%s: %s jumps near %g", known[i], shown(F), (double)k / PARTS);
        }
    }
}

static void
infinite_at_a_kink(void **state)
{
    const qdot_expr x = text_read(pool, "x");

    (void)state;
    assert_string_equal(shown(qdot_antiderivative(pool, text_read(pool, "1/abs(x)"), x, NULL)), "sign(x)*log(abs(x))");
    assert_true(qdot_antiderivative(pool, text_read(pool, "floor(x)/x"), x, NULL) == QDOT_NIL);
    assert_true(qdot_antiderivative(pool, text_read(pool, "abs(x^2 - k)"), x, NULL) == QDOT_NIL); /* k may be negative */
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
}

static void
finite_everywhere(void **state)
{
    const qdot_expr x = text_read(pool, "x");

    (void)state;
    assert_true(qdot_piecewise_finite(pool, text_read(pool, "floor(x)*sin(x)/(x^2 + 1) + abs(x - k)"), x));
    assert_false(qdot_piecewise_finite(pool, text_read(pool, "floor(x)/(x + 1)"), x));
    assert_false(qdot_piecewise_finite(pool, text_read(pool, "mod(1, x)"), x));
    assert_false(qdot_piecewise_finite(pool, text_read(pool, "abs(x)*sqrt(x)"), x));
    assert_false(qdot_piecewise_finite(pool, text_read(pool, "log(abs(x))"), x));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(changes_are_areas, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(infinite_at_a_kink, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(finite_everywhere, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
