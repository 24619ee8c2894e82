/* solve-conditions.h -- what is told of a set of solutions: its conditions, and values of parameters at which it is
 * another one.
 *
 *     a x = b:   x = b/a exists when a != 0
 *     a x = 0:   for a = 0 every x is a solution
 *
 * Tests  tests/script/solve-special.lag
 */
#ifndef QDOT_LANG_SOLVE_CONDITIONS_H
#define QDOT_LANG_SOLVE_CONDITIONS_H

#include "base/memory.h"
#include "lang/session/session.h"
#include "normal/solve/solutions.h"

/* A parameter with a value at which a divisor is 0. */
typedef struct {
    qdot_expr parameter, value;
} qdot_special;

typedef struct {
    qdot_vec(qdot_special) at;
} qdot_specials;
void qdot_specials_clear(qdot_specials *s);

/* The special values of the parameters of f = 0, of which `found` are the solutions for generic ones. What the
 * solutions there are is told in a notice, where these are others. */
QDOT_MUST_CHECK qdot_status qdot_solve_specials(qdot_session *session, qdot_expr f,
                                                qdot_expr x, qdot_expr domain,
                                                const qdot_solutions *found,
                                                qdot_specials *specials);

/* A root as a value: x, or the relations that say which x are roots; with a notice of its conditions and of the special
 * values at which it is not defined. */
QDOT_MUST_CHECK qdot_status qdot_solve_root_value(qdot_session *session, qdot_expr x,
                                                  const qdot_root *root,
                                                  const qdot_specials *specials,
                                                  qdot_expr *value);

#endif
