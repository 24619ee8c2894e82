/* cells-closure.c -- finds weak inequalities whose solutions are limits of points where they hold strictly. */
#include "normal/inequality/cells-closure.h"

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"

bool
qdot_gap_is_linear(qdot_field *f, qdot_expr g)
{
    const qdot_ratio *r = qdot_field_value(f, g);

    if (r == NULL || !fmpz_mpoly_is_fmpz(r->d, f->ctx))
        return false;
    for (slong v = 0; v < f->n; v++)
        if (fmpz_mpoly_degree_si(r->n, v, f->ctx) > 0 && f->gen[v].kind != QDOT_GEN_PLAIN)
            return false;
    return fmpz_mpoly_total_degree_si(r->n, f->ctx) <= 1;
}

/* Whether the derivative of g by the symbol x is positive everywhere, or negative everywhere. */
static bool
is_monotone(qdot_pool *pool, qdot_expr g, qdot_expr x)
{
    const qdot_expr slope = qdot_diff(pool, g, x);
    const uint8_t sign = qdot_expr_sign(pool, slope);

    return (sign & QDOT_NE0) != 0 && (sign & (QDOT_GE0 | QDOT_LE0)) != 0;
}

/* Whether the symbol x occurs under a root. */
static bool
is_under_root(const qdot_field *f, qdot_expr x)
{
    bool yes = false;

    for (slong v = 0; v < f->n && !yes; v++)
        yes = f->gen[v].kind == QDOT_GEN_ROOT &&
              qdot_expr_contains(f->pool, f->gen[v].of, x);
    return yes;
}

bool
qdot_gap_grows_alone(qdot_field *f, qdot_expr g, size_t n, const qdot_expr *weak)
{
    bool yes = false;

    for (slong v = 0; v < f->n && !yes; v++) {
        const qdot_expr x = f->gen[v].expr;

        yes = f->gen[v].kind == QDOT_GEN_PLAIN &&
              qdot_expr_kind(f->pool, x) == QDOT_SYM && !is_under_root(f, x) &&
              is_monotone(f->pool, g, x);
        for (size_t i = 0; i < n && yes; i++)
            yes = weak[i] == g || !qdot_expr_contains(f->pool, weak[i], x);
    }
    return yes;
}

bool
qdot_field_is_algebraic(const qdot_field *f)
{
    for (slong v = 0; v < f->n; v++)
        if (f->gen[v].kind == QDOT_GEN_SIN || f->gen[v].kind == QDOT_GEN_COS ||
            f->gen[v].kind == QDOT_GEN_SINH || f->gen[v].kind == QDOT_GEN_COSH ||
            f->gen[v].kind == QDOT_GEN_EXP)
            return false;
    return true;
}
