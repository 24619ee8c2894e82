/* hint-check.h -- whether the text of a hint `write TEXT` can be typed.
 *
 * A hint is made of the statement at fault, which may have more faults than the one that the hint mends: `T = (x +` lacks an
 * operand besides its bracket. What the hint says to write must parse; otherwise it is taken back.
 *
 * Tests  tests/lang/language/test_hints.c
 */
#ifndef QDOT_LANG_HINT_CHECK_H
#define QDOT_LANG_HINT_CHECK_H

#include "lang/session/parts.h"
#include "lang/source/token.h"

/* Parses a text. Returns the byte at which it fails, or SIZE_MAX: it does not. */
typedef size_t qdot_hint_parser(qdot_session *session, const char *text, size_t length);

/* Take back the hint of the last error, if it is `write TEXT` and the text does not parse. Where the text has a fault whose own hint
 * is a text that parses, of the same statement, that is the hint. */
void qdot_hint_check(qdot_session *session, qdot_hint_parser *find_fault);
/* The same, if the text is an expression in a statement [first, end) that begins with a word, with a fault at byte `at` of the
 * source, and this fails in the text or before it, wherever that is put. */
void qdot_hint_check_in_place(qdot_session *session, qdot_hint_parser *find_fault, const qdot_source *source,
                              const qdot_token *first, const qdot_token *end, size_t at);

#endif
