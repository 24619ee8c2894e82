/* test_layout.c -- formulas drawn with characters: against pictures, and as what cannot be. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/utf8.h"
#include "show/layout.h"

#define I(x) "<mi>" x "</mi>"
#define N(x) "<mn>" x "</mn>"
#define O(x) "<mo>" x "</mo>"
#define ROW(x) "<mrow>" x "</mrow>"
#define OVER(x, y) "<mfrac>" ROW(x) ROW(y) "</mfrac>"
#define POWER(x, y) "<msup>" ROW(x) ROW(y) "</msup>"
#define SUB(x, y) "<msub>" x ROW(y) "</msub>"
#define DOT(x, d) "<mover>" x "<mo>" d "</mo></mover>"
#define ROOT(x) "<msqrt>" x "</msqrt>"
#define IN(x) ROW(O("(") x O(")"))
#define TIMES O("&#x2062;")
#define APPLY O("&#x2061;")

static void
draws(const char *formula, size_t width, const char *picture)
{
    qdot_text out = {0};
    qdot_layout_size size = {0};
    size_t lines = 0;

    assert_int_equal(qdot_layout(formula, width, &out, &size), QDOT_OK);
    if (strcmp(qdot_text_str(&out), picture) != 0)
        fail_msg("drawn:\n%sexpected:\n%s", qdot_text_str(&out), picture);
    for (const char *at = out.at; *at != '\0'; at++)
        lines += *at == '\n';
    assert_int_equal(size.lines, lines);
    qdot_text_clear(&out);
}

static void
characters_are_taken_where_there_are_some(void **state)
{
    (void)state;
    draws(POWER(I("x"), N("12")) O("+") SUB(I("θ"), N("1")), 80, "x¹² + θ₁\n");
    draws("<mfrac>" N("1") N("2") "</mfrac>" TIMES I("m") TIMES POWER(DOT(I("r"), "˙"), N("2")), 80,
          "½\u202Fm\u202Fr\u0307²\n");
    draws(SUB(DOT(I("theta"), "¨"), I("max")), 80, "t\u0308hetaₘₐₓ\n");
    draws(POWER(IN(I("a") O("−") I("b")), N("3")), 80, "(a − b)³\n");
    draws(O("−") I("x") O("=") O("−") N("1"), 80, "−x = −1\n");
    draws(I("f") APPLY IN(I("x") O(",") O("−") I("y")) O("&lt;") N("2"), 80, "f(x, −y) < 2\n");
}

static void
fractions_and_roots_are_built_up(void **state)
{
    (void)state;
    draws(OVER(I("a") O("+") I("b"), I("c")), 80, "a + b\n"
                                                  "─────\n"
                                                  "  c\n");
    draws(I("x") O("=") ROOT(OVER(I("k"), I("m"))) O("+") ROOT(I("a") O("+") N("1")), 80,
          "        __\n"
          "       ╱ k    _____\n"
          "x =   ╱  ─ + √a + 1\n"
          "    ╲╱   m\n");
}

static void
scripts_are_raised_and_lowered(void **state)
{
    (void)state;
    draws(POWER(I("x"), I("a") O("+") I("b")), 80, " a + b\n"
                                                   "x\n");
    draws(SUB(I("x"), I("q")) O("+") N("1"), 80, "x  + 1\n"
                                                 " q\n");
    draws(POWER(IN(OVER(I("a"), I("b"))), N("2")), 80, "⎛a⎞2\n"
                                                       "⎜─⎟\n"
                                                       "⎝b⎠\n");
}

static void
columns_of_matrices_are_aligned(void **state)
{
#define CELL(x) "<mtd>" x "</mtd>"
    (void)state;
    draws(I("M") O("=") ROW(O("(") "<mtable><mtr>" CELL(N("100")) CELL(N("0")) "</mtr><mtr>" CELL(
              I("a")) CELL(OVER(I("a"), I("b"))) "</mtr></mtable>" O(")")),
          80,
          "    ⎡100  0⎤\n"
          "    ⎢      ⎥\n"
          "M = ⎢     a⎥\n"
          "    ⎢ a   ─⎥\n"
          "    ⎣     b⎦\n");
    draws(ROW(O("{") "<mtable><mtr>" CELL(N("1")) CELL("<mtext>if x</mtext>") "</mtr><mtr>" CELL(
              N("2")) CELL("<mtext>otherwise</mtext>") "</mtr></mtable>"),
          80,
          "⎧1    if x\n"
          "⎩2  otherwise\n");
}

/* Each row in lines of its own. */
static void
matrices_that_are_too_wide_are_broken_by_rows(void **state)
{
    (void)state;
    draws(I("M") O("=") ROW(O("(") "<mtable><mtr>" CELL(I("aaaaaa")) CELL(I("bbb")) "</mtr><mtr>" CELL(
              I("cccccc") O("+") I("dddddd")) CELL(I("e")) "</mtr></mtable>" O(")")),
          20,
          "M = [aaaaaa, bbb;\n"
          "    cccccc + dddddd,\n"
          "    e]\n");
}

/* At = first, then signs, then factors; outside of brackets first. */
static void
long_formulas_are_broken(void **state)
{
    (void)state;
    draws(I("alpha") O("=") I("beta") O("+") I("gamma") O("−") I("delta") TIMES I("epsilon"), 20,
          "alpha = beta + gamma\n"
          "    − delta\u202Fepsilon\n");
    draws(I("aaaaaaa") TIMES I("bbbbbbb") TIMES I("ccccccc") TIMES I("ddddddd"), 20,
          "aaaaaaa\u202Fbbbbbbb\n"
          "    ·ccccccc\u202Fddddddd\n");
    draws(I("x") O("=") OVER(I("aaaaaaaa") O("+") I("bbbbbbbb"), I("c")) O("+") I("d"), 20,
          "x = (aaaaaaaa\n"
          "    + bbbbbbbb)/c\n"
          "    + d\n");
    draws(N("123456789012345678901234567890"), 16, "123456789012345678901234567890\n");
}

/* Behind a label first, between words where that does not do; a minus behind one is no sign of two. */
static void
words_before_a_formula_are_labels(void **state)
{
#define WORD(x) "<mtext>" x " </mtext>"
    (void)state;
    draws(WORD("    energy") WORD("of") WORD("bob:") I("T") O("=") O("−") I("a"), 40,
          "    energy of bob: T = −a\n");
    draws(WORD("    energy") WORD("of") WORD("bob:") I("T") O("=") I("aaaa") O("+") I("bbbb"), 26,
          "    energy of bob:\n"
          "        T = aaaa + bbbb\n");
    draws(WORD("the") WORD("sum") WORD("is") I("aaaaaaaa") O("+") I("b"), 17,
          "the sum is\n"
          "    aaaaaaaa + b\n");
}

/* Those that are not drawn are counted all the same. */
static void
lines_beyond_are_only_counted(void **state)
{
    const char *const formula = I("x") O("=") OVER(I("a"), I("b")) O("+") I("ccccccccc") O("+")
        OVER(I("ddd"), I("e")) O("+") I("fffffffff");
    qdot_layout_request request = {.width = 16, .shown = SIZE_MAX};
    qdot_layout_size all = {0};
    qdot_text whole = {0};

    (void)state;
    assert_int_equal(qdot_layout_part(formula, &request, &whole, &all), QDOT_OK);
    assert_true(all.lines > 4);
    for (request.shown = 0; request.shown <= all.lines + 1; request.shown++) {
        qdot_layout_size size = {0};
        qdot_text part = {0};

        assert_int_equal(qdot_layout_part(formula, &request, &part, &size), QDOT_OK);
        assert_int_equal(size.lines, all.lines);
        assert_memory_equal(qdot_text_str(&part), whole.at, part.n);
        assert_true(request.shown < all.lines || part.n == whole.n);
        qdot_text_clear(&part);
    }
    qdot_text_clear(&whole);
}

/* Codes take no column, and stand round words and names on their own line only. */
static void
names_are_coloured(void **state)
{
    const qdot_layout_request request = {.width = 30, .shown = SIZE_MAX, .paint = "<", .end = ">"};
    qdot_layout_size size = {0};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_layout_part(WORD("    of") WORD("a:") "<mtext>T</mtext>" O("=") OVER(I("a"), I("b")),
                                      &request, &out, &size),
                     QDOT_OK);
    assert_int_equal(qdot_layout_part("<mrow class=\"name\">" SUB(I("p"), I("q")) "</mrow>" O("=") I("x"),
                                      &request, &out, &size),
                     QDOT_OK);
    assert_int_equal(qdot_layout_part(I("x") O("=") "<mtext>y</mtext>", &request, &out, &size),
                     QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "              a\n"
                                             "    <of a: T> = ─\n"
                                             "              b\n"
                                             "<p > = x\n"
                                             " q\n"
                                             "x = y\n");
    assert_int_equal(size.columns, 15);
    qdot_text_clear(&out);
}

/* No line is longer than the terminal but by one name; what is drawn is as wide as is said. */
static void
every_width_is_kept(void **state)
{
    qdot_text formula = {0};

    (void)state;
    for (int i = 0; i < 40; i++)
        qdot_text_add(&formula, i % 3 == 0   ? I("x") O("+") ROOT(OVER(I("a"), I("b"))) O("−")
                                : i % 3 == 1 ? POWER(IN(I("yy") O("−") I("z")), I("k")) TIMES
                                             : I("sin") APPLY IN(I("u") O("+") I("w")) O("="));
    qdot_text_add(&formula, I("x"));
    for (size_t width = 1; width < 120; width++) {
        const size_t room = width > 16 ? width : 16;
        qdot_text out = {0};
        qdot_layout_size size = {0};
        size_t widest = 0;

        assert_int_equal(qdot_layout(formula.at, width, &out, &size), QDOT_OK);
        for (const char *at = out.at; *at != '\0'; at += strcspn(at, "\n") + 1) {
            const size_t columns = qdot_utf8_columns(at, strcspn(at, "\n"));

            widest = columns > widest ? columns : widest;
        }
        assert_true(widest <= room && widest <= size.columns);
        qdot_text_clear(&out);
    }
    qdot_text_clear(&formula);
}

static void
what_is_no_formula_is_refused(void **state)
{
    static const char *const texts[] = {"x",
                                        "<mi>x",
                                        "<mi>x</mn>",
                                        "</mi>",
                                        "<mfrac><mi>x</mi></mfrac>",
                                        "<mtable></mtable>",
                                        "<mtr><mtd></mtd></mtr>",
                                        "<table></table>",
                                        "<mrow><mi>x</mi>",
                                        "<mover><mrow></mrow><mo>˙</mo></mover>"};

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        qdot_text out = {0};

        assert_int_equal(qdot_layout(texts[i], 80, &out, NULL), QDOT_EINVAL);
        qdot_text_clear(&out);
    }
}

/* However deep: no recursion. */
static void
depth_is_no_matter(void **state)
{
    enum { DEPTH = 20000 };
    qdot_text formula = {0}, out = {0};

    (void)state;
    for (int i = 0; i < DEPTH; i++)
        qdot_text_add(&formula, "<mrow><mo>(</mo>" I("x") O("+"));
    qdot_text_add(&formula, I("x"));
    for (int i = 0; i < DEPTH; i++)
        qdot_text_add(&formula, "<mo>)</mo></mrow>");
    assert_int_equal(qdot_layout(formula.at, 80, &out, NULL), QDOT_OK);
    qdot_text_clear(&formula);
    qdot_text_clear(&out);
}

static void
failing_allocations_are_told(void **state)
{
    bool failed = true;

    (void)state;
    for (long n = 0; failed; n++) {
        qdot_text out = {0};
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_layout(I("x") O("=") OVER(I("aaaaaaaaaa") O("+") POWER(I("b"), N("2")), I("c")),
                             16, &out, NULL);
        qdot_memory_fail_at(-1);
        failed = status != QDOT_OK;
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_text_clear(&out);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(characters_are_taken_where_there_are_some),
        cmocka_unit_test(fractions_and_roots_are_built_up),
        cmocka_unit_test(scripts_are_raised_and_lowered),
        cmocka_unit_test(columns_of_matrices_are_aligned),
        cmocka_unit_test(long_formulas_are_broken),
        cmocka_unit_test(matrices_that_are_too_wide_are_broken_by_rows),
        cmocka_unit_test(words_before_a_formula_are_labels),
        cmocka_unit_test(lines_beyond_are_only_counted),
        cmocka_unit_test(names_are_coloured),
        cmocka_unit_test(every_width_is_kept),
        cmocka_unit_test(what_is_no_formula_is_refused),
        cmocka_unit_test(depth_is_no_matter),
        cmocka_unit_test(failing_allocations_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
