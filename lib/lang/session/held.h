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

#include "lang/session/parts.h"
#include "mech/scene/saved.h"

/* Set a symbol to a value for one pass of a loop; its value by `set` or `start` is saved. */
QDOT_MUST_CHECK qdot_status qdot_held_begin(qdot_session *session, qdot_expr symbol,
                                            qdot_expr value);
/* Undo the most recent qdot_held_begin that is still in force. */
void qdot_held_end(qdot_session *session);

/* e with the values that loops set at present, of parameters and coordinates. Nil: the pool keeps
 * the failure. */
qdot_expr qdot_held_apply(qdot_session *session, qdot_expr e);
/* The expression e with the values inserted of those parameters that loops set at present. */
qdot_expr qdot_held_parameters(qdot_session *session, qdot_expr e);
/* Whether a loop sets a coordinate at present. */
bool qdot_held_coordinate(const qdot_session *session);
/* QDOT_EDOMAIN if the value that a loop assigns is outside the declared domain of its symbol. */
QDOT_MUST_CHECK qdot_status qdot_held_check(qdot_session *session);

/* Insert the loop values of parameters into the scene; kept is {0} before. Call _end in any case,
 * which restores the scene. */
QDOT_MUST_CHECK qdot_status qdot_held_scene_begin(qdot_session *session, qdot_scene_saved *kept);
void qdot_held_scene_end(qdot_session *session, qdot_scene_saved *kept);
/* The version of the scene as it was declared: without values of loops in it, and outside its phase space. */
uint64_t qdot_held_version(const qdot_session *session);

#endif
