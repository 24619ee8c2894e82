/* separation.c -- hamilton_jacobi[q] and complete_integral as values; names of separation constants. */
#include "lang/functions/separation.h"

#include "expr/node.h"
#include "expr/print-name.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/session/names.h"

/* A name of the session that is no parameter is not free; a parameter is that constant. */
static bool
is_free_for_constant(void *user, const char *name)
{
    const qdot_session *session = user;
    const qdot_name *declared = qdot_names_find(session->names, name);

    return declared == NULL || declared->kind == QDOT_NAME_PARAM;
}

/* So with functions: one that was declared of the coordinates and t, in this order, is that solution. */
static bool
is_free_for_function(void *user, const char *name)
{
    const qdot_session *session = user;
    const qdot_name *declared = qdot_names_find(session->names, name);
    qdot_expr formals;

    if (declared == NULL || declared->kind != QDOT_NAME_UFUN)
        return declared == NULL;
    formals = qdot_ufun_get(session->pool, declared->ufun)->formals;
    if (qdot_expr_count(session->pool, formals) != session->scene->coordinates.n + 1)
        return false;
    for (uint32_t i = 0; i < session->scene->coordinates.n; i++)
        if (qdot_expr_arg(session->pool, formals, i) != session->scene->coordinates.at[i])
            return false;
    return qdot_expr_arg(session->pool, formals, (uint32_t)session->scene->coordinates.n) == QDOT_T;
}

qdot_status
qdot_session_separate(qdot_session *session, qdot_expr energy, qdot_separation *out)
{
    return qdot_separation_find(session->scene, energy, &(qdot_constant_names){is_free_for_constant, session}, out);
}

qdot_status
qdot_session_jacobi_equation(qdot_session *session, qdot_expr H, qdot_expr *equation)
{
    return qdot_separation_equation(session->scene, H, &(qdot_constant_names){is_free_for_function, session}, equation);
}

/* Say that the equation does not separate, as far as that is known, or was not solved. */
static qdot_status
refuse_unseparated(const qdot_separation *x)
{
    if (x->verdict == QDOT_SEPARATES)
        return qdot_fail(QDOT_EFAILED, "a separated equation was not solved for its momentum");
    return qdot_fail(QDOT_EFAILED, "%s", x->verdict == QDOT_SEPARATES_NOT ? "the equation of Hamilton and Jacobi does not separate in these coordinates"
                                                                          : "no separation of the equation of Hamilton and Jacobi was found");
}

static qdot_status
separated_equation_of(qdot_session *session, const qdot_separation *x, qdot_expr q, qdot_expr *value)
{
    const char *name = qdot_expr_symbol(session->pool, q)->name;

    if (x->verdict != QDOT_SEPARATES)
        return refuse_unseparated(x);
    for (size_t i = 0; i < x->n; i++)
        if (x->of[i].q == q && !x->of[i].cyclic)
            return qdot_value_kind_give(session->pool, qdot_separated_equation(session->pool, &x->of[i]), value);
    return qdot_fail(QDOT_EINVAL, "%.100s is cyclic: its momentum p[%.100s] is a constant", name, name);
}

qdot_status
qdot_session_get_jacobi(qdot_session *session, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    qdot_separation x = {0};
    qdot_status status;

    if (n == 1 && !qdot_expr_is_coordinate(session->pool, index[0]))
        return qdot_fail(QDOT_ETYPE, "hamilton_jacobi[ ] takes a coordinate");
    status = qdot_session_separate(session, QDOT_NIL, &x);
    if (status == QDOT_OK)
        status = n == 0 ? qdot_session_jacobi_equation(session, x.H, value) : separated_equation_of(session, &x, index[0], value);
    qdot_separation_clear(&x);
    return status;
}

qdot_status
qdot_session_get_integral(qdot_session *session, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    qdot_separation x = {0};
    qdot_status status = qdot_session_separate(session, QDOT_NIL, &x);
    qdot_expr S;

    (void)n, (void)index;
    S = status == QDOT_OK ? qdot_separation_integral(session->scene, &x) : QDOT_NIL;
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = S == QDOT_NIL ? refuse_unseparated(&x) : qdot_value_kind_give(session->pool, S, value);
    qdot_separation_clear(&x);
    return status;
}
