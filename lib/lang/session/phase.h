/* phase.h -- statements about the motion of a scene that states H alone see its phase space.
 *
 * While such a statement is carried out, the scene is that of mech/hamilton/phase-space: p[q] is a coordinate of its own,
 * with a start and without velocity; the start values of momenta are those of these coordinates.
 *
 * Tests  tests/script/derive/hamiltonian-runs.lag
 */
#ifndef QDOT_LANG_PHASE_H
#define QDOT_LANG_PHASE_H

#include "lang/session/parts.h"

/* Enter the phase space, if the scene needs it, with states in place of coordinates (mech/hamilton/phase-space.h) or not;
 * _end, in any case, leaves it. They may be nested. */
QDOT_MUST_CHECK qdot_status qdot_phase_begin(qdot_session *session, bool states);
void qdot_phase_end(qdot_session *session);

/* Leave the phase space however many have entered it, and enter it again: returns what _resume needs. */
unsigned qdot_phase_pause(qdot_session *session);
QDOT_MUST_CHECK qdot_status qdot_phase_resume(qdot_session *session, unsigned paused);

/* Whether the scene states H alone: no velocity has a start of its own. */
bool qdot_phase_has(const qdot_session *session);
/* The version of the scene, outside of its phase space. */
uint64_t qdot_phase_version(const qdot_session *session);

#endif
