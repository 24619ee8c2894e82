/* taylor-motion.h -- a motion in doubles, of one system, stage by stage.
 *
 * If its equations are explicit (motion.h), products of K are summed apart and integrals are links:
 * the whole expansion is machine code by taylor-code.h, its products in vectors, which taylor.h
 * begins and extends. Else the steps write the equations; code is that of lanes-motion.h, of scalars.
 *
 * Tests  tests/series/test_motion.c, test_taylor-code.c, tests/sim/form/test_taylor.c
 */
#ifndef QDOT_SERIES_TAYLOR_MOTION_H
#define QDOT_SERIES_TAYLOR_MOTION_H

#include "series/lanes-motion.h"
#include "series/taylor.h"

/* Of a motion, borrowed, for stages below `most`; `shaken`: with the other neighbours of its constants
 * (tape/shake.h). Code for explicit equations solves orders up to `solved` by a Cholesky factor. The
 * unit of time is set before the first stage. Errors: QDOT_EINVAL (most), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_of_motion(const qdot_motion *motion, bool shaken,
                                                  int most, int solved, qdot_taylor **taylor);
void qdot_taylor_set_unit(qdot_taylor *taylor, double unit);
const double *qdot_taylor_series(const qdot_taylor *taylor, qdot_program_row row);
/* Taylor coefficients of an entry of the Jacobian K = dE/du of the equations E = 0, which is row `row`; multiply them by
 * *sign, 1 or -1. */
const double *qdot_taylor_entry(const qdot_taylor *taylor, qdot_program_row row, double *sign);

/* Stage k with u_k = 0, as qdot_lanes_stage; by [solved] = -E_k then; u_k becomes `by`, as
 * qdot_lanes_change. Explicit equations read nothing of order k of the unknowns before the last. */
void qdot_taylor_stage(qdot_taylor *taylor, int k);
void qdot_taylor_missing(qdot_taylor *taylor, int k, double *by);
void qdot_taylor_change(qdot_taylor *taylor, int k, const double *by);

/* Of explicit equations, before orders are run as code: [2 n x n] of a block, by rows, for the factor
 * L of K, which orders up to `solved` are found by, and K^-1 for the others. */
double *qdot_taylor_matrices(const qdot_taylor *taylor, size_t block);

/* For code of lanes: where it is to be written to, and then, before it is run, what steps divide
 * by. */
qdot_lanes_rows qdot_taylor_get_rows(const qdot_taylor *taylor);
void qdot_taylor_set_inverses(const qdot_taylor *taylor);

#endif
