/* read.h -- from text to tokens to values.
 *
 * A source is lexed whole; statements are ranges of its tokens; a statement reads its operands
 * through a cursor. An expression is parsed to postfix code by precedence with an explicit stack
 * and evaluated by a loop over that code: no recursion, so no depth of brackets breaks it.
 * Limits, each a clear error: 10^7 tokens, 10^6 open brackets.
 */
#ifndef QDOT_LANG_READ_H
#define QDOT_LANG_READ_H

#include "lang/session/session.h"

/* --- sources and tokens --------------------------------------------------------------- */

typedef enum {
    QDOT_TOKEN_END,     /* end of the statement: newline, `;`, end of the source */
    QDOT_TOKEN_NUMBER,  /* "9.81" */
    QDOT_TOKEN_NAME,    /* Greek letters spelled: "theta1" */
    QDOT_TOKEN_STRING,  /* text without its quotes */
    QDOT_TOKEN_OPERATOR /* ( ) [ ] { } , ; : . .. ' + - * / ^ = == < <= > >= % ... */
} qdot_token_kind;

typedef struct qdot_token {
    uint8_t kind;
    bool glued;             /* no blank before it */
    const char *text;       /* NUL-terminated, in the source's arena */
    uint32_t start, length; /* bytes in the source */
} qdot_token;

typedef struct qdot_source {
    unsigned uses; /* freed with the last */
    char *name;
    char *text; /* NUL-terminated copy */
    size_t length;
    qdot_arena *arena;
    qdot_vec(qdot_token) tokens; /* the last is END */
} qdot_source;

/* Lex. Errors (QDOT_ESYNTAX, with the place in *at): bytes that are no UTF-8 or no text, a bracket that
 * does not match, an unfinished string. *source is set then too, for the report, and the
 * caller's to free; it is NULL only for QDOT_ENOMEM and a text of 4 GB.
 *
 * Blank statements leave no token: an END follows each statement, one also stands before `}`, none
 * directly after `{`. A source of nothing is one END. */
QDOT_MUST_CHECK qdot_status qdot_source_new(const char *name, const char *text,
                                            size_t length, qdot_source **source,
                                            size_t *at);
qdot_source *qdot_source_keep(const qdot_source *source); /* one use more */
void qdot_source_free(qdot_source *source);               /* one use less */

/* Where a byte is: line and column from 1 (columns count characters). */
void qdot_source_locate(const qdot_source *source, size_t at, uint32_t *line,
                        uint32_t *column);
/* "file:line:column: error: message", the line, the caret, "hint: ...". A very long line is cut
 * round the caret. */
void qdot_source_report(const qdot_source *source, size_t at, const qdot_error *error,
                        qdot_text *out);

/* --- a cursor over a statement's tokens -------------------------------------------------- */

typedef struct {
    qdot_session *session;
    const qdot_source *source;
    const qdot_token
        *at;         /* the next token; tokens[i] with kind END ends every statement */
    size_t error_at; /* byte where the last error is; set by every reader that fails */
} qdot_cursor;

bool qdot_cursor_is_op(const qdot_cursor *c, const char *op);
bool qdot_cursor_is_word(const qdot_cursor *c, const char *word);
bool qdot_cursor_accept_op(qdot_cursor *c, const char *op); /* and step over it */
bool qdot_cursor_accept_word(qdot_cursor *c, const char *word);
bool qdot_cursor_is_end(const qdot_cursor *c);
/* Fail at the next token: "expected WHAT, found `...`". With hint for a missing `*`, other systems'
 * forms where they can be known. QDOT_ESYNTAX. */
qdot_status qdot_cursor_expected(qdot_cursor *c, const char *what);
QDOT_MUST_CHECK qdot_status qdot_cursor_expect_op(qdot_cursor *c, const char *op);
QDOT_MUST_CHECK qdot_status qdot_cursor_expect_end(qdot_cursor *c);

/* --- readers: parse and evaluate --------------------------------------------------------- */

/* A whole expression, equations and logic included; stops before the first token that cannot go on (an
 * option word, `,`, `:`, `..`, a closing bracket, the end). */
QDOT_MUST_CHECK qdot_status qdot_read_value(qdot_cursor *c, qdot_expr *value);
/* The same, to be named: *over: the coordinates its entries go by, `G = metric(R)` and
 * G[r, phi]; nil: by numbers only. */
QDOT_MUST_CHECK qdot_status qdot_read_named(qdot_cursor *c, qdot_expr *value,
                                            qdot_expr *over);
/* As a side of `==`, a relation, a bound: stops before = == < <= > >= and or. */
QDOT_MUST_CHECK qdot_status qdot_read_side(qdot_cursor *c, qdot_expr *value);
/* A sum without relations that must be a scalar: QDOT_ETYPE otherwise. */
QDOT_MUST_CHECK qdot_status qdot_read_scalar(qdot_cursor *c, qdot_expr *value);
/* A scalar or a vector of 2 or 3: a place or a force. */
QDOT_MUST_CHECK qdot_status qdot_read_point(qdot_cursor *c, qdot_expr *value);
/* As numbers of the moment, parameters with their values. */
QDOT_MUST_CHECK qdot_status qdot_read_number(qdot_cursor *c, double *value);
QDOT_MUST_CHECK qdot_status qdot_read_integer(qdot_cursor *c, long *value);
/* a..b, exact. */
QDOT_MUST_CHECK qdot_status qdot_read_range(qdot_cursor *c, qdot_expr *from,
                                            qdot_expr *to);
/* A name to be declared or a label, with its indices evaluated: "theta[1]", "A[1,2]". The string is in
 * the source's arena. */
QDOT_MUST_CHECK qdot_status qdot_read_name(qdot_cursor *c, const char **name);
/* name or name[...] followed by primes, of a declared coordinate: the jet symbol. */
QDOT_MUST_CHECK qdot_status qdot_read_coordinate(qdot_cursor *c, qdot_expr *jet);
/* As qdot_read_side, perhaps along a run, `a.theta` or `a.(expr)`: *run its label, else NULL. */
QDOT_MUST_CHECK qdot_status qdot_read_member(qdot_cursor *c, qdot_expr *value,
                                             const char **run);
/* A quoted string. */
QDOT_MUST_CHECK qdot_status qdot_read_string(qdot_cursor *c, const char **text);

/* Step over tokens up to (not over) the next top-level `word` or the end; NULL word: the end. */
const qdot_token *qdot_cursor_find_word(const qdot_cursor *c, const char *word);

/* --- what the evaluator asks of the tables ------------------------------------------------ */

/* A function of values, `diff`, `ds2`, `expand` ...; rows in lang/functions/builtin.c. */
typedef struct {
    const char *name;
    int least, most; /* arguments; most < 0: any number */
    qdot_status (*call)(qdot_session *session, uint32_t n, const qdot_expr *args,
                        qdot_expr *value);
    const char *usage, *summary, *example; /* for help */
    unsigned flags;                        /* QDOT_BUILTIN_... */
    /* the coordinates (a LIST) that the entries of its value go by, `metric(R)[r, phi]`; NULL */
    qdot_expr (*over)(qdot_session *session, uint32_t n, const qdot_expr *args);
} qdot_builtin;
enum {
    QDOT_BUILTIN_UNBUILT = 1, /* a word of the language that this version does not have */
    QDOT_BUILTIN_LABEL = 2,   /* the first argument is a label: its carrier symbol */
    QDOT_BUILTIN_RUN = 4,     /* arguments may name a run, value(a.theta, 20) */
    QDOT_BUILTIN_FORM = 8,    /* a form of its own: sum, if */
    QDOT_BUILTIN_SHORT = 16   /* gives way to whatever else is called so */
};
const qdot_builtin *qdot_builtin_find(const char *name);
const qdot_builtin *qdot_builtin_at(size_t i); /* NULL past the end */

/* A value of the scene, `T`, `eom`, `mass_matrix` ...; rows in lang/functions/quantities.c. `index`: for
 * eom[theta], p[theta], mass_matrix[a, b]; n = 0 for the bare name. */
typedef struct {
    const char *name;
    int least, most; /* indices allowed */
    qdot_status (*get)(qdot_session *session, uint32_t n, const qdot_expr *index,
                       qdot_expr *value);
    const char *usage, *summary, *example;
    bool over_coordinates; /* a list or matrix whose entries go by the coordinates too */
    /* what a member of the list is called where the whole is asked, `p[theta] = ...`: a
     * symbol by its coordinate; NULL: `eom[theta]` */
    qdot_expr (*symbol)(qdot_pool *pool, qdot_expr coordinate);
} qdot_quantity;
const qdot_quantity *qdot_quantity_find(const char *name);
const qdot_quantity *qdot_quantity_at(size_t i);

/* Provided by lang/commands/number.c: evaluate `value(e1, ..., t)`-like words inside an expression. Given the
 * values of the arguments; label: the run's name or NULL for the latest. The result holds measured
 * symbols; several columns: a LIST. */
QDOT_MUST_CHECK qdot_status qdot_number_value(qdot_session *session, const char *run,
                                              uint32_t n, const qdot_expr *args,
                                              qdot_expr *value);
#endif
