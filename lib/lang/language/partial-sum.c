/* partial-sum.c -- sums kept by where they stand. */
#include "lang/language/partial-sum.h"

#include <string.h>

const qdot_partial_sum *
qdot_partial_sum_find(const qdot_session *session, const qdot_token *place, long first,
                      long last)
{
    for (size_t i = 0; i < session->partial_sums.n; i++) {
        const qdot_partial_sum *sum = session->partial_sums.at + i;

        if (sum->place == place && sum->first == first && sum->last <= last)
            return sum;
    }
    return NULL;
}

qdot_status
qdot_partial_sum_keep(qdot_session *session, qdot_partial_sum sum)
{
    if (session->loops == 0)
        return QDOT_OK;
    for (size_t i = 0; i < session->partial_sums.n; i++) {
        qdot_partial_sum *other = session->partial_sums.at + i;

        if (other->place == sum.place && other->first == sum.first) {
            *other = sum;
            return QDOT_OK;
        }
    }
    return qdot_vec_push(&session->partial_sums, sum);
}

/* A parameter or coordinate that is called so, or a member of the family. */
static bool
is_called(const qdot_session *session, const char *name, qdot_expr value)
{
    const qdot_symbol *symbol =
        value != QDOT_NIL && qdot_expr_kind(session->pool, value) == QDOT_SYM
            ? qdot_expr_symbol(session->pool, value)
            : NULL;
    const size_t n = strlen(name);

    return symbol && (symbol->class == QDOT_PARAM || symbol->class == QDOT_COORD)
           && strncmp(symbol->name, name, n) == 0 && strchr("['", symbol->name[n]);
}

bool
qdot_partial_sum_may_hold(const qdot_session *session, const qdot_code *code, qdot_expr value)
{
    const char *name = code->token->text;
    const qdot_name *known = qdot_names_find(session->names, name);
    qdot_fun_id id;

    if (code->op == QDOT_CODE_NAME)
        return known && (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD);
    if (code->op == QDOT_CODE_INDEX_NAME)
        return !known && qdot_names_is_family(session->names, name)
               && is_called(session, name, value);
    return code->op == QDOT_CODE_CALL && !known && code->to == 0 && code->primes == 0
           && (qdot_fun_find(name, &id) || strcmp(name, "sqrt") == 0);
}
