/* lanes-near.h -- how far a step of one lane may go without stepping over an exponential or a quotient
 * that is nothing where it begins: near.h, for a program in lanes.
 *
 * Tests  tests/script/sweep-lanes.sh
 */
#ifndef QDOT_SERIES_LANES_NEAR_H
#define QDOT_SERIES_LANES_NEAR_H

#include "series/lanes.h"

/* Whether the program has such steps. */
bool qdot_lanes_may_hide(const qdot_lanes *lanes);
/* As qdot_taylor_near, for a lane whose rows have orders up to p. */
double qdot_lanes_near(qdot_lanes *lanes, size_t lane, int p, double s, double least);

#endif
