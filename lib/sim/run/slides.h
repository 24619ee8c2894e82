/* slides.h -- where a run stuck or slid along a surface at which the equations switch.
 *
 * Tests  tests/script/contacts/sticking.lag
 */
#ifndef QDOT_SIM_SLIDES_H
#define QDOT_SIM_SLIDES_H

#include "sim/course/run-state.h"

/* After the integration: note the surfaces along which the run slid, for what is read along it
 * (qdot_plan_reading), and add a notice of where each was held. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_slides_tell(qdot_run *run);

/* Whether the motion stays on a contact over some time of the run. */
bool qdot_slides_in_contact(const qdot_run *run);

#endif
