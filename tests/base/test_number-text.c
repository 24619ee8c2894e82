/* test_number-text.c -- numbers as people read them. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/number-text.h"

static void
bounds_have_one_digit_rounded_up(void **state)
{
    static const struct {
        double error;
        const char *text;
    } rows[] = {{3e-13, "3e-13"}, {2.1e-5, "3e-5"}, {0.003, "0.003"}, {0.31, "0.4"}, {1, "1"},
                {9.5, "10"},      {12, "20"},       {999, "1000"},    {1234, "2000"}, {12345, "2e4"}};

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_text text = {0};

        qdot_number_text_bound(&text, rows[i].error);
        assert_string_equal(qdot_text_str(&text), rows[i].text);
        qdot_text_clear(&text);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bounds_have_one_digit_rounded_up)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
