/* knots.h -- where the tables of data that a tape reads at a function of time alone go from one piece to the next.
 *
 *     u(t) = a + b t,   u passes a knot of the table (num/samples.h)
 *
 * f of a piece is smooth, f of the next one is another polynomial: a step that goes over a knot is not what it takes itself
 * for. So steps end at knots: at the first double of t, in the direction of the run, at which the tape reads the next piece.
 *
 * Tests  tests/tape/test_knots.c, tests/script/data/drive.sh
 */
#ifndef QDOT_TAPE_KNOTS_H
#define QDOT_TAPE_KNOTS_H

#include "base/memory.h"
#include "tape/tape.h"

/* Whether a tape reads tables of data. */
bool qdot_knots_any(const qdot_tape *tape);

typedef struct {
    double a, b, handle;
} qdot_knots_line;

typedef qdot_vec(qdot_knots_line) qdot_knots; /* start from {0}; free with qdot_free(knots.at) */

/* Append the tables that the tape, a borrowed one, reads at a + b t, t being input `time`. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_knots_find(const qdot_tape *tape, size_t time, qdot_knots *knots);

/* Whether, at the inputs, the tape reads a table at a place `at` where it has ended, or ends within rounding. */
bool qdot_knots_ended(const qdot_tape *tape, const double *in, double *handle, double *at);

/* The end of the piece that begins at t, in the direction +1 or -1, infinite if there is none; if a table jumps there the
 * double before, unless t is that. */
double qdot_knots_next(size_t n, const qdot_knots_line *lines, double t, int direction);

#endif
