/* entry.h -- an entry of a value, and the name of a member. */
#ifndef QDOT_LANG_ENTRY_H
#define QDOT_LANG_ENTRY_H

#include "lang/session/session.h"

/* Entry of a value; over: the coordinates its entries go by, nil: by numbers only. */
QDOT_MUST_CHECK qdot_status qdot_entry_of(qdot_session *session, qdot_expr e,
                                          qdot_expr over, uint32_t n,
                                          const qdot_expr *index, qdot_expr *value);
/* Append "name[1,2]", from values that must be integers; n = 0: "name". */
QDOT_MUST_CHECK qdot_status qdot_entry_name(qdot_session *session, const char *name,
                                            uint32_t n, const qdot_expr *index,
                                            qdot_text *member);

#endif
