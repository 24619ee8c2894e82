/* outcome.h -- the outcome of all statements read so far. */
#ifndef QDOT_LANG_OUTCOME_H
#define QDOT_LANG_OUTCOME_H

#include "lang/session/parts.h"

typedef struct qdot_outcome {
    bool failed;        /* the latest text or file stopped at an error */
    bool refuted;       /* a check was refuted: exit 1 at the end */
    size_t verdicts[3]; /* number of checks by qdot_verdict */
    bool quit;          /* after `quit` */
} qdot_outcome;

#endif
