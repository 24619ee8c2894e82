/* sizes.h -- how large expressions become along a run, and scales of slopes by them.
 *
 * Tests  tests/script/studies/units.sh
 */
#ifndef QDOT_SIM_SIZES_H
#define QDOT_SIM_SIZES_H

#include "sim/run/run.h"

/* The largest |e_i| [n] at several times of the run, ignoring values smaller than their errors.
 * Errors: those of qdot_run_values. */
QDOT_MUST_CHECK qdot_status qdot_sizes_along(qdot_run *run, size_t n, const qdot_expr *e, double *size);

/* Whether sizes [n] differ so much from each other, or from 1, that the scale 1 does not fit all of them. */
bool qdot_sizes_are_apart(size_t n, const double *size);

#endif
