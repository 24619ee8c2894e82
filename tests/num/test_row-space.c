#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/row-space.h"

enum { M = 6, N = 9 };

/* A of rank r: every row a mixture of r random ones, in units that differ widely. */
static void
random_of_rank(double *A, size_t r)
{
    double base[M * N];

    for (size_t i = 0; i < M * N; i++)
        base[i] = uniform();
    for (size_t i = 0; i < M; i++)
        for (size_t j = 0; j < N; j++) {
            A[i * N + j] = i < r ? base[i * N + j] : 0;
            for (size_t k = 0; i >= r && k < r; k++)
                A[i * N + j] += cos(1.0 + (double)(i * r + k)) * base[k * N + j];
            A[i * N + j] *= pow(10, (double)(3 * i) - 7);
        }
}

/* Whatever the rank: x solves all rows of a consistent system, x = A^T lambda, and no
 * shorter x does (x is orthogonal to every tangent). */
static void
shortest_solution_is_in_the_row_space(void **state)
{
    double A[M * N], b[M], x[N], lambda[M], t[N];
    qdot_row_space f;

    (void)state;
    assert_int_equal(qdot_row_space_init(&f, M, N), QDOT_OK);
    for (size_t r = 1; r <= M; r++) {
        random_of_rank(A, r);
        for (size_t j = 0; j < N; j++)
            t[j] = uniform();
        for (size_t i = 0; i < M; i++) {
            b[i] = 0;
            for (size_t j = 0; j < N; j++)
                b[i] += A[i * N + j] * t[j];
        }
        qdot_row_space_factor(&f, A, 1e-10, false);
        assert_int_equal(f.rank, r);
        qdot_row_space_shortest(&f, b, x, lambda);
        qdot_row_space_tangent(&f, t);
        for (size_t i = 0; i < M; i++) {
            double left = b[i], along = 0, size = 0;

            for (size_t j = 0; j < N; j++) {
                left -= A[i * N + j] * x[j];
                along += A[i * N + j] * t[j];
                size = fmax(size, fabs(A[i * N + j]));
            }
            assert_true(fabs(left) < 1e-11 * size);
            assert_true(fabs(along) < 1e-12 * size);
        }
        for (size_t j = 0; j < N; j++) {
            double sum = -x[j];

            for (size_t i = 0; i < M; i++)
                sum += A[i * N + j] * lambda[i];
            assert_true(fabs(sum) < 1e-11);
        }
    }
    qdot_row_space_clear(&f);
}

/* Of two rows that say the same the later is left out, in whatever unit it stands. */
static void
in_order_the_later_row_is_dependent(void **state)
{
    const double A[] = {1, 2, 0, 0, 0, 3, 1e5, 2e5, 0};
    qdot_row_space f;

    (void)state;
    assert_int_equal(qdot_row_space_init(&f, 3, 3), QDOT_OK);
    qdot_row_space_factor(&f, A, 1e-10, true);
    assert_int_equal(f.rank, 2);
    assert_int_equal(f.order[0], 0);
    assert_int_equal(f.order[1], 1);
    assert_int_equal(f.order[2], 2);
    qdot_row_space_clear(&f);
}

static void
rows_of_zeros_have_no_rank(void **state)
{
    const double A[] = {0, 0, 0, 0}, b[] = {1, 2};
    double x[] = {3, 4};
    qdot_row_space f;

    (void)state;
    assert_int_equal(qdot_row_space_init(&f, 2, 2), QDOT_OK);
    qdot_row_space_factor(&f, A, 1e-10, false);
    assert_int_equal(f.rank, 0);
    qdot_row_space_shortest(&f, b, x, NULL);
    assert_true(x[0] == 0 && x[1] == 0);
    qdot_row_space_clear(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shortest_solution_is_in_the_row_space),
        cmocka_unit_test(in_order_the_later_row_is_dependent),
        cmocka_unit_test(rows_of_zeros_have_no_rank),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
