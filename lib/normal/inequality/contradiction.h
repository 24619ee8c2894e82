/* contradiction.h -- do conditions contradict each other, or the declared domains?
 *
 * They do if one of them is proved false under the others: g <= 0 for a condition g > 0, r > 0 or
 * r < 0 for a relation r = 0; or if no box of the declared domains is left (boxes.h). Proofs under such conditions are worthless.
 *
 * Tests  tests/script/prove/check.lag
 */
#ifndef QDOT_NORMAL_CONTRADICTION_H
#define QDOT_NORMAL_CONTRADICTION_H

#include "normal/field/facts.h"

/* *found: a contradiction is proved. Only few and small conditions are tried. Errors:
 * QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_contradiction(qdot_pool *pool, const qdot_facts *facts,
                                               bool *found);

#endif
