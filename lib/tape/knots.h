/* knots.h -- where the tables of data that a tape reads at a function of time alone go from one piece to the next.
 *
 *     u(t) = a + b t,   u passes a knot of the table (num/samples.h)
 *
 * The table is one polynomial up to a knot and another one behind it, so an integrator's formulas, which take f for smooth,
 * do not hold for a step across a knot. Steps end at knots: at the first double of t, in the direction of the run, at which the tape reads the next piece.
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

/* Append the tables that the tape, a borrowed one, reads at a + b t, t being input `time`, and histories (num/past.h) that it
 * reads at anything else, with a = NaN, b = 0. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_knots_find(const qdot_tape *tape, size_t time, qdot_knots *knots);

/* Whether the tape, at its inputs `in`, reads a table without values outside at a place *at that is outside, or at an end within
 * 1e-9 of the length. *handle is then that of the table's pieces. Not if there is no memory to find out. */
bool qdot_knots_ended(const qdot_tape *tape, const double *in, double *handle, double *at);

/* The first time beyond t, in the direction +1 or -1, at which one of the lines passes a knot; infinite if none does. If the
 * table jumps there (`steps`), the last time before it, unless t is that time already. */
double qdot_knots_next(size_t n, const qdot_knots_line *lines, double t, int direction);

#endif
