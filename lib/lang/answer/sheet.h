/* sheet.h -- answers in which formulas stand: laid out on a terminal, as aligned equations in LaTeX
 * and MathML, else in lines as they are.
 *
 *     const qdot_sheet s = qdot_sheet_begin(session);
 *     ... text: lines with formulas in session->style, each between qdot_formula_bracket
 *     return qdot_sheet_end(session, &s, name, status, &text);
 *
 * Tests  tests/script/geometry/styles.lag, tests/script/derive/derive.lag, tests/src/test_screen.c
 */
#ifndef QDOT_LANG_SHEET_H
#define QDOT_LANG_SHEET_H

#include "lang/session/session.h"

typedef struct {
    bool laid_out;        /* on a terminal, from MathML */
    bool marked;          /* of the session before */
    size_t columns, rows; /* of the terminal */
    qdot_style style;     /* of the session before */
    bool whole;           /* never cut where it is higher than the terminal */
    uint64_t operations;  /* of the one formula in it; 0: not said where it is cut */
} qdot_sheet;

/* From here to the end the session has the style and the marks that the lines are to be in. */
qdot_sheet qdot_sheet_begin(qdot_session *session);

/* Append text, as MathML for a sheet that is laid out, word by word. */
void qdot_sheet_words(const char *text, size_t n, qdot_text *out);

/* The lines are answered if the status is good; they are cleared. With --json as the text `name`. */
QDOT_MUST_CHECK qdot_status qdot_sheet_end(qdot_session *session, const qdot_sheet *sheet,
                                           const char *name, qdot_status status,
                                           qdot_text *lines);

/* Equations of the present statement that are collected for one block are written. */
QDOT_MUST_CHECK qdot_status qdot_sheet_flush(qdot_session *session);

#endif
