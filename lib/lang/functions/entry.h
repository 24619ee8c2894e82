/* entry.h -- finds an entry of a value by its indices, and writes the name of a family member. */
#ifndef QDOT_LANG_ENTRY_H
#define QDOT_LANG_ENTRY_H

#include "base/text.h"
#include "lang/session/parts.h"

/* The entry of a value at index [n]; over: the coordinates by which entries are indexed, nil: by
 * numbers only. */
QDOT_MUST_CHECK qdot_status qdot_entry_of(qdot_session *session, qdot_expr e,
                                          qdot_expr over, uint32_t n,
                                          const qdot_expr *index, qdot_expr *value);
/* Append the name "name[1,2]" for index values, which must be integers; without indices just "name". */
QDOT_MUST_CHECK qdot_status qdot_entry_name(qdot_session *session, const char *name,
                                            uint32_t n, const qdot_expr *index,
                                            qdot_text *member);

#endif
