/* source.h -- a text with its tokens, shared by what uses it, and errors that show the place.
 *
 * Limits, each a clear error: 10^7 tokens, 10^6 open brackets. Tests: tests/lang/source/test_lex.c
 */
#ifndef QDOT_LANG_SOURCE_H
#define QDOT_LANG_SOURCE_H

#include "base/text.h"
#include "lang/source/token.h"

/* Lex. Errors (QDOT_ESYNTAX, with the place in *at): bytes that are no UTF-8 or no text, a bracket that
 * does not match, an unfinished string. *source is set then too, for the report, and the
 * caller's to free; it is NULL only for QDOT_ENOMEM and a text of 4 GB.
 *
 * Blank statements leave no token: an END follows each statement, one also stands before `}`, none
 * directly after `{`. A source of nothing is one END. */
QDOT_MUST_CHECK qdot_status qdot_source_new(const char *name, const char *text,
                                            size_t length, qdot_source **source,
                                            size_t *at);
qdot_source *qdot_source_keep(const qdot_source *source); /* count one more user of the source */
void qdot_source_free(qdot_source *source); /* count one user less; the last one frees the source */

/* Find where a byte is: line and column from 1 (columns count characters), and the line in the whole input. */
void qdot_source_locate(const qdot_source *source, size_t at, uint32_t *line,
                        uint32_t *column);
/* "file:line:column: error: message", the line, the caret, "hint: ...". A very long line is cut
 * round the caret. colours: with codes for a terminal; width: its columns, 0: there is none. */
void qdot_source_report(const qdot_source *source, size_t at, const qdot_error *error,
                        bool colours, size_t width, qdot_text *out);

#endif
