/* prompt.h -- the conversation at a terminal. */
#ifndef QDOT_PROMPT_H
#define QDOT_PROMPT_H

#include "lang/commands/script.h"

/* Read lines with readline and carry them out until Ctrl-D or `quit`. An error leaves
 * the session as it was. History is kept in $XDG_STATE_HOME/qdot/history, or below
 * ~/.local/state. */
void qdot_prompt_run(qdot_session *session, bool banner);

#endif
