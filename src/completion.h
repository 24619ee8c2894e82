/* completion.h -- the TAB key.
 *
 * Tests  tests/src/test_prompt.c, tests/lang/workbench/test_complete.c
 */
#ifndef QDOT_COMPLETION_H
#define QDOT_COMPLETION_H

#include "lang/session/parts.h"

/* Install it in readline for this session. Within quotes file names are completed, with one closing
 * quote; behind a backslash Greek letters; elsewhere what may stand there
 * (lang/workbench/complete.h). */
void qdot_completion_install(qdot_session *session);

/* Set the earlier lines of the statement that is being typed; borrowed. */
void qdot_completion_continue(const char *lines);

#endif
