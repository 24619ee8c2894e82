/* rows.h -- a tape evaluated at many points: each operation for a block of points, so that it is read once for all of
 * them, and sums and products are those of vectors. The numbers are those of qdot_tape_eval, bit by bit.
 *
 * Tests  tests/tape/test_rows.c
 */
#ifndef QDOT_TAPE_ROWS_H
#define QDOT_TAPE_ROWS_H

#include "tape/tape.h"

enum { QDOT_TAPE_ROWS = 32 }; /* points in a block */

/* Evaluate at n points: in [n][inputs], out [n][outputs], row by row; they may not overlap.
 * work [qdot_tape_work QDOT_TAPE_ROWS]. Never fails; NaN and inf by IEEE 754. */
void qdot_tape_eval_rows(const qdot_tape *tape, size_t n, const double *in, double *out, double *work);

#endif
