/* loop-index.h -- finds where the index of a `for` loop occurs in the repeated statement. */
#ifndef QDOT_LANG_LOOP_INDEX_H
#define QDOT_LANG_LOOP_INDEX_H

#include "lang/language/cursor.h"

/* Each index of the clause at the cursor, behind `for`, up to `end` (NULL: that of the statement), must occur in the tokens [from, to), or in the
 * range of a later index; a declared parameter or coordinate may occur in what a name, the scene or a
 * run there stands for. A block may count its passes only, by a name that means nothing else. QDOT_EINVAL
 * where an index occurs nowhere. */
QDOT_MUST_CHECK qdot_status qdot_loop_index_check(qdot_cursor *c, const qdot_token *from,
                                                  const qdot_token *to, const qdot_token *end,
                                                  bool block);

/* Whether a run may depend on the declared parameter or coordinate: what is declared, a value, the start, a definition or
 * the end of a domain holds it. */
bool qdot_loop_index_is_read(const qdot_session *session, qdot_expr symbol);

#endif
