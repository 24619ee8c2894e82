/* export-given.h -- the values that `set` gave to declared functions and to parameters, for an export. */
#ifndef QDOT_LANG_EXPORT_GIVEN_H
#define QDOT_LANG_EXPORT_GIVEN_H

#include "base/memory.h"
#include "lang/session/parts.h"

/* Declared functions that have a value: f(s) is heads.at[i], its value bodies.at[i]; and inputs whose value depends on the
 * motion. */
typedef struct {
    qdot_vec(qdot_expr) heads, bodies;
} qdot_given_functions;

/* Fill *f, which must be zero before; the caller clears it, also after a failure. */
QDOT_MUST_CHECK qdot_status qdot_given_functions_find(qdot_session *session, qdot_given_functions *f);
void qdot_given_functions_clear(qdot_given_functions *f);

/* The expression e with these functions replaced by their values; parameters stay. Nil: the pool keeps the failure. */
qdot_expr qdot_export_bound(qdot_session *session, qdot_expr e);
/* The number that `set` gave a parameter; NaN if none. */
QDOT_MUST_CHECK qdot_status qdot_export_value_of(qdot_session *session, qdot_expr parameter,
                                                 double *value);

#endif
