/* linear-rows.h -- does e > 0 follow from linear inequalities?
 *
 * With c_i.x + d_i > 0 (or >= 0) for the conditions and -e >= 0 added, one symbol after another is eliminated: a row with
 * a positive coefficient of it and a row with a negative one are added so that the symbol drops out. What is left are
 * numbers; the rows contradict each other if and only if one of these is wrong, 0 > 0 or -1 >= 0.
 *
 * Source  Dantzig and Eaves, "Fourier-Motzkin elimination and its dual", J. Combinatorial Theory A 14 (1973) 288.
 * Tests   tests/normal/inequality/test_linear-rows.c
 */
#ifndef QDOT_NORMAL_LINEAR_ROWS_H
#define QDOT_NORMAL_LINEAR_ROWS_H

#include "normal/inequality/cells.h"

/* As qdot_cells_decide, without a point: EMPTY where the conditions contradict each other, POSITIVE, NOT_NEGATIVE, else
 * NEGATIVE; each of them exact. UNKNOWN: e or a condition is not linear in its symbols, or the rows are too many. Errors:
 * QDOT_ENOMEM, QDOT_EINTR, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_linear_decide(qdot_pool *pool, qdot_expr e, size_t n,
                                               const qdot_cells_condition *condition, qdot_cells *result);

#endif
