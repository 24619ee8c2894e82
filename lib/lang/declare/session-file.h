/* session-file.h -- the runs of a session, and names that hold numbers of them, as statements.
 *
 * Each run is made anew under the conditions it was made under: `with` has the values that differ from
 * those of the file, and where the start differs `start` stands before it, or `start RUN` where it was
 * the end of one. A name that holds numbers of runs is written as the statement that reads them, behind
 * the run that was the latest then; so its numbers come with their errors again. What cannot be made
 * again - a run of an earlier scene, a number of a run that is gone - is a comment with what is known,
 * and a notice.
 *
 * Tests  tests/script/session-file.sh
 */
#ifndef QDOT_LANG_SESSION_FILE_H
#define QDOT_LANG_SESSION_FILE_H

#include "lang/session/session.h"

/* Append the runs, and names that hold their numbers. runs false: nothing, and a notice for each name. */
QDOT_MUST_CHECK qdot_status qdot_session_file_runs(qdot_session *s, bool runs, qdot_text *out);

/* Append a comment with its error where the value is a number that was read from a run. */
void qdot_session_file_remark(const qdot_session *s, qdot_expr value, qdot_text *out);

#endif
