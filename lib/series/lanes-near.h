/* lanes-near.h -- how far the steps of lanes may go without stepping over an exponential or a quotient
 * that is nothing where it begins: near.h, for a program in lanes.
 *
 * Tests  tests/script/sweeps/sweep-lanes.sh
 */
#ifndef QDOT_SERIES_LANES_NEAR_H
#define QDOT_SERIES_LANES_NEAR_H

#include "series/lanes.h"

/* Whether the program contains exponentials or quotients that may hide forces acting only for a short time. */
bool qdot_lanes_may_hide(const qdot_lanes *lanes);
/* As qdot_taylor_near, for lanes whose rows have orders up to p: near [a group] for steps s [a group], of
 * which a NaN is none. */
void qdot_lanes_near(qdot_lanes *lanes, int p, const double *s, const double *least, double *near);

#endif
