/* highlight.h -- what each byte of a text that is being typed is, for colours at the prompt.
 *
 * Tests  tests/lang/workbench/test_highlight.c, tests/src/test_screen.c
 */
#ifndef QDOT_LANG_HIGHLIGHT_H
#define QDOT_LANG_HIGHLIGHT_H

#include "lang/session/parts.h"
#include "lang/source/token.h"

typedef enum {
    QDOT_HIGHLIGHT_PLAIN,
    QDOT_HIGHLIGHT_WORD, /* the word of a statement, or of an option in its place */
    QDOT_HIGHLIGHT_NAME, /* a declared name or label, a value or function of the language */
    QDOT_HIGHLIGHT_NUMBER,
    QDOT_HIGHLIGHT_STRING,
    QDOT_HIGHLIGHT_COMMENT,
    QDOT_HIGHLIGHT_WRONG /* a closing bracket without an opening one, or a character without meaning */
} qdot_highlight;

/* kinds [length], one a byte, of `text` [length] as far as it is typed. Errors: QDOT_ENOMEM; the
 * kinds are those found till then. */
QDOT_MUST_CHECK qdot_status qdot_highlight_text(qdot_session *session, const char *text, size_t length, uint8_t *kinds);

/* *is: whether the name is a word of the statement that begins at `first`, or of an option; in_brackets: it stands within
 * them. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_highlight_is_word(qdot_session *session, const qdot_source *source, const qdot_token *first,
                                                   const qdot_token *name, bool in_brackets, bool *is);

#endif
