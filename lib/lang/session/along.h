/* along.h -- values of expressions along runs; an expression may refer to several runs. */
#ifndef QDOT_LANG_ALONG_H
#define QDOT_LANG_ALONG_H

#include "lang/session/parts.h"

/* value(e1, ..., t) with args [n], the last the time; run NULL: the latest. The result holds
 * measured symbols; several columns: a LIST. */
QDOT_MUST_CHECK qdot_status qdot_along_value(qdot_session *session, const char *run,
                                             uint32_t n, const qdot_expr *args,
                                             qdot_expr *value);

#endif
