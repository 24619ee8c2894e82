/* solve-numbers.h -- zeros in numbers, with the values of `set`.
 *
 * Each is proved to be a zero, has its error, and stands in expressions like a number of a run. What cannot be proved
 * is told in a notice: a zero that is not simple, a place that is not decided, a search that was ended.
 * `domain`: conditions that a solution fulfils beside its equations (normal/solve/conditions.h); nil: none.
 *
 * Tests   tests/script/solve/solve-numbers.lag, solve-line.lag, tests/bad/solve/solve-*.lag, tests/normal/solve/test_zeros.c
 */
#ifndef QDOT_LANG_SOLVE_NUMBERS_H
#define QDOT_LANG_SOLVE_NUMBERS_H

#include "lang/session/parts.h"
#include "normal/solve/solutions.h"

/* Evaluate solve(equation, x, a..b): a LIST. */
QDOT_MUST_CHECK qdot_status qdot_solve_range(qdot_session *session, qdot_expr equation,
                                             qdot_expr x, qdot_expr domain,
                                             const qdot_expr *ends, qdot_expr *value);

/* Evaluate solve(equation, x = guess): a number; of [n] equations, or with `list`: a LIST of numbers. */
QDOT_MUST_CHECK qdot_status qdot_solve_near(qdot_session *session, uint32_t n,
                                            const qdot_expr *equations,
                                            const qdot_expr *unknowns, qdot_expr domain,
                                            bool list, qdot_expr *value);

/* Every zero of f in the window. *all: it is proved that there are no others; else notices tell which places are not
 * decided. *known false: zeros are not excluded far away or too many, or f holds what has no value; then none is given. */
typedef struct {
    qdot_expr value; /* the zero, a number with its error */
    double at, radius;
} qdot_solve_zero;
typedef qdot_vec(qdot_solve_zero) qdot_solve_zeros;

QDOT_MUST_CHECK qdot_status qdot_solve_line(qdot_session *session, qdot_expr f,
                                            qdot_expr x, qdot_expr domain,
                                            const qdot_window *window,
                                            qdot_solve_zeros *zeros, bool *known,
                                            bool *all);

/* Every common zero of f [n] in the unknowns u [n] in their windows: *list, a LIST of LISTs u = number, and at
 * [*count * n], its radius behind it [*count * n]; owned by the caller. *known: it is proved that there are no others;
 * else none is given. */
QDOT_MUST_CHECK qdot_status qdot_solve_box(qdot_session *session, size_t n,
                                           const qdot_expr *f, const qdot_expr *u,
                                           qdot_expr domain, const qdot_window *window,
                                           qdot_expr *list, double **at, size_t *count,
                                           bool *known);

#endif
