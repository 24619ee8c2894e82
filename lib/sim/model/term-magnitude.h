/* term-magnitude.h -- how large the terms of an expression are, of which rounding is a part.
 *
 *     |e| <= sum |c_k t_k|   of a sum  e = sum c_k t_k;   |e| of anything else
 *
 * DBL_EPSILON times that is what evaluating e in doubles may be off by, where its terms
 * cancel: T + V of a run whose energy is 0.
 */
#ifndef QDOT_SIM_TERM_MAGNITUDE_H
#define QDOT_SIM_TERM_MAGNITUDE_H

#include "sim/course/course.h"

/* That sum, as an expression; nil absorbs. */
qdot_expr qdot_size_of(qdot_pool *pool, qdot_expr e);

/* Its values along a course: sizes [k x m] of exprs [m] at times [k], row by row; NaN where it
 * has none. Errors: as qdot_reader_lower and qdot_reader_at. */
QDOT_MUST_CHECK qdot_status qdot_size_along(const qdot_plan *plan,
                                            const qdot_course *course, size_t m,
                                            const qdot_expr *exprs, size_t k,
                                            const double *times, double *sizes);

#endif
