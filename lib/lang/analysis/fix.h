/* fix.h -- what would mend an error, from its hint.
 *
 *   did you mean `theta`?          the name in place of the one at fault
 *   write sin(x)^2                 the text in place of what it is made of: the tokens, from the one at fault or the beginning of the
 *                                  statement, whose names and numbers it keeps, all but the first
 *   `param m` declares a parameter a line above the statement
 *
 * Only what leaves fewer errors in the whole script is given, which is found by analysing it.
 *
 * Tests  tests/lang/analysis/test_fix.c, tests/meta/lsp.test
 */
#ifndef QDOT_LANG_FIX_H
#define QDOT_LANG_FIX_H

#include "lang/analysis/layout.h"

/* Append the edits that mend a remark of the analysis, each by itself; clear them by qdot_layout_clear. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_fix_find(const qdot_analysis *a, const qdot_remark *remark, qdot_edit_list *fixes);

/* The number of errors of the analysis, and of the text that it has once the edits, in order, are made. */
size_t qdot_fix_errors(const qdot_analysis *a);
QDOT_MUST_CHECK qdot_status qdot_fix_errors_with(const qdot_analysis *a, const qdot_edit_list *edits, size_t *errors);

#endif
