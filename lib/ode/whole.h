/* whole.h -- integrates all components together, step by step (integrate.h). For ode/ only. */
#ifndef QDOT_ODE_WHOLE_H
#define QDOT_ODE_WHOLE_H

#include "ode/run.h"

/* Integrate as qdot_ode_integrate does (options not NULL), by Taylor series or by steps of stepper.h. */
QDOT_MUST_CHECK qdot_status qdot_ode_whole_integrate(const qdot_ode_system *system,
                                                     const qdot_ode_method *method,
                                                     const qdot_ode_options *options,
                                                     double t0, double t1, double *y,
                                                     qdot_ode_result *result);

#endif
