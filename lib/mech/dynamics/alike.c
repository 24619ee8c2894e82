/* alike.c -- what is alike but for its symbols is simplified once.
 *
 * Two steps. A sum of parameters whose symbols stand nowhere else, m[3] + m[4] + m[5], is put
 * in as one symbol: nothing can cancel against its terms. Then symbols of one class and sign
 * are looked through: the pattern is known, or it is simplified and remembered.
 */
#include "mech/dynamics/alike.h"

#include <stdio.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "normal/form/simple.h"

enum { PATTERNS = 256, PATTERN_ATOMS = 20, UNITS = 4 };

/* The sums of parameters that were replaced by symbols, each with its symbol. */
typedef struct {
    size_t n;
    qdot_expr sum[UNITS], symbol[UNITS];
} units;

/* A new parameter that stands for a sum of parameters, declared positive if the sum is. */
static qdot_expr
symbol_for_sum(qdot_pool *pool, qdot_expr sum, size_t k)
{
    bool positive = qdot_expr_node(pool, sum)->sign == QDOT_POS;
    char name[32];
    qdot_expr e;

    snprintf(name, sizeof name, "alike+[%d,%zu]", positive, k);
    e = qdot_symbol_get(pool, QDOT_PARAM, name);
    if (e != QDOT_NIL && positive && qdot_expr_symbol(pool, e)->lo == QDOT_NIL)
        qdot_symbol_domain(pool, e, QDOT_ZERO, true, QDOT_NIL, false);
    return e;
}

static bool
is_term_of_sum(const qdot_pool *pool, qdot_expr sum, qdot_expr symbol)
{
    uint32_t n = qdot_expr_count(pool, sum);

    for (uint32_t i = 1; i < n; i += 2)
        if (qdot_expr_arg(pool, sum, i) == symbol)
            return true;
    return false;
}

/* The expression e with sums of parameters replaced by symbols; e itself if that would lose information. */
static qdot_expr
replace_parameter_sums(qdot_scene *s, qdot_expr e, units *u)
{
    qdot_pool *pool = s->pool;
    qdot_expr with, atoms;
    qdot_walk w;

    u->n = 0;
    if (s->relations.n || s->conditions.n)
        return e;
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i + 1 < w.n && u->n <= UNITS; i++)
        if (qdot_expr_kind(pool, w.at[i]) == QDOT_SUM &&
            qdot_simple_is_done(pool, w.at[i])) {
            if (u->n < UNITS)
                u->sum[u->n] = w.at[i];
            u->n++;
        }
    qdot_walk_end(&w);
    if (u->n == 0 || u->n > UNITS) {
        u->n = 0;
        return e;
    }
    for (size_t k = 0; k < u->n; k++)
        u->symbol[k] = symbol_for_sum(pool, u->sum[k], k);
    with = qdot_subs(pool, e, u->n, u->sum, u->symbol);
    atoms = qdot_expr_atoms(pool, with, false);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++)
        for (size_t k = 0; k < u->n; k++)
            if (is_term_of_sum(pool, u->sum[k], qdot_expr_arg(pool, atoms, i))) {
                u->n = 0;
                return e;
            }
    for (size_t k = 1; k < u->n; k++) /* check that no term occurs in two of the sums */
        for (uint32_t i = 1; i < qdot_expr_count(pool, u->sum[k]); i += 2)
            for (size_t l = 0; l < k; l++)
                if (is_term_of_sum(pool, u->sum[l], qdot_expr_arg(pool, u->sum[k], i))) {
                    u->n = 0;
                    return e;
                }
    return with;
}

/* A stand-in that tells of its symbol what simplification may ask: class and sign. Nil where
 * there is more to know (a domain). */
static qdot_expr
placeholder_for_symbol(qdot_scene *s, qdot_expr atom, uint32_t k)
{
    const qdot_symbol *x = qdot_expr_symbol(s->pool, atom);
    bool positive, bounded;
    qdot_expr e;
    char name[48];

    if (!x || x->class == QDOT_CONST)
        return x ? atom : QDOT_NIL;
    positive = x->sign == QDOT_POS;
    bounded = x->lo != QDOT_NIL || x->hi != QDOT_NIL;
    if (bounded && !(positive && x->lo == QDOT_ZERO && x->hi == QDOT_NIL))
        return QDOT_NIL;
    if (x->sign && !positive)
        return QDOT_NIL;
    snprintf(name, sizeof name, "alike[%d,%d,%u]", (int)x->class, positive, k);
    e = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    if (e != QDOT_NIL && positive && qdot_expr_symbol(s->pool, e)->lo == QDOT_NIL)
        qdot_symbol_domain(s->pool, e, QDOT_ZERO, true, QDOT_NIL, false);
    return e;
}

/* The expression e with its symbols replaced by numbered placeholders; nil if that is not possible. */
static qdot_expr
make_pattern(qdot_scene *s, qdot_expr e, qdot_expr *atoms)
{
    qdot_pool *pool = s->pool;
    qdot_expr from[PATTERN_ATOMS], to[PATTERN_ATOMS];
    uint32_t n;

    if (s->relations.n || s->conditions.n ||
        qdot_mech_holds(s, e) & QDOT_HAS_UFUN)
        return QDOT_NIL;
    *atoms = qdot_expr_atoms(pool, e, false);
    n = *atoms == QDOT_NIL ? 0 : qdot_expr_count(pool, *atoms);
    if (n == 0 || n > PATTERN_ATOMS)
        return QDOT_NIL;
    for (uint32_t k = 0; k < n; k++) {
        from[k] = qdot_expr_arg(pool, *atoms, k);
        to[k] = placeholder_for_symbol(s, from[k], k);
        if (to[k] == QDOT_NIL)
            return QDOT_NIL;
    }
    return qdot_subs(pool, e, n, from, to);
}

/* The expression e simplified; if one of the same pattern was simplified before, by inserting symbols into that. */
static qdot_expr
simplify_by_pattern(qdot_scene *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = s->derived;
    qdot_expr atoms = QDOT_NIL, pattern = make_pattern(s, e, &atoms);
    qdot_pattern new;

    if (pattern == QDOT_NIL)
        return qdot_mech_tidy(s, e);
    for (size_t i = 0; i < d->patterns.n; i++) {
        qdot_expr from[PATTERN_ATOMS], to[PATTERN_ATOMS];
        uint32_t n = qdot_expr_count(pool, atoms);

        if (d->patterns.at[i].pattern != pattern ||
            qdot_expr_count(pool, d->patterns.at[i].atoms) != n)
            continue;
        for (uint32_t k = 0; k < n; k++) {
            from[k] = qdot_expr_arg(pool, d->patterns.at[i].atoms, k);
            to[k] = qdot_expr_arg(pool, atoms, k);
        }
        return qdot_subs(pool, d->patterns.at[i].simple, n, from, to);
    }
    new = (qdot_pattern){pattern, atoms, qdot_mech_tidy(s, e)};
    if (new.simple != QDOT_NIL && d->patterns.n < PATTERNS &&
        qdot_vec_push(&d->patterns, new) != QDOT_OK)
        return qdot_pool_fail(pool);
    return new.simple;
}

qdot_expr
qdot_mech_alike(qdot_scene *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_expr seen;
    units u;

    if (e == QDOT_NIL || qdot_expr_kind(pool, e) < QDOT_SUM ||
        qdot_expr_kind(pool, e) > QDOT_PROD || qdot_simple_is_done(pool, e))
        return qdot_mech_tidy(s, e);
    if (s->relations.n == 0 && s->conditions.n == 0 &&
        (seen = qdot_simple_seen(pool, e)) != QDOT_NIL)
        return seen;
    e = simplify_by_pattern(s, replace_parameter_sums(s, e, &u));
    return u.n > 0 ? qdot_subs(pool, e, u.n, u.symbol, u.sum) : e;
}
