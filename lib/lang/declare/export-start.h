/* export-start.h -- where an exported motion starts: as the latest run of the scene does, else as the statements `start` say,
 * the rates of first-order states being those at that place.
 *
 * Tests  tests/meta/exports.test
 */
#ifndef QDOT_LANG_EXPORT_START_H
#define QDOT_LANG_EXPORT_START_H

#include "lang/session/session.h"
#include "show/export.h"

/* Where the start goes. */
typedef struct {
    qdot_export_system *x; /* its fields t0, t1, tol are filled in */
    double *start;         /* [2n] filled in: q, q'; NaN: it depends on a parameter without a value */
    const qdot_expr *parameters;
    qdot_export_name *values; /* [k] filled in: the values of the parameters in the run that is continued */
} qdot_export_started;

/* massless: a coordinate has no mass, so that its start follows from its equation. QDOT_EINVAL: only a run has the start. */
QDOT_MUST_CHECK qdot_status qdot_export_start(qdot_session *s, bool massless, const qdot_export_started *to);

#endif
