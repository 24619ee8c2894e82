/* shown.h -- what a person reads of an answer with formulas, made once for all programs that show answers (output.h,
 * `display`); each function appends nothing where answers are not displayed.
 *
 * Tests  tests/api/test_display.c
 */
#ifndef QDOT_LANG_SHOWN_H
#define QDOT_LANG_SHOWN_H

#include "base/text.h"
#include "lang/answer/sheet.h"
#include "lang/answer/shown-text.h"

/* Appends an answer to a sheet: to one for each notation. */
typedef qdot_status (*qdot_shown_writer)(qdot_sheet *sheet, const void *answer);

/* Print a line as the prompt does. Errors: of the writer, and as for qdot_sheet_end. */
QDOT_MUST_CHECK qdot_status qdot_shown_print(qdot_session *session, qdot_shown_writer write, const void *answer);

/* Append all three fields of an answer that is a line with a formula. */
QDOT_MUST_CHECK qdot_status qdot_shown_formula(qdot_session *session, qdot_shown_writer write, const void *answer,
                                               qdot_text *object);

/* Append "text", the lines that are written, and "html", the same lines in <div class="CLASS">, `after` behind them. */
QDOT_MUST_CHECK qdot_status qdot_shown_words(qdot_session *session, qdot_shown_writer write, const void *answer,
                                             const char *class, const char *after, qdot_text *object);

#endif
