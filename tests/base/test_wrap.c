/* test_wrap.c -- lines broken at blanks, tables folded, to the width of a window. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "base/terminal.h"
#include "base/utf8.h"
#include "base/wrap.h"

#define C QDOT_WRAP_CELL

static void
becomes(const char *text, size_t width, const char *expected)
{
    qdot_text out = {0};

    qdot_wrap(text, width, &out);
    assert_int_equal(qdot_text_status(&out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), expected);
    qdot_text_clear(&out);
}

static void
what_fits_stays_as_it_is(void **state)
{
    (void)state;
    becomes("", 10, "");
    becomes("\n\n", 10, "\n\n");
    becomes("a  b\n   c\n", 5, "a  b\n   c\n");
    becomes("no end", 6, "no end");
    becomes("off a terminal nothing is broken\n", 0,
            "off a terminal nothing is broken\n");
}

static void
lines_end_at_blanks(void **state)
{
    (void)state;
    becomes("one two three four\n", 9, "one two\n  three\n  four\n");
    becomes("  one two three\n", 10, "  one two\n    three\n");
    becomes("ends in blanks   \n", 14, "ends in blanks\n");
    becomes("a wordthatistoolongforit b\n", 10, "a\n  wordthat\n  istoolon\n  gforit b\n");
}

/* Behind a sign in the second half of a line, else where the line is full; marks stay with their letters. */
static void
words_that_are_too_long_are_cut(void **state)
{
    (void)state;
    becomes("value(theta,20)\n", 14, "value(theta,\n  20)\n");
    becomes("f(x)abcdefghijkl\n", 10, "f(x)abcdef\n  ghijkl\n");
    becomes("x = 1.2345678901234567890 ± 1e-3\n", 14, "x =\n  1.2345678901\n  234567890\n  ± 1e-3\n");
    becomes(QDOT_RED "abcde" QDOT_COLOUR_END "θ\u0307θ\u0307\n", 6,
            QDOT_RED "abcde" QDOT_COLOUR_END "θ\u0307\n  θ\u0307\n");
    assert_int_equal(qdot_wrap_cut("abc", 3, 3), 3);
    assert_int_equal(qdot_wrap_cut("abc", 3, 0), 1);
}

static void
a_second_column_keeps_its_place(void **state)
{
    (void)state;
    becomes("  param   declare parameters, each by itself\n", 34,
            "  param   declare parameters, each\n          by itself\n");
    /* where it would be too narrow it does not */
    becomes("  a rather long name   declare it\n", 24,
            "  a rather long name\n    declare it\n");
}

static void
a_value_stays_with_its_name(void **state)
{
    (void)state;
    becomes("theta = 1.25, phi = 0.5\n", 20, "theta = 1.25,\n  phi = 0.5\n");
    becomes("value 1.25 ± 3e-13\n", 13, "value 1.25 ±\n  3e-13\n");
    becomes("value 1.25 ± 3e-13\n", 14, "value\n  1.25 ± 3e-13\n");
    becomes("a*b*c + d*e*f - g\n", 14, "a*b*c + d*e*f\n  - g\n");
    becomes("a*b*c + d*e*f - g\n", 12, "a*b*c\n  + d*e*f\n  - g\n");
}

static void
marks_and_colours_take_no_column(void **state)
{
    (void)state;
    becomes("θ̇₁ ü ½ −1\n", 9, "θ̇₁ ü ½ −1\n");
    becomes(QDOT_YELLOW "notice:" QDOT_COLOUR_END " as wide\n", 15,
            QDOT_YELLOW "notice:" QDOT_COLOUR_END " as wide\n");
    becomes(QDOT_YELLOW "notice:" QDOT_COLOUR_END " as wide\n", 14,
            QDOT_YELLOW "notice:" QDOT_COLOUR_END " as\n  wide\n");
}

static const char numbers[] = "t" C "  theta" C "  energy" C "  text\n"
                              "0" C "    1.2" C "      -3" C "  done\n"
                              "1" C "    0.7" C "      -4" C "  it did not go well\n";

static void
a_table_that_fits_loses_its_marks(void **state)
{
    const char *const plain = "t  theta  energy  text\n"
                              "0    1.2      -3  done\n"
                              "1    0.7      -4  it did not go well\n";

    (void)state;
    becomes(numbers, 0, plain);
    becomes(numbers, 36, plain);
}

static void
a_wide_table_is_folded(void **state)
{
    (void)state;
    becomes(numbers, 20,
            "t  theta  energy\n0    1.2      -3\n1    0.7      -4\n\n"
            "t  text\n0  done\n1  it did not go\n   well\n");
    becomes(numbers, 8,
            "t\n  0\n  theta\n    1.2\n  energy\n    -3\n  text\n    done\n"
            "t\n  1\n  theta\n    0.7\n  energy\n    -4\n  text\n    it\n    did\n"
            "    not\n    go\n    well\n");
    becomes("t" C "  angle*angle*angle" C "  b\n0" C "                  0" C "  1\n", 16,
            "t\n  0\n  angle*angle*\n    angle\n    0\n  b\n    1\n");
    becomes("t" C "  b" C "  angle*angle*angle\n0" C "  1" C "                  0\n", 18,
            "t\n  0\n  b\n    1\n  angle*angle*\n    angle\n    0\n");
    becomes("case" C "  max(theta)" C "  error\none" C "  0.117783..0.7088" C "  small\n", 20,
            "case          one\n  max(theta)\n    0.117783..0.7088\n  error       small\n");
}

static void
rows_are_told_apart(void **state)
{
    (void)state;
    becomes("m" C " tol" C "   steps" C "   errors\n"
            "a" C "   1" C "      12" C "     1e-3\n"
            "a" C "   2" C "      24" C "     1e-5\n",
            15,
            "m tol   steps\na   1      12\na   2      24\n\n"
            "m tol   errors\na   1     1e-3\na   2     1e-5\n");
}

/* Random words: nothing but blanks and ends of lines changes; each line fits, but where the first is all blanks. */
static void
nothing_is_lost(void **state)
{
    (void)state;
    srand(3);
    for (int trial = 0; trial < 2000; trial++) {
        char text[400] = "", kept[400] = "", got[2000] = "";
        const size_t width = 1 + (size_t)rand() % 30;
        qdot_text out = {0};
        size_t n = 0, m = 0;

        for (int i = rand() % 60; i > 0; i--) {
            static const char *const parts[] = {"a",  "bc",  "def", " ",  " ",
                                                "  ", " = ", " + ", "\n", "±"};

            strcat(text, parts[(size_t)rand() % (sizeof parts / sizeof *parts)]);
        }
        qdot_wrap(text, width, &out);
        for (const char *c = text; *c != '\0'; c++)
            if (*c != ' ' && *c != '\n')
                kept[n++] = *c;
        for (const char *c = qdot_text_str(&out); *c != '\0'; c++)
            if (*c != ' ' && *c != '\n')
                got[m++] = *c;
        assert_string_equal(got, kept);
        for (const char *line = qdot_text_str(&out); *line != '\0';) {
            const size_t all = strcspn(line, "\n"), left = strspn(line, " ");

            if (qdot_utf8_columns(line, all) > width)
                assert_true(left >= width || width < 4);
            line += all + (line[all] == '\n');
        }
        qdot_text_clear(&out);
    }
}

/* Every allocation fails once: the text is marked, nothing leaks or is read behind its end. */
static void
no_memory_is_told(void **state)
{
    (void)state;
    for (int64_t k = 0;; k++) {
        qdot_text out = {0};
        bool failed;

        qdot_memory_fail_at(k);
        qdot_wrap(numbers, 20, &out);
        qdot_memory_fail_at(-1);
        failed = qdot_text_status(&out) != QDOT_OK;
        qdot_text_clear(&out);
        if (!failed) {
            assert_true(k > 3);
            return;
        }
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fits_stays_as_it_is),
        cmocka_unit_test(lines_end_at_blanks),
        cmocka_unit_test(words_that_are_too_long_are_cut),
        cmocka_unit_test(a_second_column_keeps_its_place),
        cmocka_unit_test(a_value_stays_with_its_name),
        cmocka_unit_test(marks_and_colours_take_no_column),
        cmocka_unit_test(a_table_that_fits_loses_its_marks),
        cmocka_unit_test(a_wide_table_is_folded),
        cmocka_unit_test(rows_are_told_apart),
        cmocka_unit_test(nothing_is_lost),
        cmocka_unit_test(no_memory_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
