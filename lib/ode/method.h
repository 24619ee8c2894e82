/* method.h -- the table of methods of integration.
 *
 * Taylor series (taylor.h) and DOP853 (dop853.h) are ours. The other steppers are GSL's
 * (gsl_odeiv2), with our step control, last step, rounding and failures (integrate.h). Methods
 * for long times are ours too (geometric/geometric.h). A new method is a row.
 *
 * Tests  tests/ode/test_method.c: names, and the order of the one-step rows measured.
 */
#ifndef QDOT_ODE_METHOD_H
#define QDOT_ODE_METHOD_H

#include <stdbool.h>
#include <stddef.h>

typedef struct qdot_ode_method {
    const char *name;
    int order;           /* order of accuracy; of a method with variable order the highest one */
    bool needs_jacobian; /* needs the system's Jacobian */
    bool multistep;      /* uses values of earlier steps, and therefore starts with low order */
    bool stiff;          /* stable for stiff systems: stability does not limit its step */
    int error_power; /* the error estimate is proportional to this power of the step h; 0: to the present order + 1 */
    const char *partner; /* the one-step method of its companion run (companion.h; of a stiff method
                            it is radau) and, unless it has a kernel, of its output between steps
                            (trajectory.h) */
    double companion_ratio; /* tolerance of the companion run that estimates a run's error, divided by that of the run */
    double companion_tol;   /* the smallest tolerance of a companion run that still improves accuracy */
    const char *fits;       /* one line for the user: when to use the method */
    const void *stepper; /* GSL's stepper type, const gsl_odeiv2_step_type *const *; NULL: not from GSL */
    bool series;            /* integrates by Taylor series, which the system must provide */
    const struct qdot_ode_kernel *kernel; /* our own one-step method (stepper.h); NULL: none */
    /* functions of a geometric method with constant steps (geometric/geometric.h) */
    const struct qdot_geometric_kernel *geometric;
} qdot_ode_method;

size_t qdot_ode_method_count(void);

/* Row i of the table, static; NULL past its end. */
const qdot_ode_method *qdot_ode_method_at(size_t i);

/* The method of that name; NULL if there is none (no failure is recorded). */
const qdot_ode_method *qdot_ode_method_find(const char *name);

#endif
