/* digits.h -- numbers of runs with `digits N`: exact internally, printed with N digits.
 *
 * Tests  tests/script/digits/digits.lag
 */
#ifndef QDOT_LANG_DIGITS_H
#define QDOT_LANG_DIGITS_H

#include "base/text.h"
#include "lang/session/parts.h"

/* The fewest digits among the runs whose numbers stand in e, where all of them have
 * `digits`; else 0. */
int qdot_digits_of(qdot_session *session, qdot_expr e);

/* A number e in digits: as many of `digits` as the error (absolute; NaN unknown) leaves
 * meaningful, at least one. Numbers of runs in e are put in. */
QDOT_MUST_CHECK qdot_status qdot_digits_text(qdot_session *session, qdot_expr e,
                                             int digits, double error, qdot_text *out);

/* As qdot_digits_text, for an expression; *error is raised at least to the error of the printed digits. */
QDOT_MUST_CHECK qdot_status qdot_digits_number(qdot_session *session, qdot_expr e, int digits, double *error,
                                               qdot_text *out);

/* {"kind":"number"}, {"kind":"numbers"}: e a number or a list of them, its numbers of runs
 * with so many digits. */
QDOT_MUST_CHECK qdot_status qdot_digits_answer(qdot_session *session, const char *name,
                                               qdot_expr e, int digits);

/* Find left - right as a double, without the rounding error of either; both are results of runs. */
QDOT_MUST_CHECK qdot_status qdot_digits_difference(qdot_session *session, qdot_expr left,
                                                   qdot_expr right, double *difference);

#endif
