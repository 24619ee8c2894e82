/* stepper.h -- one step of a method: try it, get its error, accept it or not.
 *
 * Used by integrate.h; nothing outside ode/ uses it.
 *
 * The state is kept as a sum y + carry. A one-step method integrates not y but the increment from
 * the start of the step,
 *
 *     z = (Y - (y + carry)) / s,   z = 0 at the start,
 *     dz/dt = f(t, y + (carry + s z)) / s
 *
 * (s: for bsimp, whose safeguards depend on |z|, the power of two at or below the size of y; else
 * 1). So its increment is rounded to 2^-53 of itself, not of y, and is added by TwoSum: no
 * addition rounds (tests/ode/test_integrate.c, additions_do_not_round). The rounding of f and of
 * the method's coefficients remains. On smooth scenes at tol 1e-15 and 1e-16 the end error was
 * 0.5 to 4 times smaller than without (1.2 in the mean), and several times smaller than by GSL's
 * own driver (compensation_pays).
 * Multistep methods keep y itself in their history; there the carry stays 0.
 *
 * The error of a step is judged component by component:
 *
 *     ratio = max_i |error_i| / (tol max(s_i, |y_i|)),   accepted if ratio <= 1 (scale.h).
 *
 * GSL's error handler aborts the program by default; qdot_ode_stepper_new turns it off
 * for the process (once, through pthread_once), as a library that returns its errors
 * must.
 */
#ifndef QDOT_ODE_STEPPER_H
#define QDOT_ODE_STEPPER_H

#include <stdbool.h>
#include <stdint.h>

#include <gsl/gsl_odeiv2.h>

#include "base/status.h"
#include "ode/method.h"
#include "ode/system.h"

typedef struct qdot_ode_stepper qdot_ode_stepper;
typedef struct qdot_ode_kernel qdot_ode_kernel;

/* A one-step method that is not from GSL: dop853.h, radau.h. */
struct qdot_ode_kernel {
    size_t stages; /* number of rows [n] in s->stages */
    size_t powers; /* number of rows [n] of the interpolating polynomial */
    /* Try a step as qdot_ode_stepper_try does, from s->y + s->carry and s->dydt: the
     * increment into s->z, the state into s->trial, *ratio finite or INFINITY. */
    qdot_status (*step)(qdot_ode_stepper *s, double t, double h, double *ratio);
    /* The polynomial F [powers x n] through the step just tried, s->trial_dydt known;
     * s->trial is lost. */
    qdot_status (*dense)(qdot_ode_stepper *s, double t, double h, double *F);
    /* Interpolate the state y [n] at the fraction x (0 to 1) of a step that began at y0 [n]. */
    void (*at)(size_t n, const double *F, const double *y0, double x, double *y);

    /* Of a method that keeps more than stages, in s->own; else NULL: made with the stepper (close
     * also after a failure); told of a start without history, and of a step accepted, before that
     * becomes s->y. */
    qdot_status (*open)(qdot_ode_stepper *s);
    void (*close)(qdot_ode_stepper *s);
    void (*restart)(qdot_ode_stepper *s);
    void (*accepted)(qdot_ode_stepper *s);
    double (*power)(const qdot_ode_stepper *s); /* power of h in the error estimate; NULL: method->error_power */
    /* Change to the next interpolation formula, after the last to the first; returns their number.
     * NULL: only one. */
    size_t (*another)(qdot_ode_stepper *s);
    bool keeps_step; /* a change of the step length is costly: keep the old length if possible */
    bool forward;    /* steps may not be interpolated backwards from their end */
};

struct qdot_ode_stepper {
    const qdot_ode_method *method;
    const qdot_ode_system *system; /* the system to be integrated; borrowed */
    double tol;

    double *room;      /* the allocated block that holds the arrays below */
    double *y, *carry; /* [n] the state at the start of the step is y + carry */
    double *dydt;      /* [n] f at the start of the step; one-step methods only */
    double *z, *error; /* [n] result of the step tried (increment or new state), and its error estimate */
    double *zdot;      /* [n] dydt_i / scale_i */
    double *scale;     /* [n] the scale factors s_i by which GSL's variables z are multiplied */
    double *trial;     /* [n] end state of the step tried: y + carry + s z */
    double *trial_dydt; /* [n] f at the end of the step tried */
    bool dydt_known;

    uint64_t evaluations, jacobians, factorisations;
    double raised; /* the tolerance that rounding errors of f allow, if larger than the requested one */
    qdot_status broken; /* status of a callback that failed during the step tried */

    double *stages; /* [stages x n] stage values of a kernel */
    void *own;      /* data of a one-step method, allocated by its function `open` */

    /* If the system projects onto constraints: the projected end of the step, and whether it was moved. */
    double *moved, *moved_carry; /* [n] the projected end as two doubles is moved + moved_carry */
    bool projected;

    gsl_odeiv2_step *step;       /* GSL's step object; NULL if the method has a kernel */
    gsl_odeiv2_control *control; /* tells GSL's multistep methods the tolerance */
    gsl_odeiv2_driver driver;    /* through which GSL's multistep methods find `control` */
    gsl_odeiv2_system inner;
};

/* Make a stepper. Errors: QDOT_EINVAL (n = 0, a tolerance outside 1e-16 .. 1, no Jacobian); QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ode_stepper_new(const qdot_ode_system *system,
                                                 const qdot_ode_method *method,
                                                 double tol, qdot_ode_stepper **out);
void qdot_ode_stepper_free(qdot_ode_stepper *s);

/* Begin at the state y [n], without history of earlier steps. */
void qdot_ode_stepper_start(qdot_ode_stepper *s, const double *y);

/* Evaluate f at (t, y [n]) into dydt, and count this evaluation. QDOT_EDOMAIN if it is not finite. */
QDOT_MUST_CHECK qdot_status qdot_ode_stepper_rhs(qdot_ode_stepper *s, double t,
                                                 const double *y, double *dydt);

/* Try a step from t of size h (signed). On QDOT_OK *ratio is finite, or INFINITY if the step is
 * too large for an estimate, and s->trial is its end. Otherwise what a callback returned; the
 * state is as before in any case.
 *   check  evaluate f at the end too, so that an accepted state is one where f exists */
QDOT_MUST_CHECK qdot_status qdot_ode_stepper_try(qdot_ode_stepper *s, double t, double h,
                                                 double *ratio);

/* Project the end of the step just tried, at t, by system->project: s->trial is then the moved
 * state. *ratio is raised to the distance moved over 100 tolerances. Does nothing without
 * system->project, or for multistep methods. */
QDOT_MUST_CHECK qdot_status qdot_ode_stepper_project(qdot_ode_stepper *s, double t,
                                                     double *ratio);

/* Accept the step just tried: its end becomes the present state. */
void qdot_ode_stepper_accept(qdot_ode_stepper *s);

/* The exponent p such that the error of the step just tried is proportional to h^p. */
double qdot_ode_stepper_error_power(const qdot_ode_stepper *s);

#endif
