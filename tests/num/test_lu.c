#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "num/kit.h"

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
    qdot_lu_row rows[MOST];

    (void)state;
    for (size_t n = 1; n <= MOST; n++) {
        fill(A, n);
        for (size_t i = 0; i < n * n; i++)
            kept[i] = A[i];
        for (size_t i = 0; i < n; i++)
            x[i] = b[i] = uniform();
        assert_true(qdot_lu_factor(n, A, rows));
        qdot_lu_solve(n, A, rows, x);
        assert_true(linear_residual(kept, n, x, b) < 1e-15 * (double)n);
    }
}

/* (R + i I)(x + i y) = b + i c as a real system of twice the size. */
static void
complex_systems_are_solved(void **state)
{
    static double re[MOST * MOST], im[MOST * MOST], K[4 * MOST * MOST], b[2 * MOST],
        x[2 * MOST];
    qdot_lu_row rows[MOST];

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
        assert_true(qdot_lu_factor_complex(n, re, im, rows));
        qdot_lu_solve_complex(n, re, im, rows, x, x + n);
        assert_true(linear_residual(K, 2 * n, x, b) < 1e-15 * (double)n);
    }
}

/* A chain whose unknowns are shuffled: its order is that of the chain, from one end or the other,
 * and a matrix in it is solved as any. */
static void
neighbours_come_together(void **state)
{
    static bool pattern[MOST * MOST];
    static double A[MOST * MOST], kept[MOST * MOST];
    size_t place[MOST], order[MOST], scratch[MOST];
    double x[MOST], b[MOST];
    qdot_lu_row rows[MOST];

    (void)state;
    for (size_t i = 0; i < MOST; i++)
        place[i] = 7 * i % MOST;
    for (size_t i = 0; i < MOST; i++)
        for (size_t j = 0; j < MOST; j++)
            pattern[place[i] * MOST + place[j]] = i <= j + 1 && j <= i + 1;
    qdot_lu_order(MOST, pattern, order, scratch);
    for (size_t i = 0; i < MOST; i++)
        assert_true(order[i] == place[order[0] == place[0] ? i : MOST - 1 - i]);
    for (size_t i = 0; i < MOST; i++) {
        x[i] = b[i] = uniform();
        for (size_t j = 0; j < MOST; j++)
            A[i * MOST + j] = kept[i * MOST + j] =
                pattern[order[i] * MOST + order[j]] ? uniform() : 0;
    }
    assert_true(qdot_lu_factor(MOST, A, rows));
    for (size_t i = 0; i < MOST; i++)
        assert_true(rows[i].to <= i + 3);
    qdot_lu_solve(MOST, A, rows, x);
    assert_true(linear_residual(kept, MOST, x, b) < 1e-14);
}

static void
singular_systems_are_told(void **state)
{
    double A[] = {1, 2, 2, 4}, re[] = {1, 0, 0, -1},
           im[] = {0, 1, 1, 0}; /* rows i times each other */
    qdot_lu_row rows[2];

    (void)state;
    assert_false(qdot_lu_factor(2, A, rows));
    assert_false(qdot_lu_factor_complex(2, re, im, rows));
    re[0] = NAN;
    assert_false(qdot_lu_factor_complex(2, re, im, rows));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(real_systems_are_solved),
        cmocka_unit_test(complex_systems_are_solved),
        cmocka_unit_test(neighbours_come_together),
        cmocka_unit_test(singular_systems_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
