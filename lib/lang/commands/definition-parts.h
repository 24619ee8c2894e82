/* definition-parts.h -- LEFT = RIGHT as it stands, for the files that look for what was meant by it.
 *
 * Inside of lang/commands/definition-check.
 */
#ifndef QDOT_LANG_DEFINITION_PARTS_H
#define QDOT_LANG_DEFINITION_PARTS_H

#include "base/text.h"
#include "lang/commands/statement.h"
#include "lang/session/names.h"
#include "lang/source/token.h"

/* The statement as it was typed: LEFT = RIGHT [for ...]. */
typedef struct {
    qdot_cursor *c;
    qdot_session *session;
    const qdot_token *name, *equals, *behind, *end; /* tokens: NAME, `=`, end of the right side (the word `for` or `end`), end */
    qdot_text right, loop; /* the right side as text; the loop " for k = 1..3", or "" */
    qdot_text line;        /* the line that the user probably meant */
    bool moves;            /* the right side contains coordinates, positions or the time */
    bool accelerations;
    bool chained; /* the right side is itself an equation: a = b = c */
    bool primed;  /* the name on the left has primes */
} qdot_assignment;

/* The number of components if the right side is a vector (a, b); 1 if it is none. */
size_t qdot_definition_components(const qdot_assignment *a);
/* Append component i of the right side as typed; the whole right side if it is no vector. */
void qdot_definition_component(const qdot_assignment *a, size_t i, qdot_text *out);
/* The coordinate declared first, or NULL. */
const qdot_name *qdot_definition_coordinate(const qdot_session *s);

/* The statement of the word with the right side as its operand into a->line: `potential -k/x` of
 * `potential = -k/x`. False: it was meant as a value, for which a name was sought. */
bool qdot_definition_statement(qdot_assignment *a, const qdot_statement *row);

#endif
