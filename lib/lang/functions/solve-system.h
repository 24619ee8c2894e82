/* solve-system.h -- solve([A = B, C = D], [x, y]), several unknowns: exactly, in numbers, from a guess.
 *
 * Exact solutions are those of normal/solve/simultaneous.h. Where they are not proved to be all and every parameter has a
 * value, the declared domains are searched in numbers, and the list is given if that proves it to be whole; solutions
 * that are known exactly stand in it so.
 *
 * Tests   tests/script/solve/solve-system.lag, solve-system-sets.lag, solve-numbers.lag, tests/bad/solve/solve-system-*.lag
 */
#ifndef QDOT_LANG_SOLVE_SYSTEM_H
#define QDOT_LANG_SOLVE_SYSTEM_H

#include "lang/session/parts.h"

/* The solutions as a LIST of LISTs of equations u = value. `domain`: conditions on solutions
 * besides the equations. */
QDOT_MUST_CHECK qdot_status qdot_solve_system(qdot_session *session, qdot_expr equations,
                                              qdot_expr unknowns, qdot_expr domain,
                                              qdot_expr *value);

/* Solve several equations numerically from a guess, a LIST of equations u = number; gives a LIST of numbers. */
QDOT_MUST_CHECK qdot_status qdot_solve_system_near(qdot_session *session,
                                                   qdot_expr equations,
                                                   qdot_expr guesses, qdot_expr domain,
                                                   qdot_expr *value);

#endif
