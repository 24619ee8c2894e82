/* solve-system.h -- exact solutions of several equations in several unknowns, by elimination.
 *
 *     f_1(u) = 0, ..., f_n(u) = 0
 *
 * Each choice of one factor of every equation is a system of its own. If an equation holds one unknown only,
 * it is solved (solve.h) and its roots are put in. Else an unknown in which equations are polynomials is
 * eliminated by resultants,
 *
 *     Res_u(p, q) = det Sylvester(p, q),
 *
 * the others are solved for, and u by putting them in. Nothing is divided by, so no branch is lost; every
 * solution is put back into all equations.
 *
 * Source  Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, 3.6.
 * Tests   tests/normal/test_solve.c
 */
#ifndef QDOT_NORMAL_SOLVE_SYSTEM_H
#define QDOT_NORMAL_SOLVE_SYSTEM_H

#include "normal/field/facts.h"

enum { QDOT_SOLVE_UNKNOWNS = 6 };

/* *list: a LIST of solutions, each a LIST of equations u = value in the order of u [n], n up to
 * QDOT_SOLVE_UNKNOWNS. *complete: these are all for generic parameters; false also where a whole curve solves
 * them. facts may be NULL. Errors: QDOT_ENOMEM, QDOT_EINTR, QDOT_ETYPE (n too large). */
QDOT_MUST_CHECK qdot_status qdot_solve_system(qdot_pool *pool, size_t n,
                                              const qdot_expr *f, const qdot_expr *u,
                                              const qdot_facts *facts, qdot_expr *list,
                                              bool *complete);

#endif
