/* domain.h -- substitutes symbols of known sign for conditions and declared bounds.
 *
 * A condition g > 0 with g = c x + rest is solved for x: x = (y - rest)/c with a new
 * symbol y > 0 in its place; a declared bound u > 3 likewise, u = 3 + y. What follows
 * from signs alone then shows by itself: abs(u - 3) is abs(y), so y. A relation that is
 * linear in a symbol, a x + b = 0 with a never zero, is solved and x put in everywhere.
 *
 * `implied`: conditions that hold wherever e[0] and e[1] are defined (defined.h) are used too.
 *
 * The domain of the new problem is not smaller, so a proof of it proves the original one.
 */
#ifndef QDOT_NORMAL_DOMAIN_H
#define QDOT_NORMAL_DOMAIN_H

#include "base/memory.h"
#include "normal/field/facts.h"

typedef qdot_vec(qdot_expr) qdot_exprs;

/* The conditions that could not be eliminated. */
typedef struct {
    qdot_exprs positive; /* left sides of the remaining conditions gap > 0; owned by the caller */
    bool empty; /* the conditions contradict each other: no point satisfies them */
} qdot_domain_rest;

/* Rewrite e[n] by substitutions that satisfy the conditions; the last nr are relations, 0 once they are solved. */
QDOT_MUST_CHECK qdot_status qdot_domain_unfold(qdot_pool *pool, const qdot_facts *facts,
                                               size_t n, qdot_expr *e, size_t nr,
                                               bool implied, qdot_domain_rest *rest);
#endif
