/* bind.h -- a plan as a system of ordinary differential equations.
 *
 *     y = (q, q'),   dy/dt = (q', M^-1 f)
 *     df/dy:  M dq''/dx = d(f - M q'')/dx  at q'' held, for x in q, q', t
 *
 * A plan is const and may be bound several times, once a thread.
 */
#ifndef QDOT_SIM_BIND_H
#define QDOT_SIM_BIND_H

#include "base/text.h"
#include "ode/system.h"
#include "sim/model/constrained.h"
#include "sim/model/equations.h"

struct qdot_past; /* num/past.h */

typedef struct qdot_bind qdot_bind;

/* The plan is borrowed. `shaken`: every rounded constant is rounded the other way
 * (tape/shake.h), for a companion run. Errors: QDOT_ESINGULAR names the coordinate of
 * a constant M; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_bind_new(const qdot_plan *plan, bool shaken,
                                          qdot_bind **bind);
void qdot_bind_free(qdot_bind *bind);

/* From now on the system has these scales [2 plan->n] (ode/scale.h), borrowed; NULL: they are 1.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_bind_scale(qdot_bind *bind, const double *scales);

/* From now on equations with delays read this history, borrowed, of a run that is one step after another by Taylor series; their
 * delays become known to it. NULL: there are none. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_bind_remember(qdot_bind *bind, struct qdot_past *history);
/* Let steps also end where a tape with inputs q, q', t reads the next piece of a table of data, or a breaking point of that history.
 * Errors: QDOT_ENOMEM; as qdot_delay_find_knots. */
QDOT_MUST_CHECK qdot_status qdot_bind_add_knots(qdot_bind *bind, const qdot_tape *tape);

/* The system of a bind; n = 2 plan->n. Valid while the bind lives. Its rhs and Jacobian fail with
 * QDOT_ESINGULAR if M is singular, QDOT_EDOMAIN if q'' is undefined; both name the coordinate. */
qdot_ode_system qdot_bind_system(qdot_bind *bind);

/* a [n + m]: q'', then the multipliers of a plan with constraints, at y [2n], all from the
 * equations as derived (not a reduced form). `system` was made by qdot_bind_system. Errors as its
 * rhs. */
QDOT_MUST_CHECK qdot_status qdot_bind_accelerations(const qdot_ode_system *system,
                                                    double t, const double *y, double *a);

/* After that, at the same state: e [n], what rounding makes of q'' a [n] where the equations are evaluated
 * (tape/rounding.h),
 *
 *     M e = e_f + e_M |a|,   e = e_f of a block of one;
 *
 * 0 under constraints, and of a plan without M. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_bind_roundings(const qdot_ode_system *system, double t,
                                                const double *y, const double *a, double *e);
/* Find the uncertainty e of q'' that underflow alone causes; it may be infinite or a NaN. */
QDOT_MUST_CHECK qdot_status qdot_bind_underflows(const qdot_ode_system *system, double t, const double *y,
                                                 const double *a, double *e);

/* Whether M is regular (and, unless a Lagrangian was stated, positive) at a state:
 * QDOT_ESINGULAR names the coordinate. With constraints y + low must also keep them, and its last
 * bits are corrected: qdot_constrained_start. */
QDOT_MUST_CHECK qdot_status qdot_bind_check(qdot_bind *bind, double t, double *y,
                                            double *low);

/* The constraint solver (sim/model/constrained.h); NULL without constraints. Borrowed. */
qdot_constrained *qdot_bind_held(qdot_bind *bind);

/* Append how the Taylor series are computed, once they are prepared: `machine code for AVX2,
 * 10.3 kB`, or `kernels` and why. */
void qdot_bind_tell_code(const qdot_bind *bind, qdot_text *to);

/* The number of times that the mass matrix M has been factored so far. */
size_t qdot_bind_factored(const qdot_bind *bind);

#endif
