/* mention.h -- the names in tokens that no usage has read: the body of a function, what a loop repeats.
 *
 * A mention is a name, the word of a statement among them, or %, the last value.
 */
#ifndef QDOT_LANG_MENTION_H
#define QDOT_LANG_MENTION_H

#include "lang/source/token.h"
#include "lang/syntax/statement.h"

typedef struct {
    const char *name;          /* the name that occurs, or "%" */
    const qdot_statement *row; /* row of the statement in which it occurs; NULL: that begins with no statement word */
    bool begins;               /* whether it is the first token of its statement */
    const qdot_token *next, *from, *to; /* the token where to look further; the tokens [from, to) that are searched */
} qdot_mention;

/* Prepare to find the names that occur in the tokens [from, to). */
static inline qdot_mention
qdot_mention_in(const qdot_token *from, const qdot_token *to)
{
    return (qdot_mention){.next = from, .from = from, .to = to};
}

/* Find the next name that occurs; false if there is none. */
bool qdot_mention_next(qdot_mention *m);

/* Whether the name, or %, occurs in the tokens [from, to). */
bool qdot_mention_is_in(const qdot_token *from, const qdot_token *to, const char *name);

/* The latest time after `last` at which the tokens read a run, as 5 in value(x, 5) and max(x, 0..5); NULL: none. */
const qdot_token *qdot_mention_time(const qdot_token *from, const qdot_token *to, double last);

#endif
