/* solve.h -- the set of all real x with f(x) = 0, for the equations that occur in mechanics.
 *
 * f is factored; each factor must be, after resolving nested functions,
 *
 *     a polynomial in x, or in one function of x, of degree 1 or 2, or in a power of it;
 *     a polynomial in sin u or cos u alone of that kind; a sin u + b cos u = d;
 *     A cos^2 u + B sin u cos u = C, which is linear in sin 2u and cos 2u;
 *     A(cos u) + B(cos u) sin u, whose resolvent A^2 = (1 - cos^2 u) B^2 is of that kind;
 *     a polynomial in sinh u and cosh u, which is one in exp u;
 *     linear in a root r, r^q = b(x): its resolvent, with the sign that r must have;
 *
 * with |u(x)|, sign u(x), max, min and if(...) once for each case.
 *
 * A root is kept, dropped or given a condition by proof (normal/solve/conditions.h): it must be real, every part of
 * f must be defined there, and no step may have added it. Parameters are generic: values at which a leading
 * coefficient vanishes are not considered; divisors that hold other unknowns are listed.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_SOLVE_H
#define QDOT_NORMAL_SOLVE_H

#include "normal/solve/solutions.h"
#include "normal/solve/solve-factors.h"
#include "normal/solve/written.h"

/* All roots, whatever the declared domain of x (its sign is used); ascending where all are constants. f = 0
 * identically: QDOT_EDOMAIN. Past the bound of memory: none, not complete. facts may be NULL. *out is cleared by
 * the caller in any case. Errors: QDOT_ENOMEM, QDOT_EINTR, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_solve(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                       const qdot_facts *facts, qdot_solutions *out);
/* qdot_solve, and the members inside the declared domain of x, or in one turn of an angle. `domain`: conditions that
 * roots fulfil beside f = 0, or nil: of what stood in the equation before it was simplified; where f is 0 identically,
 * these alone. */
QDOT_MUST_CHECK qdot_status qdot_solve_inside(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                              qdot_expr domain, const qdot_facts *facts,
                                              qdot_solutions *out);

/* Solve as qdot_solve_inside does, for an equation given in the form in which it was typed. */
QDOT_MUST_CHECK qdot_status qdot_solve_written(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                               const qdot_written *written, const qdot_facts *facts,
                                               qdot_solutions *out);

/* Ranges of x in the window on which f = 0, for f of x and constants with |u|, sign, max, min, if or floor of x: each is a
 * root x with its conditions; the single roots in the window too. `domain` as above. Where f is 0 on no range of x,
 * inside the window or not, *out is empty and not complete. */
QDOT_MUST_CHECK qdot_status qdot_solve_ranges(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                              qdot_expr domain, const qdot_window *window,
                                              qdot_solutions *out);

/* Find as a LIST those factors of f with x that qdot_solve does not solve completely. *all: f has no other factors. */
QDOT_MUST_CHECK qdot_status qdot_solve_unsolved(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                                const qdot_facts *facts, qdot_expr *list,
                                                bool *all);

/* Sort roots [n] by value if all are constants; otherwise leave their order. */
QDOT_MUST_CHECK qdot_status qdot_solve_sort(qdot_pool *pool, size_t n, qdot_root *roots);

#endif
