/* equilibria.h -- answers a list of equilibria or of steady motions, with their stability. */
#ifndef QDOT_LANG_ASK_EQUILIBRIA_H
#define QDOT_LANG_ASK_EQUILIBRIA_H

#include "lang/functions/equilibria.h"

/* word: equilibria, steady; noun: what one of them is called. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_answer(qdot_session *session, const char *word, const char *noun,
                                                   const qdot_equilibria *all);

#endif
