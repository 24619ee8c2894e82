/* integrated.c -- integrals F(q, t) of velocity constraints, stored with the scene, and the decision when they are used. */
#include "mech/dynamics/integrated.h"

#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrable.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/constraint.h"

/* Constraints with more operations are not integrated: the cost of Frobenius' condition grows with their terms. */
enum { MOST_OPERATIONS = 400 };

/* Whether every power in a product of powers is smooth: a natural exponent, or a base that is not
 * 0 (or, of a root, positive). */
static bool
has_smooth_powers(const qdot_pool *pool, qdot_expr product)
{
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, product); k += 2) {
        qdot_expr base = qdot_expr_arg(pool, product, k),
                  power = qdot_expr_arg(pool, product, k + 1);
        uint8_t sign = qdot_expr_node(pool, base)->sign;
        int64_t p;
        bool whole = qdot_expr_to_int(pool, power, &p);

        if (whole && p >= 0)
            continue;
        if ((sign & QDOT_NE0) == 0 || (!whole && (sign & QDOT_GE0) == 0))
            return false;
    }
    return true;
}

/* Whether e is smooth wherever coordinates and t are finite: polynomials of these and of entire
 * functions. */
static qdot_status
is_smooth_everywhere(qdot_scene *s, qdot_expr e, bool *yes)
{
    qdot_pool *pool = s->pool;
    qdot_walk w;

    *yes = true;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && *yes; i++) {
        qdot_expr x = w.at[i];
        qdot_kind kind = qdot_expr_kind(pool, x);

        if ((qdot_mech_holds(s, x) & (QDOT_HAS_COORD | QDOT_HAS_TIME)) == 0)
            continue;
        if (kind == QDOT_PROD)
            *yes = has_smooth_powers(pool, x);
        else
            *yes = kind == QDOT_SYM || kind == QDOT_SUM ||
                   qdot_expr_is_function_that(pool, x, QDOT_FUN_ENTIRE);
    }
    qdot_walk_end(&w);
    return QDOT_OK;
}

static qdot_status
integrate_constraint(qdot_scene *s, size_t k, qdot_expr *F, qdot_expr *mu)
{
    const qdot_constraint *c = &s->constraints.at[k];
    qdot_integrability found;
    bool smooth = true;
    qdot_status status;

    *F = *mu = QDOT_NIL;
    if (c->kind != QDOT_VELOCITY || qdot_expr_size(s->pool, c->f) > MOST_OPERATIONS)
        return QDOT_OK;
    status = qdot_mech_integrable(s, k, true, &found);
    if (status == QDOT_EINVAL) /* the constraint is not linear in the velocities */
        return QDOT_OK;
    QDOT_TRY(status);
    if (found.decision.verdict != QDOT_PROVED || found.integral == QDOT_NIL ||
        found.factor == QDOT_NIL)
        return QDOT_OK;
    for (size_t i = 0; i < s->coordinates.n && smooth; i++) {
        qdot_expr slope = qdot_diff(s->pool, found.integral, s->coordinates.at[i]);

        QDOT_TRY(qdot_pool_check(s->pool));
        QDOT_TRY(is_smooth_everywhere(s, slope, &smooth));
    }
    if (smooth) {
        *F = found.integral;
        *mu = found.factor;
    }
    return QDOT_OK;
}

qdot_expr
qdot_integrated_of(qdot_scene *s, size_t k, qdot_expr *mu)
{
    qdot_derived *d = qdot_derived_get(s);
    size_t n = s->constraints.n;

    *mu = QDOT_ONE;
    if (d->integral_known == NULL)
        d->integral_known = qdot_calloc(n + 1, sizeof *d->integral_known);
    if (d->integral_known == NULL)
        return qdot_pool_fail(s->pool);
    if (!qdot_derived_array(s, &d->factor, n) || !qdot_derived_array(s, &d->integral, n))
        return QDOT_NIL;
    if (!d->integral_known[k]) {
        if (integrate_constraint(s, k, &d->integral[k], &d->factor[k]) != QDOT_OK)
            return qdot_pool_fail(s->pool);
        d->integral_known[k] = true;
    }
    if (d->integral[k] != QDOT_NIL)
        *mu = d->factor[k];
    return d->integral[k];
}

qdot_expr
qdot_integrated_slope(qdot_scene *s, size_t k, size_t i)
{
    qdot_expr mu, F = qdot_integrated_of(s, k, &mu);

    return F == QDOT_NIL ? qdot_constraint_slope(s, k, i)
                         : qdot_diff(s->pool, F, s->coordinates.at[i]);
}

/* Whether all coefficients of velocity constraint k may vanish together, since none is known to be non-zero. */
static bool
may_all_vanish(qdot_scene *s, size_t k)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr a = qdot_constraint_slope(s, k, i);

        if (a == QDOT_NIL || (qdot_expr_node(s->pool, a)->sign & QDOT_NE0))
            return false;
    }
    return true;
}

qdot_expr
qdot_integrated_rate(qdot_scene *s, size_t k, qdot_expr *mu)
{
    const qdot_constraint *c = &s->constraints.at[k];
    qdot_expr F;

    *mu = QDOT_ONE;
    if (c->kind != QDOT_VELOCITY || !may_all_vanish(s, k))
        return c->f;
    F = qdot_integrated_of(s, k, mu);
    if (F == QDOT_NIL)
        return qdot_pool_failed(s->pool) ? QDOT_NIL : c->f;
    return qdot_mech_tidy(s, qdot_ddt(s->pool, F));
}

qdot_status
qdot_mech_is_holonomic(qdot_scene *s, bool *yes)
{
    qdot_derived *d = qdot_derived_get(s);

    if (!d->holonomic_known) {
        QDOT_TRY(qdot_mech_integrable_all(s, &d->holonomic));
        d->holonomic_known = true;
    }
    *yes = d->holonomic;
    return QDOT_OK;
}
