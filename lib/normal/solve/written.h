/* written.h -- what an equation asks of its solutions as it was written.
 *
 * A root of a product is taken apart when it is built: sqrt(b x^2) becomes sqrt(b) |x|, which asks for b >= 0 where the
 * root that was written asks for b x^2 >= 0 alone. Where the root is 0 these differ: x = 0 solves sqrt(b x^2) = 0 for
 * every b.
 *
 * Tests  tests/normal/solve/test_solve-special.c
 */
#ifndef QDOT_NORMAL_WRITTEN_H
#define QDOT_NORMAL_WRITTEN_H

#include "normal/solve/conditions.h"

typedef struct {
    qdot_expr domain; /* conditions that each root must satisfy; nil: none */
    qdot_expr apart; /* conditions 0 <= u from roots that were split; not required where u = 0; nil: none */
} qdot_written;

/* Add the power base^exponent as it was written, of a root that was taken apart: `domain` gets the condition of its base,
 * `apart` those of the parts. Of others *asked gets the conditions of the power without those of its base. */
QDOT_MUST_CHECK qdot_status qdot_written_add(qdot_pool *pool, qdot_expr base, qdot_expr exponent, qdot_written *w,
                                             qdot_expr *asked);

/* Take roots of sums in *f apart, too, where a factor that holds x stands in the sum more than once: sqrt(a x^2 - x^4)
 * becomes |x| sqrt(a - x^2), and `apart` gets what that asks and `domain` does not. */
QDOT_MUST_CHECK qdot_status qdot_written_take_apart(qdot_pool *pool, qdot_expr *f, qdot_expr x, qdot_written *w);

/* The set of conditions without those that the set `some` contains. */
qdot_expr qdot_conditions_less(qdot_pool *pool, qdot_expr set, qdot_expr some);

/* Whether f = 0 at x = value whatever the values of the roots are whose conditions are in `apart`. */
QDOT_MUST_CHECK qdot_status qdot_written_lifts(qdot_pool *pool, const qdot_written *w, qdot_expr f, qdot_expr x,
                                               qdot_expr value, const qdot_facts *facts, bool *yes);

/* The conditions *when of a solution x = value that lifts: without those that are apart, and with x put in where the
 * roots fall out by that, as in sqrt(x - 3) |x - 1| <= 1 at x = 1. */
QDOT_MUST_CHECK qdot_status qdot_written_conditions(qdot_pool *pool, const qdot_written *w, qdot_expr x,
                                                    qdot_expr value, qdot_expr *when);

#endif
