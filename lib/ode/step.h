/* step.h -- controllers of steps: a controller offers steps along a solution, its owner says how far each is taken.
 *
 *     open      at (t0, y0), towards t1
 *     while t != t1:
 *       offer   a step from t to t_end. By Taylor series the solution is known inside it: the owner may look,
 *               and bring t_end nearer
 *       take    go to t_end, where the state is then y_end; or it is found there that the step is not as
 *               accurate as it must be: *taken is false, and a shorter one will be offered
 *       accept  t_end and y_end become the present time and state; or
 *       refuse  they do not, and a shorter step will be offered
 *     close
 *
 * So the owner is a loop, which may end anywhere, and no controller calls back. There is a kind of controller for
 * each way to choose steps (qdot_ode_control); which one serves is decided by the method and the options:
 *
 *     taylor             series, whose length is found from their coefficients (taylor.h)
 *     adaptive steps     other methods, under a bound for the error of every step (integrate.h)
 *     constant steps     methods that keep a structure (geometric/geometric.h)
 *     alternating steps  a stiff method and series in turns (alternate.c)
 *
 * Tests  tests/ode/test_step.c
 */
#ifndef QDOT_ODE_STEP_H
#define QDOT_ODE_STEP_H

#include <stdbool.h>

#include "ode/run.h"

/* A step that is offered; the pointers are valid until the next call of its controller. */
typedef struct {
    const qdot_ode_method *method;
    qdot_ode_expanded *series; /* its Taylor series, whose t_end may be brought nearer; NULL: the method has none */
    double t_end;
    const double *y_end, *low_end; /* [n] after `take`: the state at t_end is y_end + low_end (NULL: 0) */
} qdot_ode_step;

/* A kind of controller. `run` is what `open` has made; its functions fail as those of the controller do. */
typedef struct {
    /* Begin; the counts go into *result until `close`. *run is closed whatever is returned. */
    qdot_status (*open)(const qdot_ode_system *system, const qdot_ode_method *method,
                        const qdot_ode_options *options, double t0, double t1, const double *y,
                        qdot_ode_result *result, void **run);
    qdot_status (*offer)(void *run, qdot_ode_step *step);
    qdot_status (*take)(void *run, qdot_ode_step *step, bool *taken); /* NULL: the end was known when it was offered */
    qdot_status (*accept)(void *run);
    qdot_status (*refuse)(void *run, qdot_status why);
    void (*state)(void *run, double *y, double *low); /* the present state y [n], and low [n] beyond it unless NULL */
    void (*close)(void *run);
} qdot_ode_control;

typedef struct {
    const qdot_ode_control *kind;
    void *run;
    double t, t1;           /* the present time, the end */
    double began;           /* CPU time at the start */
    bool opened;
    qdot_ode_result result; /* complete after `close` */
} qdot_ode_controller;

/* Begin at y [n], t0, towards t1. The system and the options (not NULL) are borrowed until `close`, which is
 * called whatever is returned. Errors are those of qdot_ode_integrate. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_open(qdot_ode_controller *c, const qdot_ode_system *system,
                                                     const qdot_ode_method *method,
                                                     const qdot_ode_options *options, double t0, double t1,
                                                     const double *y);

/* Find the next step. Errors: no step can be made, with the reason as the message; a limit, an interruption. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_offer(qdot_ode_controller *c, qdot_ode_step *step);

/* Go to the end of the step that was offered. Errors as above. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_take(qdot_ode_controller *c, qdot_ode_step *step, bool *taken);

/* The end of the step taken becomes the present state. Errors: a limit (meter.h, stiffness.h) is passed;
 * the step is accepted all the same. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_accept(qdot_ode_controller *c, const qdot_ode_step *step);

/* Refuse the step, before it was taken or after, as the owner failed with the status `why`, which is returned
 * unless it says that something is undefined there: then a shorter step will be offered. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_refuse(qdot_ode_controller *c, qdot_status why);

/* For an owner that does not look inside steps: offer and take until one is taken. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_next(qdot_ode_controller *c, qdot_ode_step *step);
/* Accept the step taken if the owner's `verdict` on it is QDOT_OK, else refuse it. */
QDOT_MUST_CHECK qdot_status qdot_ode_controller_settle(qdot_ode_controller *c, const qdot_ode_step *step,
                                                       qdot_status verdict);

/* The present state y [n], in two doubles if low [n] is not NULL; not while a step is offered. Nothing is written if
 * the controller was not opened. */
void qdot_ode_controller_state(const qdot_ode_controller *c, double *y, double *low);

/* End the run with a status, whose message becomes c->result.reason; `stopped`: by its owner. */
void qdot_ode_controller_close(qdot_ode_controller *c, qdot_status status, bool stopped);

/* The kinds, each in the file of its name (taylor.c, adaptive-steps.c, alternate.c, geometric/constant-steps.c). */
extern const qdot_ode_control qdot_ode_taylor_steps, qdot_ode_adaptive_steps, qdot_ode_alternating_steps,
    qdot_ode_constant_steps;

#endif
