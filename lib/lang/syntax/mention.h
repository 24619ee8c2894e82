/* mention.h -- the names in tokens that no usage has read: the body of a function, what a loop repeats.
 *
 * A mention is a name, the word of a statement among them, or %, the last value.
 */
#ifndef QDOT_LANG_MENTION_H
#define QDOT_LANG_MENTION_H

#include "lang/source/token.h"
#include "lang/syntax/statement.h"

typedef struct {
    const char *name;          /* the name, or "%" */
    const qdot_statement *row; /* of the statement that it stands in; NULL: that begins with no word */
    bool begins;               /* it is the first token of its statement */
    const qdot_token *next, *from, *to; /* where to look further; the tokens [from, to) */
} qdot_mention;

/* Before the first mention in the tokens [from, to). */
static inline qdot_mention
qdot_mention_in(const qdot_token *from, const qdot_token *to)
{
    return (qdot_mention){.next = from, .from = from, .to = to};
}

/* Go on to the next mention; false: there is none. */
bool qdot_mention_next(qdot_mention *m);

/* Whether the name, or %, is mentioned in the tokens [from, to). */
bool qdot_mention_is_in(const qdot_token *from, const qdot_token *to, const char *name);

/* The latest time behind `last` at which the tokens read a run, as 5 in value(x, 5) and max(x, 0..5); NULL: none. */
const qdot_token *qdot_mention_time(const qdot_token *from, const qdot_token *to, double last);

#endif
