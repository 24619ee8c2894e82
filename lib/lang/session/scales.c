/* scales.c -- the session's scales of coordinates, in the order in which they were given. */
#include "lang/session/scales.h"

#include <math.h>

#include "base/memory.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/values.h"
#include "mech/scene/things.h"

qdot_status
qdot_scales_set(qdot_session *session, qdot_expr symbol, qdot_expr value)
{
    for (size_t i = 0; i < session->values->scale_symbols.n; i++)
        if (session->values->scale_symbols.at[i] == symbol) {
            session->values->scale_values.at[i] = value;
            return QDOT_OK;
        }
    QDOT_TRY(qdot_vec_push(&session->values->scale_symbols, symbol));
    if (qdot_vec_push(&session->values->scale_values, value) == QDOT_OK)
        return QDOT_OK;
    session->values->scale_symbols.n--;
    return QDOT_ENOMEM;
}

void
qdot_scales_forget(qdot_session *session, qdot_expr q)
{
    qdot_values *v = session->values;
    size_t kept = 0;

    for (size_t i = 0; i < v->scale_symbols.n; i++) {
        if (v->scale_symbols.at[i] == q || qdot_expr_symbol(session->pool, v->scale_symbols.at[i])->base == q)
            continue;
        v->scale_symbols.at[kept] = v->scale_symbols.at[i];
        v->scale_values.at[kept++] = v->scale_values.at[i];
    }
    v->scale_symbols.n = v->scale_values.n = kept;
}

/* Evaluate the scale of a symbol; QDOT_EINVAL if it is not positive. */
static qdot_status
evaluate_scale(qdot_session *session, qdot_expr symbol, qdot_expr value, double *number)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, symbol);

    QDOT_TRY(
        qdot_session_number(session, qdot_session_bind(session, value), number, NULL));
    if (*number > 0 && isfinite(*number))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "a scale is positive: that of %.200s%s would be %.10g",
                    s->name, s->order > 0 ? "'" : "", *number);
    return qdot_hint("scale %.200s%s = 1e-10", s->name, s->order > 0 ? "'" : "");
}

qdot_status
qdot_scales_check(qdot_session *session, qdot_expr symbol, qdot_expr value)
{
    double number;

    if (qdot_expr_kind(session->pool, qdot_session_bind(session, value)) != QDOT_NUM)
        return qdot_pool_check(session->pool); /* parameters in the scale have no values yet, so its sign is checked later */
    return evaluate_scale(session, symbol, value, &number);
}

/* Find the scale that was given for a symbol; 0 if there is none. */
static qdot_status
find_given_scale(qdot_session *session, qdot_expr symbol, double *scale)
{
    *scale = 0;
    for (size_t i = 0; i < session->values->scale_symbols.n; i++)
        if (session->values->scale_symbols.at[i] == symbol)
            return evaluate_scale(session, symbol, session->values->scale_values.at[i], scale);
    return QDOT_OK;
}

qdot_status
qdot_scales_of_run(qdot_session *session, double **scales)
{
    const size_t n = session->scene->coordinates.n;
    double *of, unit;
    qdot_status status;

    *scales = NULL;
    if (session->values->scale_symbols.n == 0)
        return QDOT_OK;
    QDOT_TRY(find_given_scale(session, QDOT_T, &unit));
    of = qdot_calloc(2 * n + 1, sizeof *of);
    status = of ? QDOT_OK : QDOT_ENOMEM;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_expr q = session->scene->coordinates.at[i];

        status = find_given_scale(session, q, of + i);
        if (status == QDOT_OK)
            status = find_given_scale(session, qdot_symbol_jet(session->pool, q, 1), of + n + i);
        if (status == QDOT_OK && of[n + i] == 0 && unit > 0)
            of[n + i] = of[i] / unit;
    }
    if (status != QDOT_OK) {
        qdot_free(of);
        return status;
    }
    *scales = of;
    return QDOT_OK;
}
