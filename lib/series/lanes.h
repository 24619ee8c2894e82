/* lanes.h -- a tape for eight systems at once, in double and over power series.
 *
 * The same operations and the same recurrences as tape.h and taylor.h, every number a
 * group of QDOT_LANES doubles (num/batch.h). Elementary functions are called lane by
 * lane, so that a lane's value is the single one's; but for sines and cosines of series, which
 * all lanes have at once (num/batch.h).
 *
 * Tests  tests/series/test_lanes.c, test_motion.c
 */
#ifndef QDOT_SERIES_LANES_H
#define QDOT_SERIES_LANES_H

#include "num/batch.h"
#include "series/motion.h"

/* Evaluate a tape in all lanes: out [m groups] = outputs at in [n groups]; work [qdot_tape_work groups]. */
void qdot_lanes_eval(const qdot_tape *tape, const double *in, double *out, double *work);
/* Evaluate like qdot_lanes_eval, but with sines and cosines computed as in the Taylor series. */
void qdot_lanes_eval_near(const qdot_tape *tape, const double *in, double *out, double *work);

/* A series program with its coefficients in all lanes; each thread needs its own. */
typedef struct qdot_lanes qdot_lanes;

/* Make an object like qdot_taylor_of_program, for several lanes; the program is borrowed. */
QDOT_MUST_CHECK qdot_status qdot_lanes_of_program(const qdot_program *program, bool shaken,
                                                  int most, qdot_lanes **lanes);
void qdot_lanes_free(qdot_lanes *lanes);

/* As qdot_taylor_input, qdot_taylor_stride (in groups), qdot_taylor_output,
 * qdot_taylor_is_constant. */
double *qdot_lanes_input(qdot_lanes *lanes, size_t i);
size_t qdot_lanes_stride(const qdot_lanes *lanes);
const double *qdot_lanes_output(const qdot_lanes *lanes, size_t i);
bool qdot_lanes_is_constant(const qdot_lanes *lanes, size_t i);

/* Choose randomly rounded constants as qdot_taylor_draw does; t is a group, one time for each lane. */
void qdot_lanes_draw(qdot_lanes *lanes, const double *t);

/* Compute orders as qdot_taylor_order and qdot_taylor_change do; newest [n groups]. */
void qdot_lanes_order(qdot_lanes *lanes, int k);
void qdot_lanes_correct(qdot_lanes *lanes, int k, size_t n, const double *newest);

/* Coefficients of a program in groups: row r stands r strides, in groups, behind the first. Behind
 * all of them a group for each step, the inverse of what all its orders divide by. */
typedef struct {
    const qdot_program *program;
    double *coefficients;
    size_t stride, group; /* distance of two rows, in groups; size of a group, in doubles */
} qdot_lanes_rows;

qdot_lanes_rows qdot_lanes_get_rows(qdot_lanes *lanes);
const qdot_program *qdot_lanes_program(const qdot_lanes *lanes);

/* --- motions with unknown accelerations ---------------------------------------------- */

/* Of a motion, borrowed, for stages below `most`; `shaken`: with the other neighbours of its constants
 * (tape/shake.h). The unit of time is set before the first stage. Errors: QDOT_EINVAL (most),
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_lanes_of_motion(const qdot_motion *motion, bool shaken,
                                                 int most, qdot_lanes **lanes);
void qdot_lanes_set_unit(qdot_lanes *lanes, const double *unit);
const double *qdot_lanes_series(const qdot_lanes *lanes, qdot_program_row row);

/* Stage k of the expansion, from qdot_motion_first on, what is solved for being 0. Then that changes
 * by `by` [solved groups], and with it what later orders read: E stays what it was. */
void qdot_lanes_stage(qdot_lanes *lanes, int k);
void qdot_lanes_change(qdot_lanes *lanes, int k, const double *by);

#endif
