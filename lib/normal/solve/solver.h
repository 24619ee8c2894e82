/* solver.h -- the state of one call of qdot_solve, for the files of normal/solve/. */
#ifndef QDOT_NORMAL_SOLVER_H
#define QDOT_NORMAL_SOLVER_H

#include "normal/field/factor.h"
#include "normal/solve/solutions.h"
#include "normal/solve/written.h"

typedef struct {
    qdot_pool *pool;
    qdot_expr f, x;
    qdot_written written; /* conditions for the equation as typed to be defined, which each root must satisfy */
    const qdot_facts *facts;
    qdot_solutions *out;
    int depth; /* how often the equation has been derived from another one, as log(x) = sin(v) from asin(log(x)) = v */
    qdot_status status;
} qdot_solver;

/* In all functions below `when` is a set of conditions; those that contain x are decided at each root. */

/* Find every x with e = 0, e being an expression in x (solver.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_equation(qdot_solver *s, qdot_expr e, qdot_expr when);
/* Add the root `value`, with its period or nil, if it satisfies the equation and the conditions `when` (solver.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_add(qdot_solver *s, qdot_expr value, qdot_expr period,
                                            qdot_expr when);
/* The root `value` where e is 0: in regions of parameters on the sides of its choices; else e is noted as a divisor, for
 * its zeros are special values (solver.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_add_where(qdot_solver *s, qdot_expr value, qdot_expr e,
                                                  qdot_expr when);
/* Whether a value differs from the members of a family by an integer number of periods (solver.c). */
bool qdot_solver_is_member(const qdot_solver *s, const qdot_root *family, qdot_expr value);
/* Record that the solution divided by d, which does not contain x (solver.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_divide(qdot_solver *s, qdot_expr d);
/* The expression e, simplified (solver.c). */
qdot_expr qdot_solver_tidy(const qdot_solver *s, qdot_expr e);
/* The condition 0 <= gap; 0 < gap if the gap contains only generic parameters (solver.c). */
qdot_expr qdot_solver_positive(const qdot_solver *s, qdot_expr gap);

typedef struct {
    qdot_expr value, when;
} qdot_argument; /* an argument u at which a function takes the required value */

typedef qdot_vec(qdot_argument) qdot_arguments;

/* Add all real y for which the polynomial sum c_k y^k = 0, c [degree + 1], to *out (solve-polynomial.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_polynomial(qdot_solver *s, const qdot_expr *c, int64_t degree, qdot_expr when,
                                                   qdot_arguments *out);

/* Solve g(x) = v for an elementary function g of one argument (solve-inverse.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_invert(qdot_solver *s, qdot_expr g, qdot_expr v,
                                               qdot_expr when);
/* Solve u(x) = w[i] + 2 pi k for every integer k (solve-inverse.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_turns(qdot_solver *s, qdot_expr u, size_t n,
                                              const qdot_expr *w, qdot_expr when);
/* Solve a sin u + b cos u + d = 0 (solve-inverse.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_mixed(qdot_solver *s, qdot_expr u, qdot_expr a,
                                              qdot_expr b, qdot_expr d, qdot_expr when);

/* Solve e = a b^p + c = 0 with x in b alone, a sum, and p = m/n, m above 1 (or below -1), n even: b = (-c/a)^(1/p), without
 * raising the equation to the power n. *done: whether e is so (solve-inverse.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_power(qdot_solver *s, qdot_expr e, qdot_expr when, bool *done);

/* Solve e = 0 on each side of the switch to which `choice` (sides.h) belongs (solve-cases.c). */
QDOT_MUST_CHECK qdot_status qdot_solver_cases(qdot_solver *s, qdot_expr e, qdot_expr choice,
                                              qdot_expr when);

#endif
