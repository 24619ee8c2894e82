/* quotient.c -- a quotient of polynomials in Laplace's s. */
#include "lang/functions/quotient.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/evaluation.h"
#include "lang/session/history.h"
#include "lang/session/names.h"
#include "mech/scene/things.h"
#include "normal/field/normal-form.h"
#include "normal/simplify/simplify.h"

enum { HIGHEST_DEGREE = 60 };

qdot_expr
qdot_quotient_laplace(qdot_session *session)
{
    const qdot_name *known = qdot_names_find(session->names, "s");

    return known != NULL && known->kind == QDOT_NAME_PARAM ? known->value : qdot_symbol_get(session->pool, QDOT_FORMAL, "s");
}

bool
qdot_quotient_is_laplace(const qdot_session *session, const char *name)
{
    return strcmp(name, "s") == 0 && !session->evaluation->declares && session->history->linear.B != QDOT_NIL;
}

void
qdot_quotient_split(qdot_pool *pool, qdot_expr e, qdot_expr *top, qdot_expr *bottom)
{
    *top = e;
    *bottom = QDOT_ONE;
    if (e == QDOT_NIL || qdot_expr_kind(pool, e) != QDOT_PROD)
        return;
    *top = qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, i), power = qdot_expr_arg(pool, e, i + 1);
        int64_t k;

        if (qdot_expr_to_int(pool, power, &k) && k < 0)
            *bottom = qdot_mul(pool, *bottom, qdot_pow_int(pool, base, -k));
        else
            *top = qdot_mul(pool, *top, qdot_pow(pool, base, power));
    }
}

static qdot_status
refuse_quotient(void)
{
    (void)qdot_fail(QDOT_ETYPE, "this is no quotient of polynomials in s");
    return qdot_hint("transfer(F, x) or 1/(s^2 + 2*s + 5)");
}

/* The coefficients of a polynomial by its derivatives at 0. */
static qdot_status
read_coefficients(qdot_session *session, qdot_expr f, qdot_expr s, qdot_coefficients *out)
{
    const qdot_expr zero = QDOT_ZERO;
    const qdot_facts facts = qdot_scene_facts(session->scene);
    qdot_expr factorial = QDOT_ONE;

    /* abs(s) and floor(s) have derivatives that end, but no coefficients */
    (void)qdot_coefficient(session->pool, f, s, 0);
    if (qdot_pool_check(session->pool) != QDOT_OK)
        return refuse_quotient();
    for (int64_t k = 0; f != QDOT_ZERO; k++) {
        qdot_expr value;

        if (k > HIGHEST_DEGREE)
            return refuse_quotient();
        factorial = k == 0 ? QDOT_ONE : qdot_mul(session->pool, factorial, qdot_expr_int(session->pool, k));
        value = qdot_simplify(session->pool, qdot_div(session->pool, qdot_subs(session->pool, f, 1, &s, &zero), factorial), &facts);
        if (qdot_pool_check(session->pool) != QDOT_OK)
            return refuse_quotient();
        QDOT_TRY(qdot_vec_push(out, value));
        f = qdot_expand(session->pool, qdot_diff(session->pool, f, s));
        QDOT_TRY(qdot_pool_check(session->pool));
    }
    return out->n > 0 ? QDOT_OK : refuse_quotient();
}

qdot_status
qdot_quotient_of(qdot_session *session, qdot_expr e, qdot_expr s, qdot_quotient *out)
{
    const qdot_facts facts = qdot_scene_facts(session->scene);
    qdot_expr top, bottom;

    qdot_quotient_split(session->pool, qdot_normal(session->pool, e, &facts), &top, &bottom);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(read_coefficients(session, qdot_expand(session->pool, top), s, &out->top));
    return read_coefficients(session, qdot_expand(session->pool, bottom), s, &out->bottom);
}

void
qdot_quotient_clear(qdot_quotient *q)
{
    qdot_free(q->top.at);
    qdot_free(q->bottom.at);
}
