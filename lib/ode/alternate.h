/* alternate.h -- a method for stiff equations, and Taylor series wherever these would go faster.
 *
 * Steps of the method go on while they bring the run on by more, for the same work, than a step by
 * series would: every LOOKS steps the length h of that step is found (taylor.h). With the works w_s
 * of an expansion and w of what the method has done over the last LOOKS steps, which came as far as d,
 *
 *     h/w_s > gain d/w
 *
 * must hold without a break until the method has spent `patience` expansions more: by then it would
 * have paid to change. Series go on until stability bounds their steps (stiffness.h), or
 * they come to be slower than the method was; then the patience is doubled, so that a motion in which
 * the two take turns costs little more than by the method alone. The turns are of one integration: time goes on, the state is
 * the one at hand, and options->now tells the method of each step.
 *
 * Tests  tests/ode/test_alternate.c, tests/script/methods/stiff-turns.lag
 */
#ifndef QDOT_ODE_ALTERNATE_H
#define QDOT_ODE_ALTERNATE_H

#include "ode/run.h"

/* Whether a run by that method may change to series and back: options->alternates, the method is a
 * kernel for stiff equations, and the system has series. */
bool qdot_ode_alternates(const qdot_ode_system *system, const qdot_ode_method *method,
                         const qdot_ode_options *options);

/* Integrate like qdot_ode_integrate, changing methods on the way. Begins with *options->now if that is given and set. */
QDOT_MUST_CHECK qdot_status qdot_ode_alternate_integrate(const qdot_ode_system *system,
                                                         const qdot_ode_method *method,
                                                         const qdot_ode_options *options,
                                                         double t0, double t1, double *y,
                                                         qdot_ode_result *result);

#endif
