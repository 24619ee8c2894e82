/* scales.h -- what `scale` has said, and the scales of a run.
 *
 * Tests  tests/script/starts/scale.lag, tests/bad/starts/scale-*.lag
 */
#ifndef QDOT_LANG_SCALES_H
#define QDOT_LANG_SCALES_H

#include "lang/session/parts.h"

/* Set the scale of q, q' or t. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_scales_set(qdot_session *session, qdot_expr symbol,
                                            qdot_expr value);
/* No scale is said of q and q' any more. */
void qdot_scales_forget(qdot_session *session, qdot_expr q);

/* QDOT_EINVAL if the scale is not positive; it may contain parameters that have no value yet. */
QDOT_MUST_CHECK qdot_status qdot_scales_check(qdot_session *session, qdot_expr symbol,
                                              qdot_expr value);

/* The scales said, of q, then of q', in the order of the scene's coordinates, 0 where none was:
 * that of q' is q's over t's if these were. *scales [2n] is the caller's; NULL: none was said.
 * Errors: QDOT_EINVAL, QDOT_EUNSET, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_scales_of_run(qdot_session *session, double **scales);

#endif
