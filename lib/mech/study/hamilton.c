/* hamilton.c -- replaces velocities by momenta: all of them, or those of the cyclic coordinates. */
#include "mech/study/hamilton.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/squares.h"
#include "mech/scene/access.h"
#include "normal/form/common.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"

/* A Legendre transform over the velocities of n coordinates. */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    uint32_t n;
    qdot_expr L;
    qdot_expr *q, *qdot, *p; /* [n] coordinates, velocities, momenta */
    qdot_expr *rest;         /* [n] p - dL/dq' at q' = 0 */
    qdot_expr *A;            /* [n*n] d2L/dq'dq' */
    qdot_expr *solved;       /* [n]: q' in terms of p */
} legendre;

/* Write the momenta as linear forms p_i = sum A_ij q_j' + b_i. */
static bool
find_linear_momenta(legendre *l)
{
    qdot_pool *pool = l->pool;

    for (uint32_t i = 0; i < l->n; i++) {
        qdot_expr momentum = qdot_diff(pool, l->L, l->qdot[i]), at_rest = momentum;

        for (uint32_t j = 0; j < l->n; j++) {
            qdot_expr e =
                qdot_simplify(pool, qdot_diff(pool, momentum, l->qdot[j]), &l->facts);

            for (uint32_t k = 0; k < l->n && e != QDOT_NIL; k++)
                if (qdot_expr_contains(pool, e, l->qdot[k])) {
                    qdot_mech_fail(
                        l->s, QDOT_EDOMAIN,
                        "the momentum of %s is not linear in the velocities: they cannot "
                        "be solved for",
                        qdot_expr_symbol(pool, l->q[i])->name);
                    return false;
                }
            l->A[i * l->n + j] = e;
            at_rest = qdot_subs(pool, at_rest, 1, &l->qdot[j], (qdot_expr[]){QDOT_ZERO});
        }
        l->rest[i] = qdot_sub(pool, l->p[i], at_rest);
    }
    return !qdot_pool_failed(pool);
}

static bool
solve_for_velocities(legendre *l)
{
    uint32_t pivot = 0;
    qdot_status status =
        qdot_solve_linear(l->pool, l->n, l->A, l->rest, l->solved, &pivot, &l->facts);

    if (status == QDOT_ESINGULAR)
        qdot_mech_fail(l->s, QDOT_ESINGULAR,
                       "the momenta do not determine the velocity of %s: the mass matrix "
                       "is singular",
                       qdot_expr_symbol(l->pool, l->q[pivot])->name);
    else if (status != QDOT_OK)
        qdot_pool_fail(l->pool);
    return status == QDOT_OK;
}

/* Add 1/2 (p - b).A^-1 (p - b) for one block of A, whose rows are which [m]; written as squares or by the inverse. */
static qdot_status
add_block_energy(legendre *l, qdot_squares *q, size_t m, const size_t *which)
{
    qdot_pool *pool = l->pool;
    qdot_expr inverse[9], v[3], sum = QDOT_ZERO;
    bool done = false;

    if (m == 1)
        return qdot_squares_add(
            q, qdot_div(pool, QDOT_ONE, l->A[which[0] * l->n + which[0]]),
            l->rest[which[0]]);
    for (size_t i = 0; i < m && m <= 3; i++) {
        v[i] = l->rest[which[i]];
        for (size_t k = 0; k < m; k++)
            inverse[i * m + k] = qdot_simplify(
                pool, qdot_diff(pool, l->solved[which[i]], l->p[which[k]]), &l->facts);
    }
    QDOT_TRY(qdot_pool_check(pool));
    if (m <= 3 && qdot_squares_worth(l->s, m, inverse))
        QDOT_TRY(qdot_squares_complete(q, m, inverse, v, &done));
    if (done)
        return QDOT_OK;
    for (size_t i = 0; i < m; i++)
        sum = qdot_add(pool, sum, qdot_mul(pool, l->rest[which[i]], l->solved[which[i]]));
    sum = qdot_simplify(pool, qdot_mul(pool, QDOT_HALF, sum), &l->facts);
    if (sum != QDOT_NIL && qdot_expr_kind(pool, sum) == QDOT_PROD)
        sum = qdot_common_out(pool, sum);
    q->rest = qdot_add(pool, q->rest, sum);
    return qdot_pool_check(pool);
}

/* L is of second degree in q', its slopes being linear: with b the momenta at q' = 0
 *
 *     sum p q' - L = 1/2 (p - b).A^-1 (p - b) - L at q' = 0
 *
 * without terms that cancel, block by block of A. */
static qdot_expr
quadratic_legendre_transform(legendre *l)
{
    qdot_pool *pool = l->pool;
    qdot_expr sum = QDOT_NIL, at_rest = l->L;
    size_t *block = qdot_calloc(2 * (size_t)l->n + 1, sizeof *block),
           *which = block + l->n;
    qdot_status status = block == NULL ? QDOT_ENOMEM : QDOT_OK;
    qdot_squares q;

    qdot_squares_begin(&q, l->s);
    if (block != NULL)
        qdot_squares_blocks(l->n, l->A, block);
    for (size_t i = 0; i < l->n && status == QDOT_OK; i++) {
        size_t m = 0;

        for (size_t k = i; k < l->n && block[i] == i; k++)
            if (block[k] == i)
                which[m++] = k;
        if (m > 0)
            status = add_block_energy(l, &q, m, which);
    }
    if (status == QDOT_OK)
        sum = qdot_common_out(pool, qdot_squares_sum(&q));
    qdot_squares_clear(&q);
    qdot_free(block);
    if (status != QDOT_OK)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < l->n; i++)
        at_rest = qdot_subs(pool, at_rest, 1, &l->qdot[i], (qdot_expr[]){QDOT_ZERO});
    if (l->s->lagrangian != QDOT_NIL) /* simplify a stated Lagrangian only: T - V is in simplified form already */
        at_rest = qdot_simplify(pool, at_rest, &l->facts);
    return qdot_sub(pool, sum, at_rest);
}

/* Solve the momenta of the coordinates q [n] for their velocities; l->q is the caller's to free.
 * False: the pool has the cause. */
static bool
legendre_begin(legendre *l, qdot_scene *s, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;

    *l = (legendre){.s = s,
                    .pool = pool,
                    .facts = qdot_scene_facts(s),
                    .n = n,
                    .L = qdot_mech_lagrangian(s)};
    l->q = qdot_calloc((size_t)n * n + 5 * n + 1, sizeof *l->q);
    if (l->q == NULL) {
        qdot_pool_fail(pool);
        return false;
    }
    l->qdot = l->q + n;
    l->p = l->qdot + n;
    l->rest = l->p + n;
    l->solved = l->rest + n;
    l->A = l->solved + n;
    for (uint32_t i = 0; i < n; i++) {
        l->q[i] = q[i];
        l->qdot[i] = qdot_symbol_jet(pool, q[i], 1);
        l->p[i] = qdot_symbol_of(pool, QDOT_MOMENTUM, q[i]);
    }
    return !qdot_pool_failed(pool) && find_linear_momenta(l) && solve_for_velocities(l);
}

/* The Legendre transform sum p q' - L over the coordinates q [n], with their velocities replaced by momenta. */
static qdot_expr
legendre_transform(qdot_scene *s, uint32_t n, const qdot_expr *q)
{
    legendre l;
    qdot_expr result = legendre_begin(&l, s, n, q) ? quadratic_legendre_transform(&l) : QDOT_NIL;

    qdot_free(l.q);
    return result;
}

qdot_expr
qdot_hamilton_in_momenta(qdot_scene *s, qdot_expr e)
{
    legendre l;

    if (e == QDOT_NIL || !(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_VELOCITY))
        return e;
    e = legendre_begin(&l, s, (uint32_t)s->coordinates.n, s->coordinates.at)
            ? qdot_subs(s->pool, e, l.n, l.qdot, l.solved)
            : QDOT_NIL;
    qdot_free(l.q);
    return e;
}

qdot_expr
qdot_hamilton_in_velocities(qdot_scene *s, qdot_expr e)
{
    qdot_vec(qdot_expr) from = {0}, to = {0};
    qdot_status status = QDOT_OK;

    if (e == QDOT_NIL || !(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_MOMENTUM))
        return e;
    for (size_t i = 0; i < s->coordinates.n && status == QDOT_OK; i++) {
        const qdot_expr q = s->coordinates.at[i],
                        p = qdot_symbol_of(s->pool, QDOT_MOMENTUM, q);

        if (p == QDOT_NIL || !qdot_expr_contains(s->pool, e, p))
            continue;
        status = qdot_vec_push(&from, p);
        if (status == QDOT_OK)
            status = qdot_vec_push(&to, qdot_mech_momentum(s, q));
    }
    e = status == QDOT_OK ? qdot_subs(s->pool, e, from.n, from.at, to.at)
                          : qdot_pool_fail(s->pool);
    qdot_free(from.at);
    qdot_free(to.at);
    return e;
}

/* An argument of Poisson's bracket, with velocities replaced by momenta. */
static qdot_expr
bracket_argument(qdot_scene *s, qdot_expr e)
{
    if (e == QDOT_NIL || !(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_ACCELERATION))
        return qdot_hamilton_in_momenta(s, e);
    qdot_mech_fail(s, QDOT_ETYPE,
                   "a Poisson bracket is of functions of coordinates, momenta and "
                   "velocities, not of accelerations");
    return QDOT_NIL;
}

qdot_expr
qdot_hamilton_poisson(qdot_scene *s, qdot_expr f, qdot_expr g)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr sum = QDOT_ZERO;

    if (s->coordinates.n == 0) {
        qdot_mech_fail(s, QDOT_EINVAL, "the scene has no coordinate");
        return QDOT_NIL;
    }
    f = bracket_argument(s, f);
    g = bracket_argument(s, g);
    if (f == QDOT_NIL || g == QDOT_NIL)
        return QDOT_NIL;
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i],
                        p = qdot_symbol_of(pool, QDOT_MOMENTUM, q);

        sum = qdot_add(pool, sum,
                       qdot_sub(pool,
                                qdot_mul(pool, qdot_diff(pool, f, q), qdot_diff(pool, g, p)),
                                qdot_mul(pool, qdot_diff(pool, f, p), qdot_diff(pool, g, q))));
    }
    return qdot_simplify(pool, sum, &facts);
}

qdot_expr
qdot_hamilton_hamiltonian(qdot_scene *s)
{
    return legendre_transform(s, (uint32_t)s->coordinates.n, s->coordinates.at);
}

/* The Routhian R for the coordinates q [n], in the shorter of two forms. */
static qdot_expr
routhian(qdot_scene *s, uint32_t n, const qdot_expr *q)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr result = legendre_transform(s, n, q), shorter;

    if (result == QDOT_NIL)
        return QDOT_NIL;
    result = qdot_neg(s->pool, result);
    shorter = qdot_simplify(s->pool, result, &facts);
    return qdot_expr_size(s->pool, shorter) < qdot_expr_size(s->pool, result) ? shorter
                                                                              : result;
}

qdot_expr
qdot_hamilton_routhian(qdot_scene *s, uint32_t n, const qdot_expr *q)
{
    qdot_cyclic *list;
    size_t found;
    qdot_expr *cyclic, result = QDOT_NIL;

    if (n > 0)
        return routhian(s, n, q);
    if (qdot_mech_cyclic(s, &list, &found) != QDOT_OK)
        return qdot_pool_fail(s->pool);
    cyclic = qdot_calloc(found + 1, sizeof *cyclic);
    if (cyclic == NULL)
        qdot_pool_fail(s->pool);
    for (size_t i = 0; cyclic != NULL && i < found; i++)
        cyclic[i] = list[i].coordinate;
    if (cyclic != NULL)
        result = found == 0 ? qdot_mech_lagrangian(s) : routhian(s, (uint32_t)found, cyclic);
    qdot_free(cyclic);
    qdot_free(list);
    return result;
}
