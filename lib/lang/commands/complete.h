/* complete.h -- completions of a word, for the prompt. */
#ifndef QDOT_LANG_COMPLETE_H
#define QDOT_LANG_COMPLETE_H

#include "lang/session/session.h"

/* Completions of a word prefix: statement words, functions, values, declared names; sorted, unique.
 * *words [*n] and each owned by the caller (qdot_free). */
QDOT_MUST_CHECK qdot_status qdot_complete(qdot_session *session, const char *prefix,
                                          char ***words, size_t *n);

#endif
