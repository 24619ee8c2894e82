/* test_utf8.c -- decoding is strict and inverts encoding for every code point. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "base/utf8.h"

/* The encoding by the table of RFC 3629, section 3; bytes written. */
static size_t
encode(uint32_t c, char *out)
{
    unsigned char *s = (unsigned char *)out;
    size_t n = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;

    for (size_t i = n; i-- > 1; c >>= 6)
        s[i] = (unsigned char)(0x80 | (c & 0x3F));
    s[0] = (unsigned char)(n == 1 ? c : (0xF00u >> n & 0xFF) | c);
    s[n] = '\0';
    return n;
}

static void
every_code_point_comes_back(void **state)
{
    (void)state;
    for (uint32_t c = 1; c <= 0x10FFFF; c++) {
        char text[8];
        size_t n, length;
        uint32_t seen;

        if (c == 0xD800)
            c = 0xE000;
        n = encode(c, text);
        seen = qdot_utf8_decode(text, &length);
        if (seen != c || length != n || qdot_utf8_length(text) != n)
            fail_msg("U+%04X: decoded as U+%04X, %zu bytes of %zu", c, seen, length, n);
    }
}

static void
known_letters_decode(void **state)
{
    size_t length;

    (void)state;
    assert_int_equal(qdot_utf8_decode("q", &length), 'q');
    assert_int_equal(length, 1);
    assert_int_equal(qdot_utf8_decode("\xCE\xB8", &length), 0x3B8); /* theta */
    assert_int_equal(length, 2);
    assert_int_equal(qdot_utf8_decode("\xE2\x88\x82t", &length), 0x2202); /* partial */
    assert_int_equal(length, 3);
    assert_int_equal(qdot_utf8_decode("\xF0\x9D\x9C\x83", &length), 0x1D703);
    assert_int_equal(length, 4);
}

static void
what_is_not_well_formed_has_length_0(void **state)
{
    static const char *const bad[] = {
        "",                 /* the end */
        "\x80",             /* a continuation alone */
        "\xBF\x80",         /* two */
        "\xC0\x80",         /* NUL, overlong */
        "\xC1\xBF",         /* overlong in 2 */
        "\xE0\x9F\xBF",     /* overlong in 3 */
        "\xF0\x8F\xBF\xBF", /* overlong in 4 */
        "\xED\xA0\x80",     /* the first surrogate */
        "\xED\xBF\xBF",     /* the last surrogate */
        "\xF4\x90\x80\x80", /* beyond U+10FFFF */
        "\xF5\x80\x80\x80", /* a byte that never occurs */
        "\xFE",
        "\xFF",
        "\xCE",         /* cut short by the end */
        "\xE2\x88",     /* cut short */
        "\xF0\x9D\x9C", /* cut short */
        "\xCE!",        /* cut short by a letter */
        "\xE2\x88\xCE", /* by another beginning */
    };

    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        size_t length = 99;

        if (qdot_utf8_decode(bad[i], &length) != 0 || length != 0)
            fail_msg("sequence %zu was taken, %zu bytes", i, length);
        assert_int_equal(qdot_utf8_length(bad[i]), 0);
    }
}

static void
columns_count_code_points(void **state)
{
    const char *text = "\xCE\xB8' = \xE2\x88\x82x";

    (void)state;
    assert_int_equal(qdot_utf8_columns(text, strlen(text)), 7);
    assert_int_equal(qdot_utf8_columns(text, 2), 1);
    assert_int_equal(qdot_utf8_columns(text, 0), 0);
    assert_int_equal(qdot_utf8_columns("plain", 5), 5);
}

static void
bytes_that_are_no_character_are_removed(void **state)
{
    char text[] = "\xFF\xCE\xB8\xCE a\xE2\x88.\xE2\x88\x82\xF0\x9D\x9C", plain[] = "plain", none[] = "";

    (void)state;
    qdot_utf8_mend(text);
    qdot_utf8_mend(plain);
    qdot_utf8_mend(none);
    assert_string_equal(text, "\xCE\xB8 a.\xE2\x88\x82");
    assert_string_equal(plain, "plain");
    assert_string_equal(none, "");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_code_point_comes_back),
        cmocka_unit_test(known_letters_decode),
        cmocka_unit_test(what_is_not_well_formed_has_length_0),
        cmocka_unit_test(columns_count_code_points),
        cmocka_unit_test(bytes_that_are_no_character_are_removed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
