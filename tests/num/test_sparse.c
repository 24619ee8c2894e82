#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "num/sparse.h"

enum { most = 60 };

typedef struct {
    size_t n, positive, count;
    double K[most][most]; /* both triangles */
    qdot_sparse_entry entries[most * most];
} matrix;

static double
uniform(void)
{
    return 2.0 * rand() / RAND_MAX - 1;
}

static void
put(matrix *a, size_t i, size_t j, double x)
{
    a->K[i][j] = a->K[j][i] = x;
    a->entries[a->count++] = (qdot_sparse_entry){(uint32_t)i, (uint32_t)j, &a->K[i][j]};
}

/* [M A^T; A 0], M positive by its diagonal, a row of A for some unknowns. */
static void
fill(matrix *a, size_t n, size_t m, double density)
{
    *a = (matrix){.n = n + m, .positive = n};
    for (size_t i = 0; i < n; i++) {
        put(a, i, i, (double)n + 1 + uniform());
        for (size_t j = 0; j < i; j++)
            if (fabs(uniform()) < density)
                put(a, i, j, uniform());
    }
    for (size_t k = 0; k < m; k++)
        for (size_t i = 0; i < n; i++)
            if (i == k || fabs(uniform()) < density)
                put(a, n + k, i, i == k ? 2 + uniform() : uniform());
}

/* What is left of K x = b, in the size of its terms. */
static double
residual(const matrix *a, const double *x, const double *b)
{
    double worst = 0;

    for (size_t i = 0; i < a->n; i++) {
        long double r = b[i];
        double size = 1;

        for (size_t j = 0; j < a->n; j++) {
            r -= (long double)a->K[i][j] * x[j];
            size += fabs(a->K[i][j] * x[j]);
        }
        worst = fmax(worst, fabs((double)r) / size);
    }
    return worst;
}

static void
random_systems_are_solved(void **state)
{
    static matrix a;

    (void)state;
    srand(3);
    for (size_t n = 1; n <= 40; n++)
        for (size_t m = 0; m <= n / 2; m += 1 + n / 8)
            for (double density = 0; density < 1; density += 0.3) {
                double b[most], x[most], left[most];
                qdot_sparse s;

                fill(&a, n, m, density);
                assert_int_equal(qdot_sparse_init(&s, a.n, n, a.count, a.entries),
                                 QDOT_OK);
                assert_true(qdot_sparse_factor(&s) > 0);
                for (size_t i = 0; i < a.n; i++)
                    b[i] = x[i] = uniform();
                qdot_sparse_solve(&s, x);
                assert_true(residual(&a, x, b) < 1e-14);
                memcpy(left, b, sizeof left);
                qdot_sparse_subtract(&s, x, left);
                for (size_t i = 0; i < a.n; i++) {
                    long double r = b[i];

                    for (size_t j = 0; j < a.n; j++)
                        r -= (long double)a.K[i][j] * x[j];
                    assert_true(fabs(left[i] - (double)r) < 1e-17);
                }
                qdot_sparse_clear(&s);
            }
}

/* Rods of a chain hang together two and two: what is filled goes as their number. */
static void
a_chain_stays_thin(void **state)
{
    static matrix a;

    (void)state;
    for (size_t links = 2; links <= 20; links *= 2) {
        qdot_sparse s;

        a = (matrix){.n = 3 * links, .positive = 2 * links};
        for (size_t i = 0; i < 2 * links; i++)
            put(&a, i, i, 1);
        for (size_t k = 0; k < links; k++)
            for (size_t i = k > 0 ? 2 * k - 2 : 0; i < 2 * k + 2; i++)
                put(&a, 2 * links + k, i, 1 + (double)(i % 3));
        assert_int_equal(qdot_sparse_init(&s, a.n, a.positive, a.count, a.entries),
                         QDOT_OK);
        assert_true(s.filled <= 5 * links);
        qdot_sparse_clear(&s);
    }
}

/* Signs that are not as they should be, rows that repeat others: how much is left. */
static void
what_is_left_is_said(void **state)
{
    static matrix a;
    qdot_sparse s;

    (void)state;
    a = (matrix){.n = 4, .positive = 2};
    put(&a, 0, 0, 1);
    put(&a, 1, 1, 1);
    put(&a, 2, 0, 1);
    put(&a, 3, 0, 1);
    put(&a, 3, 1, 1e-3);
    assert_int_equal(qdot_sparse_init(&s, 4, 2, a.count, a.entries), QDOT_OK);
    assert_true(fabs(qdot_sparse_factor(&s) - 1e-6) < 1e-8); /* sine 1e-3 */
    a.K[3][1] = a.K[1][3] = 0;
    assert_true(qdot_sparse_factor(&s) == 0);
    a.K[3][1] = a.K[1][3] = 1;
    a.K[1][1] = -1;
    assert_true(qdot_sparse_factor(&s) == 0);
    a.K[1][1] = NAN;
    assert_true(qdot_sparse_factor(&s) == 0);
    a.K[1][1] = 1;
    assert_true(qdot_sparse_factor(&s) > 0.4);
    assert_true(s.definite);
    qdot_sparse_clear(&s);
}

/* Masses that rounding alone parts are none. */
static void
a_mass_that_rounding_made_is_told(void **state)
{
    static matrix a;
    qdot_sparse s;

    (void)state;
    a = (matrix){.n = 3, .positive = 2};
    put(&a, 0, 0, 3);
    put(&a, 1, 0, 1);
    put(&a, 1, 1, 1.0 / 3 + 0x1p-53);
    put(&a, 2, 0, 1);
    put(&a, 2, 1, 1);
    assert_int_equal(qdot_sparse_init(&s, 3, 2, a.count, a.entries), QDOT_OK);
    assert_true(qdot_sparse_factor(&s) < 1e-12);
    assert_false(s.definite);
    a.K[1][1] = 0.5;
    assert_true(qdot_sparse_factor(&s) > 0);
    assert_true(s.definite);
    qdot_sparse_clear(&s);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_systems_are_solved),
        cmocka_unit_test(a_chain_stays_thin),
        cmocka_unit_test(what_is_left_is_said),
        cmocka_unit_test(a_mass_that_rounding_made_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
