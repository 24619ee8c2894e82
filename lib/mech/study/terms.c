/* terms.c -- separates the terms of a sum by the symbols in them. */
#include "mech/study/terms.h"

#include "expr/build.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/walk.h"

typedef struct {
    size_t n;
    const qdot_expr *symbols;
    bool holding;
} choice;

static bool
has_chosen_symbols(const qdot_pool *pool, qdot_expr e, const choice *c)
{
    for (size_t i = 0; i < c->n; i++)
        if (qdot_expr_contains(pool, e, c->symbols[i]))
            return c->holding;
    return !c->holding;
}

static qdot_expr
keep_chosen_terms(qdot_pool *pool, qdot_expr e, void *user)
{
    const choice *c = user;
    qdot_expr sum;

    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return has_chosen_symbols(pool, e, c) ? e : QDOT_ZERO;
    sum = c->holding ? QDOT_ZERO : qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr term = qdot_expr_arg(pool, e, i);

        if (has_chosen_symbols(pool, term, c))
            sum = qdot_add(pool, sum,
                           qdot_mul(pool, qdot_expr_arg(pool, e, i + 1), term));
    }
    return sum;
}

qdot_expr
qdot_mech_terms_of(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *symbols,
                   bool holding)
{
    return qdot_value_map(pool, e, keep_chosen_terms, &(choice){n, symbols, holding});
}
