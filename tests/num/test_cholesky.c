#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/cholesky.h"

enum { most = 24 };

/* B B^T of a random n x rank B; rank = n: positive definite, else singular. */
static void
gram(double *a, size_t n, size_t rank)
{
    double b[most * most];

    for (size_t i = 0; i < n * rank; i++)
        b[i] = uniform();
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            a[i * n + j] = 0;
            for (size_t k = 0; k < rank; k++)
                a[i * n + j] += b[i * rank + k] * b[j * rank + k];
        }
}

static void
random_matrices_are_solved_backward_stably(void **state)
{
    double a[most * most], l[most * most], b[most], x[most];

    (void)state;
    srand(1);
    for (int trial = 0; trial < 400; trial++) {
        size_t n = 1 + rand() % most;

        gram(a, n, n);
        for (size_t i = 0; i < n; i++) {
            a[i * n + i] += 0.01;
            b[i] = x[i] = uniform();
        }
        memcpy(l, a, n * n * sizeof *a);
        assert_int_equal(qdot_cholesky_factor(l, n, NULL, NULL), QDOT_OK);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++) {
                double s = 0;

                for (size_t k = 0; k <= j; k++)
                    s += l[i * n + k] * l[j * n + k];
                assert_true(fabs(s - a[i * n + j]) < 1e-13 * n);
            }
        qdot_cholesky_solve(l, n, NULL, x);
        assert_true(linear_residual(a, n, x, b) < 1e-15);
    }
}

/* A permuted block matrix by its structure and as a full one: the same solution; what
 * lies outside the blocks is never read. */
static void
structure_changes_nothing_but_the_work(void **state)
{
    (void)state;
    srand(2);
    for (int trial = 0; trial < 300; trial++) {
        size_t n = 2 + rand() % (most - 2);
        double a[most * most], full[most * most], x[most], y[most];
        bool pattern[most * most];
        size_t colour[most];
        qdot_structure s;

        gram(a, n, n);
        for (size_t i = 0; i < n; i++) {
            colour[i] = rand() % (1 + trial % 8);
            a[i * n + i] += 0.5;
            x[i] = y[i] = uniform();
        }
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                pattern[i * n + j] = colour[i] == colour[j];
                full[i * n + j] = pattern[i * n + j] ? a[i * n + j] : 0;
                if (!pattern[i * n + j])
                    a[i * n + j] = NAN;
            }
        assert_int_equal(qdot_structure_find(pattern, n, &s), QDOT_OK);
        assert_int_equal(qdot_cholesky_factor(a, n, &s, NULL), QDOT_OK);
        assert_int_equal(qdot_cholesky_factor(full, n, NULL, NULL), QDOT_OK);
        qdot_cholesky_solve(a, n, &s, x);
        qdot_cholesky_solve(full, n, NULL, y);
        for (size_t i = 0; i < n; i++)
            assert_true(fabs(x[i] - y[i]) < 1e-12 * fmax(1, fabs(y[i])));
        qdot_structure_clear(&s);
    }
}

/* Rank r of n: rows 0 .. r-1 are independent, so the pivot of row r is what vanishes. */
static void
rank_deficient_matrices_are_found_in_any_units(void **state)
{
    double a[most * most];
    int named = 0;

    (void)state;
    srand(3);
    for (int trial = 0; trial < 2000; trial++) {
        size_t n = 2 + rand() % (most - 2), rank = 1 + rand() % (n - 1), failed = n;
        double unit[most];

        gram(a, n, rank);
        for (size_t i = 0; i < n; i++)
            unit[i] = ldexp(1, rand() % 60 - 30);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                a[i * n + j] *= unit[i] * unit[j];
        assert_int_equal(qdot_cholesky_factor(a, n, NULL, &failed), QDOT_ESINGULAR);
        assert_true(failed <= rank);
        named += failed == rank;
    }
    assert_true(named >= 1990); /* else a leading block is singular to rounding as well */
}

/* Hilbert matrices: badly conditioned is not singular, until rounding says so. */
static void
ill_conditioned_matrices_are_not_singular(void **state)
{
    double a[most * most];
    size_t failed = 0;

    (void)state;
    for (size_t n = 2; n <= 14; n++) {
        qdot_status status;

        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                a[i * n + j] = 1.0 / (double)(i + j + 1);
        status = qdot_cholesky_factor(a, n, NULL, &failed);
        if (n <= 9) /* condition 5e11 */
            assert_int_equal(status, QDOT_OK);
        if (n >= 14) /* 5e18 */
            assert_int_equal(status, QDOT_ESINGULAR);
    }
}

static void
the_failing_row_is_named(void **state)
{
    /* blocks {0 2} {1 3}; the second has a row of zeros at 3 */
    double a[16] = {2, 0, 1, 0, 0, 5, 0, 0, 1, 0, 3, 0, 0, 0, 0, 0};
    bool pattern[16] = {0};
    double indefinite[4] = {1, 2, 2, 1}, nan[4] = {1, NAN, NAN, 1};
    double zero = 0, tiny = 1e-300;
    size_t failed = 9;
    qdot_structure s;

    (void)state;
    pattern[2] = pattern[7] = true;
    assert_int_equal(qdot_structure_find(pattern, 4, &s), QDOT_OK);
    assert_int_equal(qdot_cholesky_factor(a, 4, &s, &failed), QDOT_ESINGULAR);
    assert_int_equal(failed, 3);
    qdot_structure_clear(&s);
    assert_int_equal(qdot_cholesky_factor(indefinite, 2, NULL, &failed), QDOT_ESINGULAR);
    assert_int_equal(failed, 1);
    assert_int_equal(qdot_cholesky_factor(nan, 2, NULL, &failed), QDOT_ESINGULAR);
    assert_int_equal(qdot_cholesky_factor(&zero, 1, NULL, &failed), QDOT_ESINGULAR);
    assert_int_equal(failed, 0);
    assert_int_equal(qdot_cholesky_factor(&tiny, 1, NULL, &failed), QDOT_OK);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_matrices_are_solved_backward_stably),
        cmocka_unit_test(structure_changes_nothing_but_the_work),
        cmocka_unit_test(rank_deficient_matrices_are_found_in_any_units),
        cmocka_unit_test(ill_conditioned_matrices_are_not_singular),
        cmocka_unit_test(the_failing_row_is_named),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
