/* system.h -- a system of ordinary differential equations: arrays and callbacks.
 *
 *     dy/dt = f(t, y),   y of n components
 */
#ifndef QDOT_ODE_SYSTEM_H
#define QDOT_ODE_SYSTEM_H

#include <stddef.h>

#include "base/status.h"

/* The callbacks may write nothing but their outputs and what `user` owns. A system that
 * is used by two threads at once must be two, each with its own `user`.
 *
 * Where f is undefined return QDOT_EDOMAIN or QDOT_ESINGULAR through qdot_fail(): the
 * integrator tries smaller steps, and if none works the run stops with that message. An
 * output that is not finite counts as QDOT_EDOMAIN. Any other status ends the run at
 * once. */
typedef struct {
    size_t n; /* components, at least 1 */
    /* dydt [n] = f(t, y [n]) */
    qdot_status (*rhs)(double t, const double *y, double *dydt, void *user);
    /* dfdy [n x n row-major] = df_i/dy_j, dfdt [n] = df/dt; NULL if there is none */
    qdot_status (*jacobian)(double t, const double *y, double *dfdy, double *dfdt,
                            void *user);
    void *user; /* borrowed */
} qdot_ode_system;

#endif
