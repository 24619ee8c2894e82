/* eliminated.c -- eliminates multipliers symbolically by L D L^T of A M^-1 A^T; the series of the result. */
#include "sim/form/eliminated.h"

#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "sim/form/derived.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"
#include "sim/model/quotient.h"

/* The most constraints whose multipliers are eliminated symbolically; with more, numbers are cheaper. */
enum { most_rows = 3 };

/* --- expressions of the elimination ------------------------------------------------- */

/* S = A M^-1 A^T, then its factors (D on the diagonal, L below); the right-hand side; the old diagonal of S. */
typedef struct {
    const qdot_plan *plan;
    const qdot_constraints *c;
    qdot_expr S[most_rows][most_rows], b[most_rows];
    qdot_expr diagonal[most_rows];
} elimination;

static qdot_expr
diagonal_mass(const qdot_plan *p, size_t i)
{
    return p->M[i * (p->n + 1)];
}

/* The element of the gradient of constraint `row` for a coordinate, 0 if the constraint does not contain it. */
static qdot_expr
constraint_gradient(const qdot_constraints *c, size_t row, size_t coordinate)
{
    for (size_t s = 0; s < c->n_slopes; s++)
        if (c->slopes[s].row == row && c->slopes[s].column == coordinate)
            return c->A[s];
    return QDOT_ZERO;
}

/* A row's S where the row is held: of a rod, a circle or a sphere S = r f + c with numbers r
 * and c, and f is 0. */
static qdot_expr
value_on_constraint(const elimination *e, size_t k, qdot_expr S)
{
    const qdot_constraints_row *row = e->c->rows + k;
    qdot_pool *pool = e->plan->pool;
    size_t s = 0;
    qdot_expr x, f, r;

    while (s < e->c->n_slopes && e->c->slopes[s].row != k)
        s++;
    if (e->plan->treatment != QDOT_RUN_PROJECT || row->kind != QDOT_HOLONOMIC ||
        s == e->c->n_slopes)
        return S;
    x = e->plan->inputs[e->c->slopes[s].column];
    f = qdot_diff(pool, qdot_diff(pool, row->f, x), x);
    r = qdot_diff(pool, qdot_diff(pool, S, x), x);
    if (qdot_expr_kind(pool, f) != QDOT_NUM || qdot_expr_kind(pool, r) != QDOT_NUM ||
        f == QDOT_ZERO || r == QDOT_ZERO)
        return S;
    r = qdot_expand(pool, qdot_sub(pool, S, qdot_mul(pool, qdot_div(pool, r, f), row->f)));
    return qdot_expr_kind(pool, r) == QDOT_NUM ? r : S;
}

static void
form_multiplier_equations(elimination *e)
{
    const qdot_plan *p = e->plan;
    qdot_pool *pool = p->pool;

    for (size_t k = 0; k < e->c->m; k++) {
        e->b[k] = e->c->gamma[k];
        for (size_t l = 0; l <= k; l++)
            e->S[k][l] = QDOT_ZERO;
        for (size_t i = 0; i < p->n; i++) {
            const qdot_expr a = constraint_gradient(e->c, k, i);
            const qdot_expr part = qdot_quotient(pool, a, diagonal_mass(p, i));

            if (a == QDOT_ZERO)
                continue;
            e->b[k] = qdot_sub(pool, e->b[k], qdot_mul(pool, part, p->f[i]));
            for (size_t l = 0; l <= k; l++)
                e->S[k][l] = qdot_add(pool, e->S[k][l],
                                      qdot_mul(pool, part, constraint_gradient(e->c, l, i)));
        }
        e->S[k][k] = value_on_constraint(e, k, e->S[k][k]);
        e->b[k] = qdot_hold(pool, e->b[k]);
        for (size_t l = 0; l <= k; l++)
            e->S[k][l] = qdot_hold(pool, e->S[k][l]);
        e->diagonal[k] = e->S[k][k];
    }
}

/* S = L D L^T in its place; whether it has an inverse, as far as can be seen: constraints that
 * repeat each other leave none. */
static bool
factor_symbolically(elimination *e)
{
    qdot_pool *pool = e->plan->pool;
    const size_t m = e->c->m;

    for (size_t k = 0; k < m; k++) {
        qdot_expr l[most_rows];

        if (e->S[k][k] == QDOT_ZERO)
            return false;
        for (size_t i = k + 1; i < m; i++) {
            l[i] = qdot_hold(pool, qdot_quotient(pool, e->S[i][k], e->S[k][k]));
            for (size_t j = k + 1; j <= i; j++)
                e->S[i][j] = qdot_hold(
                    pool, qdot_sub(pool, e->S[i][j], qdot_mul(pool, l[i], e->S[j][k])));
        }
        for (size_t i = k + 1; i < m; i++)
            e->S[i][k] = l[i];
    }
    return true;
}

/* Solve S lambda = b by the symbolic factors of S; b becomes lambda. */
static void
solve_symbolically(elimination *e)
{
    qdot_pool *pool = e->plan->pool;
    const size_t m = e->c->m;

    for (size_t i = 1; i < m; i++) {
        for (size_t k = 0; k < i; k++)
            e->b[i] = qdot_sub(pool, e->b[i], qdot_mul(pool, e->S[i][k], e->b[k]));
        e->b[i] = qdot_hold(pool, e->b[i]);
    }
    for (size_t k = m; k-- > 0;) {
        e->b[k] = qdot_quotient(pool, e->b[k], e->S[k][k]);
        for (size_t i = k + 1; i < m; i++)
            e->b[k] = qdot_sub(pool, e->b[k], qdot_mul(pool, e->S[i][k], e->b[i]));
        e->b[k] = qdot_hold(pool, e->b[k]);
    }
}

/* Add the constraint forces to the applied forces: f becomes f + A^T lambda. */
static void
add_constraint_forces(const elimination *e, qdot_expr *f)
{
    qdot_pool *pool = e->plan->pool;

    for (size_t s = 0; s < e->c->n_slopes; s++) {
        qdot_expr *to = f + e->c->slopes[s].column;

        *to = qdot_add(pool, *to, qdot_mul(pool, e->c->A[s], e->b[e->c->slopes[s].row]));
    }
}

/* --- the plan of the eliminated equations ------------------------------------------- */

static bool
is_elimination_suitable(const qdot_plan *p, double tol)
{
    const qdot_constraints *c = p->constraints;

    if (!(tol >= QDOT_ELIMINATED_TOL) || c->m > most_rows || !p->smooth || p->indefinite ||
        p->treatment == QDOT_RUN_BAUMGARTE || !p->method->series || c->n_masses != p->n)
        return false;
    for (size_t k = 0; k < c->n_masses; k++)
        if (c->masses[k].row != c->masses[k].column)
            return false;
    return true;
}

/* Write q'' of each coordinate, then d_k and S_kk of each constraint, as outputs; *there: it was possible. */
static qdot_status
write_outputs(qdot_plan *r, const qdot_plan *p, bool *there)
{
    elimination e = {.plan = p, .c = p->constraints};
    qdot_expr pivots[2 * most_rows];
    const size_t n = p->n, m = p->constraints->m;

    for (size_t i = 0; i < n; i++) {
        r->names[i] = qdot_strdup(p->names[i]);
        if (!r->names[i])
            return QDOT_ENOMEM;
    }
    memcpy(r->inputs, p->inputs, (3 * n + 1) * sizeof *r->inputs);
    memcpy(r->M, p->M, n * n * sizeof *r->M);
    memcpy(r->f, p->f, n * sizeof *r->f);
    form_multiplier_equations(&e);
    *there = factor_symbolically(&e);
    if (!*there)
        return qdot_pool_check(p->pool);
    solve_symbolically(&e);
    add_constraint_forces(&e, r->f);
    for (size_t k = 0; k < m; k++) {
        pivots[k] = e.S[k][k];
        pivots[m + k] = e.diagonal[k];
    }
    QDOT_TRY(qdot_pool_check(p->pool));
    QDOT_TRY(qdot_plan_structure(r, NULL));
    return qdot_plan_lower(r, 2 * n + 1, 2 * m, pivots);
}

qdot_status
qdot_eliminated_make(const qdot_plan *p, double tol, qdot_plan **eliminated)
{
    bool there = false;
    qdot_status status;

    *eliminated = NULL;
    if (!is_elimination_suitable(p, tol))
        return QDOT_OK;
    status = qdot_plan_of_part(p, p->n, 0, eliminated);
    if (status == QDOT_OK)
        status = write_outputs(*eliminated, p, &there);
    if (status != QDOT_OK || !there) {
        qdot_plan_free(*eliminated);
        *eliminated = NULL;
    }
    return status;
}
