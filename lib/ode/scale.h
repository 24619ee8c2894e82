/* scale.h -- the size that an error of a component counts relative to.
 *
 *     size_i = max(s_i, |y_i|)
 *
 * s_i is 1 unless the system says otherwise (system.h, `scales`): 1e-10 for the position of an
 * electron. A tolerance of 1e-12 is then 1e-22 of its unit.
 *
 * Tests  tests/ode/test_scale.c
 */
#ifndef QDOT_ODE_SCALE_H
#define QDOT_ODE_SCALE_H

#include <math.h>
#include <stddef.h>

/* The scale s_i of component i, from the array `scales` [n]; 1 if this is NULL. */
static inline double
qdot_ode_scale(const double *scales, size_t i)
{
    return scales ? scales[i] : 1;
}

/* The size of component i of a state: max(s_i, |y|); s_i if y is a NaN. */
static inline double
qdot_ode_size(const double *scales, size_t i, double y)
{
    return fmax(qdot_ode_scale(scales, i), fabs(y));
}

#endif
