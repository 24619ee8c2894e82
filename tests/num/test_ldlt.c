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
#include "num/ldlt.h"

enum { most = 24 };

/* The upper triangle is never read: it holds NaN. */
static double
solve_and_measure(const double *a, size_t n)
{
    double f[most * most], b[most], x[most];
    qdot_ldlt l;

    for (size_t i = 0; i < n; i++) {
        b[i] = x[i] = uniform();
        for (size_t j = 0; j < n; j++)
            f[i * n + j] = j <= i ? a[i * n + j] : NAN;
    }
    assert_int_equal(qdot_ldlt_init(&l, n), QDOT_OK);
    assert_int_equal(qdot_ldlt_factor(&l, f, NULL), QDOT_OK);
    qdot_ldlt_solve(&l, f, x);
    qdot_ldlt_clear(&l);
    return linear_residual(a, n, x, b);
}

static void
random_indefinite_matrices_are_solved(void **state)
{
    double a[most * most];

    (void)state;
    srand(4);
    for (int trial = 0; trial < 1000; trial++) {
        size_t n = 1 + rand() % most;
        bool odd = trial % 2; /* then with a diagonal of zeros */

        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++)
                a[i * n + j] = a[j * n + i] = i == j && n > 1 && odd ? 0 : uniform();
        assert_true(solve_and_measure(a, n) < 3e-14);
    }
}

static void
saddle_points_are_solved(void **state)
{
    double a[most * most];

    (void)state;
    srand(5);
    for (int trial = 0; trial < 500; trial++) {
        size_t n = 2 + rand() % 10, m = 1 + rand() % n, all = n + m;

        memset(a, 0, sizeof a);
        for (size_t i = 0; i < n; i++)
            a[i * all + i] = 1 + fabs(uniform());
        for (size_t i = n; i < all; i++)
            for (size_t j = 0; j < n; j++)
                a[i * all + j] = a[j * all + i] = uniform();
        assert_true(solve_and_measure(a, all) < 1e-13);
    }
}

static void
positive_definite_matrices_agree_with_cholesky(void **state)
{
    double a[9] = {4, 1, 0.5, 1, 3, -1, 0.5, -1, 2.385}, c[9];
    double x[3] = {1, -2, 0.3}, y[3] = {1, -2, 0.3};
    qdot_ldlt l;

    (void)state;
    memcpy(c, a, sizeof a);
    assert_int_equal(qdot_ldlt_init(&l, 3), QDOT_OK);
    assert_int_equal(qdot_ldlt_factor(&l, a, NULL), QDOT_OK);
    assert_int_equal(qdot_cholesky_factor(c, 3, NULL, NULL), QDOT_OK);
    qdot_ldlt_solve(&l, a, x);
    qdot_cholesky_solve(c, 3, NULL, y);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(x[i] - y[i]) < 1e-15);
    qdot_ldlt_clear(&l);
}

/* C S C^T, C n x rank, S mixed signs: rank-deficient, indefinite, in any units. */
static void
rank_deficient_matrices_are_found(void **state)
{
    double a[most * most], c[most * most];
    qdot_ldlt l;

    (void)state;
    srand(6);
    for (int trial = 0; trial < 2000; trial++) {
        size_t n = 2 + rand() % 14, rank = 1 + rand() % (n - 1), failed = n;
        double unit[most];

        for (size_t i = 0; i < n * rank; i++)
            c[i] = uniform();
        for (size_t i = 0; i < n; i++)
            unit[i] = ldexp(1, rand() % 40 - 20);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                double s = 0;

                for (size_t k = 0; k < rank; k++)
                    s += (k % 2 ? -1 : 1) * c[i * rank + k] * c[j * rank + k];
                a[i * n + j] = s * unit[i] * unit[j];
            }
        assert_int_equal(qdot_ldlt_init(&l, n), QDOT_OK);
        assert_int_equal(qdot_ldlt_factor(&l, a, &failed), QDOT_ESINGULAR);
        assert_true(failed < n);
        qdot_ldlt_clear(&l);
    }
}

static void
the_vanishing_unknown_is_named(void **state)
{
    double zero_row[9] = {0, 1, 0, 1, 0, 0, 0, 0, 0}, nan[4] = {1, NAN, NAN, 1};
    double units[4] = {1e-30, 0, 0, -1e30}, x[2] = {1, 1};
    size_t failed = 9;
    qdot_ldlt l;

    (void)state;
    assert_int_equal(qdot_ldlt_init(&l, 3), QDOT_OK);
    assert_int_equal(qdot_ldlt_factor(&l, zero_row, &failed), QDOT_ESINGULAR);
    assert_int_equal(failed, 2);
    qdot_ldlt_clear(&l);
    assert_int_equal(qdot_ldlt_init(&l, 2), QDOT_OK);
    assert_int_equal(qdot_ldlt_factor(&l, nan, &failed), QDOT_ESINGULAR);
    assert_int_equal(qdot_ldlt_factor(&l, units, &failed), QDOT_OK);
    qdot_ldlt_solve(&l, units, x);
    assert_true(fabs(x[0] * 1e-30 - 1) < 1e-15 && fabs(x[1] * 1e30 + 1) < 1e-15);
    qdot_ldlt_clear(&l);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_indefinite_matrices_are_solved),
        cmocka_unit_test(saddle_points_are_solved),
        cmocka_unit_test(positive_definite_matrices_agree_with_cholesky),
        cmocka_unit_test(rank_deficient_matrices_are_found),
        cmocka_unit_test(the_vanishing_unknown_is_named),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
