/* separation-split.h -- divide an expression into one of (q, p) and one of the other coordinates and momenta.
 *
 * Tests  tests/mech/hamilton/test_separation.c
 */
#ifndef QDOT_MECH_SEPARATION_SPLIT_H
#define QDOT_MECH_SEPARATION_SPLIT_H

#include "mech/scene/things.h"

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    size_t n;                 /* number of others */
    qdot_expr q, p;           /* the coordinate and the momentum */
    const qdot_expr *oq, *op; /* [n] those of the others */
} qdot_split;

/* Whether the e are without q and p; without the others. */
bool qdot_split_is_other(const qdot_split *x, qdot_expr e);
bool qdot_split_is_own(const qdot_split *x, qdot_expr e);

/* e = *own + *other; false: they are mixed, which is proved by no means, or the pool failed. What holds neither is own. */
bool qdot_split_sum(const qdot_split *x, qdot_expr e, qdot_expr *own, qdot_expr *other);
/* The factor of e that holds q, e = own(q) other(others); nil: e is no such product. */
qdot_expr qdot_split_factor(const qdot_split *x, qdot_expr e);

#endif
