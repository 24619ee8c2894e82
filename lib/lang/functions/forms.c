/* forms.c -- differential forms: d, wedge, hodge, pullback. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/algebra.h"
#include "lang/functions/builtin.h"
#include "mech/geometry/forms.h"

static qdot_expr
derivative_of_form(qdot_pool *pool, qdot_expr w, void *user)
{
    (void)pool;
    return qdot_forms_exterior_derivative(user, w);
}

qdot_status
qdot_call_exterior_derivative(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_value_kind_give(s->pool, qdot_value_map(s->pool, args[0], derivative_of_form, s->scene), value);
}

qdot_status
qdot_call_d(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return qdot_call_exterior_derivative(s, n, args, value);
}

qdot_status
qdot_call_wedge(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_expr product = args[0];

    for (uint32_t i = 1; i < n; i++) {
        product = qdot_forms_wedge(s->scene, product, args[i]);
        QDOT_TRY(qdot_value_kind_check(s->pool, product));
    }
    return qdot_value_kind_give(s->pool, product, value);
}

qdot_status
qdot_call_hodge(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_value_kind_give(s->pool, qdot_forms_hodge(s->scene, args[0], args[1]), value);
}

qdot_status
qdot_call_pullback(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_replacements r = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 1; i < n && status == QDOT_OK; i++)
        status = qdot_algebra_gather(s, "pullback", args[i], &r);
    for (size_t i = 0; i < r.from.n && status == QDOT_OK; i++) {
        const qdot_symbol *q = qdot_expr_symbol(s->pool, r.from.at[i]);

        if (r.from.at[i] != QDOT_T && (q == NULL || q->class != QDOT_COORD || q->order > 0)) {
            status = qdot_fail(QDOT_ETYPE, "pullback replaces coordinates and their differentials");
            qdot_hint("as in pullback(r*dphi, phi = t^2); subs replaces anything");
        }
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(s->pool, qdot_forms_pullback(s->scene, args[0], r.from.n, r.from.at, r.to.at), value);
    qdot_algebra_drop(&r);
    return status;
}
