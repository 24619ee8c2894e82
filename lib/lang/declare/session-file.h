/* session-file.h -- the runs of a session, and names that hold numbers of them, as statements.
 *
 * Each run is made anew under the conditions it was made under: `with` has the values that differ from
 * those of the file, and where the start differs `start` stands before it, or `start RUN` where it was
 * the end of one. A name that holds numbers of runs is written as the statement that reads them, behind
 * the run that was the latest then; so its numbers come with their errors again. What cannot be made
 * again - a run of an earlier scene, a number of a run that is gone - is a comment with what is known,
 * and a notice.
 *
 * Tests  tests/script/session/session-file.sh
 */
#ifndef QDOT_LANG_SESSION_FILE_H
#define QDOT_LANG_SESSION_FILE_H

#include "base/text.h"
#include "lang/session/conditions.h"
#include "lang/session/parts.h"

/* Append the runs, and names that hold their numbers, and to `lost` comments of what cannot be made again. runs false:
 * nothing, and a notice for each name. */
QDOT_MUST_CHECK qdot_status qdot_session_file_runs(qdot_session *s, bool runs, qdot_text *lost, qdot_text *out);

/* The present start as conditions of a run: q0, v0, and which of them are given or exact. Clear c
 * in any case. */
QDOT_MUST_CHECK qdot_status qdot_session_file_present_start(const qdot_session *s, qdot_conditions *c);

#endif
