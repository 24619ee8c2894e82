/* test_elliptic-algebraic.c -- elliptic integrals of 1/sqrt(P): found where the zeros and the range are known, else nil. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/calculus.h"
#include "normal/integral/elliptic-algebraic.h"
#include "normal/prove/decide.h"

static void
found_ones_are_proved(void **state)
{
    static const char *const known[] = {"1/sqrt(x^4 + 1)", "2/sqrt(x^4 + 3*x^2 + 2)", "1/sqrt(x^4 - x^2 + 1)",
                                        "1/sqrt((1 - x^2)*(4 + x^2))", "1/sqrt(x^2 + a^2)/sqrt(x^2 + 2*a^2)"};
    const qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const qdot_expr e = text_read(pool, known[i]), F = qdot_elliptic_algebraic(pool, e, x, NULL);

        if (F == QDOT_NIL)
            fail_msg("%s: not known", known[i]);
        if (!qdot_is_zero(pool, qdot_sub(pool, qdot_diff(pool, F, x), e), NULL))
            fail_msg("%s: %s has another derivative", known[i], shown(F));
    }
}

static void
others_are_nil(void **state)
{
    static const char *const unknown[] = {"1/sqrt((x^2 - 1)*(x^2 - 4))", /* two ranges */
                                          "1/sqrt(x^4 + k)",             /* k may be negative */
                                          "1/sqrt(x^3 + x + 1)", "1/sqrt(x^2 + 1)", "x/sqrt(x^4 + 1)", "1/sqrt(x^5 + 1)"};
    const qdot_expr x = text_read(pool, "x");

    (void)state;
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++)
        if (qdot_elliptic_algebraic(pool, text_read(pool, unknown[i]), x, NULL) != QDOT_NIL)
            fail_msg("%s: nothing is known", unknown[i]);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(found_ones_are_proved, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(others_are_nil, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
