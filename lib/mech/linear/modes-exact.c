/* modes-exact.c -- normal modes of M y'' + H y = 0 as formulas: of each part into which couplings and symmetries split the
 * motion by the roots of its characteristic polynomial, of uniform chains and rings in closed form. */
#include "mech/linear/modes-parts.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/linear/elimination.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

/* M z'' + H z = 0 of a part. */
typedef struct {
    qdot_modes_job *j;
    const qdot_modes_part *part;
    size_t n;
    qdot_expr *M, *H; /* [n x n] */
} motion;

/* out [n x n] = B^T X B, simplified: M or H of the part, X that of all unknowns. */
static qdot_status
project_on_part(const motion *x, const qdot_expr *X, qdot_expr *out)
{
    qdot_pool *pool = x->j->pool;
    const size_t n = x->n, whole = x->part->whole;
    const int *B = x->part->B;

    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++) {
            qdot_expr sum = QDOT_ZERO;

            for (size_t i = 0; i < whole; i++)
                for (size_t k = 0; k < whole && B[i * n + a] != 0; k++)
                    if (B[k * n + b] != 0 && X[i * whole + k] != QDOT_ZERO)
                        sum = B[i * n + a] == B[k * n + b] ? qdot_add(pool, sum, X[i * whole + k])
                                                           : qdot_sub(pool, sum, X[i * whole + k]);
            out[a * n + b] = qdot_simplify(pool, sum, &x->j->facts);
        }
    return qdot_pool_check(pool);
}

qdot_status
qdot_modes_null_space(const qdot_modes_job *j, size_t n, qdot_expr *A, qdot_expr *z, size_t *count)
{
    qdot_elimination x = {.pool = j->pool, .facts = &j->facts};
    qdot_echelon e;
    qdot_status status = qdot_echelon_begin(&e, n, n, n);

    for (size_t r = 0; r < n && status == QDOT_OK; r++) {
        bool independent;

        status = qdot_echelon_add(&x, &e, A + r * n, &independent);
    }
    *count = n - e.rank;
    if (status == QDOT_OK)
        qdot_echelon_null_space(j->pool, &e, A); /* vectors in columns: A is now [n x count] */
    for (size_t i = 0; i < n * *count && status == QDOT_OK; i++)
        z[i] = A[i % n * *count + i / n];
    qdot_echelon_end(&e);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

/* Make the vectors v [count x n], a row each, orthogonal in M, v_a M v_b = 0, by Gram and Schmidt: from each its parts along
 * those before it are subtracted. */
static qdot_status
make_orthogonal(const motion *x, size_t count, qdot_expr *v)
{
    qdot_pool *pool = x->j->pool;
    const size_t n = x->n;

    for (size_t a = 1; a < count; a++)
        for (size_t b = 0; b < a; b++) {
            qdot_expr both = QDOT_ZERO, own = QDOT_ZERO, by;

            for (size_t i = 0; i < n * n; i++) {
                const qdot_expr w = qdot_mul(pool, x->M[i], v[b * n + i / n]);

                both = qdot_add(pool, both, qdot_mul(pool, w, v[a * n + i % n]));
                own = qdot_add(pool, own, qdot_mul(pool, w, v[b * n + i % n]));
            }
            by = qdot_simplify(pool, qdot_div(pool, both, own), &x->j->facts);
            for (size_t i = 0; i < n && by != QDOT_ZERO; i++)
                v[a * n + i] = qdot_simplify(
                    pool, qdot_sub(pool, v[a * n + i], qdot_mul(pool, by, v[b * n + i])), &x->j->facts);
            QDOT_TRY(qdot_pool_check(pool));
        }
    return QDOT_OK;
}

/* Add modes of frequency w, y = B z for each row z of z [count x n], amplitudes of the part's unknowns. */
static qdot_status
add_modes_of_part(const motion *x, qdot_expr w, size_t count, const qdot_expr *z)
{
    qdot_pool *pool = x->j->pool;
    const size_t n = x->n, whole = x->part->whole;
    qdot_expr *y = qdot_calloc(whole + 1, sizeof *y);
    qdot_status status = y == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < count && status == QDOT_OK; k++) {
        for (size_t i = 0; i < whole; i++) {
            y[i] = QDOT_ZERO;
            for (size_t a = 0; a < n; a++)
                if (x->part->B[i * n + a] != 0)
                    y[i] = x->part->B[i * n + a] > 0 ? qdot_add(pool, y[i], z[k * n + a])
                                                     : qdot_sub(pool, y[i], z[k * n + a]);
        }
        status = qdot_modes_add(x->j, w, y);
    }
    qdot_free(y);
    return status;
}

/* Add the modes for one root W = w^2: the null space of H - W M. */
static qdot_status
add_modes_of_root(const motion *x, qdot_expr W)
{
    qdot_pool *pool = x->j->pool;
    size_t n = x->n, count = 0;
    qdot_expr *A = qdot_calloc(2 * n * n, sizeof *A), *z = A + n * n, w = QDOT_NIL;
    qdot_status status = A == NULL ? QDOT_ENOMEM : qdot_modes_frequency(x->j, W, &w);

    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        A[i] = qdot_simplify(pool, qdot_sub(pool, x->H[i], qdot_mul(pool, W, x->M[i])), &x->j->facts);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN)
        status = qdot_modes_fail_unstable();
    if (status == QDOT_OK)
        status = qdot_modes_null_space(x->j, n, A, z, &count);
    if (status == QDOT_OK && x->j->symmetric)
        status = make_orthogonal(x, count, z);
    if (status == QDOT_OK)
        status = add_modes_of_part(x, w, count, z);
    qdot_free(A);
    return status;
}

/* The two roots of det(H - W M) = 0 as
 *
 *     2 a W = b -+ sqrt((M11 H22 - M22 H11)^2 + 4 (M11 H12 - M12 H11)(M22 H12 - M12 H22)),
 *     a = det M,   b = M11 H22 + M22 H11 - 2 M12 H12,
 *
 * whose root is mostly shorter than that of b^2 - 4 a det H; taken where W is. */
static void
solve_two_coordinates(const motion *x, qdot_root *roots)
{
    qdot_pool *pool = x->j->pool;
    const qdot_expr *M = x->M, *H = x->H;
    qdot_expr cross[4], b, root, W[2];
    static const int pick[3][4] = {{0, 3, 3, 0}, {0, 1, 1, 0}, {3, 1, 1, 3}};

    for (int i = 0; i < 3; i++) /* cross products of entries of M and H, such as M11 H22 - M22 H11 */
        cross[i] =
            qdot_simplify(pool,
                          qdot_sub(pool, qdot_mul(pool, M[pick[i][0]], H[pick[i][1]]),
                                   qdot_mul(pool, M[pick[i][2]], H[pick[i][3]])),
                          &x->j->facts);
    cross[3] = qdot_sub(pool, qdot_mul(pool, M[0], M[3]), qdot_mul(pool, M[1], M[1]));
    b = qdot_add(pool, qdot_mul(pool, M[0], H[3]), qdot_mul(pool, M[3], H[0]));
    b = qdot_sub(pool, b,
                 qdot_mul(pool, qdot_expr_int(pool, 2), qdot_mul(pool, M[1], H[1])));
    root = qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, cross[1], cross[2]));
    root = qdot_add(pool, qdot_pow_int(pool, cross[0], 2), root);
    root = qdot_sqrt(pool, qdot_simplify(pool, root, &x->j->facts));
    for (int i = 0; i < 2; i++) {
        W[i] = i == 0 ? qdot_sub(pool, b, root) : qdot_add(pool, b, root);
        W[i] = qdot_div(pool, W[i], qdot_mul(pool, qdot_expr_int(pool, 2), cross[3]));
        W[i] = qdot_simplify(pool, W[i], &x->j->facts);
    }
    if (qdot_pool_failed(pool))
        return;
    if (qdot_expr_size(pool, W[0]) + qdot_expr_size(pool, W[1]) <
        qdot_expr_size(pool, roots[0].value) + qdot_expr_size(pool, roots[1].value))
        for (int i = 0; i < 2; i++)
            roots[i].value = W[i];
}

/* Add the modes of a part by the roots of det(H - W M); *done: all n were found. */
static qdot_status
solve_part(const motion *x, bool *done)
{
    qdot_modes_job *j = x->j;
    qdot_pool *pool = j->pool;
    const size_t n = x->n, before = j->frequency.n;
    qdot_expr W = qdot_symbol_get(pool, QDOT_FORMAL, "omega^2"), *A = qdot_calloc(n * n, sizeof *A), e;
    qdot_solutions roots;
    qdot_status status;

    if (A == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n * n; i++)
        A[i] = qdot_sub(pool, x->H[i], qdot_mul(pool, W, x->M[i]));
    e = n == 1 ? A[0] : qdot_det(pool, qdot_matrix(pool, (uint32_t)n, (uint32_t)n, A));
    qdot_free(A);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve(pool, e, W, &j->facts, &roots);
    if (status == QDOT_OK && n == 2 && roots.root.n == 2 && roots.complete)
        solve_two_coordinates(x, roots.root.at);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    for (size_t k = 0; k < roots.root.n && roots.complete && status == QDOT_OK; k++)
        status = add_modes_of_root(x, roots.root.at[k].value);
    *done = roots.complete && j->frequency.n == before + n;
    qdot_solutions_clear(&roots);
    return status;
}

/* Find the modes of a part; `go_on` is false where no formula gives them. */
static qdot_status
find_modes_of_part(void *user, const qdot_modes_part *part, bool *go_on)
{
    motion x = {.j = user, .part = part, .n = part->n};
    qdot_status status;

    *go_on = false;
    if (part->n > QDOT_MODES_MOST_EXACT)
        return QDOT_OK;
    x.M = qdot_calloc(2 * x.n * x.n, sizeof *x.M);
    if (x.M == NULL)
        return QDOT_ENOMEM;
    x.H = x.M + x.n * x.n;
    status = project_on_part(&x, x.j->m.M, x.M);
    if (status == QDOT_OK)
        status = project_on_part(&x, x.j->m.H, x.H);
    if (status == QDOT_OK)
        status = solve_part(&x, go_on);
    qdot_free(x.M);
    return status;
}

/* Add the modes of the unknowns `which` [n], which nothing couples with others; *done: all were found. */
static qdot_status
find_modes_of_set(void *user, size_t n, const size_t *which, bool *done)
{
    qdot_modes_job *j = user;
    const size_t before = j->frequency.n;

    *done = false;
    if (n > QDOT_MODES_MOST_EXACT)
        QDOT_TRY(qdot_modes_of_chain(j, n, which, done));
    if (*done)
        return QDOT_OK;
    QDOT_TRY(qdot_modes_split(j, n, which, j->m.M, j->m.H, find_modes_of_part, j));
    *done = j->frequency.n == before + n;
    if (*done || n > QDOT_MODES_MOST_EXACT)
        return QDOT_OK;
    j->frequency.n = before;
    j->amplitude.n = before * j->s->coordinates.n;
    return qdot_modes_of_chain(j, n, which, done);
}

qdot_status
qdot_modes_exact(qdot_modes_job *j, bool *done)
{
    return qdot_modes_for_sets(j->m.n, j->m.M, j->m.H, find_modes_of_set, j, done);
}
