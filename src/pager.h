/* pager.h -- answers that are longer than the screen.
 *
 * Tests  tests/src/test_prompt.c
 */
#ifndef QDOT_PAGER_H
#define QDOT_PAGER_H

#include "lang/session/parts.h"

/* Collect the answers and errors of a session that writes to a terminal, from here to
 * qdot_pager_end; false: they go where they always go, and nothing is to end. */
bool qdot_pager_begin(qdot_session *session);

/* Write what was collected: by $PAGER (`less -FRX` if there is none) if it is longer than the
 * screen, else as it is. */
void qdot_pager_end(qdot_session *session);

#endif
