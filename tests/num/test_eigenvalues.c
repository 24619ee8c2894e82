#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <cmocka.h>

#include "num/eigenvalues.h"

/* A rotation by 0.3, stretched by 2.385, beside -7 and 0.5, in other directions. */
static void
pairs_and_reals_in_order(void **state)
{
    const double c = 2.385 * cos(0.3), s = 2.385 * sin(0.3);
    const double A[16] = {c, -s, 1, 2, s, c, 3, -1, 0, 0, -7, 4, 0, 0, 0, 0.5};
    const double wanted[4][2] = {{-7, 0}, {c, s}, {c, -s}, {0.5, 0}};
    double E[16] = {0}, re[4], im[4], error[4];

    (void)state;
    assert_int_equal(qdot_eigenvalues(4, A, E, re, im, error), QDOT_OK);
    for (int k = 0; k < 4; k++) {
        assert_true(hypot(re[k] - wanted[k][0], im[k] - wanted[k][1]) <= error[k]);
        assert_true(error[k] < 1e-12);
    }
}

/* Errors of entries reach an eigenvalue by its vectors: little where they are apart, as a root where they meet. */
static void
errors_hold_what_entries_may_do(void **state)
{
    const double E[4] = {1e-8, 1e-8, 1e-8, 1e-8};

    (void)state;
    for (int together = 0; together < 2; together++) {
        const double A[4] = {1, 1, together ? 1e-14 : 0, together ? 1 : 3};
        const double B[4] = {A[0] + 1e-8, A[1] - 1e-8, A[2] + 1e-8, A[3] + 1e-8};
        double re[2], im[2], error[2], moved[2], moved_im[2], none[2];

        assert_int_equal(qdot_eigenvalues(2, A, E, re, im, error), QDOT_OK);
        assert_int_equal(qdot_eigenvalues(2, B, E, moved, moved_im, none), QDOT_OK);
        for (int k = 0; k < 2; k++)
            assert_true(hypot(re[k] - moved[k], im[k] - moved_im[k]) <= error[k]);
        assert_true(together || error[0] < 1e-7);
    }
}

/* [a 1; -d a] is [a 1; 0 a] to an error of d: what is two apart by its root is one. */
static void
a_pair_with_one_vector_is_known_to_the_root(void **state)
{
    (void)state;
    for (double d = 1e-18; d < 1e-8; d *= 100)
        for (int way = -1; way <= 1; way += 2) {
            const double A[4] = {2.385, 1, way * d, 2.385}, E[4] = {0, 0, d, 0}, none[4] = {0};
            double re[2], im[2], error[2];

            assert_int_equal(qdot_eigenvalues(2, A, E, re, im, error), QDOT_OK);
            for (int k = 0; k < 2; k++) {
                assert_true(hypot(re[k] - 2.385, im[k]) <= error[k]);
                assert_true(error[k] <= 4 * sqrt(d + 1e-14));
            }
            assert_int_equal(qdot_eigenvalues(2, A, none, re, im, error), QDOT_OK);
            assert_true(error[0] < 2e-6 * fmin(1, 1e-9 / sqrt(d)) + 3e-7);
        }
}

/* [1 a; 0 1] as it is: [1 a; d 1] has 1 +- sqrt(a d). */
static void
a_pair_that_is_exactly_one_is_known_to_the_root_too(void **state)
{
    (void)state;
    for (double a = 1; a <= 100; a *= 100) {
        const double A[4] = {1, a, 0, 1}, E[4] = {1e-10, a * 1e-10, 1e-10 / a, 1e-10};
        double re[2], im[2], error[2];

        assert_int_equal(qdot_eigenvalues(2, A, E, re, im, error), QDOT_OK);
        for (int k = 0; k < 2; k++)
            assert_true(error[k] >= 1e-5 && error[k] < 4e-5);
    }
}

/* [1 0 a; 0 1 a; 0 0 2]: two vectors of 1, both nearly normal to theirs: errors of the last row count a times. */
static void
one_with_two_vectors_has_their_condition(void **state)
{
    const double A[9] = {1, 0, 100, 0, 1, 100, 0, 0, 2}, E[9] = {0, 0, 0, 0, 0, 0, 1e-10, 1e-10, 0};
    double re[3], im[3], error[3];

    (void)state;
    assert_int_equal(qdot_eigenvalues(3, A, E, re, im, error), QDOT_OK);
    for (int k = 0; k < 3; k++)
        assert_true(error[k] >= 1.9e-8 && error[k] < 1e-7);
}

/* One that comes twice with two vectors is as exact as the entries. */
static void
one_with_two_vectors_is_as_exact_as_its_entries(void **state)
{
    const double A[4] = {2.385, 0, 0, 2.385 + 1e-15}, E[4] = {1e-10, 1e-10, 1e-10, 1e-10};
    double re[2], im[2], error[2];

    (void)state;
    assert_int_equal(qdot_eigenvalues(2, A, E, re, im, error), QDOT_OK);
    assert_true(error[0] >= 1e-10 && error[0] < 4e-10 && error[1] >= 1e-10 && error[1] < 4e-10);
}

/* Moduli that differ by less than their errors do not decide on the order. */
static void
order_holds_against_rounding(void **state)
{
    const double c = cos(1.83), s = sin(1.83);
    const double wanted[6][2] = {{-2.385, 0}, {1, 0}, {c, s}, {c, -s}, {-1, 0}, {0.5, 0}};
    const double longer[6] = {0, -1e-13, 2e-13, 2e-13, 3e-13, 0}; /* both of a pair by the same */

    (void)state;
    for (int first = 0; first < 6; first++)
        for (int way = -1; way <= 1; way++) {
            double re[6], im[6], error[6];

            for (int i = 0; i < 6; i++) {
                const int from = (5 * i + first) % 6;

                re[i] = wanted[from][0] * (1 + way * longer[from]);
                im[i] = wanted[from][1] * (1 + way * longer[from]);
                error[i] = 1e-12;
            }
            qdot_eigenvalues_arrange(6, re, im, error);
            for (int i = 0; i < 6; i++)
                assert_true(hypot(re[i] - wanted[i][0], im[i] - wanted[i][1]) < 1e-12);
        }
}

enum { N = 5, FACTORS = 12 };

/* P_k: no two of its columns are one direction. */
static double
turned(int k, int i, int j)
{
    return (i == j ? 2 : 0) + sin(1.3 * k + 2.1 * i + 0.7 * j * j + 0.4 * i * j);
}

/* X <- P_k^-1 (Gauss with row exchanges). */
static void
invert(int k, double X[N][N])
{
    double M[N][2 * N];

    for (int i = 0; i < N; i++)
        for (int j = 0; j < 2 * N; j++)
            M[i][j] = j < N ? turned(k, i, j) : j - N == i;
    for (int p = 0; p < N; p++) {
        int best = p;

        for (int i = p; i < N; i++)
            best = fabs(M[i][p]) > fabs(M[best][p]) ? i : best;
        for (int j = 0; j < 2 * N; j++) {
            const double kept = M[p][j];

            M[p][j] = M[best][j];
            M[best][j] = kept;
        }
        for (int i = 0; i < N; i++) {
            const double by = i == p ? 0 : M[i][p] / M[p][p];

            for (int j = 0; j < 2 * N; j++)
                M[i][j] -= by * M[p][j];
        }
    }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            X[i][j] = M[i][N + j] / M[i][i];
}

/* A_k = P_(k+1) D_k P_k^-1: 5e12, -3, a pair, 1e-10 of a product that as one matrix holds no more than the first two. */
static void
a_product_keeps_its_least_eigenvalue(void **state)
{
    const double root = 1.0 / FACTORS, wanted[N][2] = {
        {5e12, 0}, {-3, 0}, {0.7 * cos(2.4), 0.7 * sin(2.4)}, {0.7 * cos(2.4), -0.7 * sin(2.4)}, {1e-10, 0}};
    const double size = pow(0.7, root), c = size * cos(2.4 * root), s = size * sin(2.4 * root);
    double A[FACTORS][N][N] = {{{0}}}, E[FACTORS][N][N] = {{{0}}}, re[N], im[N], error[N];

    (void)state;
    for (int k = 0; k < FACTORS; k++) {
        const double D[N][N] = {{pow(5e12, root)}, {0, k == 0 ? -pow(3, root) : pow(3, root)}, {0, 0, c, -s},
                                {0, 0, s, c}, {0, 0, 0, 0, pow(1e-10, root)}};
        double X[N][N];

        invert(k, X);
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
                for (int a = 0; a < N; a++)
                    for (int b = 0; b < N; b++)
                        A[k][i][j] += turned((k + 1) % FACTORS, i, a) * D[a][b] * X[b][j];
    }
    assert_int_equal(qdot_eigenvalues_of_product(FACTORS, N, &A[0][0][0], &E[0][0][0], re, im, error), QDOT_OK);
    for (int i = 0; i < N; i++) {
        const double size = hypot(wanted[i][0], wanted[i][1]);

        if (!(hypot(re[i] - wanted[i][0], im[i] - wanted[i][1]) <= error[i] && error[i] < 1e-8 * size))
            fail_msg("%d: %.17g + %.17g i, error %g", i, re[i], im[i], error[i]);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_and_reals_in_order),
        cmocka_unit_test(a_pair_with_one_vector_is_known_to_the_root),
        cmocka_unit_test(a_pair_that_is_exactly_one_is_known_to_the_root_too),
        cmocka_unit_test(one_with_two_vectors_has_their_condition),
        cmocka_unit_test(one_with_two_vectors_is_as_exact_as_its_entries),
        cmocka_unit_test(order_holds_against_rounding),
        cmocka_unit_test(errors_hold_what_entries_may_do),
        cmocka_unit_test(a_product_keeps_its_least_eigenvalue),
    };

    return cmocka_run_group_tests_name("eigenvalues", tests, NULL, NULL);
}
