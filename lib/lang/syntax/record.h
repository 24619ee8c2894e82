/* record.h -- a statement as it was read: its words and holes, the holes as compiled expressions.
 *
 * qdot_match makes a record of the tokens of a statement; nothing is looked up or evaluated then
 * but what decides how an expression is read (a call or a product). The handler of the statement
 * asks for the values of the holes, as often as it likes.
 *
 * A hole is found by the word before it and its name in the usage text:
 *
 *     particle NAME mass M at R    qdot_record_hole(r, "mass", "M")
 *
 * Values are read as by lang/language/read.h, with the same failures at the same places. A hole
 * that is NULL was left out: it must not be asked for its value.
 *
 * Tests  tests/lang/syntax/test_syntax.c
 */
#ifndef QDOT_LANG_RECORD_H
#define QDOT_LANG_RECORD_H

#include "lang/language/compiled.h"
#include "lang/language/formals.h"
#include "lang/syntax/row.h"
#include "lang/syntax/usage.h"

enum { QDOT_RECORD_INDICES = 8 }; /* largest number of indices of a name */

/* A part of a statement: a word, a sign, or a placeholder ("hole") with what was typed for it. */
typedef struct {
    const qdot_usage_node *node;
    const qdot_token *from, *to; /* the tokens from ... to - 1 of this part */
    size_t first, n; /* indices of its expressions: compiled[first] ... compiled[first + n - 1] */
    const qdot_token *name;      /* for a name: its token, since bounds may stand before it */
    const qdot_token *primes;    /* the token after the name; the primes of a coordinate are [primes, to) */
} qdot_filled;

/* A bound of a new name. */
typedef struct {
    const qdot_token *at;
    qdot_expr value;
    bool upper, strict; /* whether it is an upper bound; whether the bound itself is excluded */
} qdot_bound;

typedef struct qdot_record {
    const qdot_statement *row;
    qdot_cursor cursor; /* session and source; position of an error; position after the statement */
    const qdot_token *start; /* the token after the statement's word, which is start[-1] */
    qdot_vec(qdot_filled) parts; /* the parts as typed; the first is the statement's word */
    qdot_vec(qdot_compiled) compiled;
    qdot_usage *usage; /* compiled for this record alone; NULL: shared with other records */
} qdot_record;

void qdot_record_free(qdot_record *r);

/* The record of a statement that stands alone, asked for by another one in place of a person: without words or holes,
 * nothing to free. Its errors stand at the end of the statement at the cursor. */
qdot_record qdot_record_alone(const qdot_cursor *c, const qdot_statement *row);

/* --- parts of the statement ---------------------------------------------------------- */

/* _word: the first part that is this word; the other: this placeholder. NULL: none. before or text NULL: any. */
const qdot_filled *qdot_record_word(const qdot_record *r, const char *word);
const qdot_filled *qdot_record_hole(const qdot_record *r, const char *before, const char *text);
/* The next placeholder of that name after `part`, as in a list; NULL if there is none. */
const qdot_filled *qdot_record_next(const qdot_record *r, const qdot_filled *part, const char *text);
/* Whether a part is the placeholder ("hole") or word of that name in the usage. */
bool qdot_filled_is(const qdot_filled *part, const char *text);
/* Whether the part consists of the single token `word`. */
bool qdot_filled_is_word(const qdot_filled *part, const char *word);
/* Whether the part has the form NAME[...], a member of the family with that name. */
bool qdot_filled_is_member(const qdot_filled *part, const char *family);
/* Whether the name occurs in the operands of the statement, other than in this part. */
bool qdot_record_mentions_besides(const qdot_record *r, const qdot_filled *part, const char *name);
/* The first name in the part that is the time or means nothing yet, as F in 9.81*F; else its first name; NULL: it has none. */
const qdot_token *qdot_record_own_name(const qdot_record *r, const qdot_filled *part);
/* Whether the part is a text in quotes. */
bool qdot_filled_is_text(const qdot_filled *part);
/* Whether the part contains, outside of brackets, an operator that begins with the sign. */
bool qdot_filled_holds_sign(const qdot_filled *part, char sign);

/* --- evaluating parts ---------------------------------------------------------------- */

QDOT_MUST_CHECK qdot_status qdot_record_value(qdot_record *r, const qdot_filled *part, qdot_expr *value);
/* Evaluate an expression whose answer has a name. *over: the coordinates that index its entries, or nil. */
QDOT_MUST_CHECK qdot_status qdot_record_named(qdot_record *r, const qdot_filled *part, qdot_expr *value,
                                              qdot_expr *over);
QDOT_MUST_CHECK qdot_status qdot_record_scalar(qdot_record *r, const qdot_filled *part, qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_record_point(qdot_record *r, const qdot_filled *part, qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_record_number(qdot_record *r, const qdot_filled *part, double *value);
QDOT_MUST_CHECK qdot_status qdot_record_integer(qdot_record *r, const qdot_filled *part, int64_t *value);
/* Evaluate the two ends of a range a..b exactly. */
QDOT_MUST_CHECK qdot_status qdot_record_range(qdot_record *r, const qdot_filled *part, qdot_expr *from,
                                              qdot_expr *to);
/* Evaluate component k of a tuple (A, B, ...), which must be a scalar. */
QDOT_MUST_CHECK qdot_status qdot_record_item(qdot_record *r, const qdot_filled *part, size_t k,
                                             qdot_expr *value);
/* Evaluate expression k of a part of the statement, such as one side of a comparison. */
QDOT_MUST_CHECK qdot_status qdot_record_side(qdot_record *r, const qdot_filled *part, size_t k,
                                             qdot_expr *value);
/* The sides of an equation; of a motion: what a loop holds moves there. `A = B` or an equation by its
 * name, else a failure behind it. */
QDOT_MUST_CHECK qdot_status qdot_record_equation(qdot_record *r, const qdot_filled *part, bool motion,
                                                 qdot_expr *left, qdot_expr *right);
/* Write a name with its indices evaluated, as a text in the arena of the source. */
QDOT_MUST_CHECK qdot_status qdot_record_name(qdot_record *r, const qdot_filled *part, const char **name);
/* As qdot_record_name, for a new name: QDOT_ENAME at the part if something with that name is declared or defined. */
QDOT_MUST_CHECK qdot_status qdot_record_new_name(qdot_record *r, const qdot_filled *part, const char **name);
/* Find bound k of a name with bounds, in the order typed; *is: the name has a bound k. */
QDOT_MUST_CHECK qdot_status qdot_record_bound(qdot_record *r, const qdot_filled *part, size_t k,
                                              qdot_bound *bound, bool *is);
/* Read the arguments of NAME(u, v); evaluate an expression in which they hide other names. Leave f
 * in any case. */
QDOT_MUST_CHECK qdot_status qdot_record_formals(qdot_record *r, const qdot_filled *call, qdot_formals *f);
QDOT_MUST_CHECK qdot_status qdot_record_body(qdot_record *r, const qdot_filled *part, qdot_formals *f,
                                             qdot_expr *body);
/* Find a declared coordinate with its primes. */
QDOT_MUST_CHECK qdot_status qdot_record_coordinate(qdot_record *r, const qdot_filled *part,
                                                   qdot_expr *jet);
/* The name that expression k of the part is, NAME or NAME[i, j] and nothing else; *name NULL: it is
 * more than a name. */
QDOT_MUST_CHECK qdot_status qdot_record_bare_name(qdot_record *r, const qdot_filled *part, size_t k,
                                                  const char **name);
/* Find the label in FUNCTION(LABEL, ...), if the part is just such a call; otherwise *label is NULL. */
QDOT_MUST_CHECK qdot_status qdot_record_label_in(qdot_record *r, const qdot_filled *part,
                                                 const char *function, const char **label);
/* Find the arguments of FUNCTION(A, B), if the part is just such a call; *is: whether it is. */
QDOT_MUST_CHECK qdot_status qdot_record_call_of_two(qdot_record *r, const qdot_filled *part,
                                                    const char *function, qdot_expr *values, bool *is);
/* The text in quotes that was typed for a placeholder. */
const char *qdot_record_text(const qdot_filled *part);

/* --- reporting errors ---------------------------------------------------------------- */

/* The unit behind a declared name or its bound, or behind its value (NULL: none), as in `param m > 0 [kg]`; *unit nil:
 * there is none. *angle: it is one of angles. */
QDOT_MUST_CHECK qdot_status qdot_record_unit(qdot_record *r, const qdot_filled *part, const qdot_filled *value,
                                             qdot_expr *unit, bool *angle);

/* Set the position at which an error is shown to the beginning of this part of the statement. */
void qdot_record_blame(qdot_record *r, const qdot_filled *part);
/* Fail at the primes of a name that cannot have any; what: a description of what should follow the name. */
QDOT_MUST_CHECK qdot_status qdot_record_no_prime(qdot_record *r, const qdot_filled *part,
                                                 const char *what);
/* Fail at the token `at`: "expected WHAT, found ...". */
qdot_status qdot_record_expected(qdot_record *r, const qdot_token *at, const char *what);

#endif
