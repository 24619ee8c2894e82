/* parse-stack.c -- the operators and open brackets that wait while an expression becomes postfix code. */
#include "lang/language/parse-stack.h"

qdot_status
qdot_parser_append(qdot_parser *p, qdot_postfix_kind op, const qdot_token *token, uint32_t n, uint32_t to,
                   unsigned primes)
{
    qdot_postfix code = {.op = (uint8_t)op, .primes = (uint8_t)primes, .n = n, .to = to, .token = token};

    return qdot_vec_push(&p->program->list, code);
}

qdot_waiting *
qdot_parser_top(qdot_parser *p)
{
    return p->stack.n > 0 ? &p->stack.at[p->stack.n - 1] : NULL;
}

qdot_status
qdot_parser_push(qdot_parser *p, qdot_waiting_kind kind, const qdot_token *token)
{
    qdot_waiting w = {.kind = (uint8_t)kind, .token = token};

    if (kind >= QDOT_IN_GROUP) {
        p->depth++;
        p->operand = true;
    }
    return qdot_vec_push(&p->stack, w);
}

/* Append the instruction of the operator on top of the parser's stack, whose last operand is complete. */
static qdot_status
emit_top_operator(qdot_parser *p)
{
    qdot_waiting w = p->stack.at[--p->stack.n];

    switch ((qdot_waiting_kind)w.kind) {
    case QDOT_OP_OR: return qdot_parser_append(p, QDOT_POSTFIX_OR, w.token, w.count + 1, 0, 0);
    case QDOT_OP_AND: return qdot_parser_append(p, QDOT_POSTFIX_AND, w.token, w.count + 1, 0, 0);
    case QDOT_OP_NOT: return qdot_parser_append(p, QDOT_POSTFIX_NOT, w.token, 1, 0, 0);
    case QDOT_OP_RELATION:
        QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_RELATION, w.token, 2, 0, 0));
        return w.count > 1 ? qdot_parser_append(p, QDOT_POSTFIX_AND, w.token, w.count, 0, 0) : QDOT_OK;
    case QDOT_OP_SUM:
        QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_TERM, w.token, 1, 0, 0));
        return qdot_parser_append(p, QDOT_POSTFIX_SUM, w.token, w.count + 1, 0, 0);
    case QDOT_OP_PRODUCT:
        QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_TERM, w.token, 1, 0, 0));
        return qdot_parser_append(p, QDOT_POSTFIX_PRODUCT, w.token, w.count + 1, 0, 0);
    case QDOT_OP_NEGATE: return qdot_parser_append(p, QDOT_POSTFIX_NEGATE, w.token, 1, 0, 0);
    case QDOT_OP_POWER: return qdot_parser_append(p, QDOT_POSTFIX_POWER, w.token, 2, 0, 0);
    case QDOT_OP_ROOT: return qdot_parser_append(p, QDOT_POSTFIX_CALL, w.token, 1, 0, 0);
    default: return qdot_parser_append(p, QDOT_POSTFIX_MEMBER, w.token, 1, 0, 0);
    }
}

qdot_status
qdot_parser_emit_tighter(qdot_parser *p, qdot_waiting_kind kind)
{
    while (qdot_parser_top(p) != NULL && qdot_parser_top(p)->kind < QDOT_IN_GROUP && qdot_parser_top(p)->kind > kind)
        QDOT_TRY(emit_top_operator(p));
    return QDOT_OK;
}

qdot_status
qdot_parser_emit_to_bracket(qdot_parser *p)
{
    while (qdot_parser_top(p) != NULL && qdot_parser_top(p)->kind < QDOT_IN_GROUP)
        QDOT_TRY(emit_top_operator(p));
    return QDOT_OK;
}
