/* sheet.h -- an answer in which formulas stand: lines of words and formulas, as data.
 *
 *     qdot_sheet s = qdot_sheet_begin(session);
 *     qdot_sheet_words(&s, "the force is ");
 *     status = qdot_sheet_formula(&s, force);
 *     return qdot_sheet_end(&s, name, status);
 *
 * At its end a sheet is drawn on a terminal, becomes equations of a page (LaTeX, MathML), or lines of text.
 *
 * A formula stands between qdot_sheet_open and qdot_sheet_close. Where memory runs out the sheet is marked as failed,
 * which qdot_sheet_end tells.
 *
 * Tests  tests/script/geometry/styles.lag, tests/script/derive/derive.lag, tests/src/test_screen.c
 */
#ifndef QDOT_LANG_SHEET_H
#define QDOT_LANG_SHEET_H

#include "expr/print-name.h"
#include "formula/formula.h"
#include "lang/session/parts.h"

typedef enum {
    QDOT_SHEET_LINES, /* the answer is written as lines of text */
    QDOT_SHEET_DRAWN, /* drawn in two dimensions on a terminal */
    QDOT_SHEET_PAGE   /* as a part of a page, in LaTeX or HTML */
} qdot_sheet_form;

typedef struct qdot_sheet {
    qdot_session *session;
    struct qdot_sheet *typeset; /* the same answer as a part of a page of HTML, where a program displays answers; NULL: not */
    qdot_sheet_form form;
    qdot_style style; /* style of formulas that are written as text */
    qdot_notation_kind notation;
    struct qdot_formula_page *page; /* the page to which the answer's lines belong; NULL: equations of the present statement */
    qdot_formula formula;
    qdot_formula_id lines, line, at; /* formula nodes: parent of all lines; present line; where parts are appended */
    size_t columns, rows;            /* size of the terminal */
    bool broken;                     /* whether lines of text are broken at the width of the terminal */
    bool whole; /* never shorten the answer if it is higher than the terminal */
    uint64_t operations;             /* operations of its single formula, shown where it is cut; 0: not shown */
} qdot_sheet;

/* Begin an answer, whose formulas may be drawn over several rows. */
qdot_sheet qdot_sheet_begin(qdot_session *session);
/* As qdot_sheet_begin, but formulas stand within lines of text, never drawn over several rows. */
qdot_sheet qdot_sheet_begin_words(qdot_session *session);
/* Begin a sheet that becomes a text of this style (qdot_sheet_text), without marks around formulas. */
qdot_sheet qdot_sheet_begin_text(qdot_session *session, qdot_style style);
/* Begin a sheet that becomes a part of a page of HTML (qdot_sheet_html). */
qdot_sheet qdot_sheet_begin_html(qdot_session *session);

/* Append text to the answer; \n ends a line. */
void qdot_sheet_words(qdot_sheet *sheet, const char *text);
void qdot_sheet_format(qdot_sheet *sheet, const char *format, ...) QDOT_PRINTF(2, 3);

/* Append a number to the answer, to `digits` digits. */
void qdot_sheet_double(qdot_sheet *sheet, double x, int digits);

/* Append a number with only the digits that its error leaves meaningful. */
void qdot_sheet_known(qdot_sheet *sheet, double x, double error);

/* _open: begin a formula in the answer; _close: end it. */
void qdot_sheet_open(qdot_sheet *sheet);
void qdot_sheet_close(qdot_sheet *sheet);

/* Append to the open formula: a sign, an expression, the name of an answer as it was typed. Errors: those of
 * lang/answer/expression.h. */
void qdot_sheet_sign(qdot_sheet *sheet, qdot_formula_sign sign);
QDOT_MUST_CHECK qdot_status qdot_sheet_expr(qdot_sheet *sheet, qdot_expr e);
QDOT_MUST_CHECK qdot_status qdot_sheet_name(qdot_sheet *sheet, const char *name, unsigned flags);

/* Append e to the answer as a formula. */
QDOT_MUST_CHECK qdot_status qdot_sheet_formula(qdot_sheet *sheet, qdot_expr e);

/* Add parts that the functions above do not have: `write` adds them to the formula of the sheet that it gets, which is
 * each in which the answer is kept. Returns its first failure. */
QDOT_MUST_CHECK qdot_status qdot_sheet_each(qdot_sheet *sheet, qdot_status (*write)(qdot_sheet *one, void *data), void *data);

/* _at_begin: whether the present line is empty; _is_empty: whether the whole sheet is. */
bool qdot_sheet_at_begin(const qdot_sheet *sheet);
bool qdot_sheet_is_empty(const qdot_sheet *sheet);

/* Print the answer if status is QDOT_OK (with --json as the text `name`), and free it. */
QDOT_MUST_CHECK qdot_status qdot_sheet_end(qdot_sheet *sheet, const char *name, qdot_status status);

/* As qdot_sheet_end, but append the answer to a text; _html: of a sheet that was begun as a part of a page. */
QDOT_MUST_CHECK qdot_status qdot_sheet_text(qdot_sheet *sheet, qdot_status status, qdot_text *out);
QDOT_MUST_CHECK qdot_status qdot_sheet_html(qdot_sheet *sheet, qdot_status status, qdot_text *out);

/* Free the answer without printing it. */
void qdot_sheet_clear(qdot_sheet *sheet);

/* Write, or discard, the equations of the present statement that were collected for one block. */
QDOT_MUST_CHECK qdot_status qdot_sheet_flush(qdot_session *session);
void qdot_sheet_forget(qdot_session *session);

#endif
