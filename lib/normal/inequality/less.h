/* less.h -- decides whether one number is less than another. Tests: tests/normal/inequality/test_less.c */
#ifndef QDOT_NORMAL_LESS_H
#define QDOT_NORMAL_LESS_H

#include "normal/prove/decide.h"

/* Decide left < right (or <=): prove it from signs and declared domains, or refute it by a point. */
QDOT_MUST_CHECK qdot_status qdot_decide_less(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, bool strict,
                                             const qdot_facts *facts,
                                             qdot_decision *decision);

/* e with u for |u| and 1 for sign u if the conditions of `facts` imply u > 0, likewise -u and -1, and with the branch of
 * an if whose condition they decide; the constructors use the declared domains already. */
qdot_expr qdot_known_signs(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
