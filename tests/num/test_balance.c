#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <cmocka.h>

#include "num/balance.h"

/* The slopes of an oscillator of frequency w: units of x and v come out w apart, as powers of 2. */
static void
units_of_an_oscillator(void **state)
{
    static const double w[] = {1, 1e3, 3e6, 2e-9};

    (void)state;
    for (size_t k = 0; k < sizeof w / sizeof *w; k++) {
        const double A[] = {0.3, 1 / w[k], -w[k], 0.3};
        double d[2];

        qdot_balance(2, A, d);
        assert_true(fabs(log2(d[1] / d[0] / w[k])) <= 1);
        assert_true(frexp(d[1] / d[0], &(int){0}) == 0.5);
    }
}

/* What is not coupled, or not known, keeps its unit. */
static void
what_stands_alone_keeps_its_unit(void **state)
{
    const double A[] = {1, 0, 0, 0, 5, 1e8, NAN, 2e-8, 5};
    double d[3];

    (void)state;
    qdot_balance(3, A, d);
    assert_true(d[0] == 1);
    qdot_balance(3, (const double[]){1, 0, 0, 0, 5, 1e8, 0, 1e-8, 5}, d);
    assert_true(d[0] == 1 && fabs(log2(d[1] / d[2] / 1e8)) <= 1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_of_an_oscillator),
        cmocka_unit_test(what_stands_alone_keeps_its_unit),
    };

    return cmocka_run_group_tests_name("balance", tests, NULL, NULL);
}
