/* report-answer.h -- collects the answers of statements for the page of a report. */
#ifndef QDOT_LANG_REPORT_ANSWER_H
#define QDOT_LANG_REPORT_ANSWER_H

#include "expr/print-name.h"
#include "lang/syntax/record.h"
#include "show/formula-page.h"

/* The session's settings, saved while an answer is collected. */
typedef struct {
    FILE *out, *console, *file;
    bool json, console_json;
    qdot_style style;
    size_t history, history_over;
    qdot_formula_page page, *page_before;
    char *text;
    size_t length;
} qdot_report_answer;

/* From here on what the session answers is taken down, in this style: MathML as a part of a page (show/page.h), another
 * as text. `a` stays where it is. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_report_answer_begin(qdot_session *s, qdot_style style,
                                                     qdot_report_answer *a);
/* The session answers as before; append to `text` what was taken down. A failure, status, other than
 * a grave one is the answer itself: `Not found: ...`. */
QDOT_MUST_CHECK qdot_status qdot_report_answer_end(qdot_session *s, qdot_report_answer *a,
                                                   qdot_status status, qdot_text *text);

/* Append the answer of a statement without operands, as part of a page. */
QDOT_MUST_CHECK qdot_status qdot_report_answer_of(const qdot_cursor *c,
                                                  const qdot_statement *statement,
                                                  qdot_text *text);

/* _line: append a line of words; the other: `Not found: ` and the cause of the last failure. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_report_line(qdot_text *page, const char *words);
QDOT_MUST_CHECK qdot_status qdot_report_not_found(qdot_text *page);

/* Append a heading of the page. */
void qdot_report_heading(qdot_text *page, const char *title);

#endif
