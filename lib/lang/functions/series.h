/* series.h -- series(E, x = a, ..., n): Taylor series in several symbols. */
#ifndef QDOT_LANG_SERIES_H
#define QDOT_LANG_SERIES_H

#include "lang/session/parts.h"

#define QDOT_SERIES "series(e, x = a, y = b, n)"

QDOT_MUST_CHECK qdot_status qdot_algebra_series(qdot_session *s, uint32_t n,
                                        const qdot_expr *args, qdot_expr *value);

#endif
