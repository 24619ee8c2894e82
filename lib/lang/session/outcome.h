/* outcome.h -- the outcome of all statements read so far. */
#ifndef QDOT_LANG_OUTCOME_H
#define QDOT_LANG_OUTCOME_H

#include <stddef.h>

#include "lang/session/parts.h"

typedef struct qdot_outcome {
    bool failed;        /* the latest text or file stopped at an error */
    size_t error_at;    /* place of the latest error in its text, in bytes */
    bool refuted;       /* some check was refuted: the program exits with 1 */
    size_t verdicts[3]; /* number of checks for each qdot_verdict */
    bool quit;          /* `quit` was given */
} qdot_outcome;

#endif
