/* relative.h -- expressions written in differences of angles.
 *
 * If e holds the angles a_1 ... a_n within sines and cosines only, and does not change when all of them grow alike, it is a
 * polynomial in the sines and cosines of d_k = a_k - a_(k+1). There cos(a1 - a2) cos(a2 - a3) sin(a3 - a4) is one term; as a
 * sum of waves, or in sines and cosines of the a_k, it has 2^(n-2) or more. Chains of bodies that turn with the scene as a
 * whole (trailers, links without gravity) have such expressions.
 *
 * Tests   tests/normal/simplify/test_relative.c
 */
#ifndef QDOT_NORMAL_RELATIVE_H
#define QDOT_NORMAL_RELATIVE_H

#include "normal/field/facts.h"

/* e simplified in differences of its angles, symbols with integer multiples in sines and cosines, in their order; nil where
 * e has fewer than two or depends on more than their differences, and on failure, which the pool keeps. */
qdot_expr qdot_simplify_relative(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
