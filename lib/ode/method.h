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
    int order;           /* of the result; of a variable-order method the highest */
    bool needs_jacobian; /* the system must have one */
    bool multistep;      /* keeps a history: cannot start at full order */
    bool stiff;          /* stability does not limit its step */
    int error_power;     /* its error estimate goes as h to this power; 0: present order + 1 */
    const char *partner; /* the one-step method of its companion run (companion.h; of a stiff method
                            it is radau) and, unless it has a kernel, of its output between steps
                            (trajectory.h) */
    double companion_ratio; /* how much tighter the companion's tolerance is */
    double companion_tol;   /* the smallest companion tolerance that still improves accuracy */
    const char *fits;       /* one line: when to use it */
    const void *stepper;    /* const gsl_odeiv2_step_type *const *; else NULL */
    bool series;            /* the system must have Taylor series */
    const struct qdot_ode_kernel *kernel; /* of our own Runge-Kutta methods (stepper.h) */
    /* the kernel, for methods with constant steps (geometric/geometric.h) */
    const struct qdot_geometric_kernel *geometric;
} qdot_ode_method;

size_t qdot_ode_method_count(void);

/* Row i of the table, static; NULL past its end. */
const qdot_ode_method *qdot_ode_method_at(size_t i);

/* The method of that name; NULL if there is none (no failure is recorded). */
const qdot_ode_method *qdot_ode_method_find(const char *name);

#endif
