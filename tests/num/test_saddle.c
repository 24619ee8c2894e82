#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/bordered.h"
#include "num/least-move.h"
#include "num/saddle.h"

enum { most = 40 };

/* A positive matrix of rank `rank`, in units that differ by 2^20. */
static void
fill_mass(qdot_saddle *s, size_t rank, bool indefinite)
{
    double G[most * most];

    memset(s->M, 0, s->n * s->n * sizeof *s->M);
    for (size_t k = 0; k < rank; k++) {
        for (size_t i = 0; i < s->n; i++)
            G[i] = uniform() * ldexp(1, (int)(i % 3) * 10);
        for (size_t i = 0; i < s->n; i++)
            for (size_t j = 0; j < s->n; j++)
                s->M[i * s->n + j] += (indefinite && k % 2 ? -1 : 1) * G[i] * G[j];
    }
}

static void
fill_rows(qdot_saddle *s)
{
    for (size_t k = 0; k < s->m * s->n; k++)
        s->A[k] = uniform();
}

/* The largest residual of the solution in s->x, relative to the sizes in its row. */
static double
residual(const qdot_saddle *s, const double *b)
{
    double worst = 0;

    for (size_t i = 0; i < s->n + s->m; i++) {
        long double r = -(long double)b[i];
        double size = fabs(b[i]);

        for (size_t j = 0; j < s->n; j++) {
            double a = i < s->n ? s->M[i * s->n + j] : s->A[(i - s->n) * s->n + j];

            r += (long double)a * s->x[j];
            size += fabs(a * s->x[j]);
        }
        for (size_t k = 0; i < s->n && k < s->m; k++) {
            r += (long double)s->A[k * s->n + i] * s->x[s->n + k];
            size += fabs(s->A[k * s->n + i] * s->x[s->n + k]);
        }
        worst = fmax(worst, (double)fabsl(r) / fmax(size, 1e-300));
    }
    return worst;
}

static void
fill_right(qdot_saddle *s, double *b)
{
    for (size_t i = 0; i < s->n + s->m; i++)
        b[i] = s->x[i] = uniform();
}

static void
random_systems_are_solved(void **state)
{
    (void)state;
    srand(1);
    for (size_t n = 1; n <= 24; n++)
        for (size_t m = 0; m <= n; m += 1 + n / 5)
            for (int indefinite = 0; indefinite < 2; indefinite++) {
                double b[2 * most], applied[2 * most];
                size_t failed;
                qdot_saddle s;

                assert_int_equal(qdot_saddle_init(&s, n, m, indefinite), QDOT_OK);
                fill_mass(&s, n + 1, indefinite);
                fill_rows(&s);
                assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
                assert_int_equal(s.rank, m);
                qdot_saddle_prepare(&s);
                fill_right(&s, b);
                qdot_saddle_apply(&s);
                memcpy(applied, s.x, sizeof(double) * (n + m));
                memcpy(s.x, b, sizeof(double) * (n + m));
                qdot_saddle_solve_refined(&s);
                if (!(residual(&s, b) < 1e-13))
                    fail_msg("n = %zu, m = %zu: %g", n, m, residual(&s, b));
                for (size_t i = 0; i < n + m; i++)
                    assert_true(fabs(applied[i] - s.x[i])
                                < 1e-6 * (fabs(s.x[i]) + 1e-3));
                qdot_saddle_clear(&s);
            }
}

/* M alone has rank n - m: with m rows that is enough. */
static void
a_mass_that_is_singular_alone_is_enough(void **state)
{
    double b[2 * most];
    size_t failed;
    qdot_saddle s;

    (void)state;
    srand(2);
    assert_int_equal(qdot_saddle_init(&s, 7, 3, false), QDOT_OK);
    fill_mass(&s, 4, false);
    fill_rows(&s);
    assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
    fill_right(&s, b);
    qdot_saddle_solve_refined(&s);
    assert_true(residual(&s, b) < 1e-13);
    fill_mass(&s, 3, false); /* and this is not */
    assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_ESINGULAR);
    assert_true(failed < 7);
    qdot_saddle_clear(&s);
}

/* Row 2 twice row 0 less row 1: rank 2, the multipliers of least norm. */
static void
repeated_rows_give_the_least_multipliers(void **state)
{
    double b[8], norm = 0, along = 0;
    const double null[3] = {2, -1, -1};
    size_t failed;
    qdot_saddle s;

    (void)state;
    srand(3);
    assert_int_equal(qdot_saddle_init(&s, 5, 3, false), QDOT_OK);
    fill_mass(&s, 6, false);
    fill_rows(&s);
    for (size_t i = 0; i < 5; i++)
        s.A[10 + i] = 2 * s.A[i] - s.A[5 + i];
    assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
    assert_int_equal(s.rank, 2);
    fill_right(&s, b);
    s.x[7] = b[7] = 2 * b[5] - b[6];
    qdot_saddle_solve(&s);
    assert_true(residual(&s, b) < 1e-12);
    for (size_t k = 0; k < 3; k++) {
        along += null[k] * s.x[5 + k];
        norm = fmax(norm, fabs(s.x[5 + k]));
    }
    assert_true(fabs(along) < 1e-12 * norm);
    qdot_saddle_clear(&s);
}

/* An unknown whose mass fades to rounding keeps its scale, and the rows that it stands in their
 * independence; the solution is that of no mass at all. */
static void
a_mass_that_fades_keeps_its_scale(void **state)
{
    const double A[2][3] = {{1, 2, 0}, {1, 0, 3}};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double b[5] = {1, 2, 3, 4, 5};
        size_t failed;
        qdot_saddle s;

        assert_int_equal(qdot_saddle_init(&s, 3, 2, false), QDOT_OK);
        memcpy(s.A, A, sizeof A);
        for (size_t i = 0; i < 3; i++)
            s.M[i * 3 + i] = i > 0 ? 1 : k; /* never there, or at first */
        assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
        assert_int_equal(s.rank, 2);
        s.M[0] = 1e-24;
        assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
        assert_true(s.quality > 1e-3);
        memcpy(s.x, b, sizeof b);
        qdot_saddle_solve(&s);
        assert_true(residual(&s, b) < 1e-14);
        qdot_saddle_clear(&s);
    }
}

/* A rank that was found is kept, and its loss told with the rows that are dependent. */
static void
a_lost_rank_is_told(void **state)
{
    double part[3];
    size_t failed;
    qdot_saddle s;

    (void)state;
    srand(4);
    assert_int_equal(qdot_saddle_init(&s, 4, 3, false), QDOT_OK);
    fill_mass(&s, 5, false);
    fill_rows(&s);
    assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
    for (size_t i = 0; i < 4; i++)
        s.A[8 + i] = -3 * s.A[i];
    assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_ESINGULAR);
    assert_true(failed == 4 || failed == 6);
    qdot_saddle_parts(&s, 0, part);
    assert_true(part[0] > 0.1 && part[1] < 1e-9 && part[2] > 0.1);
    qdot_saddle_clear(&s);
}

/* Row `to` of A: the sum of the rows k in 0..3 by their weights, and `off` of a random one. */
static void
combine(qdot_saddle *s, size_t to, const double *weight, double off)
{
    for (size_t i = 0; i < s->n; i++) {
        double sum = off * uniform();

        for (size_t k = 0; k < 4; k++)
            sum += weight[k] * s->A[k * s->n + i];
        s->A[to * s->n + i] = sum;
    }
}

/* Whether row k is one of the first three pivots. */
static bool
is_pivot(const qdot_saddle *s, size_t k)
{
    return s->pivot[0] == k || s->pivot[1] == k || s->pivot[2] == k;
}

/* Of six rows the sum of four says nothing new. Where a row vanishes and another repeats a third, these are named, and
 * not that sum, wherever the pivots show the pair and whether or not the rank is lost to rounding. */
static void
short_dependencies_are_named(void **state)
{
    const double sum[4] = {1, 1, 1, 1}, twice[4] = {0, 0, 0, 2}, none[4] = {0};
    double part[6];
    size_t failed, seen = 0;
    qdot_saddle s;

    (void)state;
    srand(6);
    for (int round = 0; round < 40; round++) {
        const double off = round % 2 ? 0 : 1e-11;

        assert_int_equal(qdot_saddle_init(&s, 8, 6, false), QDOT_OK);
        for (size_t i = 0; i < 8; i++)
            s.M[i * 9] = 1;
        fill_rows(&s);
        combine(&s, 4, sum, 0);
        assert_int_equal(qdot_saddle_faded(&s), 6);
        assert_int_equal(qdot_saddle_factor_fully(&s, &failed), QDOT_OK);
        assert_int_equal(s.rank, 5);
        combine(&s, 2, none, off);
        combine(&s, 4, sum, 0);
        combine(&s, 5, twice, off);
        (void)qdot_saddle_faded(&s);
        assert_int_equal(qdot_saddle_factor_fully(&s, &failed),
                         round % 2 ? QDOT_ESINGULAR : QDOT_OK);
        qdot_saddle_parts(&s, 1e-3, part);
        seen += is_pivot(&s, 3) || is_pivot(&s, 5);
        for (size_t k = 0; k < 6 && (is_pivot(&s, 3) || is_pivot(&s, 5)); k++)
            assert_true(k == 2 || k == 3 || k == 5 ? part[k] > 0.1 : part[k] < 1e-6);
        qdot_saddle_clear(&s);
    }
    assert_true(seen > 30);
}

/* The weakest combination: w^T A = R_rr u^T in scaled form, small where rows nearly are
 * dependent, and linear in what parts them. */
static void
the_weakest_combination_is_found(void **state)
{
    double row[3], column[4], left[2];
    size_t failed;
    qdot_saddle s;

    (void)state;
    srand(5);
    assert_int_equal(qdot_saddle_init(&s, 4, 3, false), QDOT_OK);
    for (size_t i = 0; i < 4; i++)
        s.M[i * 5] = 1;
    fill_rows(&s);
    for (size_t i = 0; i < 4; i++)
        s.A[8 + i] = s.A[i] - 2 * s.A[4 + i];
    for (int k = 0; k < 2; k++) {
        s.A[8] += 0x1p-20;
        assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
        qdot_saddle_weakest(&s, row, column);
        left[k] = 0;
        for (size_t r = 0; r < 3; r++)
            for (size_t i = 0; i < 4; i++)
                left[k] += row[r] * s.A[r * 4 + i] * column[i];
        assert_true(fabs(row[0] + row[2]) < 1e-4 * fabs(row[2]));
        assert_true(fabs(row[1] - 2 * row[2]) < 1e-4 * fabs(row[2]));
    }
    assert_true(fabs(fabs(left[1] / left[0]) - 2) < 1e-4);
    qdot_saddle_clear(&s);
}

/* By its pattern a system has the solution that the null space has; where the rows become
 * dependent the null space takes over, and gives back. */
static void
a_pattern_is_no_other_solution(void **state)
{
    static const qdot_saddle_entry of_M[] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
    static const qdot_saddle_entry of_A[] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {1, 2}, {1, 3}};
    qdot_saddle s, full;
    size_t failed, direct = 0;

    (void)state;
    assert_int_equal(qdot_saddle_init(&s, 4, 2, false), QDOT_OK);
    assert_int_equal(qdot_saddle_init(&full, 4, 2, false), QDOT_OK);
    assert_int_equal(qdot_saddle_pattern(&s, 4, of_M, 6, of_A), QDOT_OK);
    for (int k = 0; k <= 40; k++) {
        double along = k < 20 ? 0.1 : pow(10, -(double)(k > 30 ? 40 - k : k - 20));

        for (size_t i = 0; i < 4; i++)
            s.M[5 * i] = full.M[5 * i] = 1 + (double)i;
        s.A[0] = 1;
        s.A[1] = 2;
        s.A[4] = -1;
        s.A[5] = -2;
        s.A[6] = along;
        s.A[7] = -along;
        memcpy(full.A, s.A, 8 * sizeof *s.A);
        assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
        assert_int_equal(qdot_saddle_factor(&full, &failed), QDOT_OK);
        assert_false(full.direct);
        direct += s.direct;
        if (along < 1e-4)
            assert_false(s.direct);
        for (size_t i = 0; i < 6; i++)
            s.x[i] = full.x[i] = uniform();
        qdot_saddle_solve_refined(&s);
        qdot_saddle_solve_refined(&full);
        for (size_t i = 0; i < 4; i++)
            assert_true(fabs(s.x[i] - full.x[i]) < 1e-13 / along);
        assert_true(fabs(qdot_saddle_row(&s, 1, s.x) - qdot_saddle_row(&full, 1, s.x))
                    < 1e-12 / along);
    }
    assert_true(direct >= 15 && direct <= 30);
    qdot_saddle_clear(&s);
    qdot_saddle_clear(&full);
}

/* The saddle point with a diagonal M and nothing but c on the right. */
static void
few_rows_move_least(void **state)
{
    (void)state;
    for (size_t m = 1; m <= QDOT_LEAST_MOVE_ROWS; m++) {
        const size_t n = m + 3;
        double W[QDOT_LEAST_MOVE_ROWS * most], c[QDOT_LEAST_MOVE_ROWS], x[most];
        qdot_least_move move = {.n = n, .m = m, .W = W};
        qdot_saddle s;
        size_t failed;

        assert_int_equal(qdot_saddle_init(&s, n, m, false), QDOT_OK);
        for (size_t i = 0; i < n; i++)
            s.M[i * (n + 1)] = 0.3 + (double)i;
        fill_rows(&s);
        for (size_t k = 0; k < m; k++)
            s.x[n + k] = c[k] = uniform();
        assert_true(qdot_least_move_factor(&move, s.A, s.M, n + 1));
        qdot_least_move_solve(&move, c, x);
        assert_int_equal(qdot_saddle_factor(&s, &failed), QDOT_OK);
        qdot_saddle_solve(&s);
        for (size_t i = 0; i < n; i++)
            assert_true(fabs(x[i] - s.x[i]) < 1e-13);

        /* a row that repeats another, a coordinate without mass */
        memcpy(s.A + (m - 1) * n, s.A, n * sizeof *s.A);
        assert_int_equal(qdot_least_move_factor(&move, s.A, s.M, n + 1), m == 1);
        s.M[0] = 0;
        assert_false(qdot_least_move_factor(&move, s.A, s.M, n + 1));
        qdot_saddle_clear(&s);
    }
}

/* K times what it has become is the identity. */
static void
inverses(bool diagonal, bool (*invert)(size_t, size_t, double (*)[QDOT_BORDERED_MOST], double))
{
    enum { all = QDOT_BORDERED_MOST };

    for (size_t n = 1; n < all; n++)
        for (size_t m = 0; m <= n && n + m <= all; m++) {
            double K[all][all] = {{0}}, before[all][all];
            qdot_saddle s;

            assert_int_equal(qdot_saddle_init(&s, n, m, false), QDOT_OK);
            fill_mass(&s, n, false);
            fill_rows(&s);
            for (size_t i = 0; i < n; i++)
                for (size_t j = 0; j < n; j++)
                    K[i][j] = diagonal && i != j
                                  ? 0
                                  : ldexp(s.M[i * n + j], -10 * (int)(i % 3 + j % 3)) + (i == j);
            for (size_t k = 0; k < m; k++)
                for (size_t j = 0; j < n; j++)
                    K[n + k][j] = K[j][n + k] = s.A[k * n + j];
            memcpy(before, K, sizeof K);
            assert_true(invert(n, m, K, 1e-9));
            for (size_t i = 0; i < n + m; i++)
                for (size_t j = 0; j < n + m; j++) {
                    double sum = i == j ? -1 : 0, size = 1;

                    for (size_t k = 0; k < n + m; k++) {
                        sum += before[i][k] * K[k][j];
                        size += fabs(before[i][k] * K[k][j]);
                    }
                    assert_true(fabs(sum) < 1e-11 * size);
                }
            /* a row that repeats another; no mass */
            memcpy(K, before, sizeof K);
            for (size_t j = 0; m > 1 && j < n; j++)
                K[n + m - 1][j] = K[j][n + m - 1] = K[n][j];
            assert_int_equal(invert(n, m, K, 1e-9), m < 2);
            memcpy(K, before, sizeof K);
            K[0][0] = 0;
            assert_false(invert(n, m, K, 1e-9));
            qdot_saddle_clear(&s);
        }
}

static void
a_bordered_matrix_is_inverted(void **state)
{
    (void)state;
    inverses(false, qdot_bordered_invert);
    inverses(true, qdot_bordered_invert);
    inverses(true, qdot_bordered_invert_diagonal);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_systems_are_solved),
        cmocka_unit_test(a_mass_that_is_singular_alone_is_enough),
        cmocka_unit_test(repeated_rows_give_the_least_multipliers),
        cmocka_unit_test(a_mass_that_fades_keeps_its_scale),
        cmocka_unit_test(a_lost_rank_is_told),
        cmocka_unit_test(short_dependencies_are_named),
        cmocka_unit_test(the_weakest_combination_is_found),
        cmocka_unit_test(a_pattern_is_no_other_solution),
        cmocka_unit_test(few_rows_move_least),
        cmocka_unit_test(a_bordered_matrix_is_inverted),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
