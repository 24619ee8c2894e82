/* parse-stack.h -- the operators and open brackets that wait while an expression becomes postfix code. */
#ifndef QDOT_LANG_PARSE_STACK_H
#define QDOT_LANG_PARSE_STACK_H

#include "lang/language/evaluator.h"

/* Operators (by precedence) and open brackets that wait on the parser's stack. */
typedef enum {
    QDOT_OP_OR,
    QDOT_OP_AND,
    QDOT_OP_NOT,
    QDOT_OP_RELATION,
    QDOT_OP_SUM,
    QDOT_OP_PRODUCT,
    QDOT_OP_NEGATE,
    QDOT_OP_POWER,
    QDOT_OP_ROOT, /* √ before its operand */
    QDOT_OP_MEMBER, /* the run `a.` before its operand */
    QDOT_IN_GROUP,  /* brackets ( ) of an operand: a vector if they contain a comma */
    QDOT_IN_LIST,   /* brackets [ ]: a list, or with `;` a matrix */
    QDOT_IN_INDEX_NAME,
    QDOT_IN_INDEX,
    QDOT_IN_LABEL,
    QDOT_IN_CALL,
    QDOT_IN_SUM,
    QDOT_IN_IF
} qdot_waiting_kind;

typedef struct {
    uint8_t kind; /* the operator or bracket, a qdot_waiting_kind */
    uint8_t primes;
    bool ranged; /* for QDOT_IN_CALL: the last argument is a range a..b */
    bool passed; /* for QDOT_IN_CALL: between the instructions PASS_BEGIN and PASS_END */
    const qdot_token *token; /* the operator's sign, or the opening bracket */
    const qdot_token *name;  /* for QDOT_IN_SUM: token of the sum's index */
    const qdot_token *power; /* for QDOT_IN_CALL: exponent of sin²(x), which means sin(x)^2; NULL: none */
    uint32_t count;          /* number of complete operands or arguments */
    uint32_t columns, indices, at;
    uint32_t last; /* of QDOT_IN_CALL: where the code of the present argument begins, from the second on */
} qdot_waiting;

typedef struct {
    qdot_cursor *c;
    qdot_postfix_list *program;
    qdot_parse_extent extent;
    qdot_vec(qdot_waiting) stack;
    size_t depth; /* number of open brackets */
    bool operand; /* whether an operand must come next */
    bool done;
} qdot_parser;

/* Append an instruction: its token, number of operands, place to go on at, primes. */
QDOT_MUST_CHECK qdot_status qdot_parser_append(qdot_parser *p, qdot_postfix_kind op, const qdot_token *token, uint32_t n, uint32_t to,
                                               unsigned primes);
/* The operator or bracket that waits last; NULL: none. */
qdot_waiting *qdot_parser_top(qdot_parser *p);
QDOT_MUST_CHECK qdot_status qdot_parser_push(qdot_parser *p, qdot_waiting_kind kind, const qdot_token *token);
/* Append the instructions of all operators on the stack that bind tighter than `kind`. */
QDOT_MUST_CHECK qdot_status qdot_parser_emit_tighter(qdot_parser *p, qdot_waiting_kind kind);
/* Append the instructions of all operators on the stack down to the last opening bracket. */
QDOT_MUST_CHECK qdot_status qdot_parser_emit_to_bracket(qdot_parser *p);

#endif
