#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "num/sum.h"

static void
two_sum_loses_nothing(void **state)
{
    double e, s = qdot_two_sum(0x1p60, 2.385, &e);

    (void)state;
    assert_true(s == 0x1p60);
    assert_true(e == 2.385);
    s = qdot_two_sum(-2.385, 0x1p60, &e);
    assert_true(s == 0x1p60 && e == -2.385);
    s = qdot_two_sum(0.1, 0.2, &e);
    assert_true((long double)s + e == (long double)0.1 + 0.2);
}

static void
cancelling_sum_is_exact(void **state)
{
    const double x[] = {1e100, 1.0, -1e100, 2.385, 1e16, -1e16};
    qdot_sum s = {0};

    (void)state;
    for (int i = 0; i < 6; i++)
        qdot_sum_add(&s, x[i]);
    assert_true(qdot_sum_value(&s) == 3.385);
}

static void
sum_of_tenths_matches_long_double(void **state)
{
    qdot_sum s = {0};
    double plain = 0;

    (void)state;
    for (int i = 0; i < 1000000; i++) {
        qdot_sum_add(&s, 0.1);
        plain += 0.1;
    }
    assert_true(qdot_sum_value(&s) == (double)(1000000.0L * 0.1));
    assert_true(plain != qdot_sum_value(&s));
}

static void
advance_keeps_a_small_carry(void **state)
{
    double hi = 1, lo = 0;

    (void)state;
    for (int i = 0; i < 1 << 20; i++)
        qdot_sum_advance(&hi, &lo, 0x1p-60);
    assert_true(hi == 1 + 0x1p-40);
    assert_true(lo == 0);
}

/* x has its last place at 2^-56, the rests are below half of it. */
static void
advance_by_keeps_the_rest(void **state)
{
    const double x = 0x1p-4 + 0x1p-56, rest = 0x1p-59;
    double hi = 1, lo = 0;

    (void)state;
    for (int i = 0; i < 1 << 10; i++)
        qdot_sum_advance_by(&hi, &lo, x, rest);
    assert_true((hi - 1 - 64) + lo == 0x1p-46 + 0x1p-49);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_sum_loses_nothing),
        cmocka_unit_test(cancelling_sum_is_exact),
        cmocka_unit_test(sum_of_tenths_matches_long_double),
        cmocka_unit_test(advance_keeps_a_small_carry),
        cmocka_unit_test(advance_by_keeps_the_rest),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
