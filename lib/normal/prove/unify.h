/* unify.h -- makes arguments that are equal by the field's rules the same node.
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

#include "normal/prove/equal.h"

/* The procedures by which arguments are proved equal. */
typedef struct {
    qdot_prover prove;   /* called a limited number of times */
    qdot_prover harder;  /* a stronger prover, tried if `prove` fails; NULL: none */
    bool only_undefined; /* treat only arguments of undefined functions */
} qdot_unify_way;

/* Rewrite e[n] in place; the relations of facts may be used, and are among the e if they
 * are to be rewritten. *changed. Errors: QDOT_ENOMEM, QDOT_EINTR; the pool may keep a
 * failure. */
QDOT_MUST_CHECK qdot_status qdot_unify(qdot_pool *pool, size_t n, qdot_expr *e,
                                       const qdot_facts *facts, const qdot_unify_way *way,
                                       bool *changed);

#endif
