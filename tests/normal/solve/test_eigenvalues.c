/* Eigenvalues of constants are enclosed: companion matrices, whose eigenvalues are the roots of a polynomial, and matrices
 * with eigenvalues that coincide. */
#include <setjmp.h>
#include <math.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/build.h"
#include "normal/solve/eigenvalues.h"

enum { MOST = 6 };

/* The eigenvalues of a matrix of small integers, against those known. */
static void
check_eigenvalues(size_t n, const int64_t *A, const double *re, const double *im, double error)
{
    qdot_expr entries[MOST * MOST];
    double got[3][MOST];

    for (size_t i = 0; i < n * n; i++)
        entries[i] = qdot_expr_int(pool, A[i]);
    assert_int_equal(qdot_eigenvalues_of_constants(pool, n, entries, got[0], got[1], got[2]), QDOT_OK);
    for (size_t i = 0; i < n; i++) {
        assert_true(hypot(got[0][i] - re[i], got[1][i] - im[i]) <= got[2][i] + 1e-15);
        if (got[2][i] > error)
            fail_msg("%zu: %g + %g i, error %g", i, got[0][i], got[1][i], got[2][i]);
    }
}

static void
roots_of_unity(void **state)
{
    const int64_t A[] = {0, 1, 0, 0, 0, 1, 1, 0, 0};

    (void)state;
    check_eigenvalues(3, A, (double[]){-0.5, -0.5, 1}, (double[]){-sqrt(0.75), sqrt(0.75), 0}, 1e-15);
}

static void
coinciding_ones(void **state)
{
    const int64_t two[] = {2, 1, 0, 2}, diagonal[] = {3, 0, 0, 3};

    (void)state;
    check_eigenvalues(2, two, (double[]){2, 2}, (double[]){0, 0}, 1e-15);
    check_eigenvalues(2, diagonal, (double[]){3, 3}, (double[]){0, 0}, 1e-15);
}

/* Entries that are not rational are enclosed in balls. */
static void
irrational_entries(void **state)
{
    const qdot_expr root = qdot_sqrt(pool, text_read(pool, "2")), A[] = {QDOT_ZERO, root, qdot_neg(pool, root), QDOT_PI};
    double re[2], im[2], error[2];

    (void)state;
    assert_int_equal(qdot_eigenvalues_of_constants(pool, 2, A, re, im, error), QDOT_OK);
    assert_true(fabs(re[0] - (M_PI - sqrt(M_PI * M_PI - 8)) / 2) <= error[0] + 1e-15 && im[0] == 0 && error[0] < 1e-15);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(roots_of_unity, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(coinciding_ones, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(irrational_entries, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
