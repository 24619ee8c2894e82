/* test_notation.c -- formulas of books in words of answers, in each style. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

#include "base/text.h"
#include "expr/print-formula.h"
#include "lang/answer/notation.h"

static void
is_written(const char *formula, qdot_style style, const char *expected)
{
    const qdot_notation_kind notation = qdot_print_notation(style);
    qdot_formula f = {0};
    const qdot_formula_id all = qdot_formula_new(&f, QDOT_FORMULA_SPAN, 0, 0);
    qdot_text out = {0};

    qdot_notation_add(&f, all, formula, notation);
    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_print_written(&f, all, style, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), expected);
    if (notation != QDOT_NOTATION_DRAWN) {
        qdot_text_truncate(&out, 0);
        qdot_notation_print(formula, notation, &out);
        assert_string_equal(qdot_text_str(&out), expected);
    }
    qdot_formula_clear(&f);
    qdot_text_clear(&out);
}

static void
plain_stays_as_it_is(void **state)
{
    (void)state;
    is_written("d/dt dT/dq' - dT/dq = Q + sum lambda df/dq''", QDOT_PLAIN,
               "d/dt dT/dq' - dT/dq = Q + sum lambda df/dq''");
}

static void
slopes_are_partial_but_for_time(void **state)
{
    (void)state;
    is_written("d/dt dT/dq' - dT/dq = Q", QDOT_UNICODE, "d/dt ∂T/∂q\u0307 − ∂T/∂q = Q");
    is_written("d/dt dT/dq''", QDOT_LATEX, "\\frac{d}{dt} \\frac{\\partial T}{\\partial \\ddot{q}}");
    is_written("dr/dt", QDOT_MATHML,
               "<mfrac><mrow><mo>∂</mo><mi>r</mi></mrow><mrow><mo>∂</mo><mi>t</mi></mrow></mfrac>");
}

static void
words_signs_and_squares_have_their_characters(void **state)
{
    (void)state;
    is_written("T = 1/2 sum m v^2 + 1/2 sum omega.I omega", QDOT_UNICODE,
               "T = ½ Σ m v² + ½ Σ ω·I ω");
    is_written("deltaW = -sum m g.r, 0", QDOT_UNICODE, "δW = −Σ m g·r, 0");
    is_written("f = left - right = 0", QDOT_LATEX, "f = \\text{left} - \\text{right} = 0");
    is_written("v^2", QDOT_MATHML, "<msup><mi>v</mi><mn>2</mn></msup>");
    is_written("omega^2", QDOT_LATEX, "\\omega ^{2}");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_stays_as_it_is),
        cmocka_unit_test(slopes_are_partial_but_for_time),
        cmocka_unit_test(words_signs_and_squares_have_their_characters),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
