/* lanes-motion.h -- the stages of a motion as machine code (lanes-code.h), of eight systems at once or
 * of one.
 *
 * Stage k is as in motion.h, the unknowns of a block being -K^-1 E by the inverse of K: order 0, and
 * what comes before it, are the caller's, by kernels.
 *
 * Tests  tests/series/test_motion.c, tests/sim/form/test_motion.c
 */
#ifndef QDOT_SERIES_LANES_MOTION_H
#define QDOT_SERIES_LANES_MOTION_H

#include "series/lanes-code.h"

typedef struct qdot_lanes_motion qdot_lanes_motion;

/* For motions with larger blocks of coupled unknowns no machine code is generated. */
enum { QDOT_LANES_SOLVED = 16 };

/* Stages 1 ... to, of rows of the motion's program; all borrowed. Up to stage `factored` a block is
 * solved by the factor of K = L L^T. *code NULL: as qdot_lanes_code_new, or a block is large.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_lanes_motion_new(const qdot_lanes_rows *rows,
                                                  const qdot_motion *motion, int to,
                                                  int factored, qdot_lanes_motion **code);
void qdot_lanes_motion_free(qdot_lanes_motion *code);
/* Of block b, with n unknowns, the inverse of K [n rows of `length` groups], and L [n x n groups]
 * where stages are solved by it and n > 1. Then all of it is run, unit being a group. */
void qdot_lanes_motion_set(qdot_lanes_motion *code, size_t b, const double *inverse,
                           size_t length, const double *L);
void qdot_lanes_motion_run(qdot_lanes_motion *code, const double *unit);
size_t qdot_lanes_motion_size(const qdot_lanes_motion *code);
int qdot_lanes_motion_orders(const qdot_lanes_motion *code);

#endif
