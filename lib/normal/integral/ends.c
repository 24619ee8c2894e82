/* ends.c -- values at the ends of a range: by substitution, else as limits. */
#include "normal/integral/ends.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/elementary.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/calculus/limit.h"
#include "normal/prove/decide.h"

/* F with elliptic_F(phi, m), m free of x, where phi has a limit. */
static qdot_status
settle_elliptic_integral(qdot_pool *pool, qdot_expr *F, qdot_expr x, qdot_expr at, const qdot_facts *facts)
{
    const qdot_fun_id id = QDOT_ELLIPTIC_F;
    const qdot_expr e = qdot_expr_find_function(pool, *F, 1, &id, x);
    qdot_limit_answer limit;
    qdot_expr value;

    if (e == QDOT_NIL || qdot_expr_contains(pool, qdot_expr_arg(pool, e, 1), x))
        return QDOT_OK;
    QDOT_TRY(qdot_limit(pool, facts, qdot_expr_arg(pool, e, 0), x, at, 0, &limit));
    if (limit.kind != QDOT_LIMIT_VALUE)
        return QDOT_OK;
    value = qdot_fun(pool, id, 2, (qdot_expr[]){limit.value, qdot_expr_arg(pool, e, 1)});
    *F = qdot_subs(pool, *F, 1, &e, &value);
    return QDOT_OK;
}

/* F with -1 or 1 for an erf(u) that stands in it with a constant factor, u tending to minus infinity or infinity. */
static qdot_status
settle_error_function(qdot_pool *pool, qdot_expr *F, qdot_expr x, qdot_expr at, const qdot_facts *facts)
{
    const qdot_fun_id id = QDOT_ERF;
    qdot_expr e = qdot_expr_find_function(pool, *F, 1, &id, x), w = qdot_symbol_get(pool, QDOT_FORMAL, "erf#"), f, end;
    qdot_limit_answer limit;

    if (e == QDOT_NIL)
        return QDOT_OK;
    f = qdot_subs(pool, *F, 1, &e, &w);
    if (f == QDOT_NIL || qdot_expr_contains(pool, qdot_diff(pool, f, w), x))
        return QDOT_OK;
    QDOT_TRY(qdot_limit(pool, facts, qdot_expr_arg(pool, e, 0), x, at, 0, &limit));
    if (limit.kind != QDOT_LIMIT_INFINITE)
        return QDOT_OK;
    end = qdot_infinite(pool, limit.value) > 0 ? QDOT_ONE : QDOT_MINUS_ONE;
    *F = qdot_subs(pool, f, 1, &w, &end);
    return QDOT_OK;
}

/* Whether the k-th argument of a product or function e matters where it is 0: the base of a root or of a negative power. */
static bool
zero_matters(qdot_pool *pool, qdot_expr e, uint32_t k)
{
    int64_t n;

    return qdot_expr_kind(pool, e) == QDOT_FUN ||
           (k % 2 == 1 && !(qdot_expr_to_int(pool, qdot_expr_arg(pool, e, k + 1), &n) && n > 0));
}

static bool
has_known_sign(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_sign(pool, e) & (QDOT_GE0 | QDOT_LE0)) != 0;
}

/* F at x = at, with 0 for arguments and bases that are 0 there in disguise; nil: F has no value there, it divides by 0. */
static qdot_expr
value_at(qdot_pool *pool, qdot_expr F, qdot_expr x, qdot_expr at, const qdot_facts *facts)
{
    const qdot_expr zero = QDOT_ZERO;
    bool defined = true;
    qdot_walk w;

    if (qdot_walk_begin(pool, F, &w) != QDOT_OK)
        return QDOT_NIL;
    for (size_t i = w.n; i-- > 0;) {
        const qdot_kind kind = qdot_expr_kind(pool, w.at[i]);

        for (uint32_t k = 0; (kind == QDOT_PROD || kind == QDOT_FUN) && k < qdot_expr_count(pool, w.at[i]); k++) {
            qdot_expr u = qdot_expr_arg(pool, w.at[i], k), value;

            if (!qdot_expr_contains(pool, u, x) || !zero_matters(pool, w.at[i], k))
                continue;
            value = qdot_subs(pool, u, 1, &x, &at);
            if (value == QDOT_ZERO && kind == QDOT_PROD) /* 0^p with a p that may be negative */
                defined = defined && has_known_sign(pool, qdot_expr_arg(pool, w.at[i], k + 1));
            if (value == QDOT_NIL || value == QDOT_ZERO || !qdot_is_zero(pool, value, facts))
                continue;
            defined = defined && (kind == QDOT_FUN || (qdot_expr_sign(pool, qdot_expr_arg(pool, w.at[i], k + 1)) & QDOT_GE0));
            F = qdot_subs(pool, F, 1, &u, &zero);
        }
    }
    qdot_walk_end(&w);
    return defined ? qdot_subs(pool, F, 1, &x, &at) : QDOT_NIL;
}

qdot_status
qdot_end_value(qdot_pool *pool, qdot_expr F, qdot_expr x, qdot_expr at, int side, const qdot_facts *facts, qdot_end *end)
{
    qdot_limit_answer limit;

    *end = (qdot_end){QDOT_END_UNKNOWN, QDOT_NIL, QDOT_NIL};
    if (qdot_infinite(pool, at) == 0) {
        end->value = value_at(pool, F, x, at, facts);
        QDOT_TRY(qdot_grave(qdot_pool_check(pool)));
        if (end->value != QDOT_NIL) {
            end->kind = QDOT_END_VALUE;
            return QDOT_OK;
        }
    }
    if (qdot_infinite(pool, at) != 0)
        QDOT_TRY(settle_error_function(pool, &F, x, at, facts));
    if (qdot_infinite(pool, at) != 0)
        QDOT_TRY(settle_elliptic_integral(pool, &F, x, at, facts));
    QDOT_TRY(qdot_limit(pool, facts, F, x, at, qdot_infinite(pool, at) == 0 ? side : 0, &limit));
    if (limit.kind == QDOT_LIMIT_VALUE || limit.kind == QDOT_LIMIT_INFINITE) {
        end->kind = limit.kind == QDOT_LIMIT_VALUE ? QDOT_END_VALUE : QDOT_END_INFINITE;
        end->value = limit.value;
    } else {
        end->undecided = limit.undecided;
    }
    return QDOT_OK;
}
