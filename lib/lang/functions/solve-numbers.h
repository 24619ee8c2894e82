/* solve-numbers.h -- solve(...): exactly, in numbers over a range, in numbers from a guess.
 *
 *     solve(A = B, x)                             every value, exact (functions/algebra.h)
 *     solve([A = B, C = D], [x, y])               exactly, in several unknowns (normal/solve/solve-system.h)
 *     solve(A = B, x, a..b)                       every zero in a..b, in numbers
 *     solve(A = B, x = guess)                     the one that Newton's steps reach
 *     solve([A = B, C = D], [x = 1, y = 2])       the same in several unknowns
 *
 * Numbers are taken with the values of `set`. Each is proved to be a zero, has its error, and stands in
 * expressions like a number of a run. What cannot be proved is told in a notice: a zero that is not
 * simple, a place that is not decided, a search that was ended.
 *
 * Tests   tests/script/solve-numbers.lag, tests/bad/solve-*.lag, tests/normal/test_zeros.c
 */
#ifndef QDOT_LANG_SOLVE_NUMBERS_H
#define QDOT_LANG_SOLVE_NUMBERS_H

#include "lang/session/session.h"

/* args [n]: n = 4 if a range is given, its ends stand last. */
QDOT_MUST_CHECK qdot_status qdot_solve_call(qdot_session *session, uint32_t n,
                                            const qdot_expr *args, qdot_expr *value);

#endif
