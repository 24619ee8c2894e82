/* shortest.h -- the shortest form of an expression.
 *
 * Among equal forms (normal form, factored, Pythagoras either way, sums of angles, common factors
 * out, collected in velocities and accelerations) the one with the fewest operations.
 * Deterministic. Works on any kind of value; never fails for size: when its work budget is
 * spent it returns the best form so far (e itself if none).
 */
#ifndef QDOT_NORMAL_SHORTEST_H
#define QDOT_NORMAL_SHORTEST_H

#include "normal/field/facts.h"

/* The shortest form of e; the relations among the facts are used, the conditions are not. */
qdot_expr qdot_shortest(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* The same with a budget for each scalar, in operations on terms of polynomials;
 * *spent: whether one was used up, so that there may be a shorter form. */
enum { QDOT_SHORTEST_WORK = 4000000 };
qdot_expr qdot_shortest_within(qdot_pool *pool, qdot_expr e, const qdot_facts *facts,
                               int64_t work, bool *spent);

#endif
