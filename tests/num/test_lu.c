#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "kit.h"

#include "num/lu.h"

enum { MOST = 20 };

static void
fill(double *A, size_t n)
{
    for (size_t i = 0; i < n * n; i++)
        A[i] = uniform();
    if (n > 1)
        A[0] = 0; /* a row must be exchanged */
}

static void
real_systems_are_solved(void **state)
{
    double A[MOST * MOST], kept[MOST * MOST], b[MOST], x[MOST];
    size_t pivot[MOST];

    (void)state;
    for (size_t n = 1; n <= MOST; n++) {
        fill(A, n);
        for (size_t i = 0; i < n * n; i++)
            kept[i] = A[i];
        for (size_t i = 0; i < n; i++)
            x[i] = b[i] = uniform();
        assert_true(qdot_lu_factor(n, A, pivot));
        qdot_lu_solve(n, A, pivot, x);
        assert_true(linear_residual(kept, n, x, b) < 1e-15 * (double)n);
    }
}

/* (R + i I)(x + i y) = b + i c as a real system of twice the size. */
static void
complex_systems_are_solved(void **state)
{
    static double re[MOST * MOST], im[MOST * MOST], K[4 * MOST * MOST], b[2 * MOST],
        x[2 * MOST];
    size_t pivot[MOST];

    (void)state;
    for (size_t n = 1; n <= MOST; n++) {
        fill(re, n);
        fill(im, n);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                K[i * 2 * n + j] = K[(n + i) * 2 * n + n + j] = re[i * n + j];
                K[(n + i) * 2 * n + j] = im[i * n + j];
                K[i * 2 * n + n + j] = -im[i * n + j];
            }
        for (size_t i = 0; i < 2 * n; i++)
            x[i] = b[i] = uniform();
        assert_true(qdot_lu_factor_complex(n, re, im, pivot));
        qdot_lu_solve_complex(n, re, im, pivot, x, x + n);
        assert_true(linear_residual(K, 2 * n, x, b) < 1e-15 * (double)n);
    }
}

static void
singular_systems_are_told(void **state)
{
    double A[] = {1, 2, 2, 4}, re[] = {1, 0, 0, -1},
           im[] = {0, 1, 1, 0}; /* rows i times each other */
    size_t pivot[2];

    (void)state;
    assert_false(qdot_lu_factor(2, A, pivot));
    assert_false(qdot_lu_factor_complex(2, re, im, pivot));
    re[0] = NAN;
    assert_false(qdot_lu_factor_complex(2, re, im, pivot));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(real_systems_are_solved),
        cmocka_unit_test(complex_systems_are_solved),
        cmocka_unit_test(singular_systems_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
