/* test_formula-page.c -- answers as LaTeX and as MathML: blocks, breaks, text. */
#include "../formula/kit.h"

#include "base/memory.h"
#include "show/formula-page.h"

#define EQUALS sign(QDOT_SIGN_EQUALS)
#define PLUS sign(QDOT_SIGN_PLUS)
#define MINUS sign(QDOT_SIGN_MINUS)
#define NEGATIVE sign(QDOT_SIGN_NEGATIVE)
#define TIMES sign(QDOT_SIGN_TIMES)
#define WORDS(x) text(QDOT_TEXT_WORDS, x)
#define LINE(...) SPAN(__VA_ARGS__)

/* The lines, up to a 0, become that. */
static void
becomes(qdot_page_kind kind, const char *expected, ...)
{
    qdot_formula_page page = {.kind = kind};
    qdot_text out = {0};
    va_list lines;

    va_start(lines, expected);
    for (qdot_formula_id line; (line = va_arg(lines, qdot_formula_id)) != 0;)
        qdot_formula_page_line(&page, &f, line);
    va_end(lines);
    assert_int_equal(qdot_formula_page_end(&page, &out), QDOT_OK);
    if (strcmp(qdot_text_str(&out), expected) != 0)
        fail_msg("written:\n%sexpected:\n%s", qdot_text_str(&out), expected);
    qdot_formula_page_clear(&page);
    qdot_text_clear(&out);
}

static void
equations_of_a_block_are_aligned(void **state)
{
    (void)state;
    becomes(QDOT_PAGE_LATEX,
            "\\begin{align*}\n"
            "    T & = \\frac{1}{2} m \\\\\n"
            "    % \\mathrm{eom}_{x}\n"
            "    m x & = -k x\n"
            "\\end{align*}\n",
            LINE(SPAN(NAME("T"), EQUALS, OVER(NUMBER("1"), NUMBER("2")), TIMES, NAME("m"))),
            LINE(SPAN(INDEX(NAME("eom"), NAME("x")), sign(QDOT_SIGN_COLON), NAME("m"), TIMES, NAME("x"), EQUALS,
                      NEGATIVE, NAME("k"), TIMES, NAME("x"))),
            END);
}

static void
text_stands_between_blocks(void **state)
{
    (void)state;
    becomes(QDOT_PAGE_LATEX,
            "\\par\\medskip\\noindent\\textbf{1. Energies \\& all}\n"
            "\\begin{align*}\n    V & = 0\n\\end{align*}\n"
            "\\noindent x\\_1: \\(a\\) is 5 \\%\\par\n",
            LINE(WORDS("1. Energies & all")), LINE(WORDS("    "), SPAN(NAME("V"), EQUALS, NUMBER("0"))), SPAN(END),
            LINE(WORDS("x_1: "), SPAN(NAME("a")), WORDS(" is 5 %")), END);
}

/* A block goes on behind the words. */
static void
words_stand_before_their_equation(void **state)
{
    (void)state;
    becomes(QDOT_PAGE_LATEX,
            "\\noindent energy of a\\_1:\n"
            "\\begin{align*}\n"
            "    T & = m \\\\\n"
            "    \\intertext{together:}\n"
            "    T & = 2 m\n"
            "\\end{align*}\n"
            "\\noindent they are 2\\par\n",
            LINE(WORDS("    energy of a_1: "), SPAN(NAME("T"), EQUALS, NAME("m"))),
            LINE(WORDS("    together: "), SPAN(NAME("T"), EQUALS, NUMBER("2"), TIMES, NAME("m"))),
            LINE(WORDS("    they are 2")), END);
}

#define MATH "<math xmlns=\"http://www.w3.org/1998/Math/MathML\">"
#define BLOCK                                                                             \
    "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">"              \
    "<mtable displaystyle=\"true\">\n"

static void
mathml_is_a_table_of_rows(void **state)
{
    (void)state;
    becomes(QDOT_PAGE_MATHML,
            "<h2>3. a &lt; b</h2>\n" BLOCK
            "<mtr><mtd class=\"left\"><mi>T</mi></mtd><mtd class=\"right\">"
            "<mo form=\"infix\">=</mo><mo>−</mo><mi>m</mi></mtd></mtr>\n</mtable></math>\n",
            LINE(WORDS("3. a < b")), LINE(SPAN(NAME("T"), EQUALS, NEGATIVE, NAME("m"))), END);
    becomes(QDOT_PAGE_MATHML,
            "<p class=\"label\">of a:</p>\n" BLOCK
            "<mtr><mtd class=\"left\"></mtd><mtd class=\"right\"><mi>x</mi></mtd></mtr>\n"
            "</mtable></math>\n",
            LINE(WORDS("    of a: "), SPAN(NAME("x"))), END);
    becomes(QDOT_PAGE_MATHML,
            "<p class=\"label\">" MATH "<mtext>eom[x]</mtext></math></p>\n" BLOCK
            "<mtr><mtd class=\"left\"></mtd><mtd class=\"right\"><mi>x</mi></mtd></mtr>\n"
            "</mtable></math>\n",
            LINE(SPAN(WORDS("eom[x]"), sign(QDOT_SIGN_COLON), NAME("x"))), END);
}

/* Lines without formulas, as other answers write them; where a line ends a block ends too. */
static void
texts_are_paragraphs(void **state)
{
    static const char lines[] = "a < b\n\n2. Title\n  c";
    qdot_formula_page page = {.kind = QDOT_PAGE_MATHML};
    qdot_text out = {0};

    (void)state;
    qdot_formula_page_text(&page, lines, strlen(lines));
    assert_int_equal(qdot_formula_page_end(&page, &out), QDOT_OK);
    assert_string_equal(out.at, "<p>a &lt; b</p>\n<h2>2. Title</h2>\n<p>c</p>\n");
    qdot_formula_page_clear(&page);
    qdot_text_clear(&out);
}

static size_t
count(const char *text, const char *what)
{
    size_t n = 0;

    for (; (text = strstr(text, what)) != NULL; text++)
        n++;
    return n;
}

/* `T = ` and a sum of 20 terms of 12 letters, which may stand in brackets. */
static void
write_sum(qdot_page_kind kind, bool bracket, bool left, qdot_text *out)
{
    qdot_formula_page page = {.kind = kind};
    const qdot_formula_id sum = bracket ? node(QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, 0, END)
                                        : node(QDOT_FORMULA_SPAN, 0, 0, END);

    for (int i = 0; i < 20; i++) {
        if (i > 0)
            qdot_formula_append(&f, sum, PLUS);
        qdot_formula_append(&f, sum, NAME("abcdefghijkl"));
    }
    qdot_formula_page_line(&page, &f, left ? LINE(SPAN(sum, EQUALS, NUMBER("0"))) : LINE(SPAN(NAME("T"), EQUALS, sum)));
    qdot_text_truncate(out, 0);
    assert_int_equal(qdot_formula_page_end(&page, out), QDOT_OK);
    qdot_formula_page_clear(&page);
}

/* No row is wider than a line; what is in brackets is not broken, however long. */
static void
long_formulas_are_broken_between_terms(void **state)
{
    qdot_text out = {0};

    (void)state;
    write_sum(QDOT_PAGE_LATEX, false, false, &out);
    assert_int_equal(count(out.at, "\\\\"), 3);
    assert_int_equal(count(out.at, "abcdefghijkl"), 20);
    assert_int_equal(count(out.at, "& \\quad {}+ \\mathrm{abc"), 3);
    write_sum(QDOT_PAGE_LATEX, true, false, &out);
    assert_int_equal(count(out.at, "\\\\"), 0);
    write_sum(QDOT_PAGE_MATHML, false, true, &out);
    assert_int_equal(count(out.at, "<mtr>"), 5); /* the left side alone, then = 0 */
    assert_int_equal(count(out.at, "<mo form=\"infix\">+</mo>"), 3);
    qdot_text_clear(&out);
}

/* A text in LaTeX is divided outside braces; its signs align and break. */
static void
latex_is_divided_between_terms(void **state)
{
    static const char given[] = "\\frac{a + b}{2} = \\left(c - d\\right) - \\{ \\le e";
    const qdot_formula_id all = node(QDOT_FORMULA_SPAN, 0, 0, END);
    qdot_formula_parts parts = {0};

    (void)state;
    qdot_formula_add_latex(&f, all, given, strlen(given));
    assert_int_equal(qdot_formula_find_parts(&f, all, &parts), QDOT_OK);
    assert_int_equal(parts.part.n, 7);
    assert_int_equal(qdot_formula_sign_duty(qdot_formula_at(&f, parts.part.at[1])), QDOT_DUTY_RELATION);
    assert_int_equal(qdot_formula_sign_duty(qdot_formula_at(&f, parts.part.at[3])), QDOT_DUTY_TERMS);
    assert_int_equal(qdot_formula_sign_duty(qdot_formula_at(&f, parts.part.at[5])), QDOT_DUTY_RELATION);
    qdot_formula_parts_clear(&parts);
    becomes(QDOT_PAGE_LATEX,
            "\\begin{align*}\n    \\frac{a + b}{2} & = \\left(c - d\\right) - \\{ \\le e\n\\end{align*}\n",
            LINE(all), END);
}

static void
failing_memory_is_told(void **state)
{
    (void)state;
    for (int64_t n = 0;; n++) {
        qdot_formula_page page = {.kind = QDOT_PAGE_MATHML};
        const qdot_formula_id line = LINE(SPAN(NAME("a"), EQUALS, NAME("b")));
        qdot_text out = {0};
        qdot_status status;

        qdot_memory_fail_at(n);
        qdot_formula_page_text(&page, "x\n", 2);
        qdot_formula_page_line(&page, &f, line);
        status = qdot_formula_page_html(&page, "a", &out);
        qdot_memory_fail_at(-1);
        qdot_formula_page_clear(&page);
        qdot_text_clear(&out);
        if (status == QDOT_OK) {
            assert_true(n > 1);
            return;
        }
        assert_int_equal(status, QDOT_ENOMEM);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(equations_of_a_block_are_aligned),
        TEST(text_stands_between_blocks),
        TEST(words_stand_before_their_equation),
        TEST(mathml_is_a_table_of_rows),
        TEST(texts_are_paragraphs),
        TEST(long_formulas_are_broken_between_terms),
        TEST(latex_is_divided_between_terms),
        TEST(failing_memory_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
