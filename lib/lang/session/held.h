/* held.h -- parameters and coordinates that have a value for one pass of a loop: `for l = [1, 2, 3]`.
 *
 * In numbers the value is that of `set` or `start` (a run: `with l = 1`), in an expression it is put in
 * when the expression has been evaluated, so diff(V, x) for x = [0, 1] is the slope at these places.
 * A statement that asks sees the scene with the parameters' values in it.
 *
 * Tests  tests/script/sweeps/loops-over-declared.lag
 */
#ifndef QDOT_LANG_HELD_H
#define QDOT_LANG_HELD_H

#include "lang/session/session.h"
#include "mech/scene/saved.h"

/* Hold the symbol at the value, innermost last; its value of `set` or `start` is kept for the end. */
QDOT_MUST_CHECK qdot_status qdot_held_begin(qdot_session *session, qdot_expr symbol,
                                            qdot_expr value);
/* Let go of the innermost. */
void qdot_held_end(qdot_session *session);

/* e with what is held put in. Nil: the pool keeps the failure. */
qdot_expr qdot_held_apply(qdot_session *session, qdot_expr e);
/* The same of held parameters alone. */
qdot_expr qdot_held_parameters(qdot_session *session, qdot_expr e);
/* Whether a coordinate is held. */
bool qdot_held_coordinate(const qdot_session *session);
/* QDOT_EDOMAIN where a value is outside the declared domain. */
QDOT_MUST_CHECK qdot_status qdot_held_check(qdot_session *session);

/* Put held parameters into the scene, {0} before; end() in any case, which puts the scene back. */
QDOT_MUST_CHECK qdot_status qdot_held_scene_begin(qdot_session *session, qdot_scene_saved *kept);
void qdot_held_scene_end(qdot_session *session, qdot_scene_saved *kept);

#endif
