/* contact.h -- contacts that last: a ball that has come to rest on the floor of its event.
 *
 *     event bounce: y = 0 falling then y' = -e*y'
 *
 * Where such an event comes ever faster, or the motion does not leave it, the contact lasts: u = 0 of
 * the event is held by a reaction that only pushes, until it would have to pull. This is a mode as
 * sliding is (sim/model/sliding.h), with the reaction as its share; u is a surface of the switches behind
 * those of the equations, one for each side that it may be met from.
 *
 * It is what the event means only if `then` is an impact on a smooth wall: it sets velocities, and coordinates to
 * what they are there (y = 0, y' = -e*y'), but nothing else, by a change along M^-1 du/dq that turns du/dt about, to at most its size, and leaves a motion with du/dt
 * = 0 as it is; and u is of q and t. On a place that moves the motion rests beside it, u = u' = 0, and leaves it where
 * that falls away faster than the motion would; its speed may not jump. Anything else ends the run as before.
 *
 * Tests  tests/script/contacts/resting.lag, moving-floors.lag
 */
#ifndef QDOT_SIM_CONTACT_H
#define QDOT_SIM_CONTACT_H

#include "mech/scene/scene.h"
#include "sim/model/switch.h"

/* Append the surfaces of lasting contacts to a run's switches. Errors: those of the pool, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_contacts_find(const qdot_scene *scene, const qdot_run_request *request,
                                               qdot_switches *switches);

/* The surface of the event's contact that prevents du/dt of the sign `way`; SIZE_MAX: none. */
size_t qdot_contacts_surface(const qdot_switches *switches, size_t event, int way);
/* Whether the wall of a contact moves with time, and so does work. */
bool qdot_contacts_moves(const qdot_switches *switches, size_t surface);

#endif
