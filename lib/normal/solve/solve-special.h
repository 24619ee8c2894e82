/* solve-special.h -- what a set of roots owes to the values of the parameters: where each root exists, and the sets
 * at special values, where a divisor of the solution is 0.
 *
 *     a x^2 + b x + c = 0:   two roots where 4 a c <= b^2 and a != 0;
 *                            for a = 0: x = -c/b where b != 0;  for a = 0 and b = 0 and c = 0: every x
 *
 * Tests  tests/normal/solve/test_solve-special.c
 */
#ifndef QDOT_NORMAL_SOLVE_SPECIAL_H
#define QDOT_NORMAL_SOLVE_SPECIAL_H

#include "normal/solve/solutions.h"
#include "normal/solve/written.h"

/* The set of roots of an equation at special values of its parameters. */
typedef struct {
    qdot_expr where; /* a LIST of equations parameter = value */
    qdot_solutions set;
} qdot_special;

typedef struct {
    qdot_vec(qdot_special) at;
    qdot_vec(qdot_expr) open; /* equations in parameters for which the roots may differ and are unknown */
} qdot_specials;

void qdot_specials_clear(qdot_specials *s);

/* The conditions without x under which f is defined, and those without x in `domain` (nil: none), under which the equation
 * is defined as it was written. */
qdot_expr qdot_solve_conditions(qdot_pool *pool, qdot_expr domain, qdot_expr f, qdot_expr x);

/* Add to the conditions of each root that its value is defined, and f in its parts without x, as `written` asks for it; leave
 * out those that follow from others, and roots without any values of the parameters. */
QDOT_MUST_CHECK qdot_status qdot_solve_parameters(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                                  const qdot_written *written, const qdot_facts *facts,
                                                  qdot_solutions *found);

/* The sets of f = 0 at special values, as far as they are not what `found` (by qdot_solve_written and
 * qdot_solve_parameters) says there; at values special for these in turn too. */
QDOT_MUST_CHECK qdot_status qdot_solve_specials(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                                const qdot_written *written, const qdot_facts *facts,
                                                const qdot_solutions *found, qdot_specials *out);

#endif
