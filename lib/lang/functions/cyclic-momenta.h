/* cyclic-momenta.h -- the value `cyclic`: the equations p[phi] = dL/dphi' of the cyclic coordinates.
 *
 * Tests  tests/script/studies/cyclic-by-coordinate.lag
 */
#ifndef QDOT_LANG_CYCLIC_MOMENTA_H
#define QDOT_LANG_CYCLIC_MOMENTA_H

#include "lang/session/parts.h"

/* All of them as a LIST; with an index (n = 1) one: the k-th, or that of a coordinate. QDOT_EINVAL: the coordinate is not cyclic. */
QDOT_MUST_CHECK qdot_status qdot_session_cyclic(qdot_session *session, uint32_t n, const qdot_expr *index, qdot_expr *value);

#endif
