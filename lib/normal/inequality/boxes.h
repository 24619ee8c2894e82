/* boxes.h -- conditions that no point of the declared domains fulfils, by bounds over boxes.
 *
 * The box of all domains is halved until in each part one condition is proved false by bounds of its values: cos(a/2) < 0
 * for 0 < a < pi. Ended early where all conditions hold in a whole part.
 *
 * Tests  tests/script/solve/conditions-never.lag
 */
#ifndef QDOT_NORMAL_BOXES_H
#define QDOT_NORMAL_BOXES_H

#include "normal/field/facts.h"

/* *never: no values of the symbols in the conditions of `facts` fulfil all of these. Of few symbols, with a bounded number
 * of parts; relations of `facts` are not looked at. Errors: QDOT_ENOMEM, QDOT_EINTR, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_boxes_exclude(qdot_pool *pool, const qdot_facts *facts, bool *never);

#endif
