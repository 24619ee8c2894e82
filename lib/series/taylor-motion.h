/* taylor-motion.h -- a motion in doubles, of one system: its stages by the kernels of taylor.h, or as
 * machine code (lanes-motion.h).
 *
 * Tests  tests/series/test_motion.c, tests/sim/test_taylor.c
 */
#ifndef QDOT_SERIES_TAYLOR_MOTION_H
#define QDOT_SERIES_TAYLOR_MOTION_H

#include "series/lanes-motion.h"
#include "series/taylor.h"

/* Of a motion, borrowed, for stages below `most`; `shaken`: with the other neighbours of its constants
 * (tape/shake.h). The unit of time is set before the first stage. What taylor.h says of order, links
 * and code is not for it. Errors: QDOT_EINVAL (most), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_of_motion(const qdot_motion *motion, bool shaken,
                                                  int most, qdot_taylor **taylor);
void qdot_taylor_set_unit(qdot_taylor *taylor, double unit);
const double *qdot_taylor_series(const qdot_taylor *taylor, qdot_program_row row);

/* As qdot_lanes_stage, qdot_lanes_change. */
void qdot_taylor_stage(qdot_taylor *taylor, int k);
void qdot_taylor_change(qdot_taylor *taylor, int k, const double *by);

/* For code: where it is to be written to, and then, before it is run, what steps divide by. */
qdot_lanes_rows qdot_taylor_get_rows(const qdot_taylor *taylor);
void qdot_taylor_set_inverses(const qdot_taylor *taylor);

#endif
