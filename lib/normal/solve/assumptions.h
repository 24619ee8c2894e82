/* assumptions.h -- what `assume` states, as the search for solutions uses it.
 *
 *     a = b      of parameters: the value of one of them, which is put in
 *     x > 0      of an unknown: part of its domain
 *
 * Tests  tests/normal/solve/test_assumptions.c
 */
#ifndef QDOT_NORMAL_ASSUMPTIONS_H
#define QDOT_NORMAL_ASSUMPTIONS_H

#include "base/memory.h"
#include "normal/field/facts.h"

typedef struct {
    qdot_facts facts;               /* facts without the inequalities of unknowns; borrows the array `others` */
    qdot_expr domain; /* inequalities of the unknowns, a set of conditions (conditions.h); nil: none */
    qdot_vec(qdot_expr) from, to; /* parameters, and the values that replace them, which contain none of these parameters */
    qdot_vec(qdot_expr) others;
} qdot_assumptions;

/* Read the facts for a search of the unknowns, a LIST. An equation that has several solutions, or one that depends on
 * whether a parameter is 0, gives no value. *a is cleared by the caller in any case. */
QDOT_MUST_CHECK qdot_status qdot_assumptions_read(qdot_pool *pool, const qdot_facts *facts, qdot_expr unknowns,
                                                  qdot_assumptions *a);
void qdot_assumptions_clear(qdot_assumptions *a);

/* The expression e with the recorded parameter values inserted (nil stays nil). */
qdot_expr qdot_assumptions_put(qdot_pool *pool, const qdot_assumptions *a, qdot_expr e);

#endif
