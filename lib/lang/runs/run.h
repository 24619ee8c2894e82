/* run.h -- carries out a run that was read.
 *
 * Tests  tests/script/runs/run.sh
 */
#ifndef QDOT_LANG_RUN_H
#define QDOT_LANG_RUN_H

#include "lang/runs/run-options.h"

/* Make the run of the present values and these options, keep it as the latest, tell how it went;
 * start: the first token of what it was read from. QDOT_EFAILED: it failed and is kept. */
QDOT_MUST_CHECK qdot_status qdot_run_carry_out(qdot_cursor *c, const qdot_token *start,
                                               const qdot_run_options *o);

#endif
