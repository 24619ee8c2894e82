/* startup.h -- the startup file, read before the first prompt.
 *
 * Tests  tests/src/test_prompt.c
 */
#ifndef QDOT_STARTUP_H
#define QDOT_STARTUP_H

#include "lang/workbench/script.h"

/* Carry out $XDG_CONFIG_HOME/qdot/init.lag, or else ~/.config/qdot/init.lag, if there is one. An
 * error in it is reported, and the session goes on with what stands before it. */
void qdot_startup_read(qdot_session *session);

#endif
