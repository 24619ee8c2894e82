/* facts.h -- assumptions for a decision or a simplification, in addition to the declared domains.
 *  */
#ifndef QDOT_NORMAL_FACTS_H
#define QDOT_NORMAL_FACTS_H

#include "expr/id.h"

/* Assumptions: relations (each a scalar expression that is 0) and conditions (RELs that sample
 * points must satisfy). Arrays borrowed. */
typedef struct {
    size_t n_relations;
    const qdot_expr *relations;
    size_t n_conditions;
    const qdot_expr *conditions;
    /* Undefined functions in the relations: only the relations themselves restrict their
     * derivatives up to this order. 0: consequences of the relations may restrict higher
     * derivatives. 2: the relations are constraints of a motion whose accelerations are
     * substituted. */
    uint32_t free_derivatives;
    /* A LIST (or nil) of subexpressions that must be defined where sides are compared, though
     * they may have been simplified away: sqrt(x) for sqrt(x)^2, which is x. */
    qdot_expr defined;
    /* Conditions hold for all values of the parameters, special ones too; else for generic ones: what is not 0 for all
     * of them is not 0. */
    bool exact;
} qdot_facts;

#endif
