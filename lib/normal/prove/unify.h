/* unify.h -- arguments that are equal by the field's rules made the same node.
 *
 * f(cos(2*z)) and f(1 - 2*sin(z)^2) are one function at one argument, but different
 * generators of a field that does not look into f. Functions and bases of roots are
 * compared, inner ones first: where two arguments have a constant rational ratio at
 * points of the domain, the ratio is proved, and one is written by the other:
 *
 *     f(A) = f(B) if A = B;
 *     |A| = |c| |B|,   A^x = c^x B^x,   sin A = sin(c B) if A = c B.
 */
#ifndef QDOT_NORMAL_UNIFY_H
#define QDOT_NORMAL_UNIFY_H

#include "normal/field/facts.h"

/* Rewrite e[n] in place; the relations of facts may be used, and are among the e if they
 * are to be rewritten. `only_undefined`: undefined functions only, but their arguments
 * with all that qdot_prove_harder knows (else: qdot_prove_equal). *changed. Errors:
 * QDOT_ENOMEM, QDOT_EINTR; the pool may keep a failure. */
QDOT_MUST_CHECK qdot_status qdot_unify(qdot_pool *pool, size_t n, qdot_expr *e,
                                       const qdot_facts *facts, bool only_undefined,
                                       bool *changed);
#endif
