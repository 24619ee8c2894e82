/* test_layout.c -- formulas drawn with characters: against pictures, and as what cannot be. */
#include "kit.h"

#include <stdio.h>

#include "base/memory.h"
#include "base/utf8.h"
#include "formula/layout.h"

#define EQUALS sign(QDOT_SIGN_EQUALS)
#define LESS sign(QDOT_SIGN_LESS)
#define PLUS sign(QDOT_SIGN_PLUS)
#define MINUS sign(QDOT_SIGN_MINUS)
#define NEGATIVE sign(QDOT_SIGN_NEGATIVE)
#define TIMES sign(QDOT_SIGN_TIMES)
#define COMMA sign(QDOT_SIGN_COMMA)
#define WORDS(x) text(QDOT_TEXT_WORDS, x)

static void
draws(qdot_formula_id formula, size_t width, const char *picture)
{
    qdot_text out = {0};
    qdot_layout_size size = {0};
    size_t lines = 0;

    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_layout(&f, formula, width, &out, &size), QDOT_OK);
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
    draws(SPAN(POWER(ROW(NAME("x")), NUMBER("12")), PLUS, INDEX(NAME("θ"), ROW(NUMBER("1")))), 80, "x¹² + θ₁\n");
    draws(SPAN(OVER(NUMBER("1"), NUMBER("2")), TIMES, NAME("m"), TIMES, POWER(ROW(DOTS(1, NAME("r"))), NUMBER("2"))), 80,
          "½\u202Fm\u202Fr\u0307²\n");
    draws(SPAN(INDEX(DOTS(2, NAME("theta")), NAME("max"))), 80, "t\u0308hetaₘₐₓ\n");
    draws(SPAN(POWER(ROUND(NAME("a"), MINUS, NAME("b")), NUMBER("3"))), 80, "(a − b)³\n");
    draws(SPAN(NEGATIVE, NAME("x"), EQUALS, NEGATIVE, NUMBER("1")), 80, "−x = −1\n");
    draws(SPAN(APPLY(NAME("f"), ROUND(NAME("x"), COMMA, NEGATIVE, NAME("y"))), LESS, NUMBER("2")), 80,
          "f(x, −y) < 2\n");
    draws(SPAN(APPLY(PRIMES(2, NAME("f")), ROUND(NAME("x"))), PLUS, DOTS(4, NAME("q"))), 80, "f′′(x) + q⁽⁴⁾\n");
}

static void
fractions_and_roots_are_built_up(void **state)
{
    (void)state;
    draws(SPAN(OVER(ROW(NAME("a"), PLUS, NAME("b")), NAME("c"))), 80, "a + b\n"
                                                                      "─────\n"
                                                                      "  c\n");
    draws(SPAN(NAME("x"), EQUALS, ROOT(OVER(NAME("k"), NAME("m"))), PLUS, ROOT(NAME("a"), PLUS, NUMBER("1"))), 80,
          "        __\n"
          "       ╱ k    _____\n"
          "x =   ╱  ─ + √a + 1\n"
          "    ╲╱   m\n");
}

static void
scripts_are_raised_and_lowered(void **state)
{
    (void)state;
    draws(SPAN(POWER(NAME("x"), ROW(NAME("a"), PLUS, NAME("b")))), 80, " a + b\n"
                                                                       "x\n");
    draws(SPAN(INDEX(NAME("x"), NAME("q")), PLUS, NUMBER("1")), 80, "x  + 1\n"
                                                                    " q\n");
    draws(SPAN(POWER(ROW(INDEX(NAME("p"), NAME("θ"))), NUMBER("2")), PLUS,
               POWER(ROW(INDEX(NAME("p"), NAME("θφ"))), NUMBER("2")), PLUS,
               POWER(ROW(INDEX(NAME("p"), NAME("θ"))), NUMBER("12"))),
          80,
          "p² + p²  + p¹²\n"
          " θ    θφ    θ\n");
    draws(SPAN(POWER(ROUND(OVER(NAME("a"), NAME("b"))), NUMBER("2"))), 80, "⎛a⎞2\n"
                                                                           "⎜─⎟\n"
                                                                           "⎝b⎠\n");
    draws(SPAN(node(QDOT_FORMULA_TENSOR, 0, 0, NAME("Γ"), ROW(NUMBER("1")), ROW(NUMBER("2"), NUMBER("3")), END)), 80,
          "Γ¹₂₃\n");
}

static void
columns_of_matrices_are_aligned(void **state)
{
    (void)state;
    draws(SPAN(NAME("M"), EQUALS, TABLE(2, NUMBER("100"), NUMBER("0"), NAME("a"), OVER(NAME("a"), NAME("b")))), 80,
          "    ⎡100  0⎤\n"
          "    ⎢      ⎥\n"
          "M = ⎢     a⎥\n"
          "    ⎢ a   ─⎥\n"
          "    ⎣     b⎦\n");
    draws(SPAN(CASES(NUMBER("1"), NAME("x"), NUMBER("2"))), 80,
          "⎧1    if x\n"
          "⎩2  otherwise\n");
}

/* Each row in lines of its own. */
static void
matrices_that_are_too_wide_are_broken_by_rows(void **state)
{
    (void)state;
    draws(SPAN(NAME("M"), EQUALS,
               TABLE(2, NAME("aaaaaa"), NAME("bbb"), SPAN(NAME("cccccc"), PLUS, NAME("dddddd")), NAME("e"))),
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
    draws(SPAN(NAME("alpha"), EQUALS, NAME("beta"), PLUS, NAME("gamma"), MINUS, NAME("delta"), TIMES, NAME("epsilon")),
          20,
          "alpha = beta + gamma\n"
          "    − delta\u202Fepsilon\n");
    draws(SPAN(NAME("aaaaaaa"), TIMES, NAME("bbbbbbb"), TIMES, NAME("ccccccc"), TIMES, NAME("ddddddd")), 20,
          "aaaaaaa\u202Fbbbbbbb\n"
          "    ·ccccccc\u202Fddddddd\n");
    draws(SPAN(NAME("x"), EQUALS, OVER(ROW(NAME("aaaaaaaa"), PLUS, NAME("bbbbbbbb")), NAME("c")), PLUS, NAME("d")), 20,
          "x = (aaaaaaaa\n"
          "    + bbbbbbbb)/c\n"
          "    + d\n");
}

/* What has parts is taken apart first; a name or a number is cut where it has none. What is higher than a line rather
 * stands alone. */
static void
no_line_is_wider_than_the_terminal(void **state)
{
    const qdot_formula_id fraction = OVER(NAME("nnnnnnnnnnnnnn"), NAME("d"));

    (void)state;
    draws(SPAN(NUMBER("123456789012345678901234567890")), 16, "1234567890123456\n"
                                                              "    789012345678\n"
                                                              "    90\n");
    draws(SPAN(NAME("f"), EQUALS, ROUND(NAME("aaaaa"), COMMA, NAME("bbbbbb"))), 17, "f = (aaaaa,\n"
                                                                                   "    bbbbbb)\n");
    draws(SPAN(NAME("abcdefghijk"), EQUALS, ROUND(NAME("aaaaa"), COMMA, NAME("bbbbb"))), 17, "abcdefghijk\n"
                                                                                            "    = (aaaaa,\n"
                                                                                            "    bbbbb)\n");
    draws(SPAN(NAME("omega"), EQUALS, fraction), 18, "omega =\n"
                                                     "    nnnnnnnnnnnnnn\n"
                                                     "    ──────────────\n"
                                                     "          d\n");
    draws(SPAN(NAME("f"), EQUALS, POWER(ROUND(NAME("aaaaaaaaaaaaaaaaaaa")), NUMBER("2"))), 16,
          "f = (aaaaaaaaaaa\n"
          "    aaaaaaaa)²\n");
    draws(SPAN(NAME("L"), EQUALS,
               POWER(ROW(INDEX(DOTS(1, NAME("the")), ROW(NAME("angle"), COMMA, NAME("ofall")))), NUMBER("2"))),
          16,
          "L = t\u0307he_angle_\n"
          "    ofall²\n");
}

/* The value of a name that takes several lines has its own; words before a name, or a text, are no name. */
static void
a_value_stands_behind_a_broken_name(void **state)
{
    (void)state;
    draws(SPAN(WORDS("value("), WORDS("theta "), WORDS("+ "), WORDS("phi, "), WORDS("20)"), EQUALS, NUMBER("1")), 18,
          "value(theta +\n"
          "    phi, 20)\n"
          "    = 1\n");
    draws(SPAN(WORDS("value(theta*phi*psi,20)"), EQUALS, NUMBER("1.2345")), 16, "value(theta*phi*\n"
                                                                              "    psi,20)\n"
                                                                              "    = 1.2345\n");
    draws(SPAN(WORDS("spring "), WORDS("number "), WORDS("1: "), WORDS("F"), EQUALS, NUMBER("1.5")), 17,
          "spring number 1:\n"
          "    F = 1.5\n");
}

/* Behind a label first, between words where that does not do; a minus behind one is no sign of two. */
static void
words_before_a_formula_are_labels(void **state)
{
    (void)state;
    draws(SPAN(WORDS("    energy "), WORDS("of "), WORDS("bob: "), SPAN(NAME("T"), EQUALS, NEGATIVE, NAME("a"))), 40,
          "    energy of bob: T = −a\n");
    draws(SPAN(WORDS("    energy "), WORDS("of "), WORDS("bob: "),
               SPAN(NAME("T"), EQUALS, NAME("aaaa"), PLUS, NAME("bbbb"))),
          26,
          "    energy of bob:\n"
          "        T = aaaa + bbbb\n");
    draws(SPAN(WORDS("the "), WORDS("sum "), WORDS("is "), SPAN(NAME("aaaaaaaa"), PLUS, NAME("b"))), 17,
          "the sum is\n"
          "    aaaaaaaa + b\n");
}

/* Those that are not drawn are counted all the same. */
static void
lines_beyond_are_only_counted(void **state)
{
    const qdot_formula_id formula =
        SPAN(NAME("x"), EQUALS, OVER(NAME("a"), NAME("b")), PLUS, NAME("ccccccccc"), PLUS,
             OVER(NAME("ddd"), NAME("e")), PLUS, NAME("fffffffff"));
    qdot_layout_request request = {.width = 16, .shown = SIZE_MAX};
    qdot_layout_size all = {0};
    qdot_text whole = {0};

    (void)state;
    assert_int_equal(qdot_layout_part(&f, formula, &request, &whole, &all), QDOT_OK);
    assert_true(all.lines > 4);
    for (request.shown = 0; request.shown <= all.lines + 1; request.shown++) {
        qdot_layout_size size = {0};
        qdot_text part = {0};

        assert_int_equal(qdot_layout_part(&f, formula, &request, &part, &size), QDOT_OK);
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
    const qdot_formula_id formulas[] = {
        SPAN(WORDS("    of "), WORDS("a: "), SPAN(WORDS("T"), EQUALS, OVER(NAME("a"), NAME("b")))),
        SPAN(node(QDOT_FORMULA_SPAN, 0, QDOT_FORMULA_LABEL, INDEX(NAME("p"), NAME("q")), END), EQUALS, NAME("x")),
        SPAN(NAME("x"), EQUALS, WORDS("y"))};
    qdot_layout_size size = {0};
    qdot_text out = {0};

    (void)state;
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(qdot_layout_part(&f, formulas[i], &request, &out, &size), QDOT_OK);
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
    const qdot_formula_id formula = SPAN(NAME("x"));

    (void)state;
    for (int i = 0; i < 40; i++)
        qdot_formula_append(
            &f, formula,
            i % 3 == 0   ? SPAN(EQUALS, NAME("x"), PLUS, ROOT(OVER(NAME("a"), NAME("b"))))
            : i % 3 == 1 ? SPAN(MINUS, POWER(ROUND(NAME("yy"), MINUS, NAME("z")), NAME("k")))
                         : SPAN(TIMES, APPLY(FUNCTION("sin"), ROUND(NAME("u"), PLUS, NAME("w")))));
    for (size_t width = 1; width < 120; width++) {
        const size_t room = width > 16 ? width : 16;
        qdot_text out = {0};
        qdot_layout_size size = {0};
        size_t widest = 0;

        assert_int_equal(qdot_layout(&f, formula, width, &out, &size), QDOT_OK);
        for (const char *at = out.at; *at != '\0'; at += strcspn(at, "\n") + 1) {
            const size_t columns = qdot_utf8_columns(at, strcspn(at, "\n"));

            widest = columns > widest ? columns : widest;
        }
        assert_true(widest <= room && widest <= size.columns);
        qdot_text_clear(&out);
    }
}

/* However deep: no recursion. */
static void
depth_is_no_matter(void **state)
{
    enum { DEPTH = 20000 };
    qdot_formula_id inner = SPAN(NAME("x"));
    qdot_text out = {0};

    (void)state;
    for (int i = 0; i < DEPTH; i++)
        inner = ROUND(NAME("x"), PLUS, inner);
    assert_int_equal(qdot_layout(&f, inner, 80, &out, NULL), QDOT_OK);
    qdot_text_clear(&out);
}

static void
failing_allocations_are_told(void **state)
{
    const qdot_formula_id formula =
        SPAN(NAME("x"), EQUALS, OVER(ROW(NAME("aaaaaaaaaa"), PLUS, POWER(NAME("b"), NUMBER("2"))), NAME("c")));
    bool failed = true;

    (void)state;
    for (int64_t n = 0; failed; n++) {
        qdot_text out = {0};
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_layout(&f, formula, 16, &out, NULL);
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
        TEST(characters_are_taken_where_there_are_some),
        TEST(fractions_and_roots_are_built_up),
        TEST(scripts_are_raised_and_lowered),
        TEST(columns_of_matrices_are_aligned),
        TEST(long_formulas_are_broken),
        TEST(no_line_is_wider_than_the_terminal),
        TEST(a_value_stands_behind_a_broken_name),
        TEST(matrices_that_are_too_wide_are_broken_by_rows),
        TEST(words_before_a_formula_are_labels),
        TEST(lines_beyond_are_only_counted),
        TEST(names_are_coloured),
        TEST(every_width_is_kept),
        TEST(depth_is_no_matter),
        TEST(failing_allocations_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
