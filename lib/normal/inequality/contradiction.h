/* contradiction.h -- do conditions contradict each other, or the declared domains?
 *
 * They do where one of them is proved false under the others: g <= 0 for a condition g > 0, r > 0 or
 * r < 0 for a relation r = 0. What is proved under such conditions says nothing.
 *
 * Tests  tests/script/check.lag
 */
#ifndef QDOT_NORMAL_CONTRADICTION_H
#define QDOT_NORMAL_CONTRADICTION_H

#include "normal/field/facts.h"

/* *found: proved to. Only few and small ones are looked at. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_contradiction(qdot_pool *pool, const qdot_facts *facts,
                                               bool *found);

#endif
