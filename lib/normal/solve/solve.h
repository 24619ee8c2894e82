/* solve.h -- all real x with f(x) = 0, for the equations that occur in mechanics.
 *
 * f is factored; each factor must be, after resolving nested functions,
 *
 *     a polynomial in x, or in one function of x, of degree 1 or 2, or in a power of it;
 *     a polynomial in sin u or cos u alone of that kind; a sin u + b cos u = d;
 *     A(cos u) + B(cos u) sin u, whose resolvent A^2 = (1 - cos^2 u) B^2 is of that kind;
 *     linear in a root r, r^q = b(x): its resolvent, each solution tested;
 *
 * with |u(x)| and sign u(x) once for either sign of u.
 *
 * Angles (u rational in x) are given in -pi < x <= pi, else in x's declared domain.
 * Solutions outside that, or where f is not defined, are dropped; a solution that is real only
 * for some parameters carries that condition. Parameters are generic: values at which a leading
 * coefficient vanishes are not considered.
 *
 * Tests  tests/normal/test_solve.c
 */
#ifndef QDOT_NORMAL_SOLVE_H
#define QDOT_NORMAL_SOLVE_H

#include "normal/field/facts.h"

typedef struct {
    qdot_expr value;
    qdot_expr condition; /* a LIST of RELs under which it is real; nil: always */
} qdot_root;

/* *roots [*n], owned by the caller, ascending where all are constants; *complete: these are all there are. f = 0
 * identically: QDOT_EDOMAIN. Past the bound of memory: none, not complete. facts may be NULL. */
QDOT_MUST_CHECK qdot_status qdot_solve(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                       const qdot_facts *facts, qdot_root **roots,
                                       size_t *n, bool *complete);

/* The innermost u of |u| and sign u in f that holds x, nil: none; and qdot_solve where there is
 * one: a case for u > 0 and one for u < 0, their roots with that as a condition. */
qdot_expr qdot_solve_sign(qdot_pool *pool, qdot_expr f, qdot_expr x);
QDOT_MUST_CHECK qdot_status qdot_solve_by_sign(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                               const qdot_facts *facts, qdot_root **roots,
                                               size_t *n, bool *complete);

/* A list of conditions (nil: none) and one more; QDOT_FALSE if one is. */
qdot_expr qdot_solve_both(qdot_pool *pool, qdot_expr conditions, qdot_expr relation);

/* Sort them by their values, if all are constants; else they stay as they are. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_solve_sort(qdot_pool *pool, size_t n, qdot_root *roots);

/* The factors of f's numerator, each once, numbers left out: f = 0 where one of them
 * is. A LIST; f itself alone where it cannot be factored. */
qdot_expr qdot_solve_factors(qdot_pool *pool, qdot_expr f);

/* e as a product of irreducible factors, numerator and denominator. */
qdot_expr qdot_solve_product(qdot_pool *pool, qdot_expr e);

#endif
