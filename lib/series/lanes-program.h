/* lanes-program.h -- a series program in lanes from inside. Internal to series/. */
#ifndef QDOT_SERIES_LANES_PROGRAM_H
#define QDOT_SERIES_LANES_PROGRAM_H

#include "series/taylor-steps.h"

typedef struct qdot_lanes qdot_lanes; /* lanes.h */

/* The program of one lane, with order 0 alone: row r of it is row r in lanes, at
 * qdot_lanes_input(lanes, 0) + r qdot_lanes_stride(lanes) groups. */
const qdot_taylor *qdot_lanes_program(const qdot_lanes *lanes);

#endif
