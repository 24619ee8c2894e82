/* evaluator.h -- for the files of the evaluator: from tokens to postfix code to values.
 *
 * parse.c, evaluate.c, resolve.c, call.c and read.c call each other, because an index or the body
 * of a function is read and evaluated while an expression is. Statements use read.h.
 */
#ifndef QDOT_LANG_EVALUATOR_H
#define QDOT_LANG_EVALUATOR_H

#include "base/text.h"
#include "lang/language/cursor.h"
#include "lang/session/names.h"
#include "lang/source/token.h"

/* --- postfix code: parsing and evaluating ------------------------------------------- */

typedef enum {
    QDOT_POSTFIX_NUMBER,     /* push the number written at `token` */
    QDOT_POSTFIX_NAME,       /* push the value of the name `token`, with `primes` */
    QDOT_POSTFIX_LABEL,      /* pop n indices; push the label as the symbol that stands for it */
    QDOT_POSTFIX_HISTORY,    /* push answer %n; n = 0: the latest */
    QDOT_POSTFIX_INDEX_NAME, /* pop n indices; push token[...] with `primes` */
    QDOT_POSTFIX_INDEX,      /* pop n indices and a value; push the value's entry */
    QDOT_POSTFIX_CALL,       /* pop `to` indices and n arguments; push token(...) */
    QDOT_POSTFIX_RANGE, /* pop n values, of which the last two are the limits of a range of token(...) */
    QDOT_POSTFIX_TERM,    /* the top value is the right operand of `token` in a sum or product */
    QDOT_POSTFIX_SUM,     /* pop n terms; push their sum */
    QDOT_POSTFIX_PRODUCT, /* pop n factors; push their product */
    QDOT_POSTFIX_NEGATE,
    QDOT_POSTFIX_POWER,
    QDOT_POSTFIX_RELATION, /* pop a, b; push the relation a op b */
    QDOT_POSTFIX_CHAIN,    /* for a < b < c: pop a, b; push a op b, then b again */
    QDOT_POSTFIX_AND,      /* pop n operands; push their conjunction */
    QDOT_POSTFIX_OR,
    QDOT_POSTFIX_NOT,
    QDOT_POSTFIX_UNIT,      /* multiply the top value by the unit in the brackets at `token`; n = 0: push the unit */
    QDOT_POSTFIX_IN,        /* divide the top value by the unit in the brackets at `token` */
    QDOT_POSTFIX_VECTOR,    /* pop n components; push a vector */
    QDOT_POSTFIX_LIST,      /* pop n members; push a list of them */
    QDOT_POSTFIX_MATRIX,    /* pop n entries; push a matrix with `to` columns */
    QDOT_POSTFIX_MEMBER,    /* the top value is taken along the run named `token`, as in a.x */
    QDOT_POSTFIX_JUMP,      /* continue at instruction `to` */
    QDOT_POSTFIX_SUM_BEGIN, /* pop limits a, b; begin a sum whose index is token n and whose body begins at `to` */
    QDOT_POSTFIX_SUM_NEXT,  /* pop the body's value; repeat the body or continue */
    QDOT_POSTFIX_IF_TEST,   /* the condition stays; if false push nil and continue at `to` */
    QDOT_POSTFIX_IF_ELSE, /* if the condition is true: pop both, push the value, continue at `to` */
    QDOT_POSTFIX_IF_END,    /* pop condition, a, b; push if(...) */
    QDOT_POSTFIX_PASS_BEGIN, /* until PASS_END, session->passed records what must be defined */
    QDOT_POSTFIX_PASS_END    /* the end of what began with PASS_BEGIN */
} qdot_postfix_kind;

typedef struct {
    uint8_t op; /* the instruction, a qdot_postfix_kind */
    uint8_t primes;
    uint32_t n, to;
    uint32_t last;           /* for CALL, RANGE: start of the code of the last of several arguments */
    const qdot_token *token; /* token at which an error points */
} qdot_postfix;

typedef struct {
    qdot_vec(qdot_postfix) list;
} qdot_postfix_list;

/* How far the expression to be parsed extends. */
typedef enum {
    QDOT_PARSE_VALUE, /* a value, also with relations, `and`, `or` */
    QDOT_PARSE_SIDE   /* a value up to a relation, `and`, `or` */
} qdot_parse_extent;

/* Parse one expression at the cursor and step over it; append the code to *program. */
QDOT_MUST_CHECK qdot_status qdot_parse(qdot_cursor *c, qdot_parse_extent extent,
                                       qdot_postfix_list *program);

/* Run the program; *run (may be NULL: not allowed) the run that the whole expression refers to,
 * or NULL. *over (may be NULL): the coordinates that index its entries, or nil. */
QDOT_MUST_CHECK qdot_status qdot_evaluate(qdot_cursor *c, const qdot_postfix_list *program,
                                          qdot_expr *value, qdot_expr *over,
                                          const char **run);

/* Step over `NAME[k].`, a run of a family before an operand; *run: a token that spells the
 * run, "NAME[2]"; NULL: it is none, the cursor stays. */
QDOT_MUST_CHECK qdot_status qdot_cursor_accept_run(qdot_cursor *c,
                                                   const qdot_token **run);

/* As qdot_evaluate, for the instructions [first, end) only, those of one operand. */
QDOT_MUST_CHECK qdot_status qdot_evaluate_part(qdot_cursor *c, const qdot_postfix_list *program, uint32_t first,
                                               uint32_t end, qdot_expr *value);

/* --- meaning of names and calls ----------------------------------------------------- */

/* Evaluate a name followed by `primes` primes. *over: the coordinates by which its entries are indexed, or nil. */
QDOT_MUST_CHECK qdot_status qdot_resolve_name(qdot_cursor *c, const qdot_token *token,
                                              unsigned primes, qdot_expr *value,
                                              qdot_expr *over);
/* Evaluate name[index ...] followed by `primes` primes. */
QDOT_MUST_CHECK qdot_status qdot_resolve_index(qdot_cursor *c, const qdot_token *token,
                                               unsigned primes, uint32_t n,
                                               const qdot_expr *index, qdot_expr *value);
/* Fail with QDOT_ETYPE: `name` cannot have a prime. */
qdot_status qdot_resolve_no_prime(const char *name, const char *why);
/* Evaluate x(args) or x'(args) of an undefined function; primes are allowed only with one argument. */
QDOT_MUST_CHECK qdot_status qdot_resolve_undefined(qdot_session *session,
                                                   const qdot_name *entry, unsigned primes,
                                                   uint32_t n, const qdot_expr *args,
                                                   qdot_expr *value);
/* A call name(args), name[index](args) or name'(args). */
typedef struct {
    const qdot_token *token;
    unsigned primes;
    uint32_t indices, n;       /* number of indices and of arguments */
    const qdot_expr *values;   /* [indices + n] values of the indices and arguments */
    const char *const *labels; /* [indices + n] labels of particles or bodies whose positions they are, else NULL */
    const char *run;           /* name of the run along which the arguments are read; NULL: none */
} qdot_call;
/* Evaluate a function call. *over: the coordinates that index the value's entries, or nil. */
QDOT_MUST_CHECK qdot_status qdot_resolve_call(qdot_cursor *c, const qdot_call *call,
                                              qdot_expr *value, qdot_expr *over);
/* Evaluate solve(A = B, x, a..b) and similar functions of a range; its ends are the last arguments. */
QDOT_MUST_CHECK qdot_status qdot_resolve_over_range(qdot_session *session, const char *name,
                                                    uint32_t n, const qdot_expr *args,
                                                    qdot_expr *value);
/* *label: of the particle or body that name or name[index ...] is, itself or as the argument
 * of a function; NULL: it is none. Borrowed from the scene. */
QDOT_MUST_CHECK qdot_status qdot_resolve_label(qdot_session *session, const char *name,
                                               uint32_t n, const qdot_expr *index,
                                               const char **label);
/* Whether a name is declared as a function, either with a definition or as an undefined function. */
bool qdot_resolve_is_function(const qdot_session *session, const char *name);

#endif
