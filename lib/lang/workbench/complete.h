/* complete.h -- completions at a place of a text, for the prompt, editors and notebooks.
 *
 * What may stand there and no more: within a statement by its usage (syntax/usage.h), within
 * `NAME[` by what its entries go by, elsewhere in brackets the words of an expression.
 *
 * Tests  tests/lang/workbench/test_complete.c
 */
#ifndef QDOT_LANG_COMPLETE_H
#define QDOT_LANG_COMPLETE_H

#include "lang/session/parts.h"

/* The words that may stand behind `before` [length], the text typed so far, and begin with
 * `prefix`; sorted, unique. Of a prefix in Greek letters (θ1 for theta1) they begin as it does. Of a family `theta[1]`, `theta[2]`, ... there is one, `theta[`.
 * *words [*n] and each owned by the caller (qdot_free). */
QDOT_MUST_CHECK qdot_status qdot_complete(qdot_session *session, const char *before,
                                          size_t length, const char *prefix,
                                          char ***words, size_t *n);

/* The characters at which a word that is being typed begins anew. */
#define QDOT_COMPLETE_BREAKS " \t\n\"'`@$><=;|&{}()[]+-*/^,:.!%~#"

/* Whether the text [length] ends within a comment or a quoted text. */
typedef enum { QDOT_PLACE_PLAIN, QDOT_PLACE_QUOTED, QDOT_PLACE_COMMENT } qdot_place;
qdot_place qdot_complete_place(const char *text, size_t length);

/* The completions of the word that ends at byte `cursor` of the text; *start: the byte at which it begins. In
 * comments and quoted texts there are none; a name of a Greek letter behind `\` is completed to the letter. *words [*n]
 * as of qdot_complete. */
QDOT_MUST_CHECK qdot_status qdot_complete_at(qdot_session *session, const char *text, size_t cursor, size_t *start,
                                             char ***words, size_t *n);

/* The Greek letters whose spelled names begin with `prefix`, as `\theta`; if it is only one, the
 * letter itself, or (letter false) `theta`. */
QDOT_MUST_CHECK qdot_status qdot_complete_greek(const char *prefix, bool letter,
                                                char ***words, size_t *n);

#endif
