/* forms-replace.c -- replacements in differential forms, pullback. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/geometry/forms.h"
#include "normal/simplify/simplify.h"

typedef struct {
    qdot_vec(qdot_expr) from, to;
} replacements;

static void
push_replaced_symbol(qdot_pool *pool, replacements *r, qdot_expr from, qdot_expr to)
{
    if (qdot_vec_push(&r->from, from) != QDOT_OK || qdot_vec_push(&r->to, to) != QDOT_OK)
        qdot_pool_fail(pool);
}

/* If one of its differentials is replaced, add the replacement of wedge(dq, ...): the product of what replaces them. */
static void
add_replaced_product(qdot_scene *s, qdot_expr symbol, replacements *r)
{
    const qdot_expr list = qdot_expr_symbol(s->pool, symbol)->base;
    const size_t given = r->from.n;
    qdot_expr product = QDOT_ONE;
    bool changed = false;

    for (uint32_t i = 0; i < qdot_expr_count(s->pool, list); i++) {
        const qdot_expr dq = qdot_symbol_of(s->pool, QDOT_DIFFERENTIAL, qdot_expr_arg(s->pool, list, i));
        const size_t at = qdot_expr_place(given, r->from.at, dq);

        changed |= at < given;
        product = qdot_forms_wedge(s, product, at < given ? r->to.at[at] : dq);
    }
    if (changed)
        push_replaced_symbol(s->pool, r, symbol, product);
}

/* e with the replacements, to which those of its products of differentials are added; r is freed. */
static qdot_expr
replace_in_form(qdot_scene *s, qdot_expr e, replacements *r)
{
    const qdot_expr atoms = qdot_forms_has_product(s, e) ? qdot_expr_atoms(s->pool, e, false) : QDOT_NIL;

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(s->pool, atoms) && !qdot_pool_failed(s->pool); i++) {
        const qdot_expr x = qdot_expr_arg(s->pool, atoms, i);

        if (qdot_expr_is_class(s->pool, x, QDOT_DIFFERENTIAL)
            && qdot_expr_kind(s->pool, qdot_expr_symbol(s->pool, x)->base) == QDOT_LIST
            && qdot_expr_place(r->from.n, r->from.at, x) == r->from.n)
            add_replaced_product(s, x, r);
    }
    e = qdot_pool_failed(s->pool) ? QDOT_NIL : qdot_subs(s->pool, e, r->from.n, r->from.at, r->to.at);
    qdot_free(r->from.at);
    qdot_free(r->to.at);
    return e;
}

qdot_expr
qdot_forms_subs(qdot_scene *s, qdot_expr e, size_t n, const qdot_expr *from, const qdot_expr *to)
{
    replacements r = {0};

    for (size_t i = 0; i < n; i++)
        push_replaced_symbol(s->pool, &r, from[i], to[i]);
    return replace_in_form(s, e, &r);
}

qdot_expr
qdot_forms_pullback(qdot_scene *s, qdot_expr w, size_t n, const qdot_expr *q, const qdot_expr *to)
{
    const qdot_facts facts = qdot_scene_facts(s);
    replacements r = {0};

    for (size_t i = 0; i < n && !qdot_pool_failed(s->pool); i++) {
        push_replaced_symbol(s->pool, &r, q[i], to[i]);
        push_replaced_symbol(s->pool, &r, qdot_symbol_of(s->pool, QDOT_DIFFERENTIAL, q[i]), qdot_forms_exterior_derivative(s, to[i]));
    }
    w = replace_in_form(s, w, &r);
    if (w != QDOT_NIL && qdot_forms_has_product(s, w))
        return qdot_forms_wedge(s, QDOT_ONE, w);
    return w == QDOT_NIL ? w : qdot_simplify(s->pool, w, &facts);
}
