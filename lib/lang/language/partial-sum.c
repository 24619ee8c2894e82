/* partial-sum.c -- stores the values of sums with a growing upper limit during a loop, by their place in the text. */
#include "lang/language/partial-sum.h"

#include <string.h>

#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"

const qdot_partial_sum *
qdot_partial_sum_find(const qdot_session *session, const qdot_token *place, int64_t first,
                      int64_t last)
{
    for (size_t i = 0; i < session->evaluation->partial_sums.n; i++) {
        const qdot_partial_sum *sum = session->evaluation->partial_sums.at + i;

        if (sum->place == place && sum->first == first && sum->last <= last)
            return sum;
    }
    return NULL;
}

qdot_status
qdot_partial_sum_keep(qdot_session *session, qdot_partial_sum sum)
{
    if (session->evaluation->loops == 0)
        return QDOT_OK;
    for (size_t i = 0; i < session->evaluation->partial_sums.n; i++) {
        qdot_partial_sum *other = session->evaluation->partial_sums.at + i;

        if (other->place == sum.place && other->first == sum.first) {
            *other = sum;
            return QDOT_OK;
        }
    }
    return qdot_vec_push(&session->evaluation->partial_sums, sum);
}

/* Whether the value is a parameter or coordinate with that name, or a member of the family with that name. */
static bool
has_name(const qdot_session *session, const char *name, qdot_expr value)
{
    const qdot_symbol *symbol =
        value != QDOT_NIL && qdot_expr_kind(session->pool, value) == QDOT_SYM
            ? qdot_expr_symbol(session->pool, value)
            : NULL;
    const size_t n = strlen(name);

    return symbol && (symbol->class == QDOT_PARAM || symbol->class == QDOT_COORD)
           && strncmp(symbol->name, name, n) == 0 && strchr("['", symbol->name[n]);
}

/* Whether the value is the same whenever the instruction is carried out with the same operands in
 * this loop. */
static bool
is_same_in_next_pass(const qdot_session *session, const qdot_postfix *code, qdot_expr value)
{
    const char *name = code->token->text;
    const qdot_name *known;
    qdot_fun_id id;

    switch ((qdot_postfix_kind)code->op) {
    case QDOT_POSTFIX_NAME:
        known = qdot_names_find(session->names, name);
        return known && (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD);
    case QDOT_POSTFIX_INDEX_NAME:
        return !qdot_names_find(session->names, name)
               && qdot_names_is_family(session->names, name) && has_name(session, name, value);
    case QDOT_POSTFIX_CALL:
        return !qdot_names_find(session->names, name) && code->to == 0 && code->primes == 0
               && (qdot_fun_find(name, &id) || strcmp(name, "sqrt") == 0);
    case QDOT_POSTFIX_LABEL:
    case QDOT_POSTFIX_HISTORY:
    case QDOT_POSTFIX_INDEX:
    case QDOT_POSTFIX_RANGE:
    case QDOT_POSTFIX_MEMBER: return false;
    default: return true; /* the value depends on the operands only */
    }
}

void
qdot_partial_sum_note(qdot_machine *m, const qdot_postfix *code)
{
    const qdot_name *known;
    size_t i = m->frames.n;

    if (is_same_in_next_pass(m->session, code, qdot_machine_top(m, 1)->value))
        return;
    known = code->op == QDOT_POSTFIX_NAME ? qdot_names_find(m->session->names, code->token->text)
                                       : NULL;
    /* mark all sums inside the sum to which this index belongs */
    for (; i > 0 && !(known && known->kind == QDOT_NAME_INDEX
                      && strcmp(m->frames.at[i - 1].index, known->name) == 0);
         i--)
        m->frames.at[i - 1].varies = true;
}
