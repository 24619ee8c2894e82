/* test_text.c -- a growing string, its numbers, its JSON, its failures. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "base/text.h"

static void
nothing_appended_is_the_empty_string(void **state)
{
    qdot_text s = {0};

    (void)state;
    assert_string_equal(qdot_text_str(&s), "");
    assert_int_equal(qdot_text_status(&s), QDOT_OK);
    qdot_text_add(&s, "");
    assert_string_equal(qdot_text_str(&s), "");
    assert_int_equal(s.n, 0);
    qdot_text_clear(&s);
}

static void
pieces_join_in_order(void **state)
{
    qdot_text s = {0};

    (void)state;
    qdot_text_add(&s, "m*");
    qdot_text_add_n(&s, "r^2 and more", 3);
    qdot_text_char(&s, '/');
    qdot_text_format(&s, "%d%s", 2, "!");
    assert_string_equal(qdot_text_str(&s), "m*r^2/2!");
    assert_int_equal(s.n, 8);
    qdot_text_clear(&s);
    assert_string_equal(qdot_text_str(&s), "");
    assert_int_equal(s.capacity, 0);
}

/* Against a plain array: lengths around every power of two up to 64 KiB. */
static void
growing_keeps_every_byte(void **state)
{
    static char plain[70000];
    qdot_text s = {0};
    size_t n = 0;

    (void)state;
    while (n < sizeof plain - 1) {
        plain[n] = (char)('a' + n * 7 % 26);
        qdot_text_char(&s, plain[n]);
        n++;
        if ((n & (n - 1)) == 0 || (n & (n + 1)) == 0) {
            assert_int_equal(s.n, n);
            assert_int_equal(s.at[n], '\0');
            assert_memory_equal(s.at, plain, n);
        }
    }
    qdot_text_clear(&s);
}

/* One format in the small buffer, at its edge and beyond, against snprintf. */
static void
formats_of_any_length_match_snprintf(void **state)
{
    char expected[2100];

    (void)state;
    for (int width = 0; width <= 2000; width += width > 240 && width < 270 ? 1 : 13) {
        qdot_text s = {0};

        snprintf(expected, sizeof expected, "<%*d>", width, 42);
        qdot_text_add(&s, "x");
        qdot_text_format(&s, "<%*d>", width, 42);
        assert_string_equal(qdot_text_str(&s) + 1, expected);
        assert_int_equal(s.n, strlen(expected) + 1);
        qdot_text_clear(&s);
    }
}

static void
truncate_shortens_and_never_lengthens(void **state)
{
    qdot_text s = {0};

    (void)state;
    qdot_text_truncate(&s, 3); /* nothing there */
    assert_string_equal(qdot_text_str(&s), "");
    qdot_text_add(&s, "theta");
    qdot_text_truncate(&s, 7);
    assert_string_equal(qdot_text_str(&s), "theta");
    assert_int_equal(s.n, 5);
    qdot_text_truncate(&s, 2);
    assert_string_equal(qdot_text_str(&s), "th");
    qdot_text_add(&s, "!");
    assert_string_equal(qdot_text_str(&s), "th!");
    qdot_text_clear(&s);
}

static void
a_double_of_17_digits_reads_back_the_same(void **state)
{
    uint64_t bits = 0x9E3779B97F4A7C15u;

    (void)state;
    for (int i = 0; i < 20000; i++) {
        qdot_text s = {0};
        double x;

        bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x))
            continue;
        qdot_text_double(&s, x, 17);
        if (strtod(qdot_text_str(&s), NULL) != x)
            fail_msg("%a was written %s", x, qdot_text_str(&s));
        qdot_text_clear(&s);
    }
}

static void
doubles_are_written_short_and_in_words(void **state)
{
    static const struct {
        double x;
        int digits;
        const char *text;
    } row[] = {
        {2.385, 4, "2.385"},    {1.0 / 3, 3, "0.333"},
        {-1e-12, 3, "-1e-12"},  {6.02214076e23, 4, "6.022e+23"},
        {NAN, 5, "nan"},        {INFINITY, 5, "inf"},
        {-INFINITY, 5, "-inf"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_text s = {0};

        qdot_text_double(&s, row[i].x, row[i].digits);
        assert_string_equal(qdot_text_str(&s), row[i].text);
        qdot_text_clear(&s);
    }
}

static void
the_fewest_digits_read_back_the_same(void **state)
{
    static const struct {
        double x;
        int least, digits;
    } row[] = {
        {0.1, 1, 1}, {0.1, 15, 15}, {2.385, 1, 4}, {1e22, 1, 1}, {0.1 + 0.2, 1, 17}, {1.0 / 3, 1, 16}, {0, 1, 1},
        {-0.0, 3, 3}, {5e-324, 1, 1}, {NAN, 1, 17}, {INFINITY, 1, 1},
    };
    uint64_t bits = 0x2545F4914F6CDD1Du;

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        assert_int_equal(qdot_double_digits(row[i].x, row[i].least), row[i].digits);
    for (int i = 0; i < 20000; i++) {
        char text[400];
        double x;
        int digits;

        bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x))
            continue;
        digits = qdot_double_digits(x, 1);
        snprintf(text, sizeof text, "%.*g", digits, x);
        assert_true(strtod(text, NULL) == x);
        snprintf(text, sizeof text, "%.*g", digits - 1, x);
        assert_true(digits == 1 || strtod(text, NULL) != x);
    }
}

static void
json_escapes_what_it_must(void **state)
{
    static const struct {
        const char *text, *json;
    } row[] = {
        {"", "\"\""},
        {"theta'", "\"theta'\""},
        {"say \"a\\b\"", "\"say \\\"a\\\\b\\\"\""},
        {"a\nb\tc\x01\x7f", "\"a\\u000ab\\u0009c\\u0001\\u007f\""},
        {"\xCE\xB8\xF0\x9D\x9C\x83", "\"\xCE\xB8\xF0\x9D\x9C\x83\""},
        {"a\xFFz\xCE", "\"a\xEF\xBF\xBDz\xEF\xBF\xBD\""},
        {"\xED\xA0\x80", "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\""},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_text s = {0};

        qdot_text_json(&s, row[i].text);
        assert_string_equal(qdot_text_str(&s), row[i].json);
        qdot_text_clear(&s);
    }
}

/* The allocations of one long text are made to fail, one after the other, until none is
 * left to fail; each time the mark is set, kept, and what was there is whole. */
static void
a_failed_append_marks_the_string_for_good(void **state)
{
    bool passed = false;

    (void)state;
    for (int64_t n = 0; !passed; n++) {
        qdot_text s = {0};

        assert_true(n < 100);
        qdot_memory_fail_at(n);
        for (int i = 0; i < 100; i++)
            qdot_text_format(&s, "%d %300d,", i, i);
        qdot_memory_fail_at(-1);
        passed = qdot_text_status(&s) == QDOT_OK;
        if (!passed) {
            size_t length = s.n;

            assert_int_equal(qdot_last_error()->status, QDOT_ENOMEM);
            qdot_text_add(&s, "more");
            qdot_text_char(&s, 'x');
            qdot_text_format(&s, "%300d", 1);
            assert_int_equal(s.n, length);
            assert_int_equal(strlen(qdot_text_str(&s)), length);
            assert_int_equal(qdot_text_status(&s), QDOT_ENOMEM);
        } else {
            assert_true(n > 3);
            assert_int_equal(s.n, 10 * 303 + 90 * 304);
        }
        qdot_text_clear(&s);
    }
}

static void
an_ending_has_something_before_it(void **state)
{
    (void)state;
    assert_true(qdot_ends_in("a.csv", ".csv"));
    assert_false(qdot_ends_in(".csv", ".csv"));
    assert_false(qdot_ends_in("csv", ".csv"));
    assert_false(qdot_ends_in("a.csv.txt", ".csv"));
}

static void
a_member_has_the_name_of_its_family_before_the_bracket(void **state)
{
    (void)state;
    assert_true(qdot_is_member_of("theta[2]", "theta"));
    assert_false(qdot_is_member_of("theta", "theta"));
    assert_false(qdot_is_member_of("theta1[2]", "theta"));
    assert_false(qdot_is_member_of("the[2]", "theta"));
}

static void
a_word_stands_by_itself(void **state)
{
    (void)state;
    assert_true(qdot_has_word("run T0..T1 [tol TOL]", "tol"));
    assert_true(qdot_has_word("a|b", "b"));
    assert_false(qdot_has_word("tolerance", "tol"));
    assert_false(qdot_has_word("a_tol", "tol"));
    assert_true(qdot_has_word("tolerance, tol", "tol"));
    assert_false(qdot_has_word("", "tol"));
}

static void
html_has_entities(void **state)
{
    qdot_text s = {0};

    (void)state;
    qdot_text_html(&s, "a<b & \"c\">d; not this", 13, false);
    assert_string_equal(qdot_text_str(&s), "a&lt;b &amp; \"c\"&gt;d; ");
    qdot_text_truncate(&s, 0);
    qdot_text_html(&s, "\"<>&\"", 5, true);
    assert_string_equal(qdot_text_str(&s), "&quot;&lt;&gt;&amp;&quot;");
    qdot_text_clear(&s);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_appended_is_the_empty_string),
        cmocka_unit_test(pieces_join_in_order),
        cmocka_unit_test(growing_keeps_every_byte),
        cmocka_unit_test(formats_of_any_length_match_snprintf),
        cmocka_unit_test(truncate_shortens_and_never_lengthens),
        cmocka_unit_test(a_double_of_17_digits_reads_back_the_same),
        cmocka_unit_test(doubles_are_written_short_and_in_words),
        cmocka_unit_test(the_fewest_digits_read_back_the_same),
        cmocka_unit_test(json_escapes_what_it_must),
        cmocka_unit_test(a_failed_append_marks_the_string_for_good),
        cmocka_unit_test(an_ending_has_something_before_it),
        cmocka_unit_test(a_member_has_the_name_of_its_family_before_the_bracket),
        cmocka_unit_test(a_word_stands_by_itself),
        cmocka_unit_test(html_has_entities),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
