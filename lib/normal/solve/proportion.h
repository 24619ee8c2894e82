/* proportion.h -- decides whether two equations are the same up to a factor. */
#ifndef QDOT_NORMAL_PROPORTION_H
#define QDOT_NORMAL_PROPORTION_H

#include "normal/prove/decide.h"

/* Two equations are equal when one residual is the other times a factor free of velocities and
 * accelerations that is nonzero inside the declared domains. a, b: residuals. *factor: the
 * factor if proved; *may_vanish: it could be zero somewhere in the domains (a notice is due). */
QDOT_MUST_CHECK qdot_status qdot_decide_proportional(qdot_pool *pool, qdot_expr a,
                                                     qdot_expr b, const qdot_facts *facts,
                                                     qdot_decision *decision,
                                                     qdot_expr *factor, bool *may_vanish);

#endif
