/* test_page.c -- answers as parts of a page: formulas divided, texts escaped. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "show/page.h"

static void
becomes(const char *lines, const char *want)
{
    qdot_text out = {0};

    qdot_page_lines(&out, lines);
    assert_int_equal(qdot_text_status(&out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), want);
    qdot_text_clear(&out);
}

static void
lines_by_their_kind(void **state)
{
    (void)state;
    becomes("12. A < B\n\n    x & y\nnone",
            "<h3>12. A &lt; B</h3>\n"
            "<p class=\"formula\">x &amp; y</p>\n<p>none</p>\n");
    becomes("", "");
    becomes("1.5 is no heading\n", "<p>1.5 is no heading</p>\n");
}

/* Before + and = at the top level; not within brackets, and no sign is cut off. */
static void
formula_is_divided(void **state)
{
    (void)state;
    becomes("  <math xmlns=\"x\"><mi>a</mi><mo>=</mo><mo>\u2212</mo><mi>b</mi><mo>+</mo>"
            "<mrow><mi>c</mi><mo>+</mo><mi>d</mi></mrow></math>, stable\n",
            "<p class=\"formula\"><math><mi>a</mi></math> <math><mo form=\"infix\" lspace=\"0\">=</mo>"
            "<mo>\u2212</mo><mi>b</mi></math> <math><mo form=\"infix\" lspace=\"0\">+</mo>"
            "<mrow><mi>c</mi><mo>+</mo><mi>d</mi></mrow></math>, stable</p>\n");
    becomes("  <math><mi>a</mi><mrow><mi>c</mi><mo>+</mo><mi>d</mi></mrow></math>\n",
            "<p class=\"formula\"><math><mi>a</mi>"
            "<mrow><mi>c</mi><mo>+</mo><mi>d</mi></mrow></math></p>\n");
    becomes("  <math><mo>\u2212</mo><mi>b</mi></math>\n",
            "<p class=\"formula\"><math><mo>\u2212</mo><mi>b</mi></math></p>\n");
}

/* An index and a power are set at one place, also where the power holds another. */
static void
index_and_power_are_one_above_the_other(void **state)
{
    (void)state;
    becomes("  <math><msup><mrow><msub><mi>L</mi><mn>1</mn></msub></mrow><mrow><mn>2</mn></mrow></msup>"
            "<mo>+</mo><mi>a</mi></math>\n",
            "<p class=\"formula\"><math><msubsup><mi>L</mi><mn>1</mn><mrow><mn>2</mn></mrow></msubsup>"
            "</math> <math><mo form=\"infix\" lspace=\"0\">+</mo><mi>a</mi></math></p>\n");
    becomes("  <math><msup><mrow><msub><mi>a</mi><mn>1</mn></msub></mrow><mrow><msup><mrow><mi>b</mi>"
            "</mrow><mrow><mn>2</mn></mrow></msup></mrow></msup></math>\n",
            "<p class=\"formula\"><math><msubsup><mi>a</mi><mn>1</mn><mrow><msup><mrow><mi>b</mi>"
            "</mrow><mrow><mn>2</mn></mrow></msup></mrow></msubsup></math></p>\n");
    becomes("  <math><msup><msub><mi>v</mi><mi>a</mi></msub><mn>2</mn></msup></math>\n",
            "<p class=\"formula\"><math><msubsup><mi>v</mi><mi>a</mi><mn>2</mn></msubsup></math></p>\n");
    becomes("  <math><msup><mrow><mi>b</mi></mrow><mrow><mn>2</mn></mrow></msup></math>\n",
            "<p class=\"formula\"><math><msup><mrow><mi>b</mi></mrow><mrow><mn>2</mn></mrow></msup>"
            "</math></p>\n");
}

/* Brackets about one line do not stretch; those about a fraction do, and they may hold others. */
static void
flat_brackets_do_not_stretch(void **state)
{
    (void)state;
    becomes("  <math><mrow><mo>(</mo><mi>a</mi><mo>)</mo></mrow></math>\n",
            "<p class=\"formula\"><math><mrow><mo stretchy=\"false\">(</mo><mi>a</mi>"
            "<mo stretchy=\"false\">)</mo></mrow></math></p>\n");
    becomes("  <math><mrow><mo>(</mo><mfrac><mi>a</mi><mrow><mo>(</mo><mi>b</mi><mo>)</mo></mrow></mfrac>"
            "<mo>)</mo></mrow></math>\n",
            "<p class=\"formula\"><math><mrow><mo>(</mo><mfrac><mi>a</mi><mrow>"
            "<mo stretchy=\"false\">(</mo><mi>b</mi><mo stretchy=\"false\">)</mo></mrow></mfrac>"
            "<mo>)</mo></mrow></math></p>\n");
}

/* A thin space before sin x and sin^2 x behind a factor; not before a letter. */
static void
functions_stand_apart(void **state)
{
    static const char sine[] = "<mi>sin</mi><mo>&#x2061;</mo><mi>u</mi>",
                      square[] = "<msup><mrow><mi>sin</mi></mrow><mrow><mn>2</mn></mrow></msup>"
                                 "<mo>&#x2061;</mo><mi>u</mi>";
    char given[300], want[400];

    (void)state;
    for (int i = 0; i < 2; i++) {
        const char *f = i == 0 ? sine : square;

        snprintf(given, sizeof given, "  <math><mi>L</mi><mo>&#x2062;</mo>%s</math>\n", f);
        snprintf(want, sizeof want,
                 "<p class=\"formula\"><math><mi>L</mi><mo>&#x2062;</mo>"
                 "<mspace width=\"0.17em\"></mspace>%s</math></p>\n",
                 f);
        becomes(given, want);
    }
    becomes("  <math><mi>L</mi><mo>&#x2062;</mo><mi>f</mi><mo>&#x2061;</mo></math>\n",
            "<p class=\"formula\"><math><mi>L</mi><mo>&#x2062;</mo><mi>f</mi><mo>&#x2061;</mo></math></p>\n");
    becomes("  <math><mi>L</mi><mo>&#x2062;</mo><mi>mass</mi></math>\n",
            "<p class=\"formula\"><math><mi>L</mi><mo>&#x2062;</mo><mi>mass</mi></math></p>\n");
}

/* MathML that does not end, or ends on another line, is text. */
static void
broken_formula_is_text(void **state)
{
    (void)state;
    becomes("a <math><mi>b\nc</math>",
            "<p>a &lt;math&gt;&lt;mi&gt;b</p>\n<p>c&lt;/math&gt;</p>\n");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_by_their_kind),
        cmocka_unit_test(formula_is_divided),
        cmocka_unit_test(index_and_power_are_one_above_the_other),
        cmocka_unit_test(flat_brackets_do_not_stretch),
        cmocka_unit_test(functions_stand_apart),
        cmocka_unit_test(broken_formula_is_text),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
