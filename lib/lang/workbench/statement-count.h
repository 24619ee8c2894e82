/* statement-count.h -- the statements of what was typed are counted, kept, and told when they are done.
 *
 * Tests  tests/script/files/json-stream.sh, tests/script/files/history.sh
 */
#ifndef QDOT_LANG_STATEMENT_COUNT_H
#define QDOT_LANG_STATEMENT_COUNT_H

#include "lang/session/parts.h"
#include "lang/source/source.h"

/* Record that a statement begins at byte `at` of the source; no effect within another statement. */
void qdot_typed_begin(qdot_session *session, const qdot_source *source, size_t at);

/* Record that the statement ends; its text [length] is stored for `save history` if it succeeded. */
void qdot_typed_end(qdot_session *session, const char *text, size_t length, qdot_status status);

#endif
