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
    const qdot_token *equals; /* the sign `=` behind LEFT; NULL: the statement has another form */
    const qdot_token *behind; /* the token behind RIGHT: a word `for` or `to`, or the end */
    bool member, call;        /* LEFT is NAME[...]; NAME(...) */
    bool apart;               /* a blank precedes this bracket */
    size_t primes;            /* number of primes of LEFT */
    bool loop;                /* a loop follows RIGHT */
    /* what RIGHT holds */
    bool chained;             /* an equation sign outside brackets: a = b = c */
    bool equation, comparison; /* a sign = or ==, also within brackets; only the first, = */
    bool primed, accelerations; /* a prime; two of them */
    bool sum;                 /* a sign + or - outside brackets */
    bool on;                  /* the word `on` outside brackets, not as its first token */
    bool range, colon, text;  /* a sign `..`; a sign `:`; a text in quotes */
    size_t components;        /* number of components of a vector (a, b); 1: it is none */
} qdot_definition;

/* Take the statement that begins at `first` and ends at `end` apart; false: it does not begin with NAME [...] ' =. */
bool qdot_definition_find(const qdot_token *first, const qdot_token *end, qdot_definition *d);

/* Whether LEFT is a name alone. */
static inline bool
qdot_definition_is_of_name(const qdot_definition *d)
{
    return d->name + 1 == d->equals;
}

/* Component i of RIGHT as typed; the whole of it if it is no vector. */
void qdot_definition_component(qdot_session *session, const qdot_definition *d, size_t i, qdot_text *out);
/* NAME[2,1] without blanks, if the indices are written in numbers; nothing otherwise. */
void qdot_definition_member(const qdot_definition *d, qdot_text *out);
/* Argument i of NAME(X, Y), counted from 0; NULL: there are not as many, or they are not all names. */
const qdot_token *qdot_definition_argument(const qdot_definition *d, size_t i);
/* The name of which RIGHT consists; the name with which it begins as NAME(...) or NAME.E; NULL: it does not. */
const char *qdot_definition_word(const qdot_definition *d);
const char *qdot_definition_applied(const qdot_definition *d);
/* What RIGHT mentions. */
qdot_mention qdot_definition_right(const qdot_definition *d);
/* The next name of RIGHT from *k on that stands outside the arguments of functions, without index or arguments; NULL: there
 * is none. *k: first NULL. */
const char *qdot_definition_next_term(const qdot_definition *d, const qdot_token **k);
/* Whether the name of LEFT is mentioned behind it, at byte `at` of the source; *family: with an index. */
bool qdot_definition_recurs_at(const qdot_definition *d, size_t at, bool *family);

#endif
