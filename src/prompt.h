/* prompt.h -- reads and carries out statements typed at a terminal. */
#ifndef QDOT_PROMPT_H
#define QDOT_PROMPT_H

#include "lang/workbench/script.h"

/* Read statements with readline and carry them out until Ctrl-D or `quit`. An error leaves
 * the session as it was. startup: after the startup file (startup.h). Ctrl-C never ends it. */
void qdot_prompt_run(qdot_session *session, bool banner, bool startup);

#endif
