/* range.h -- finds the maximum, minimum, mean and drift over a time range of a run. */
#ifndef QDOT_LANG_RANGE_H
#define QDOT_LANG_RANGE_H

#include "lang/session/parts.h"

bool qdot_range_is_word(const char *word);
/* Whether the word is max, min, mean, drift or `value`: functions that read a run at intermediate times. */
bool qdot_range_is_of_way(const char *word);
/* Of each expression [n] along the run (NULL: the latest) between range [2], NULL: all of
 * it. A list where there are several. */
QDOT_MUST_CHECK qdot_status qdot_range_value(qdot_session *session, const char *run,
                                             const char *word, uint32_t n,
                                             const qdot_expr *args,
                                             const qdot_expr *range, qdot_expr *value);

#endif
