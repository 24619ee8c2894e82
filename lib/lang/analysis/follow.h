/* follow.h -- what a text says is kept while the text changes.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_FOLLOW_H
#define QDOT_LANG_FOLLOW_H

#include "lang/analysis/analysis.h"

/* Take over another text [length]; analysed are still the statements before the first that is another one. QDOT_ENOMEM;
 * QDOT_ELIMIT: it is too long. */
QDOT_MUST_CHECK qdot_status qdot_follow_text(qdot_analysis *a, const char *text, size_t length);
/* Analyse anew what depends on files, for they have changed. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_follow_files(qdot_analysis *a);
/* Analyse the statements that are left. *done: there are no more; false: something waits, or Ctrl-C was simulated
 * (qdot_interrupt_set) within a statement, which is then analysed next. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_follow_on(qdot_analysis *a, bool *done);

#endif
