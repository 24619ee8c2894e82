/* stability-degenerate.c -- a strict minimum of the potential of several coordinates where its second derivatives do not decide.
 *
 * Along each axis let the potential at the place begin with c_i y_i^(2 m_i), c_i > 0, W a common multiple of the 2 m_i. On
 * y_i eps^(w_i), w_i = W/(2 m_i),
 *
 *     eps dV/deps = -sum_i w_i eps^(w_i) y_i F_i = W eps^W P(y) + ...
 *
 * if no term is of a lower order. Where P(y) > 0 for all y != 0, V has a strict minimum: terms of higher order are smaller than
 * P near the place. By an energy that does not grow the rest is stable (Lagrange and Dirichlet). P is asked for along
 * y = (0, ..., 0, 1 or -1, any, ..., any).
 *
 * Source  Arnold, Gusein-Zade, Varchenko, Singularities of Differentiable Maps I, 12 (quasihomogeneous functions).
 * Tests   tests/script/rests/degenerate-minimum.lag
 */
#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/stability-parts.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solutions.h"

enum { MOST_COORDINATES = 3, HIGHEST = 8, LONGEST = 200 }; /* order in eps; operations in the forces */

typedef struct {
    qdot_judgement *j;
    qdot_pool *pool;
    size_t n;
    qdot_expr y[MOST_COORDINATES], place[MOST_COORDINATES], eps;
    int64_t w[MOST_COORDINATES]; /* weights; 0: the coordinate is held at the place */
} degenerate;

/* The lowest order in eps of eps dV/deps along these weights, up to HIGHEST, and its coefficient; 0: there is none. */
static qdot_status
find_lowest_order(const degenerate *x, int64_t *order, qdot_expr *coefficient)
{
    qdot_pool *pool = x->pool;
    const qdot_expr *q = x->j->s->coordinates.at, zero = QDOT_ZERO;
    qdot_expr at[MOST_COORDINATES], e = QDOT_ZERO;

    *order = 0;
    for (size_t i = 0; i < x->n; i++)
        at[i] = x->w[i] == 0 ? x->place[i]
                             : qdot_add(pool, x->place[i], qdot_mul(pool, x->y[i], qdot_pow_int(pool, x->eps, x->w[i])));
    for (size_t i = 0; i < x->n; i++)
        if (x->w[i] != 0)
            e = qdot_sub(pool, e, qdot_product(pool, 4, (qdot_expr[]){qdot_expr_int(pool, x->w[i]), x->y[i], qdot_pow_int(pool, x->eps, x->w[i]),
                                                                      qdot_subs(pool, qdot_expr_arg(pool, x->j->judge->forces, (uint32_t)i),
                                                                                x->n, q, at)}));
    QDOT_TRY(qdot_pool_check(pool));
    for (int64_t k = 1, factorial = 1; k <= HIGHEST; k++) {
        e = qdot_diff(pool, e, x->eps);
        factorial *= k;
        *coefficient = qdot_simplify(pool, qdot_subs(pool, e, 1, &x->eps, &zero), &x->j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        if (qdot_is_zero(pool, *coefficient, &x->j->facts))
            continue;
        *order = k;
        *coefficient = qdot_div(pool, *coefficient, qdot_expr_int(pool, factorial));
        return qdot_pool_check(pool);
    }
    return QDOT_OK;
}

static int64_t
least_common_multiple(int64_t a, int64_t b)
{
    int64_t m = a;

    while (m % b != 0)
        m += a;
    return m;
}

/* The weights from the orders along the axes; *W: the order that eps dV/deps must have. *found: all are even and W is low. */
static qdot_status
find_weights(degenerate *x, int64_t *W, bool *found)
{
    int64_t order[MOST_COORDINATES];

    *W = 1;
    *found = true;
    for (size_t i = 0; i < x->n && *found; i++) {
        qdot_expr c;

        for (size_t k = 0; k < x->n; k++)
            x->w[k] = k == i;
        QDOT_TRY(find_lowest_order(x, &order[i], &c));
        *found = order[i] > 0 && order[i] % 2 == 0;
        *W = *found ? least_common_multiple(*W, order[i]) : *W;
    }
    *found = *found && *W <= HIGHEST;
    for (size_t i = 0; i < x->n && *found; i++)
        x->w[i] = *W / order[i];
    return QDOT_OK;
}

/* Whether P > 0 is proved for all y != 0. */
static qdot_status
is_positive_definite(const degenerate *x, qdot_expr P, bool *yes)
{
    *yes = true;
    for (size_t i = 0; i < x->n && *yes; i++)
        for (int sign = -1; sign <= 1 && *yes; sign += 2) {
            qdot_expr to[MOST_COORDINATES], e;
            qdot_decision d;

            for (size_t k = 0; k < x->n; k++)
                to[k] = k < i ? QDOT_ZERO : k > i ? x->y[k] : sign < 0 ? QDOT_MINUS_ONE : QDOT_ONE;
            e = qdot_simplify(x->pool, qdot_subs(x->pool, P, x->n, x->y, to), &x->j->facts);
            QDOT_TRY(qdot_pool_check(x->pool));
            QDOT_TRY(qdot_decide_less(x->pool, QDOT_ZERO, e, true, &x->j->facts, &d));
            *yes = d.verdict == QDOT_PROVED;
        }
    return QDOT_OK;
}

qdot_status
qdot_stability_by_degenerate_minimum(qdot_judgement *j, qdot_equilibrium *e)
{
    qdot_scene *s = j->s;
    degenerate x = {.j = j, .pool = s->pool, .n = s->coordinates.n};
    qdot_expr P;
    int64_t W, order;
    bool yes;
    qdot_status status;

    if (x.n < 2 || x.n > MOST_COORDINATES || s->constraints.n > 0 || j->judge->velocity_kink || j->m.n != x.n || j->n != x.n ||
        qdot_solve_integers(s->pool, e->equations) > 0 || qdot_expr_size(s->pool, j->judge->forces) > LONGEST || qdot_expr_count(s->pool, j->judge->forces) != x.n)
        return QDOT_OK;
    QDOT_TRY(qdot_judgement_is_definite(j, x.n, j->m.M, &yes));
    if (!yes)
        return QDOT_OK;
    x.eps = qdot_symbol_get(s->pool, QDOT_FORMAL, "(epsilon)");
    for (size_t i = 0; i < x.n; i++) {
        char name[24];

        snprintf(name, sizeof name, "(axis %zu)", i + 1);
        x.y[i] = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
        x.place[i] = qdot_rest_value(s, e->equations, s->coordinates.at[i]);
    }
    QDOT_TRY(qdot_pool_check(s->pool));
    status = find_weights(&x, &W, &yes);
    if (status == QDOT_OK && yes)
        status = find_lowest_order(&x, &order, &P);
    if (status == QDOT_OK && yes && order == W)
        status = is_positive_definite(&x, P, &yes);
    else
        yes = false;
    if (status == QDOT_OK && yes)
        e->stability = QDOT_STABLE;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}
