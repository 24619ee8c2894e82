/* circle.h -- sin(u)^2 + cos(u)^2 = 1 in the sums of an expression:
 *
 *     c sin(u)^2 + c cos(u)^2 + d -> c + d,   3 sin(u)^2 + 2 cos(u)^2 -> sin(u)^2 + 2.
 *
 * Nothing else is changed, so that what was put into an expression stays recognizable there.
 *
 * Tests  tests/script/definitions/squares-joined.lag
 */
#ifndef QDOT_NORMAL_CIRCLE_H
#define QDOT_NORMAL_CIRCLE_H

#include "expr/id.h"

/* Join sin(u)^2 and cos(u)^2 in e, of any kind of value; e itself if there are none to join. Nil on failure. */
qdot_expr qdot_circle_join(qdot_pool *pool, qdot_expr e);

#endif
