/* write.h -- answers written: texts, as they stand or as JSON.
 *
 * Tests  tests/script/, tests/lang/session/test_session.c
 */
#ifndef QDOT_LANG_WRITE_H
#define QDOT_LANG_WRITE_H

#include "base/terminal.h"
#include "base/text.h"
#include "lang/session/parts.h"

/* Write a finished text to `out`, `err` or `console` of session->output, and clear it: on a terminal as wide as that
 * (base/wrap.h), else as it is. QDOT_EIO. */
QDOT_MUST_CHECK qdot_status qdot_write(const qdot_session *session, FILE *file, qdot_text *text);

/* Write a JSON object `{...}` and a newline; to an answer add which statement it belongs to. */
QDOT_MUST_CHECK qdot_status qdot_write_object(const qdot_session *session, FILE *file, qdot_text *object);

/* Write the object of an answer if `status`, that of its parts, is QDOT_OK; it is cleared. Returns the first failure. */
QDOT_MUST_CHECK qdot_status qdot_write_answer(const qdot_session *session, qdot_status status, qdot_text *object);

/* Whether answers are shown by a program that can draw (output.h, `display`), and do not go to a file now. */
bool qdot_write_displays(const qdot_session *session);

/* Answer {"kind":KIND}, "figure" or "page": what a displaying program shows, such as the text of an image; mime: its
 * type, "image/svg+xml"; name: what it is of. Written if `status`, that of the text, is QDOT_OK; the text is cleared. */
QDOT_MUST_CHECK qdot_status qdot_answer_shown(qdot_session *session, const char *kind, const char *mime,
                                              const char *name, qdot_status status, qdot_text *text);

/* The columns of the terminal to which `file` is connected; 0 if it is none, or if JSON is written. */
size_t qdot_write_width(const qdot_session *session, const FILE *file);

/* The stream for which answers are meant: the terminal, even while they are collected for pages. */
FILE *qdot_write_stream(const qdot_session *session);

/* Whether answers are coloured at their present destination. */
bool qdot_write_colours(const qdot_session *session);
#define QDOT_NAME_COLOUR QDOT_CYAN /* colour of names and labels */

/* Append the text `before` to a line of JSON, then `text` as a JSON string. */
void qdot_write_field(qdot_text *line, const char *before, const char *text);

/* Answer {"kind":"text"}: the text unchanged, with a newline added if it has none at its end. */
QDOT_MUST_CHECK qdot_status qdot_answer_text(qdot_session *session, const char *name,
                                             const char *text);
/* As qdot_answer_text where answers are displayed, with a part of a page of HTML that shows the text typeset. */
QDOT_MUST_CHECK qdot_status qdot_answer_typeset(qdot_session *session, const char *name, const char *text,
                                                const char *html);
/* The same of a text that was written with that status, which is returned if it is none; the text
 * is cleared. */
QDOT_MUST_CHECK qdot_status qdot_answer_written(qdot_session *session, const char *name,
                                                qdot_status status, qdot_text *text);
/* As qdot_answer_text, for lines that must not be broken: drawings, formulas of one line. */
QDOT_MUST_CHECK qdot_status qdot_answer_drawn(qdot_session *session, const char *name,
                                              qdot_status status, qdot_text *text);

#endif
