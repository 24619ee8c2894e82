/* less.h -- is one number less than another? Tests: tests/normal/test_less.c */
#ifndef QDOT_NORMAL_LESS_H
#define QDOT_NORMAL_LESS_H

#include "normal/prove/decide.h"

/* Decide left < right (or <=) from signs and declared domains; else refute by a point. */
QDOT_MUST_CHECK qdot_status qdot_decide_less(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, bool strict,
                                             const qdot_facts *facts,
                                             qdot_decision *decision);

/* e with u for |u|, 1 for sign u where the conditions of `facts` make u > 0, and so with -u, -1; of
 * what declared domains say the constructors know. */
qdot_expr qdot_known_signs(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
