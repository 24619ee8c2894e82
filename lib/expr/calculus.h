/* calculus.h -- derivatives, substitution, expansion.
 *
 * All work on any kind of value: they map over equations, vectors, matrices and lists.
 */
#ifndef QDOT_EXPR_CALCULUS_H
#define QDOT_EXPR_CALCULUS_H

#include "expr/id.h"

/* de/dx, all other symbols held: q, q', q'', t, parameters are independent. x a SYM, else
 * QDOT_ETYPE. */
qdot_expr qdot_diff(qdot_pool *pool, qdot_expr e, qdot_expr x);

/* Total time derivative: q -> q', q' -> q'', t -> 1, multipliers and momenta held constant is
 * wrong, so they are QDOT_EDOMAIN. */
qdot_expr qdot_ddt(qdot_pool *pool, qdot_expr e);

/* The total differential of e: the sum of de/dq dq over the coordinates, plus de/dt dt. */
qdot_expr qdot_differential(qdot_pool *pool, qdot_expr e);

/* Make n replacements at once; from[i] may be any node, usually a symbol. */
qdot_expr qdot_subs(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *from,
                    const qdot_expr *to);

/* Multiply out products of sums, and integer powers of sums. */
qdot_expr qdot_expand(qdot_pool *pool, qdot_expr e);

/* e as a sum over powers of x (a symbol or any node): expanded in x only. */
qdot_expr qdot_collect(qdot_pool *pool, qdot_expr e, qdot_expr x);

/* Coefficient of x^n in e, a polynomial in x, after collecting powers. QDOT_EDOMAIN if e is no
 * polynomial in x. */
qdot_expr qdot_coefficient(qdot_pool *pool, qdot_expr e, qdot_expr x, int64_t n);

/* Whether e holds floor, mod, sign or `if` of something that moves with one of `holds`
 * (QDOT_HAS_...): its derivative is that between the jumps. */
QDOT_MUST_CHECK qdot_status qdot_jumps(qdot_pool *pool, qdot_expr e, uint32_t holds, bool *yes);

#endif
