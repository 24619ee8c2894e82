/* test_integer.c -- integers of 64 bits pass to FLINT and back, whatever its words have. */
#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "num/integer.h"

static const int64_t numbers[] = {0,          1,          -1,          INT64_C(1) << 29,   (INT64_C(1) << 30) - 1,
                                  INT64_C(1) << 30, -(INT64_C(1) << 30), INT32_MAX,        INT32_MIN,
                                  INT64_C(1) << 31, INT64_C(0xffffffff), INT64_C(0x100000000), INT64_C(-0x100000000),
                                  INT64_C(1234567890123456789), INT64_C(1) << 62, -(INT64_C(1) << 62), INT64_MAX,
                                  INT64_MIN,  INT64_MIN + 1};

/* The decimal digits that the C library writes are those that FLINT writes. */
static void
numbers_pass_unchanged(void **state)
{
    char wanted[32], seen[32];
    fmpz_t x;

    (void)state;
    fmpz_init(x);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        qdot_integer_set(x, numbers[i]);
        snprintf(wanted, sizeof wanted, "%" PRId64, numbers[i]);
        assert_string_equal(fmpz_get_str(seen, 10, x), wanted);
        assert_true(qdot_integer_fits(x));
        assert_true(qdot_integer_get(x) == numbers[i]);
        qdot_integer_set_unsigned(x, (uint64_t)numbers[i]);
        snprintf(wanted, sizeof wanted, "%" PRIu64, (uint64_t)numbers[i]);
        assert_string_equal(fmpz_get_str(seen, 10, x), wanted);
        for (size_t j = 0; j < sizeof numbers / sizeof *numbers; j++)
            if (llabs(numbers[j] / 2) < INT64_C(1) << 61) {
                qdot_integer_set(x, numbers[i]);
                assert_int_equal(qdot_integer_is(x, numbers[j]), i == j);
            }
    }
    fmpz_clear(x);
}

static void
what_has_more_bits_does_not_fit(void **state)
{
    static const char *const texts[] = {"9223372036854775808", "-9223372036854775809", "18446744073709551616",
                                        "-18446744073709551616", "-9223372041149743104"};
    fmpz_t x;

    (void)state;
    fmpz_init(x);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        assert_int_equal(fmpz_set_str(x, texts[i], 10), 0);
        assert_false(qdot_integer_fits(x));
        assert_false(qdot_integer_is(x, 0));
        assert_false(qdot_integer_is(x, INT64_C(1) << 32));
    }
    fmpz_clear(x);
}

static void
quotients_are_in_lowest_terms(void **state)
{
    char seen[64];
    fmpq_t x;

    (void)state;
    fmpq_init(x);
    qdot_rational_set_integers(x, INT64_C(-6000000000000000006), UINT64_C(10000000000000000010));
    assert_string_equal(fmpq_get_str(seen, 10, x), "-3/5");
    qdot_rational_set_integers(x, INT64_MIN, 3);
    assert_string_equal(fmpq_get_str(seen, 10, x), "-9223372036854775808/3");
    fmpq_clear(x);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_pass_unchanged),
        cmocka_unit_test(what_has_more_bits_does_not_fit),
        cmocka_unit_test(quotients_are_in_lowest_terms),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
