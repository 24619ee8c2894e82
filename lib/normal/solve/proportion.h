/* proportion.h -- decides whether two equations are the same up to a factor. */
#ifndef QDOT_NORMAL_PROPORTION_H
#define QDOT_NORMAL_PROPORTION_H

#include "expr/symbol.h"
#include "normal/prove/decide.h"

/* Symbols that the factor between two equations of motion must not hold, as bits of qdot_node.holds: with the first the
 * factor may hold coordinates, with the second velocities too. */
enum {
    QDOT_FACTOR_OF_PLACE = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER,
    QDOT_FACTOR_OF_STATE = QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER
};

/* Two equations are equal when one residual is the other times a factor free of `fixed` that is nonzero inside the
 * declared domains; if they hold nothing of `fixed`, the factor must not vanish with a coordinate. a, b: residuals. *factor:
 * the factor if proved; *may_vanish: it could be zero somewhere in the domains (a notice is due). */
QDOT_MUST_CHECK qdot_status qdot_decide_proportional(qdot_pool *pool, qdot_expr a, qdot_expr b,
                                                     uint32_t fixed, const qdot_facts *facts,
                                                     qdot_decision *decision,
                                                     qdot_expr *factor, bool *may_vanish);

#endif
