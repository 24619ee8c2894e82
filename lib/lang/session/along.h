/* along.h -- values along runs, of expressions that may name several of them. */
#ifndef QDOT_LANG_ALONG_H
#define QDOT_LANG_ALONG_H

#include "lang/session/session.h"

/* One expression at times [k], each with what the exact one is beyond it (lows NULL: 0), along
 * whatever runs it names, else along `run` (NULL: the latest). */
QDOT_MUST_CHECK qdot_status qdot_along_values(qdot_session *session, const char *run,
                                              qdot_expr e, size_t k, const double *times,
                                              const double *lows, double *values,
                                              double *errors);
/* value(e1, ..., t) with args [n], the last the time; run NULL: the latest. The result holds measured
 * symbols; several columns: a LIST. */
QDOT_MUST_CHECK qdot_status qdot_along_value(qdot_session *session, const char *run,
                                             uint32_t n, const qdot_expr *args,
                                             qdot_expr *value);

#endif
