/* definition-parts.h -- LEFT = RIGHT as it stands, for the files that look for what was meant by it.
 *
 * Inside of lang/commands/definition-check.
 */
#ifndef QDOT_LANG_DEFINITION_PARTS_H
#define QDOT_LANG_DEFINITION_PARTS_H

#include "lang/language/cursor.h"
#include "lang/session/names.h"
#include "lang/syntax/definition.h"

typedef struct {
    qdot_cursor *c;
    qdot_session *session;
    qdot_definition as; /* the definition LEFT = RIGHT [for ...], split into its parts */
    qdot_text right, loop; /* the right side as text; the loop " for k = 1..3", or "" */
    qdot_text line;        /* the line that the user probably meant */
    bool moves;            /* the right side contains coordinates, positions or the time */
} qdot_assignment;

/* The coordinate declared first, or NULL. */
const qdot_name *qdot_definition_coordinate(const qdot_session *s);

/* The statement of the word with the right side as its operand into a->line: `potential -k/x` of
 * `potential = -k/x`. False: it was meant as a value, for which a name was sought. */
bool qdot_definition_statement(qdot_assignment *a, const qdot_statement *row);

#endif
