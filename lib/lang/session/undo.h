/* undo.h -- statements taken back, and done again.
 *
 * The session's state is a number of arrays: the scene's, the values of `set` and `start`, the runs,
 * the declared names. A copy of each from before a statement is kept and compared afterwards; the
 * differences are the record of that statement. Undo replaces the new items by the old ones. A
 * record contains only changes, so any number of them can be kept; no statement is ever carried
 * out again.
 *
 * A parameter declared anew after `undo` must not have its old sign. So the symbols of removed
 * names are hidden in the pool, and shown again by `redo`. `reset` starts a new pool; its record
 * is the session before it.
 *
 * Tests  tests/lang/session/test_undo.c, tests/script/session/undo.lag, tests/script/session/undo-included.sh
 */
#ifndef QDOT_LANG_UNDO_H
#define QDOT_LANG_UNDO_H

#include "lang/session/parts.h"

typedef struct qdot_undo qdot_undo;

/* A text begins: within an `include` `undo` goes back to its beginning. Returns what _text_end
 * takes. */
size_t qdot_undo_text_begin(qdot_session *session);
void qdot_undo_text_end(qdot_session *session, size_t outer);

/* A statement of a text begins and ends, well or not. If it changed the session, there is one thing
 * more to undo, all that went on within it (`include`) with it; text [length]: what it says. Without
 * memory for that everything before it can no longer be undone. */
size_t qdot_undo_begin(qdot_session *session);
void qdot_undo_end(qdot_session *session, size_t begun, const char *text, size_t length);

/* The number of statements that can be undone or, with `again`, redone. */
size_t qdot_undo_statements(const qdot_session *session, bool again);
/* Whether undo has reached the beginning of the script that is being included. */
bool qdot_undo_is_at_floor(const qdot_session *session);
/* Take back the latest statement, or do it again: there must be one. *text: what it says, borrowed.
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_undo_step(qdot_session *session, bool again,
                                           const char **text);

/* Record a `reset`; `other` is the session's state before the reset, and is taken over. */
void qdot_undo_reset(qdot_session *session, qdot_session *other);

#endif
