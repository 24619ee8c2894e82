/* loop-index.h -- finds where the index of a `for` loop occurs in the repeated statement. */
#ifndef QDOT_LANG_LOOP_INDEX_H
#define QDOT_LANG_LOOP_INDEX_H

#include "lang/syntax/record.h"

/* Each index of a loop must occur in what is repeated, the tokens [from, to), or in the values of a later index; a declared
 * parameter or coordinate may occur in what a name, the scene or a run there stands for. A block may count its passes only,
 * by a name that means nothing else. The clause is the parts [clause, end) of the record, those behind the word `for`.
 * QDOT_EINVAL where an index occurs nowhere. */
QDOT_MUST_CHECK qdot_status qdot_loop_index_check(qdot_record *r, const qdot_filled *clause, const qdot_filled *end,
                                                  const qdot_token *from, const qdot_token *to, bool block);

/* Whether a run may depend on the declared parameter or coordinate: what is declared, a value, the start, a definition or
 * the end of a domain holds it. */
bool qdot_loop_index_is_read(const qdot_session *session, qdot_expr symbol);

#endif
