/* test_page.c -- lines of answers as parts of a report: formulas divided, texts escaped. */
#include "../formula/kit.h"

#include "base/memory.h"
#include "show/page.h"

#define EQUALS sign(QDOT_SIGN_EQUALS)
#define PLUS sign(QDOT_SIGN_PLUS)
#define NEGATIVE sign(QDOT_SIGN_NEGATIVE)
#define WORDS(x) text(QDOT_TEXT_WORDS, x)

static void
becomes(qdot_formula_id line, const char *want)
{
    qdot_text out = {0};

    assert_int_equal(qdot_page_line(&out, &f, line), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), want);
    qdot_text_clear(&out);
}

static void
lines_by_their_kind(void **state)
{
    (void)state;
    becomes(SPAN(WORDS("12. A < B")), "<h3>12. A &lt; B</h3>\n");
    becomes(SPAN(WORDS("    x & y")), "<p class=\"formula\">x &amp; y</p>\n");
    becomes(SPAN(WORDS("none")), "<p>none</p>\n");
    becomes(SPAN(WORDS("1.5 is no heading")), "<p>1.5 is no heading</p>\n");
    becomes(SPAN(WORDS("2. "), SPAN(NAME("x"))), "<h3>2. <math><mi>x</mi></math></h3>\n");
    becomes(node(QDOT_FORMULA_SPAN, 0, 0, END), "");
    becomes(SPAN(WORDS("  ")), "");
}

/* Before + and = at the top level; not within brackets, and no sign is cut off. */
static void
formula_is_divided(void **state)
{
    (void)state;
    becomes(SPAN(WORDS("  "),
                 SPAN(NAME("a"), EQUALS, NEGATIVE, NAME("b"), PLUS, ROW(NAME("c"), PLUS, NAME("d"))),
                 WORDS(", stable")),
            "<p class=\"formula\"><math><mi>a</mi></math> <math><mo form=\"infix\" lspace=\"0\">=</mo>"
            "<mo>\u2212</mo><mi>b</mi></math> <math><mo form=\"infix\" lspace=\"0\">+</mo>"
            "<mrow><mi>c</mi><mo>+</mo><mi>d</mi></mrow></math>, stable</p>\n");
    becomes(SPAN(SPAN(NAME("a"), ROW(NAME("c"), PLUS, NAME("d")))),
            "<p class=\"formula\"><math><mi>a</mi>"
            "<mrow><mi>c</mi><mo>+</mo><mi>d</mi></mrow></math></p>\n");
    becomes(SPAN(SPAN(NEGATIVE, NAME("b"))), "<p class=\"formula\"><math><mo>\u2212</mo><mi>b</mi></math></p>\n");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(lines_by_their_kind),
        TEST(formula_is_divided),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
