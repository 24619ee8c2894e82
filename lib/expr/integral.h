/* integral.h -- integrals that stand as they are: of f over x from a to b, and a function of x of which f is the
 * derivative.
 *
 * A definite integral does not hold its variable: within the integrand that is a symbol of class QDOT_BOUND, numbered by
 * how many integrals stand between it and its own (1: none). So integrals that differ in the name of the variable only
 * are one node, and whatever is put for a symbol of the integrand is not captured. The name is kept for printing alone.
 * The ends may be QDOT_INFINITY and minus it.
 *
 * The value of a definite integral is that of the limit where an end is improper. What does not hold the variable stands
 * before the integral; an integrand that does not hold it gives f (b - a).
 *
 * A function F with dF/dx = f that was not found, integral(f, x), holds x. Another variable may be put for x; a value
 * may not (QDOT_EDOMAIN), because which of the functions F it is has never been said.
 *
 * Source  de Bruijn, "Lambda calculus notation with nameless dummies", Indag. Math. 34 (1972) 381.
 * Tests   tests/expr/test_integral.c
 */
#ifndef QDOT_EXPR_INTEGRAL_H
#define QDOT_EXPR_INTEGRAL_H

#include "expr/id.h"
#include "expr/walk.h"

/* The integral of f over the symbol x from a to b. QDOT_ETYPE: f, a or b is no number, x no variable. */
qdot_expr qdot_integral(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr a, qdot_expr b);
/* A function of x with the derivative f. */
qdot_expr qdot_integral_unfound(qdot_pool *pool, qdot_expr f, qdot_expr x);

bool qdot_integral_is_definite(const qdot_pool *pool, qdot_expr e);
/* The integrand of e as a function of the symbol x, which must not occur in it. */
qdot_expr qdot_integral_open(qdot_pool *pool, qdot_expr e, qdot_expr x);
/* The name by which the variable of the definite integral e was introduced. */
const char *qdot_integral_name(const qdot_pool *pool, qdot_expr e);
/* Whether e is infinity (1), minus infinity (-1) or neither (0). */
int qdot_infinite(const qdot_pool *pool, qdot_expr e);
/* Fail with QDOT_EDOMAIN where e holds infinity outside of the ends of integrals. */
QDOT_MUST_CHECK qdot_status qdot_infinity_refuse(const qdot_pool *pool, qdot_expr e);

/* --- for expr/ and for copies of nodes ------------------------------------------------------ */

/* The integral e with other args, in canonical form; those of a definite one as they stand in the node. */
qdot_expr qdot_integral_rebuild(qdot_pool *pool, qdot_expr e, const qdot_expr *args);
/* The same in another pool, to which the args have been copied. */
qdot_expr qdot_integral_copy(const qdot_pool *from, qdot_expr e, qdot_pool *to, const qdot_expr *args);
/* f, an integrand as it stands in a node, with `value` for its variable. */
qdot_expr qdot_integral_at(qdot_pool *pool, qdot_expr f, qdot_expr value);
/* Give the nodes of a walk over root that are reached without passing through an integrand a value other than 0. */
void qdot_integral_mark_outside(const qdot_pool *pool, struct qdot_walk *w, qdot_expr root);
/* The number of a symbol of class QDOT_BOUND; 0 for anything else. */
uint32_t qdot_bound_number(const qdot_pool *pool, qdot_expr e);

#endif
