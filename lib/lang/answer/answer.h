/* answer.h -- prints the answers of a session: one function for each kind of answer, as text or
 * as JSON.
 *
 * Text goes to session->output->out in the session's style; with --json one object a line (kinds
 * and fields as the language reference has them). Doubles are written with 17 digits in
 * JSON, null where they are not finite; in text with the digits that their error leaves
 * meaningful.
 *
 * Tests  tests/script/, tests/lang/session/test_session.c
 */
#ifndef QDOT_LANG_ANSWER_H
#define QDOT_LANG_ANSWER_H

#include "base/text.h"
#include "lang/answer/write.h"
#include "lang/source/token.h"
#include "normal/prove/decide.h"

/* {"kind":"expr"}: `name = value`, `name: left = right` for an equation; just the
 * value where the name says the same or is NULL. */
QDOT_MUST_CHECK qdot_status qdot_answer_expr(qdot_session *session, const char *name,
                                             qdot_expr value);

/* {"kind":"expr"} of `name`; as text `symbol = value`, what a member of momenta, accel,
 * forces is called. */
QDOT_MUST_CHECK qdot_status qdot_answer_solved(qdot_session *session, const char *name,
                                               qdot_expr symbol, qdot_expr value);

/* Answer {"kind":"number"} with an error bound: 0 if the value is exact, NaN if the error is unknown. */
QDOT_MUST_CHECK qdot_status qdot_answer_number(qdot_session *session, const char *name,
                                               double value, double error);
/* The same for a number that e is, such as an unknown that was found: with its unit, where e has a dimension. */
QDOT_MUST_CHECK qdot_status qdot_answer_quantity(qdot_session *session, const char *name, qdot_expr e, double value,
                                                 double error);
/* The same for an estimate, whose error is a standard error: a person reads two digits of it, "2.3855 ± 0.0012". */
QDOT_MUST_CHECK qdot_status qdot_answer_estimate(qdot_session *session, const char *name, qdot_expr e, double value,
                                                 double error);
/* Answer {"kind":"number"} without an error: a person reads a few digits. */
QDOT_MUST_CHECK qdot_status qdot_answer_statistic(qdot_session *session, const char *name, double value);
/* Answer {"kind":"numbers"}: values [n], errors [n]; _statistics: a person reads a few digits, no errors. */
QDOT_MUST_CHECK qdot_status qdot_answer_statistics(qdot_session *session, const char *name, size_t n,
                                                   const double *values, const double *errors);
QDOT_MUST_CHECK qdot_status qdot_answer_numbers(qdot_session *session, const char *name,
                                                size_t n, const double *values,
                                                const double *errors);

/* Numbers in digits: where JSON is written values and errors are JSON with commas; text is what the prompt prints, the
 * values with their errors. Start with `qdot_numerals x = {0};`. */
typedef struct {
    qdot_text values, errors, text;
} qdot_numerals;

/* {"kind":"number"}, {"kind":"numbers"} of numbers that were written with that status, which is returned if it is none;
 * they are cleared. */
QDOT_MUST_CHECK qdot_status qdot_answer_numerals(qdot_session *session, const char *name, bool several, qdot_status status,
                                                 qdot_numerals *numerals);

/* Answer {"kind":"check"}: the verdict, with left and right as they were compared. */
QDOT_MUST_CHECK qdot_status qdot_answer_check(qdot_session *session, qdot_expr left,
                                              qdot_expr right,
                                              const qdot_decision *decision);

/* Answer {"kind":"file"}: `wrote PATH`. */
QDOT_MUST_CHECK qdot_status qdot_answer_file(qdot_session *session, const char *path);

/* The text becomes that file, then as qdot_answer_file. Errors: those of the text and of
 * qdot_sink_write. */
QDOT_MUST_CHECK qdot_status qdot_answer_in_file(qdot_session *session, const char *path,
                                                const qdot_text *text);

/* Answer {"kind":"notice"}: `notice: MESSAGE` (printf). */
QDOT_MUST_CHECK qdot_status qdot_answer_notice(qdot_session *session, const char *format,
                                               ...) QDOT_PRINTF(2, 3);
/* Give a notice in whose format %s stands for e, printed as plain text. */
QDOT_MUST_CHECK qdot_status qdot_answer_notice_of(qdot_session *session, const char *format, qdot_expr e);
/* Give a notice, unless this session has already given it. */
QDOT_MUST_CHECK qdot_status qdot_answer_notice_once(qdot_session *session,
                                                    const char *format, ...)
    QDOT_PRINTF(2, 3);
/* Give a notice that belongs to the answers of the present statement, as the condition of a solution, unless this
 * statement has already given it. */
QDOT_MUST_CHECK qdot_status qdot_answer_condition(qdot_session *session, const char *format, ...) QDOT_PRINTF(2, 3);
/* Each of the three for a text that was written with `status`: if that is QDOT_OK give the text as a notice; free it in any
 * case. Returns `status`, or the first failure after it. */
QDOT_MUST_CHECK qdot_status qdot_answer_notice_text(qdot_session *session, qdot_status status, qdot_text *text);
QDOT_MUST_CHECK qdot_status qdot_answer_notice_once_text(qdot_session *session, qdot_status status, qdot_text *text);
QDOT_MUST_CHECK qdot_status qdot_answer_condition_text(qdot_session *session, qdot_status status, qdot_text *text);

/* The last failure: reported with line, caret and hint on session->output->err and, with
 * --json, as {"kind":"error"} on session->output->out. `at`: the byte of the source. source
 * NULL: no place. */
void qdot_answer_error(qdot_session *session, const qdot_source *source, size_t at);

#endif
