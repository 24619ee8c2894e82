/* session-remarks.h -- what stands as a comment in files of scenes and sessions.
 *
 *     start x = 0.54 # from the end of a, its error 3e-15        behind a number of a run
 *     # B: a number of a run, 0.54 +- 3e-13                      what no statement gives again
 *
 * Where the run is gone in a session that has read such a file, the comment is all that is known: it is kept, and
 * written again.
 *
 * Tests  tests/script/session/session-file.sh, session-again.sh
 */
#ifndef QDOT_LANG_SESSION_REMARKS_H
#define QDOT_LANG_SESSION_REMARKS_H

#include "base/text.h"
#include "lang/session/parts.h"

/* The first line of scene and session files. */
extern const char qdot_session_file_header[];

/* Whether the value is a number with more than twelve digits, which nobody types. */
bool qdot_session_file_is_long(const qdot_session *s, qdot_expr value);

/* If the text begins with the header of a scene or session file, remember its comment lines. */
QDOT_MUST_CHECK qdot_status qdot_session_remarks_keep(qdot_session *s, const char *text, size_t length);

/* End the line that begins at `from` of the text: with a comment that has the error of `value`, where that is a number that
 * was read from a run, or the end of one of the first `runs`, or with the one that was kept of the same line. */
void qdot_session_remarks_end_line(const qdot_session *s, qdot_expr value, size_t runs, size_t from, qdot_text *out);

/* Append the remembered comment lines about names and runs that are still missing; then the text `more`. */
void qdot_session_remarks_lost(const qdot_session *s, const qdot_text *more, qdot_text *out);

#endif
