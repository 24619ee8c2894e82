/* solve.h -- the function solve(...): exactly, in numbers over a range, in numbers from a guess.
 *
 *     solve(A = B, x)                             every value in the domain of x: exact; where no formula gives them
 *                                                 in numbers, if all are proved to be found
 *     solve([A = B, C = D], [x, y])               the same in several unknowns (solve-system.h)
 *     solve(A = B, x, a..b)                       every zero in a..b, in numbers
 *     solve(A = B, x = guess)                     the one that Newton's steps reach
 *     solve([A = B, C = D], [x = 1, y = 2])       the same in several unknowns
 *
 * Where A and B, as they were written, are not defined there is no solution, though what is left of them after
 * simplification may be: solve(sin(asin(x)) = a, x) asks for -1 <= a <= 1.
 *
 * Tests   tests/script/solve/solve.lag, solution-sets.lag, solve-domains.lag, solve-line.lag, solve-special.lag
 */
#ifndef QDOT_LANG_SOLVE_H
#define QDOT_LANG_SOLVE_H

#include "lang/session/parts.h"

/* args [n]: n = 4 if a range is given, its ends stand last. What stood in them before simplification is in
 * session->passed. */
QDOT_MUST_CHECK qdot_status qdot_solve_call(qdot_session *session, uint32_t n,
                                            const qdot_expr *args, qdot_expr *value);

#endif
