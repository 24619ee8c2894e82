/* powers.c -- finds the roots in an expression, b^p of sums b, and puts symbols in their place. */
#include "normal/solve/powers.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/solve/conditions.h"

enum { MOST = QDOT_POWERS_MOST };

static bool
power_has_unknown(const qdot_pool *pool, const qdot_powers *p, qdot_expr e)
{
    bool holds = false;

    for (size_t i = 0; i < p->unknowns && !holds; i++)
        holds = qdot_expr_contains(pool, e, p->unknown[i]);
    return holds;
}

/* The symbol of a power, a new one where it is not known yet; the power itself if there are too many. */
static qdot_expr
symbol_of_power(qdot_pool *pool, qdot_powers *p, qdot_expr base, qdot_expr exponent)
{
    static const char *const names[MOST] = {"power#1", "power#2", "power#3"};
    const qdot_expr power = qdot_pow(pool, base, exponent);
    const uint32_t known = p->n < MOST ? p->n : MOST, k = (uint32_t)qdot_expr_place(known, p->power, power);

    if (k == MOST) {
        p->n = MOST + 1;
        return power;
    }
    if (k == p->n) {
        p->power[k] = power;
        p->base[k] = base;
        p->exponent[k] = exponent;
        p->symbol[k] = qdot_symbol_get(pool, QDOT_FORMAL, names[k]);
        p->n++;
    }
    return p->symbol[k];
}

static qdot_expr
product_by_symbols(qdot_pool *pool, qdot_expr product, void *user)
{
    qdot_powers *p = user;
    qdot_expr out = qdot_expr_arg(pool, product, 0);

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, product); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, product, i), exponent = qdot_expr_arg(pool, product, i + 1);
        const fmpq *q = qdot_expr_rational(pool, exponent);
        const bool root = q != NULL && !fmpz_is_one(fmpq_denref(q)) && qdot_expr_kind(pool, base) == QDOT_SUM &&
                          power_has_unknown(pool, p, base);

        out = qdot_mul(pool, out, root ? symbol_of_power(pool, p, base, exponent) : qdot_pow(pool, base, exponent));
    }
    return out;
}

qdot_expr
qdot_powers_replace(qdot_pool *pool, qdot_powers *p, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_PROD, product_by_symbols, p);
}

bool
qdot_powers_invert(qdot_pool *pool, const qdot_powers *p, uint32_t k, qdot_expr v, const qdot_facts *facts,
                   qdot_expr *equation, qdot_expr *condition)
{
    const fmpq *exponent = qdot_expr_rational(pool, p->exponent[k]);

    if (!fmpz_is_even(fmpq_denref(exponent)))
        return false;
    *condition = qdot_condition(pool, v, fmpq_sgn(exponent) < 0, facts);
    *equation = *condition == QDOT_FALSE
                    ? QDOT_NIL
                    : qdot_sub(pool, p->base[k], qdot_pow(pool, v, qdot_div(pool, QDOT_ONE, p->exponent[k])));
    return true;
}

bool
qdot_is_linear_in(qdot_pool *pool, qdot_expr e, uint32_t n, const qdot_expr *x, qdot_expr *a, qdot_expr *b)
{
    *b = e;
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr zero = QDOT_ZERO;

        a[i] = qdot_diff(pool, e, x[i]);
        for (uint32_t k = 0; k < n; k++)
            if (a[i] == QDOT_NIL || qdot_expr_contains(pool, a[i], x[k]))
                return false;
        *b = qdot_subs(pool, *b, 1, &x[i], &zero);
    }
    return *b != QDOT_NIL;
}
