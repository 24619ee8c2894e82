/* cursor.h -- a reading position in the tokens of a statement. */
#ifndef QDOT_LANG_CURSOR_H
#define QDOT_LANG_CURSOR_H

#include "lang/session/parts.h"
#include "lang/source/token.h"

typedef struct {
    qdot_session *session;
    const qdot_source *source;
    const qdot_token
        *at;         /* the next token to be read; a statement ends with a token END */
    size_t error_at; /* position of the last error in bytes, set by every reader that fails */
    /* of a text that is being typed, the names of which need not be declared yet: whether a name is a word of the
     * statement's usage; else NULL */
    bool (*is_word)(const void *usage, const char *name);
    const void *usage;
} qdot_cursor;

bool qdot_cursor_is_op(const qdot_cursor *c, const char *op);
bool qdot_cursor_is_word(const qdot_cursor *c, const char *word);
bool qdot_cursor_accept_op(qdot_cursor *c, const char *op); /* if the next token is `op`, step over it */
bool qdot_cursor_accept_word(qdot_cursor *c, const char *word);
bool qdot_cursor_is_end(const qdot_cursor *c);
/* Fail at the next token: "expected WHAT, found `...`". With hint for a missing `*`, other systems'
 * forms where they can be known. QDOT_ESYNTAX. */
qdot_status qdot_cursor_expected(qdot_cursor *c, const char *what);
QDOT_MUST_CHECK qdot_status qdot_cursor_expect_op(qdot_cursor *c, const char *op);
QDOT_MUST_CHECK qdot_status qdot_cursor_expect_end(qdot_cursor *c);
/* Whether the blank before this token, which is not the first one, is a product, as in `½ m v²`: between two operands of
 * a statement that is written as the screen shows formulas, of which none is a word of the language. inside: within ( ) or [ ]. */
bool qdot_cursor_is_shown_product(const qdot_cursor *c, const qdot_token *t, bool inside);
/* The byte after the operand that begins with `t`, including its brackets and primes. */
size_t qdot_cursor_operand_end(const qdot_cursor *c, const qdot_token *t);
/* Whether the name is known: declared by the user, or a word of the language, or a label of the scene. */
bool qdot_cursor_knows(const qdot_session *session, const char *name);
/* Whether the token t begins a call of a known function, as in `cos(`. */
bool qdot_cursor_is_call(const qdot_cursor *c, const qdot_token *t);

#endif
