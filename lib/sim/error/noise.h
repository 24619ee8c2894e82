/* noise.h -- what evaluating an expression at a state loses to rounding.
 *
 * Accelerations are solved for, and terms cancel in them and in expressions; two runs that
 * round alike do not show it. So g is evaluated at seven states along a line, near enough
 * to each other for its third differences to hold nothing but rounding:
 *
 *     g_s = g(t, y + s h d),  s = 0 ... 6,   h = 2^-38,  d_i = +-y_i
 *     noise = sqrt(mean (third differences)^2 / 20)
 *
 * Source  More & Wild, Estimating computational noise, SIAM J. Sci. Comput. 33 (2011) 1292
 * Tests   tests/script/inner-times.sh
 */
#ifndef QDOT_SIM_NOISE_H
#define QDOT_SIM_NOISE_H

#include "sim/course/reader.h"

/* Of expressions [m] at t, in a piece (sim/course/reader.h), into noise [m]. Errors: as
 * qdot_reader_at. */
QDOT_MUST_CHECK qdot_status qdot_noise_at(qdot_reader *r, size_t piece, double t,
                                          double *noise);

/* What evaluating expressions [m] along a course at times [k] may be off by: roundings [k x m],
 *
 *     max(4 noise, DBL_EPSILON max(magnitude, |g|))
 *
 * where magnitude is that of its terms (sim/model/term-magnitude.h) and values [k x m] are g.
 * Errors: as qdot_reader_at. */
QDOT_MUST_CHECK qdot_status qdot_noise_roundings(const qdot_reading *of,
                                                 const qdot_course *course, size_t k,
                                                 const double *times,
                                                 const double *values,
                                                 double *roundings);

#endif
