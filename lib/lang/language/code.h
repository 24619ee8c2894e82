/* code.h -- inside the reader: from tokens to postfix code to values.
 *
 * Not for users of the library: only the files of lang/ that lex, parse, evaluate see it.
 */
#ifndef QDOT_LANG_CODE_H
#define QDOT_LANG_CODE_H

#include "lang/language/read.h"

/* --- lexing ------------------------------------------------------------------------- */

#define QDOT_LEX_TOKENS 10000000u  /* tokens of one source */
#define QDOT_LEX_PRIMES 200u       /* primes behind one name */
#define QDOT_LEX_BRACKETS 1000000u /* open brackets */

/* Fill source->tokens from source->text. On failure the place is in *at. */
QDOT_MUST_CHECK qdot_status qdot_lex(qdot_source *source, size_t *at);

/* The spelled name of a Greek letter ("theta"), NULL if c is none. */
const char *qdot_letters_greek(uint32_t c);
/* Whether c is a Latin letter. */
bool qdot_letters_latin(uint32_t c);
/* The exact number of a QDOT_TOKEN_NUMBER: "9.81", or of a fraction of one sign "1/2". */
qdot_expr qdot_lex_number(qdot_pool *pool, const char *text);
/* The digit 0-9 that a subscript or superscript stands for, -1 if c is none. */
int qdot_letters_subscript(uint32_t c);
int qdot_letters_superscript(uint32_t c);
/* How many dots the letter that text begins with carries, ẋ 1, ẍ 2; *letter the one below them. ä, ë,
 * ï, ö, ü, ÿ are letters of names, and have none. */
unsigned qdot_letters_dotted(const char *text, const char **letter);

/* --- postfix code ------------------------------------------------------------------- */

typedef enum {
    QDOT_CODE_NUMBER,     /* push the number of `token` */
    QDOT_CODE_NAME,       /* push what `token` means, with `primes` */
    QDOT_CODE_LABEL,      /* n indices popped; push the label as a carrier symbol */
    QDOT_CODE_HISTORY,    /* push %n, n = 0: the last */
    QDOT_CODE_INDEX_NAME, /* n indices popped; push token[...] with `primes` */
    QDOT_CODE_INDEX,      /* n indices and a value popped; push its entry */
    QDOT_CODE_CALL,       /* `to` indices and n arguments popped; push token(...) */
    QDOT_CODE_RANGE,      /* n popped, the last two the ends of a range of token(...) */
    QDOT_CODE_TERM,    /* the top is the right operand of `token` in a sum or product */
    QDOT_CODE_SUM,     /* n terms popped */
    QDOT_CODE_PRODUCT, /* n factors popped */
    QDOT_CODE_NEGATE,
    QDOT_CODE_POWER,
    QDOT_CODE_RELATION, /* a b -> (a op b) */
    QDOT_CODE_CHAIN,    /* a b -> (a op b) b: the first part of a < b < c */
    QDOT_CODE_AND,      /* n popped */
    QDOT_CODE_OR,
    QDOT_CODE_NOT,
    QDOT_CODE_VECTOR,    /* n popped */
    QDOT_CODE_LIST,      /* n popped */
    QDOT_CODE_MATRIX,    /* n entries popped, `to` columns */
    QDOT_CODE_MEMBER,    /* the top is meant along the run `token` */
    QDOT_CODE_JUMP,      /* to `to` */
    QDOT_CODE_SUM_BEGIN, /* a b popped; the loop over source token n, body at `to` */
    QDOT_CODE_SUM_NEXT,  /* the body's value popped; round again or go on */
    QDOT_CODE_IF_TEST,   /* the condition stays; false: nil pushed, go to `to` */
    QDOT_CODE_IF_ELSE,   /* condition true: both popped, value pushed, go to `to` */
    QDOT_CODE_IF_END     /* condition, a, b popped; push if(...) */
} qdot_code_op;

typedef struct {
    uint8_t op; /* qdot_code_op */
    uint8_t primes;
    uint32_t n, to;
    const qdot_token *token; /* answerable for it: where the caret goes */
} qdot_code;

typedef struct {
    qdot_vec(qdot_code) list;
} qdot_program;

/* How far an expression goes. */
typedef enum {
    QDOT_PARSE_VALUE, /* relations and logic too */
    QDOT_PARSE_SIDE   /* up to a relation, `and`, `or` */
} qdot_parse_extent;

/* Parse one expression at the cursor and step over it. Append to *program. */
QDOT_MUST_CHECK qdot_status qdot_parse(qdot_cursor *c, qdot_parse_extent extent,
                                       qdot_program *program);

/* Run the program; *run (may be NULL: not allowed) the run that the whole is meant along,
 * or NULL. *over (may be NULL): the coordinates its entries go by, or nil. */
QDOT_MUST_CHECK qdot_status qdot_evaluate(qdot_cursor *c, const qdot_program *program,
                                          qdot_expr *value, qdot_expr *over,
                                          const char **run);

/* Whether a run NAME[...] is kept. */
bool qdot_cursor_has_runs(const qdot_cursor *c, const char *name);
/* Step over `NAME[k].`, a run of a family before an operand; *run: a token that spells the
 * run, "NAME[2]"; NULL: it is none, the cursor stays. */
QDOT_MUST_CHECK qdot_status qdot_cursor_accept_run(qdot_cursor *c,
                                                   const qdot_token **run);

/* --- meaning ------------------------------------------------------------------------ */

/* What `x₁` may be, where nothing is called x1: form 0 "x[1]", form 1 "x_1". False: there is none. */
bool qdot_resolve_small(const char *name, unsigned form, qdot_text *spelled);
/* A bare name with `primes`. *over: the coordinates its entries go by, or nil. */
QDOT_MUST_CHECK qdot_status qdot_resolve_name(qdot_cursor *c, const qdot_token *token,
                                              unsigned primes, qdot_expr *value,
                                              qdot_expr *over);
/* name[index ...] with `primes`. */
QDOT_MUST_CHECK qdot_status qdot_resolve_index(qdot_cursor *c, const qdot_token *token,
                                               unsigned primes, uint32_t n,
                                               const qdot_expr *index, qdot_expr *value);
/* Entry of a value; over: the coordinates its entries go by, nil: by numbers only. */
QDOT_MUST_CHECK qdot_status qdot_resolve_entry(qdot_session *session, qdot_expr e,
                                               qdot_expr over, uint32_t n,
                                               const qdot_expr *index, qdot_expr *value);
/* The failure that a prime cannot stand at `name`. QDOT_ETYPE. */
qdot_status qdot_resolve_no_prime(const char *name, const char *why);
/* x(args), x'(args) of an undefined function; a prime only where it has one argument. */
QDOT_MUST_CHECK qdot_status qdot_resolve_undefined(qdot_session *session,
                                                   const qdot_name *entry, unsigned primes,
                                                   uint32_t n, const qdot_expr *args,
                                                   qdot_expr *value);
/* name(args), name[index](args), name'(args); labels [indices + n]: of the values that are
 * positions of particles and bodies, else NULL. *over: as above. In lang/language/call.c. */
QDOT_MUST_CHECK qdot_status qdot_resolve_call(qdot_cursor *c, const qdot_token *token,
                                              unsigned primes, uint32_t indices,
                                              uint32_t n, const qdot_expr *values,
                                              const char *const *labels, const char *run,
                                              qdot_expr *value, qdot_expr *over);
/* *label: of the particle or body that name or name[index ...] is, itself or as the argument
 * of a function; NULL: it is none. Borrowed from the scene. */
QDOT_MUST_CHECK qdot_status qdot_resolve_label(qdot_session *session, const char *name,
                                               uint32_t n, const qdot_expr *index,
                                               const char **label);
/* Append "name[1,2]", from values that must be integers; n = 0: "name". */
QDOT_MUST_CHECK qdot_status qdot_resolve_member(qdot_session *session, const char *name,
                                                uint32_t n, const qdot_expr *index,
                                                qdot_text *member);
/* Whether a name is declared as a function of either kind. */
bool qdot_resolve_is_function(const qdot_session *session, const char *name);
/* "a vector", "an equation" ... in a user's words. */
const char *qdot_resolve_kind(const qdot_pool *pool, qdot_expr e);
/* After a constructor: QDOT_OK, or the pool's failure if value is nil. */
QDOT_MUST_CHECK qdot_status qdot_resolve_check(qdot_pool *pool, qdot_expr value);

/* --- hints -------------------------------------------------------------------------- */

/* Whether a name without a meaning is another system's for one of our functions: `Sin`. */
bool qdot_hints_is_foreign(const qdot_session *session, const char *name);
/* "unknown name `thta`", with the hint that fits: the nearest name, our form of another
 * system's. member: the whole, "thta[2]", or NULL. QDOT_ENAME. */
qdot_status qdot_hints_unknown(qdot_cursor *c, const qdot_token *token,
                               const char *member);
/* The same for a call. */
qdot_status qdot_hints_unknown_function(qdot_cursor *c, const qdot_token *token);
/* A function's name without its brackets: `sqrt x`, `sin^2(x)`. QDOT_ESYNTAX. */
qdot_status qdot_hints_bare_function(qdot_cursor *c, const qdot_token *token);
/* "there is no particle or body `bod`", nearest label. QDOT_ENAME. */
qdot_status qdot_hints_unknown_label(qdot_session *session, const char *what,
                                     const char *label);
/* The nearest of everything known; NULL if none is near. Valid until the next change. */
const char *qdot_hints_nearest(qdot_session *session, const char *name);
#endif
