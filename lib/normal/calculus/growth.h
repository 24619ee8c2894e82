/* growth.h -- what an expression in X does as X tends to infinity: Gruntz's algorithm (limit.h).
 */
#ifndef QDOT_NORMAL_GROWTH_H
#define QDOT_NORMAL_GROWTH_H

#include "normal/field/facts.h"

/* A question about expressions in x, a symbol that is positive and tends to infinity. */
typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x, w;
    int depth;      /* questions within questions */
    int64_t work;      /* how many more may be asked */
    bool undefined; /* what was asked for is not real near infinity */
    qdot_expr undecided; /* the first expression free of x whose sign was needed and is not known; nil: none */
} qdot_growth;

/* The limit of e: a value, or QDOT_INFINITY or minus it. QDOT_EFAILED: not found. */
QDOT_MUST_CHECK qdot_status qdot_growth_limit(qdot_growth *g, qdot_expr e, qdot_expr *limit);
/* The sign of e for all large x: 1, -1, 0. QDOT_EFAILED: not found. */
QDOT_MUST_CHECK qdot_status qdot_growth_sign(qdot_growth *g, qdot_expr e, int *sign);

#endif
