/* hole-read.h -- parses the tokens of a hole (a placeholder of a usage text) as its class says (holes.h). */
#ifndef QDOT_LANG_HOLE_READ_H
#define QDOT_LANG_HOLE_READ_H

#include "lang/syntax/holes.h"
#include "lang/syntax/record.h"

/* Whether the token is the word or sign of this node of the usage automaton. */
bool qdot_usage_node_is(const qdot_usage_node *node, const qdot_token *token);
/* Whether the placeholder ("hole") begins with an expression, so that any token may be its first. */
bool qdot_hole_is_expression(const qdot_usage_node *node);
/* Whether the placeholder can begin with the token at the record's cursor, where other things may stand, too. */
bool qdot_hole_suits(const qdot_usage *u, const qdot_record *r, const qdot_usage_node *node);
/* Read the hole at the record's cursor and step over it: its expressions are appended to the record, its names put into
 * the part. Errors: QDOT_ESYNTAX and those of qdot_compiled_parse, the place in the cursor. */
QDOT_MUST_CHECK qdot_status qdot_hole_read(const qdot_usage *u, qdot_record *r, const qdot_usage_node *node,
                                           qdot_filled *part);

#endif
