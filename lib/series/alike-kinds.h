/* alike-kinds.h -- finds the parts of a motion that are alike (alike.h).
 *
 * Tests  tests/series/test_taylor-alike.c
 */
#ifndef QDOT_SERIES_ALIKE_KINDS_H
#define QDOT_SERIES_ALIKE_KINDS_H

#include "series/alike.h"
#include "series/motion.h"

/* Give a motion all of whose unknowns are given by rows its like parts (motion->alike), which it frees; none if
 * few are alike. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_alike_find(qdot_motion *motion);

#endif
