/* test_formula-page.c -- answers as LaTeX and as MathML: blocks, breaks, text. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

#include "base/memory.h"
#include "show/formula-page.h"

static void
becomes(qdot_status (*page)(const char *, qdot_text *), const char *answers,
        const char *expected)
{
    qdot_text out = {0};

    assert_int_equal(page(answers, &out), QDOT_OK);
    if (strcmp(qdot_text_str(&out), expected) != 0)
        fail_msg("written:\n%sexpected:\n%s", qdot_text_str(&out), expected);
    qdot_text_clear(&out);
}

static void
equations_of_a_block_are_aligned(void **state)
{
    (void)state;
    becomes(qdot_page_latex, "\\(T = \\frac{1}{2} m\\)\n\\(\\mathrm{eom}_{x}: m \\ddot{x} = -k x\\)\n",
            "\\begin{align*}\n"
            "    T & = \\frac{1}{2} m \\\\\n"
            "    % \\mathrm{eom}_{x}\n"
            "    m \\ddot{x} & = -k x\n"
            "\\end{align*}\n");
}

static void
text_stands_between_blocks(void **state)
{
    (void)state;
    becomes(qdot_page_latex, "1. Energies & all\n    \\(V = 0\\)\n\nx_1: \\(a\\) is 5 %\n",
            "\\par\\medskip\\noindent\\textbf{1. Energies \\& all}\n"
            "\\begin{align*}\n    V & = 0\n\\end{align*}\n"
            "\\noindent x\\_1: \\(a\\) is 5 \\%\\par\n");
}

/* A block goes on behind the words. */
static void
words_stand_before_their_equation(void **state)
{
    (void)state;
    becomes(qdot_page_latex,
            "    energy of a_1: \\(T = m\\)\n    together: \\(T = 2 m\\)\n    they are 2\n",
            "\\noindent energy of a\\_1:\n"
            "\\begin{align*}\n"
            "    T & = m \\\\\n"
            "    \\intertext{together:}\n"
            "    T & = 2 m\n"
            "\\end{align*}\n"
            "\\noindent they are 2\\par\n");
}

#define MATH "<math xmlns=\"http://www.w3.org/1998/Math/MathML\">"
#define BLOCK                                                                             \
    "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">"              \
    "<mtable displaystyle=\"true\">\n"

static void
mathml_is_a_table_of_rows(void **state)
{
    (void)state;
    becomes(qdot_page_mathml,
            "3. a < b\n" MATH "<mi>T</mi><mo>=</mo><mo>−</mo><mi>m</mi></math>\n",
            "<h2>3. a &lt; b</h2>\n" BLOCK
            "<mtr><mtd class=\"left\"><mi>T</mi></mtd><mtd class=\"right\">"
            "<mo form=\"infix\">=</mo><mo>−</mo><mi>m</mi></mtd></mtr>\n</mtable></math>\n");
    becomes(qdot_page_mathml, "    of a: " MATH "<mi>x</mi></math>\n",
            "<p class=\"label\">of a:</p>\n" BLOCK
            "<mtr><mtd class=\"left\"></mtd><mtd class=\"right\"><mi>x</mi></mtd></mtr>\n"
            "</mtable></math>\n");
    becomes(qdot_page_mathml, MATH "<mtext>eom[x]</mtext><mo>:</mo><mi>x</mi></math>\n",
            "<p class=\"label\">" MATH "<mtext>eom[x]</mtext></math></p>\n" BLOCK
            "<mtr><mtd class=\"left\"></mtd><mtd class=\"right\"><mi>x</mi></mtd></mtr>\n"
            "</mtable></math>\n");
}

/* A sum of n terms of 12 letters. */
static void
sum(qdot_text *text, const char *term, const char *plus, int n)
{
    for (int i = 0; i < n; i++) {
        qdot_text_add(text, i > 0 ? plus : "");
        qdot_text_add(text, term);
    }
}

static size_t
count(const char *text, const char *what)
{
    size_t n = 0;

    for (; (text = strstr(text, what)) != NULL; text++)
        n++;
    return n;
}

/* No row is wider than a line; what is in brackets is not broken, however long. */
static void
long_formulas_are_broken_between_terms(void **state)
{
    qdot_text in = {0}, out = {0};

    (void)state;
    qdot_text_add(&in, "\\(T = ");
    sum(&in, "abcdefghijkl", " + ", 20); /* 20 x 13 letters */
    qdot_text_add(&in, "\\)\n");
    assert_int_equal(qdot_page_latex(in.at, &out), QDOT_OK);
    assert_int_equal(count(out.at, "\\\\"), 3);
    assert_int_equal(count(out.at, "abcdefghijkl"), 20);
    assert_int_equal(count(out.at, "& \\quad {}+ abc"), 3);
    qdot_text_truncate(&in, 0);
    qdot_text_truncate(&out, 0);
    qdot_text_add(&in, "\\(T = \\left(");
    sum(&in, "abcdefghijkl", " - ", 20);
    qdot_text_add(&in, "\\right)\\)\n");
    assert_int_equal(qdot_page_latex(in.at, &out), QDOT_OK);
    assert_int_equal(count(out.at, "\\\\"), 0);
    qdot_text_truncate(&in, 0);
    qdot_text_truncate(&out, 0);
    qdot_text_add(&in, MATH);
    sum(&in, "<mi>abcdefghijkl</mi>", "<mo>+</mo>", 20);
    qdot_text_add(&in, "<mo>=</mo><mn>0</mn></math>\n");
    assert_int_equal(qdot_page_mathml(in.at, &out), QDOT_OK);
    assert_int_equal(count(out.at, "<mtr>"), 5); /* the left side alone, then = 0 */
    assert_int_equal(count(out.at, "<mo form=\"infix\">+</mo>"), 3);
    qdot_text_clear(&in);
    qdot_text_clear(&out);
}

static void
failing_memory_is_told(void **state)
{
    (void)state;
    for (long n = 0;; n++) {
        qdot_text out = {0};
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_page_html("a", "\\(x\\)\n" MATH "<mi>a</mi><mo>=</mo><mi>b</mi></math>\n",
                                &out);
        qdot_memory_fail_at(-1);
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
        cmocka_unit_test(equations_of_a_block_are_aligned),
        cmocka_unit_test(text_stands_between_blocks),
        cmocka_unit_test(words_stand_before_their_equation),
        cmocka_unit_test(mathml_is_a_table_of_rows),
        cmocka_unit_test(long_formulas_are_broken_between_terms),
        cmocka_unit_test(failing_memory_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
