/* noise.h -- the rounding error of evaluating an expression at a state.
 *
 * Terms cancel in accelerations, which are solved for, and in expressions; two runs that round
 * alike do not show the error. So g is evaluated at seven states along a line, so near to each
 * other that its third differences consist of rounding errors:
 *
 *     g_s = g(t, y + s h d),  s = 0 ... 6,   h = 2^-38,  d_i = +-y_i
 *     noise = sqrt(mean (third differences)^2 / 20)
 *
 * Source  More & Wild, Estimating computational noise, SIAM J. Sci. Comput. 33 (2011) 1292
 * Tests   tests/script/cases/inner-times.sh
 */
#ifndef QDOT_SIM_NOISE_H
#define QDOT_SIM_NOISE_H

#include "sim/course/reader.h"

/* Find the rounding noise [m] of the reader's expressions at t, in the given pieces. Errors: as
 * qdot_reader_read. */
QDOT_MUST_CHECK qdot_status qdot_noise_at(qdot_reader *r, const size_t *pieces, double t,
                                          double *noise);

/* Bounds for the rounding of expressions [m] along their courses at times [k]: roundings [k x m],
 *
 *     max(4 noise, DBL_EPSILON/2 |dg/dh|, bound of its operations)
 *
 * dg/dh: what rounding of the state makes of g, an angle of 22 of its sine; the bound is that of
 * tape/rounding.h. Errors: as qdot_reader_read. */
QDOT_MUST_CHECK qdot_status qdot_noise_roundings(const qdot_reading *of,
                                                 const qdot_course *const *courses,
                                                 size_t k, const double *times,
                                                 double *roundings);

#endif
