/* definition.h -- LEFT = RIGHT as it was typed, before it is known whether it defines LEFT.
 *
 *   NAME = EXPR,  NAME[K] = EXPR,  NAME(X, Y) = EXPR,  NAME'' = EXPR   [for ... | to "FILE"]
 *
 * Tests  tests/script/definitions/, tests/bad/definitions/
 */
#ifndef QDOT_LANG_DEFINITION_H
#define QDOT_LANG_DEFINITION_H

#include "base/text.h"
#include "lang/syntax/mention.h"

typedef struct {
    const qdot_token *name;   /* the first token of the statement, a name */
    const qdot_token *equals; /* the sign `=` after LEFT; NULL: the statement is no definition */
    const qdot_token *behind; /* the token after RIGHT: a word `for` or `to`, or the end */
    bool member, call;        /* LEFT has the form NAME[...]; NAME(...) */
    bool apart;               /* a blank precedes the bracket of NAME[...] or NAME(...) */
    size_t primes;            /* number of primes at the end of LEFT */
    bool loop;                /* a loop, `for ...`, follows RIGHT */
    /* the fields from here on tell what RIGHT contains */
    bool chained;             /* RIGHT contains an equation sign outside brackets: a = b = c */
    bool equation, comparison; /* RIGHT contains a sign =, also within brackets; a sign = or == */
    bool primed, accelerations; /* RIGHT contains a prime; two primes in a row */
    bool sum;                 /* RIGHT contains a sign + or - outside brackets */
    bool on;                  /* RIGHT contains `on` outside brackets, not as first token */
    bool range, colon, text;  /* RIGHT contains a sign `..`; a sign `:`; a quoted text */
    size_t components;        /* number of components if RIGHT is a vector (a, b); 1 if it is none */
} qdot_definition;

/* Split the definition in the tokens first ... end - 1 into its parts; false: they do not begin with NAME [...] ' =. */
bool qdot_definition_find(const qdot_token *first, const qdot_token *end, qdot_definition *d);

/* Whether the left side of a definition is a name alone. */
static inline bool
qdot_definition_is_of_name(const qdot_definition *d)
{
    return d->name + 1 == d->equals;
}

/* Append component i of the right side of a definition as typed; all of it if it is no vector. */
void qdot_definition_component(qdot_session *session, const qdot_definition *d, size_t i, qdot_text *out);
/* Append NAME[2,1] without blanks, if the indices of the left side are written in numbers; else nothing. */
void qdot_definition_member(const qdot_definition *d, qdot_text *out);
/* Argument i (from 0) of a left side NAME(X, Y); NULL: there are fewer, or they are not all names. */
const qdot_token *qdot_definition_argument(const qdot_definition *d, size_t i);
/* The name that the right side consists of, or begins with as NAME(...) or NAME.E; NULL: there is none. */
const char *qdot_definition_word(const qdot_definition *d);
const char *qdot_definition_applied(const qdot_definition *d);
/* What the right side of a definition mentions. */
qdot_mention qdot_definition_right(const qdot_definition *d);
/* The next name of RIGHT from *k on that stands outside the arguments of functions, without index or arguments; NULL: there
 * is none. *k: first NULL. */
const char *qdot_definition_next_term(const qdot_definition *d, const qdot_token **k);
/* Whether the name on the left is mentioned after it, at byte `at` of the source; *family: with an index. */
bool qdot_definition_recurs_at(const qdot_definition *d, size_t at, bool *family);

#endif
