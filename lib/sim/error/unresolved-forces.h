/* unresolved-forces.h -- forces that act for less than a step, so that the run missed them.
 *
 * Steps by series check the arguments of exponentials and what is divided by (series/near.h), all
 * others but those of one length are looked at before they are accepted (sim/bind/pulses.h). What
 * is left is found here after the run, by the same look: what a step of one length has gone over, or
 * one by series with an exponential whose argument is nothing but noise.
 *
 * Tests  tests/script/contacts/hidden-forces.lag
 */
#ifndef QDOT_SIM_UNRESOLVED_FORCES_H
#define QDOT_SIM_UNRESOLVED_FORCES_H

#include "sim/course/course.h"

/* Whether a step missed a force (qdot_pulses_look); *t: about where. Errors: QDOT_ENOMEM, QDOT_EINTR;
 * states that cannot be read are skipped. */
QDOT_MUST_CHECK qdot_status qdot_unresolved_forces_find(const qdot_course *course,
                                                        bool *found, double *t);

#endif
