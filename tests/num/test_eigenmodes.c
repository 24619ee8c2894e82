#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <complex.h>
#include <math.h>
#include <cmocka.h>

#include "num/eigenmodes.h"

/* A rotation by 0.3, stretched by 2.385, beside -7 and 0.5: A v = lambda v, and f is the sum of its parts. */
static void
parts_make_the_vector(void **state)
{
    const double c = 2.385 * cos(0.3), s = 2.385 * sin(0.3);
    const double A[16] = {c, -s, 1, 2, s, c, 3, -1, 0, 0, -7, 4, 0, 0, 0, 0.5};
    const double f[4] = {0.3, -1.7, 2.1, 0.9};
    double complex lambda[4], v[16], part[4];

    (void)state;
    assert_int_equal(qdot_eigenmodes(4, A, f, lambda, v, part), QDOT_OK);
    for (int i = 0; i < 4; i++) {
        double complex sum = 0;

        for (int k = 0; k < 4; k++) {
            double complex image = 0;

            for (int j = 0; j < 4; j++)
                image += A[4 * i + j] * v[4 * k + j];
            assert_true(cabs(image - lambda[k] * v[4 * k + i]) < 1e-13);
            sum += part[k] * v[4 * k + i];
        }
        assert_true(cabs(sum - f[i]) < 1e-13);
    }
}

static void
too_few_vectors_are_told(void **state)
{
    const double A[4] = {2, 1, 0, 2}, f[2] = {1, 1};
    double complex lambda[2], v[4], part[2];
    const qdot_status status = qdot_eigenmodes(2, A, f, lambda, v, part);

    (void)state;
    /* the second vector is the first within rounding */
    assert_true(status == QDOT_EFAILED || cabs(part[1]) > 1e7);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_make_the_vector),
        cmocka_unit_test(too_few_vectors_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
