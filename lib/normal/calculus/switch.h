/* switch.h -- finds functions that switch at a point: abs(x) at 0, floor(x) at 1, if(x > 0, ...)
 * at 0. */
#ifndef QDOT_NORMAL_SWITCH_H
#define QDOT_NORMAL_SWITCH_H

#include "expr/function.h"
#include "normal/field/facts.h"

/* Find the first subexpression *part of e that jumps or has a kink at ray = 0; nil if none does. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_switch_find(qdot_pool *pool, qdot_expr e, qdot_expr ray,
                                             const qdot_facts *facts, qdot_expr *part);
/* Whether a function of one argument jumps or has a kink where the argument has the value `there`. */
bool qdot_switch_at(qdot_pool *pool, qdot_fun_id id, qdot_expr there,
                    const qdot_facts *facts);

/* Whether e holds a function of x that may jump where it is defined, such as sign, floor or if. Without one, e is
 * continuous in x wherever it is defined. */
bool qdot_has_steps(qdot_pool *pool, qdot_expr e, qdot_expr x);

#endif
