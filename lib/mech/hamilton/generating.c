/* generating.c -- a generating function of a canonical transformation. */
#include "mech/hamilton/generating.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/integral/antiderivative.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/simultaneous.h"

enum { MOST = 32, MOST_MIXED = 3 }; /* degrees of freedom: a bit for each; up to which mixed types are tried, 4^n of them */

typedef struct {
    qdot_pool *pool;
    const qdot_transformation *x;
    const qdot_facts *facts;
    size_t n;
    qdot_expr *variable[2]; /* [n] the old and the new variables of F */
    qdot_expr *sought;      /* [n] the old ones that are solved for */
    qdot_expr *equal;       /* [n] the new variables as functions of the old ones */
    qdot_expr *other;       /* [n] the other new ones, as functions of the old ones */
    int *sign;              /* [2n] of the derivatives of F: dF = sum p dq - q dp - P dQ + Q dP, by the variables that it has */
    qdot_expr *u, *a, *f, *J; /* [2n] the variables of F, its derivatives; [n] equations; [n*n] what they say of the sought ones */
} search;

/* What is 0 where the new variable k has the value of its function; atan2(y, x) = Q as y cos(Q) - x sin(Q) = 0. */
static qdot_expr
equation_of(const search *s, size_t k)
{
    qdot_pool *pool = s->pool;
    const qdot_expr e = s->equal[k], Q = s->variable[1][k];

    if (qdot_expr_kind(pool, e) == QDOT_FUN && qdot_expr_node(pool, e)->op == QDOT_ATAN2)
        return qdot_sub(pool, qdot_mul(pool, qdot_expr_arg(pool, e, 0), qdot_fun1(pool, QDOT_COS, Q)),
                        qdot_mul(pool, qdot_expr_arg(pool, e, 1), qdot_fun1(pool, QDOT_SIN, Q)));
    return qdot_sub(pool, e, Q);
}

/* e with u for each |u|. */
static qdot_expr
without_magnitudes(qdot_pool *pool, qdot_expr e)
{
    qdot_walk w;
    qdot_expr out = e;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return QDOT_NIL;
    for (size_t i = 0; i < w.n; i++)
        if (qdot_expr_is_function(pool, w.at[i], QDOT_ABS)) {
            const qdot_expr u = qdot_expr_arg(pool, w.at[i], 0);

            out = qdot_subs(pool, out, 1, &w.at[i], &u);
        }
    qdot_walk_end(&w);
    return out;
}

/* The derivatives of F, in its variables, by a solution for the sought ones. Of sqrt(q) cos(p) = Q follows q = Q^2/cos(p)^2,
 * and sqrt(q) as |Q/cos(p)|, which is Q/cos(p): `plain` tries that, and what follows is proved. */
static void
find_derivatives(const search *s, qdot_expr values, bool plain)
{
    for (size_t k = 0; k < 2 * s->n; k++) {
        const bool new = k >= s->n;
        qdot_expr e = qdot_simultaneous_put(s->pool, new ? s->other[k - s->n] : s->sought[k], values);

        e = qdot_simplify(s->pool, e, s->facts);
        e = plain ? qdot_simplify(s->pool, without_magnitudes(s->pool, e), s->facts) : e;
        s->a[k] = s->sign[k] < 0 ? qdot_neg(s->pool, e) : e;
    }
}

/* Whether the derivatives of F are what they must be, for all old coordinates and momenta. */
static bool
are_derivatives_proved(const search *s, qdot_expr F)
{
    for (size_t k = 0; k < 2 * s->n; k++) {
        const bool new = k >= s->n;
        const qdot_expr wanted = new ? s->other[k - s->n] : s->sought[k];
        qdot_expr slope = qdot_diff(s->pool, F, s->u[k]);

        slope = slope == QDOT_NIL ? slope : qdot_subs(s->pool, slope, (uint32_t)s->n, s->variable[1], s->equal);
        if (slope == QDOT_NIL ||
            !qdot_is_zero(s->pool, s->sign[k] < 0 ? qdot_add(s->pool, slope, wanted) : qdot_sub(s->pool, slope, wanted), s->facts))
            return false;
    }
    return true;
}

/* Whether the sought variables do not follow from the equations: the determinant of these by those is 0. */
static bool
is_singular(const search *s)
{
    if (s->n == 1)
        return qdot_is_zero(s->pool, qdot_diff(s->pool, s->equal[0], s->sought[0]), s->facts);
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->n; k++)
            s->J[i * s->n + k] = qdot_diff(s->pool, s->equal[i], s->sought[k]);
    return qdot_is_zero(s->pool, qdot_det(s->pool, qdot_matrix(s->pool, (uint32_t)s->n, (uint32_t)s->n, s->J)), s->facts);
}

/* Choose variables and equations: F is of p_k, not q_k, where bit k of `old` is set, of P_k, not Q_k, where bit k of `new` is. */
static void
set_type(search *s, unsigned old, unsigned new)
{
    const qdot_transformation *x = s->x;

    for (size_t k = 0; k < s->n; k++) {
        const bool p = old >> k & 1, P = new >> k & 1;

        s->variable[0][k] = p ? x->p[k] : x->q[k];
        s->variable[1][k] = P ? x->P[k] : x->Q[k];
        s->sought[k] = p ? x->q[k] : x->p[k];
        s->equal[k] = P ? x->P_of[k] : x->Q_of[k];
        s->other[k] = P ? x->Q_of[k] : x->P_of[k];
        s->sign[k] = p ? -1 : 1;
        s->sign[s->n + k] = P ? 1 : -1;
    }
}

/* Try the variables that bits of `old` and `new` choose (set_type). Where a budget is passed, others may be simpler. */
static qdot_status
try_type(search *s, unsigned old, unsigned new, qdot_generating *out)
{
    qdot_pool *pool = s->pool;
    qdot_simultaneous found = {0};
    qdot_expr F = QDOT_NIL;
    qdot_status status;

    set_type(s, old, new);
    if (is_singular(s))
        return qdot_grave(qdot_pool_check(pool));
    for (size_t k = 0; k < s->n; k++) {
        s->u[k] = s->variable[0][k];
        s->u[s->n + k] = s->variable[1][k];
        s->f[k] = equation_of(s, k);
    }
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_simultaneous_all(pool, s->n, s->f, s->sought, QDOT_NIL, s->facts, &found);
    for (size_t i = 0; status == QDOT_OK && i < 2 * found.found.n && F == QDOT_NIL; i++) {
        find_derivatives(s, found.found.at[i / 2].values, i % 2 == 1);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            F = qdot_potential_of(pool, 2 * s->n, s->u, s->a, s->facts);
        if (F != QDOT_NIL && !are_derivatives_proved(s, F))
            F = QDOT_NIL;
    }
    qdot_simultaneous_clear(&found);
    if (F != QDOT_NIL)
        *out = (qdot_generating){.F = F, .of_p = old, .of_P = new};
    return qdot_grave(status);
}

qdot_status
qdot_generating_find(qdot_pool *pool, const qdot_transformation *x, const qdot_facts *facts, qdot_generating *F)
{
    const size_t n = x->n;
    const unsigned all = n < MOST ? (1u << n) - 1 : 0, pure[] = {0, all};
    search s = {.pool = pool, .x = x, .facts = facts, .n = n};
    qdot_expr *room;
    qdot_status status;

    *F = (qdot_generating){.F = QDOT_NIL};
    if (n >= MOST)
        return QDOT_OK;
    room = qdot_calloc(10 * n + n * n + 1, sizeof *room);
    s.sign = qdot_calloc(2 * n + 1, sizeof *s.sign);
    status = room == NULL || s.sign == NULL ? QDOT_ENOMEM : QDOT_OK;
    if (status == QDOT_OK) {
        qdot_expr **const parts[] = {&s.variable[0], &s.variable[1], &s.sought, &s.equal, &s.other, &s.f};

        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
            *parts[i] = room + i * n;
        s.u = room + 6 * n;
        s.a = room + 8 * n;
        s.J = room + 10 * n;
    }
    for (int k = 0; k < 4 && status == QDOT_OK && F->F == QDOT_NIL; k++)
        status = try_type(&s, pure[k / 2], pure[k % 2], F);
    for (unsigned old = 0; n > 1 && n <= MOST_MIXED && old <= all; old++)
        for (unsigned new = 0; new <= all && status == QDOT_OK && F->F == QDOT_NIL; new++)
            if ((old != 0 && old != all) || (new != 0 && new != all))
                status = try_type(&s, old, new, F);
    qdot_free(room);
    qdot_free(s.sign);
    return status;
}
