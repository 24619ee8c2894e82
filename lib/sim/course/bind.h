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

typedef struct qdot_bind qdot_bind;

/* The plan is borrowed. `shaken`: with every rounded constant on its other side
 * (tape/shake.h), for a companion run. Errors: QDOT_ESINGULAR names the coordinate of
 * a constant M; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_bind_new(const qdot_plan *plan, bool shaken,
                                          qdot_bind **bind);
void qdot_bind_free(qdot_bind *bind);

/* Its system; n = 2 plan->n. Valid while the bind lives. Both fail with QDOT_ESINGULAR or
 * QDOT_EDOMAIN where M is singular or q'' undefined, naming the coordinate. */
qdot_ode_system qdot_bind_system(qdot_bind *bind);

/* q'' [n], and the multipliers [m] of a plan with constraints behind it, at y [2n]: of a
 * system that qdot_bind_system made, all of them from the equations as they are derived.
 * Errors as those of its rhs. */
QDOT_MUST_CHECK qdot_status qdot_bind_accelerations(const qdot_ode_system *system,
                                                    double t, const double *y, double *a);

/* Whether M is regular (and, unless a Lagrangian was stated, positive) at a state:
 * QDOT_ESINGULAR names the coordinate. With constraints y + low must also fulfil them, and
 * is brought the last bits nearer: qdot_constrained_start. */
QDOT_MUST_CHECK qdot_status qdot_bind_check(qdot_bind *bind, double t, double *y,
                                            double *low);

/* Of a plan with constraints, else NULL: sim/model/constrained.h. Borrowed. */
qdot_constrained *qdot_bind_held(qdot_bind *bind);

/* How its Taylor series are computed once they are prepared, added to a text: `machine code
 * for AVX2, 10.3 kB`, or `kernels` and why. */
void qdot_bind_tell_code(const qdot_bind *bind, qdot_text *to);

/* How often M was factored. */
size_t qdot_bind_factored(const qdot_bind *bind);

#endif
