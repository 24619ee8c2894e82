/* variation-parts.c -- symbols of the variational scene, and derivatives in its directions. */
#include "sim/study/variation-parts.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "sim/model/substitute.h"

qdot_expr
qdot_variation_jet(const qdot_variation *v, size_t i, uint32_t order)
{
    return qdot_symbol_jet(v->of->pool, v->of->coordinates.at[i], order);
}

qdot_expr
qdot_variation_slope_jet(const qdot_variation *v, size_t k, size_t i, uint32_t order)
{
    return qdot_symbol_jet(v->of->pool, v->y[k * v->n + i], order);
}

qdot_expr
qdot_variation_with_numbers(const qdot_variation *v, qdot_expr e)
{
    const qdot_run_request *r = v->request;

    return qdot_substitute(v->of->pool, e, r->n_values, r->symbols, r->values);
}

qdot_expr
qdot_variation_by_parameter(const qdot_variation *v, qdot_expr e, size_t k)
{
    const qdot_variation_by *by = v->by + k;
    const qdot_run_request *r = v->request;
    qdot_pool *pool = v->of->pool;

    if (by->parameter == QDOT_NIL)
        return QDOT_ZERO;
    e = qdot_substitute(pool, e, r->n_values, r->symbols, by->values);
    e = qdot_diff(pool, e, by->parameter);
    return e == QDOT_NIL ? e : qdot_variation_with_numbers(v, e);
}

qdot_expr
qdot_variation_with_motion(const qdot_variation *v, qdot_expr e)
{
    for (size_t i = 0; i < v->n && e != QDOT_NIL; i++) {
        const qdot_expr from = qdot_variation_jet(v, i, 2);

        e = qdot_subs(v->of->pool, e, 1, &from, &v->a[i]);
    }
    return e;
}

/* The sum over q and q' (and q'', if order 2) of de/dz dz/ds along direction k, for an e with
 * parameter values. */
static qdot_expr
derivative_by_state(const qdot_variation *v, qdot_expr e, size_t k, uint32_t order)
{
    qdot_pool *pool = v->of->pool;
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t o = 0; o <= order; o++)
        for (size_t i = 0; i < v->n && e != QDOT_NIL; i++) {
            const qdot_expr slope = qdot_diff(pool, e, qdot_variation_jet(v, i, o));

            if (slope != QDOT_ZERO)
                sum =
                    qdot_add(pool, sum,
                             qdot_mul(pool, slope, qdot_variation_slope_jet(v, k, i, o)));
        }
    return sum;
}

qdot_expr
qdot_variation_of(const qdot_variation *v, qdot_expr e, size_t k)
{
    return qdot_add(v->of->pool, derivative_by_state(v, qdot_variation_with_numbers(v, e), k, 2),
                    qdot_variation_by_parameter(v, e, k));
}

qdot_expr
qdot_variation_rate(const qdot_variation *v, qdot_expr e)
{
    return qdot_variation_with_motion(
        v, qdot_ddt(v->of->pool, qdot_variation_with_numbers(v, e)));
}
