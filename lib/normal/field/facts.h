/* facts.h -- what a decision or a simplification may use beside the declared domains. */
#ifndef QDOT_NORMAL_FACTS_H
#define QDOT_NORMAL_FACTS_H

#include "expr/expr.h"

/* What may be used: relations (each a scalar expression that is 0) and conditions (RELs that
 * sample points must satisfy). Arrays borrowed. */
typedef struct {
    size_t n_relations;
    const qdot_expr *relations;
    size_t n_conditions;
    const qdot_expr *conditions;
    /* Undefined functions in the relations: derivatives up to this order are bound by nothing but
     * the relations themselves. 0: their consequences may bind any that is higher than theirs. 2:
     * the relations are constraints of a motion whose accelerations are put in. */
    uint32_t free_derivatives;
    /* A LIST (or nil) of what must have values where sides are compared, though it may be gone from
     * them: sqrt(x) for sqrt(x)^2, which is x. */
    qdot_expr defined;
} qdot_facts;

#endif
