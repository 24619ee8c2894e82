/* test_articulated.c -- elimination along trees against the full matrix by Cholesky's
 * method. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/articulated.h"
#include "num/cholesky.h"

enum { most = 72, size = 6, unknowns = 3 };

/* A tree with its numbers: S, d, r by node, component. */
typedef struct {
    size_t nodes, m, c;
    uint32_t parent[most * size];
    uint8_t free[most];
    double weight[most * size * size];
    double S[unknowns * size][most], d[size][most], r[unknowns][most];
} tree;

/* Node n hangs on `on`, component by component. */
static void
hang(tree *t, size_t n, size_t on)
{
    for (size_t i = 0; i < t->m; i++)
        t->parent[n * t->m + i] =
            n == 0 ? QDOT_ARTICULATED_NONE : (uint32_t)(on * t->m + i);
}

/* W = w 1 at every node, unknowns everywhere, directions at random. */
static void
fill(tree *t, double w_least, double w_most)
{
    memset(t->weight, 0, sizeof t->weight);
    for (size_t n = 0; n < t->nodes; n++) {
        const double w = w_least * pow(w_most / w_least, 0.5 * (1 + uniform()));

        t->free[n] = (uint8_t)t->c;
        for (size_t i = 0; i < t->m; i++)
            t->weight[(n * t->m + i) * t->m + i] = w;
        for (size_t e = 0; e < t->c * t->m; e++)
            t->S[e][n] = uniform();
        for (size_t i = 0; i < t->m; i++)
            t->d[i][n] = uniform();
        for (size_t k = 0; k < t->c; k++)
            t->r[k][n] = uniform();
    }
}

/* x [nodes x m] of every unknown and of d: what a node adds, carried down. */
static void
carry_down(const tree *t, long double *x)
{
    for (size_t e = 0; e < t->nodes * t->m; e++)
        if (t->parent[e] != QDOT_ARTICULATED_NONE)
            x[e] += x[t->parent[e]];
}

/* F [nodes x m] of x. */
static void
gather(const tree *t, const long double *x, long double *F)
{
    for (size_t n = 0; n < t->nodes; n++)
        for (size_t i = 0; i < t->m; i++) {
            F[n * t->m + i] = 0;
            for (size_t k = 0; k < t->m; k++)
                F[n * t->m + i] += t->weight[(n * t->m + i) * t->m + k] * x[n * t->m + k];
        }
    for (size_t e = t->nodes * t->m; e-- > 0;)
        if (t->parent[e] != QDOT_ARTICULATED_NONE)
            F[t->parent[e]] += F[e];
}

/* S^T F into out [nodes x c]. */
static void
project(const tree *t, const long double *F, long double *out)
{
    for (size_t n = 0; n < t->nodes; n++)
        for (size_t k = 0; k < t->c; k++) {
            out[n * t->c + k] = 0;
            for (size_t i = 0; i < t->m; i++)
                out[n * t->c + k] += t->S[k * t->m + i][n] * F[n * t->m + i];
        }
}

/* A q = b, A symmetric and positive definite, by elimination. */
static void
eliminate(long double *A, size_t n, long double *b)
{
    for (size_t k = 0; k < n; k++)
        for (size_t i = k + 1; i < n; i++) {
            const long double factor = A[i * n + k] / A[k * n + k];

            for (size_t j = k; j < n; j++)
                A[i * n + j] -= factor * A[k * n + j];
            b[i] -= factor * b[k];
        }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = k + 1; j < n; j++)
            b[k] -= A[k * n + j] * b[j];
        b[k] /= A[k * n + k];
    }
}

/* q [nodes x c] by the full matrix, in more digits; then by Cholesky's method, in doubles. */
static void
solve_full(const tree *t, double factor, long double *q, double *by_cholesky)
{
    const size_t n = t->nodes * t->c, e = t->nodes * t->m;
    long double *M = calloc(n * n, sizeof *M), *x = calloc(e, sizeof *x);
    long double *F = calloc(e, sizeof *F), *column = calloc(n, sizeof *column);
    double *a = calloc(n * n, sizeof *a);

    for (size_t j = 0; j < n; j++) {
        memset(x, 0, e * sizeof *x);
        for (size_t i = 0; i < t->m; i++)
            x[j / t->c * t->m + i] = t->S[j % t->c * t->m + i][j / t->c];
        carry_down(t, x);
        gather(t, x, F);
        project(t, F, column);
        for (size_t i = 0; i < n; i++)
            M[i * n + j] = column[i];
    }
    for (size_t j = 0; j < n; j++) /* what is not free stays */
        if (j % t->c >= t->free[j / t->c])
            M[j * n + j] = 1;
    for (size_t k = 0; k < e; k++)
        x[k] = factor * t->d[k % t->m][k / t->m];
    carry_down(t, x);
    gather(t, x, F);
    project(t, F, column);
    for (size_t j = 0; j < n; j++)
        q[j] = j % t->c < t->free[j / t->c] ? t->r[j % t->c][j / t->c] - column[j] : 0;
    for (size_t k = 0; k < n * n; k++)
        a[k] = (double)M[k];
    for (size_t k = 0; k < n; k++)
        by_cholesky[k] = (double)q[k];
    assert_int_equal(qdot_cholesky_factor(a, n, NULL, NULL), QDOT_OK);
    qdot_cholesky_solve(a, n, NULL, by_cholesky);
    eliminate(M, n, q);
    free(M);
    free(x);
    free(F);
    free(column);
    free(a);
}

static qdot_articulated *
build(const tree *t)
{
    const qdot_articulated_tree of = {t->nodes,  t->m,      t->c,
                                      t->parent, t->weight, t->free};
    qdot_articulated *a;

    assert_int_equal(qdot_articulated_new(&of, &a), QDOT_OK);
    return a;
}

/* An array of slots with this number in those that no node has. */
static double *
spread(const qdot_articulated *a, const double *from, size_t nodes, double other)
{
    const size_t slots = qdot_articulated_slots(a);
    double *to = calloc(slots, sizeof *to);

    for (size_t s = 0; s < slots; s++)
        to[s] = other;
    for (size_t n = 0; from && n < nodes; n++)
        to[qdot_articulated_slot(a, n)] = from[n];
    return to;
}

typedef struct {
    double *S[unknowns * size], *d[size], *r[unknowns], *q[unknowns], *F[size];
} arrays;

static void
lay_out(const qdot_articulated *a, const tree *t, arrays *to)
{
    for (size_t e = 0; e < t->c * t->m; e++)
        to->S[e] = spread(a, t->S[e], t->nodes, 0.3);
    for (size_t i = 0; i < t->m; i++) {
        to->d[i] = spread(a, t->d[i], t->nodes, 0.7);
        to->F[i] = spread(a, NULL, 0, 0);
    }
    for (size_t k = 0; k < t->c; k++) {
        to->r[k] = spread(a, t->r[k], t->nodes, -0.4);
        to->q[k] = spread(a, NULL, 0, 0);
    }
}

static void
release(const tree *t, arrays *to)
{
    for (size_t e = 0; e < t->c * t->m; e++)
        free(to->S[e]);
    for (size_t i = 0; i < t->m; i++) {
        free(to->d[i]);
        free(to->F[i]);
    }
    for (size_t k = 0; k < t->c; k++) {
        free(to->r[k]);
        free(to->q[k]);
    }
}

/* q as the full matrix has it, and F as q makes it: within `bound` of the largest, or no
 * farther than a few times what Cholesky's method in doubles is. */
static void
agrees(const tree *t, bool path, double bound)
{
    const size_t n = t->nodes * t->c, e = t->nodes * t->m;
    const double factor = 1.75;
    qdot_articulated *a = build(t);
    long double q[most * unknowns], x[most * size] = {0}, F[most * size];
    double lost, most_q = 0, most_F = 0, allowed = 0, by_cholesky[most * unknowns];
    size_t node, unknown;
    arrays at;

    assert_int_equal(qdot_articulated_is_path(a), path);
    lay_out(a, t, &at);
    assert_true(
        qdot_articulated_factor(a, (const double *const *)at.S, &lost, &node, &unknown));
    assert_true(lost > 0 && lost <= 1);
    qdot_articulated_solve(
        a, &(qdot_articulated_equations){(const double *const *)at.S, (const double *const *)at.d,
                                         (const double *const *)at.r, factor, at.q, at.F});
    solve_full(t, factor, q, by_cholesky);
    for (size_t j = 0; j < n; j++) {
        most_q = fmax(most_q, fabs((double)q[j]));
        allowed = fmax(allowed, 4 * fabs((double)(by_cholesky[j] - q[j])));
    }
    allowed = fmax(allowed, bound * most_q);
    for (size_t j = 0; j < n; j++) {
        const double found = at.q[j % t->c][qdot_articulated_slot(a, j / t->c)];

        if (!(fabs((double)(found - q[j])) <= allowed))
            fail_msg("unknown %zu of %zu: %.17g, not %.17g", j, n, found, (double)q[j]);
    }
    for (size_t k = 0; k < e; k++) {
        x[k] = factor * t->d[k % t->m][k / t->m];
        for (size_t l = 0; l < t->c; l++)
            x[k] += t->S[l * t->m + k % t->m][k / t->m] * q[k / t->m * t->c + l];
    }
    carry_down(t, x);
    gather(t, x, F);
    for (size_t k = 0; k < e; k++)
        most_F = fmax(most_F, fabs((double)F[k]));
    allowed = fmax(bound * most_F, allowed / most_q * most_F);
    for (size_t k = 0; k < e; k++) {
        const double found = at.F[k % t->m][qdot_articulated_slot(a, k / t->m)];

        if (!(fabs((double)(found - F[k])) <= allowed))
            fail_msg("force %zu: %.17g, not %.17g", k, found, (double)F[k]);
    }
    release(t, &at);
    qdot_articulated_free(a);
}

static void
chains_agree_with_the_full_matrix(void **state)
{
    static const size_t lengths[] = {1, 2, 5, 7, 8, 9, 15, 16, 17, 24, 31, 64, 67};
    static const size_t shapes[][2] = {{2, 1}, {3, 2}, {3, 1}, {1, 1}};
    tree *t = calloc(1, sizeof *t);

    (void)state;
    srand(2);
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (size_t l = 0; l < sizeof lengths / sizeof *lengths; l++) {
            t->nodes = lengths[l];
            t->m = shapes[s][0];
            t->c = shapes[s][1];
            for (size_t n = 0; n < t->nodes; n++)
                hang(t, n, n - 1);
            fill(t, 1, 1);
            agrees(t, true, 1e-10);
        }
    free(t);
}

/* Links of one length in a plane, as a chain has them: to roundoff. */
static void
links_of_one_length_agree_to_roundoff(void **state)
{
    tree *t = calloc(1, sizeof *t);

    (void)state;
    srand(3);
    t->m = 2;
    t->c = 1;
    for (t->nodes = 1; t->nodes <= most; t->nodes++) {
        for (size_t n = 0; n < t->nodes; n++)
            hang(t, n, n - 1);
        fill(t, 1, 1);
        for (size_t n = 0; n < t->nodes; n++) {
            const double angle = 4 * uniform();

            t->S[0][n] = cos(angle);
            t->S[1][n] = sin(angle);
        }
        agrees(t, true, 1e-13);
    }
    free(t);
}

static void
masses_of_differing_size_agree(void **state)
{
    tree *t = calloc(1, sizeof *t);

    (void)state;
    srand(4);
    t->m = 2;
    t->c = 1;
    t->nodes = 30;
    for (size_t n = 0; n < t->nodes; n++)
        hang(t, n, n - 1);
    for (int trial = 0; trial < 20; trial++) {
        fill(t, 1e-3, 1e3);
        for (size_t n = 0; n < t->nodes; n++) {
            const double angle = 4 * uniform();

            t->S[0][n] = cos(angle);
            t->S[1][n] = sin(angle);
        }
        agrees(t, true, 1e-10);
    }
    free(t);
}

/* Branches, components measured from other ones or from nowhere, nodes without unknowns,
 * weights that couple components. */
static void
trees_agree_with_the_full_matrix(void **state)
{
    tree *t = calloc(1, sizeof *t);

    (void)state;
    srand(5);
    for (int trial = 0; trial < 200; trial++) {
        t->m = 2 + (size_t)rand() % 3;
        t->c = 1 + (size_t)rand() % (t->m - 1);
        t->nodes = 3 + (size_t)rand() % 30;
        for (size_t n = 0; n < t->nodes; n++)
            hang(t, n, n > 0 ? (size_t)rand() % n : 0);
        hang(t, 2, 0);
        t->parent[2 * t->m] = 1;
        t->parent[2 * t->m + 1] = trial % 3 ? 0 : QDOT_ARTICULATED_NONE;
        fill(t, 0.3, 3);
        for (size_t n = 0; n < t->nodes; n++) {
            double *W = t->weight + n * t->m * t->m;

            t->free[n] = (uint8_t)((size_t)rand() % 4 ? t->c : (size_t)rand() % t->c);
            for (size_t k = t->free[n]; k < t->c; k++)
                for (size_t i = 0; i < t->m; i++)
                    t->S[k * t->m + i][n] = 0;
            W[1] = W[t->m] = 0.4 * W[0] * uniform();
        }
        agrees(t, false, 1e-10);
    }
    free(t);
}

static void
a_node_that_moves_nothing_is_named(void **state)
{
    tree *t = calloc(1, sizeof *t);
    qdot_articulated *a;
    size_t node, unknown;
    double lost;
    arrays at;

    (void)state;
    srand(6);
    t->m = 2;
    t->c = 1;
    t->nodes = 12;
    for (size_t n = 0; n < t->nodes; n++)
        hang(t, n, n - 1);
    fill(t, 1, 1);
    t->weight[11 * 4] = t->weight[11 * 4 + 3] = 0;
    a = build(t);
    lay_out(a, t, &at);
    assert_false(
        qdot_articulated_factor(a, (const double *const *)at.S, &lost, &node, &unknown));
    assert_int_equal(node, 11);
    assert_int_equal(unknown, 0);
    release(t, &at);
    qdot_articulated_free(a);
    free(t);
}

/* The pivot of a link that barely differs from the next is small against its mass. */
static void
what_a_pivot_has_lost_is_told(void **state)
{
    tree *t = calloc(1, sizeof *t);
    qdot_articulated *a;
    size_t node, unknown;
    double lost;
    arrays at;

    (void)state;
    srand(7);
    t->m = 2;
    t->c = 1;
    t->nodes = 2;
    hang(t, 0, 0);
    hang(t, 1, 0);
    fill(t, 1, 1);
    t->S[0][0] = t->S[0][1] = 1;
    t->S[1][0] = 0;
    t->S[1][1] = 1e-3;
    t->weight[0] = t->weight[3] = 1e-6;
    a = build(t);
    lay_out(a, t, &at);
    assert_true(
        qdot_articulated_factor(a, (const double *const *)at.S, &lost, &node, &unknown));
    assert_true(lost < 3e-6 && lost > 1e-6); /* 1e-6 + 1e-6, of 1 */
    release(t, &at);
    qdot_articulated_free(a);
    free(t);
}

static void
what_is_no_tree_is_refused(void **state)
{
    const uint32_t itself[] = {QDOT_ARTICULATED_NONE, 1};
    const uint32_t two[] = {QDOT_ARTICULATED_NONE,
                            QDOT_ARTICULATED_NONE,
                            QDOT_ARTICULATED_NONE,
                            QDOT_ARTICULATED_NONE,
                            0,
                            2};
    const double weight[12] = {1};
    const uint8_t one[] = {1, 1, 1};
    qdot_articulated_tree t = {2, 1, 1, itself, weight, one};
    qdot_articulated *a;

    (void)state;
    assert_int_equal(qdot_articulated_new(&t, &a), QDOT_EINVAL);
    assert_null(a);
    t = (qdot_articulated_tree){3, 2, 1, two, weight, one};
    assert_int_equal(qdot_articulated_new(&t, &a), QDOT_EINVAL);
    t = (qdot_articulated_tree){1, 7, 1, two, weight, one};
    assert_int_equal(qdot_articulated_new(&t, &a), QDOT_EINVAL);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_agree_with_the_full_matrix),
        cmocka_unit_test(links_of_one_length_agree_to_roundoff),
        cmocka_unit_test(masses_of_differing_size_agree),
        cmocka_unit_test(trees_agree_with_the_full_matrix),
        cmocka_unit_test(a_node_that_moves_nothing_is_named),
        cmocka_unit_test(what_a_pivot_has_lost_is_told),
        cmocka_unit_test(what_is_no_tree_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
