/* fields.c -- functions of a density in fields: its equations, its energy and momentum. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "mech/fields/euler-lagrange.h"

typedef qdot_vec(qdot_expr) expressions;

/* Append e, or the members of the list or vector e. */
static qdot_status
push_members(const qdot_pool *pool, qdot_expr e, expressions *list)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    if (kind != QDOT_LIST && kind != QDOT_VEC)
        return qdot_vec_push(list, e);
    for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++)
        QDOT_TRY(qdot_vec_push(list, qdot_expr_arg(pool, e, i)));
    return QDOT_OK;
}

/* The fields of args[1] and the variables after them; where none are said, the arguments of the first field. */
static qdot_status
read_fields(qdot_session *s, uint32_t n, const qdot_expr *args, expressions *fields, expressions *variables)
{
    qdot_pool *pool = s->pool;

    QDOT_TRY(push_members(pool, args[1], fields));
    if (fields->n == 0)
        return qdot_fail(QDOT_EINVAL, "the list of fields is empty");
    for (uint32_t i = 2; i < n; i++)
        QDOT_TRY(push_members(pool, args[i], variables));
    if (variables->n > 0)
        return QDOT_OK;
    if (qdot_expr_kind(pool, fields->at[0]) != QDOT_UFUN)
        return qdot_vec_push(variables, QDOT_T);
    for (uint32_t i = 0; i < qdot_expr_count(pool, fields->at[0]) / 2; i++)
        QDOT_TRY(qdot_vec_push(variables, qdot_expr_arg(pool, fields->at[0], i)));
    return QDOT_OK;
}

qdot_status
qdot_call_euler_lagrange(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    expressions fields = {0}, variables = {0};
    qdot_status status = read_fields(s, n, args, &fields, &variables);
    bool single = qdot_expr_kind(s->pool, args[1]) != QDOT_LIST && qdot_expr_kind(s->pool, args[1]) != QDOT_VEC;

    for (size_t i = 0; i < fields.n && status == QDOT_OK; i++) {
        fields.at[i] = qdot_fields_euler_lagrange(s->scene, args[0], fields.at[i], (uint32_t)variables.n, variables.at);
        status = qdot_value_kind_check(s->pool, fields.at[i]);
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            s->pool, single ? fields.at[0] : qdot_list(s->pool, (uint32_t)fields.n, fields.at), value);
    qdot_free(fields.at);
    qdot_free(variables.at);
    return status;
}

qdot_status
qdot_call_energy_momentum(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    expressions fields = {0}, variables = {0};
    qdot_status status = read_fields(s, n, args, &fields, &variables);

    if (status == QDOT_OK)
        status = qdot_value_kind_give(s->pool,
                                      qdot_fields_energy_momentum(s->scene, args[0], (uint32_t)fields.n, fields.at,
                                                                  (uint32_t)variables.n, variables.at),
                                      value);
    qdot_free(fields.at);
    qdot_free(variables.at);
    return status;
}
