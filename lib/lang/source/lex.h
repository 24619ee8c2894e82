/* lex.h -- splits the bytes of a source into tokens. */
#ifndef QDOT_LANG_LEX_H
#define QDOT_LANG_LEX_H

#include "expr/id.h"
#include "lang/source/token.h"

#define QDOT_LEX_TOKENS 10000000u  /* largest number of tokens in one source */
#define QDOT_LEX_PRIMES 200u       /* largest number of primes after one name */
#define QDOT_LEX_BRACKETS 1000000u /* largest depth of nested brackets */

/* Split source->text into source->tokens. On failure *at is the position of the error. */
QDOT_MUST_CHECK qdot_status qdot_lex(qdot_source *source, size_t *at);
/* The exact value of a QDOT_TOKEN_NUMBER: "9.81", or "1/2" for a fraction of one character. */
qdot_expr qdot_lex_number(qdot_pool *pool, const char *text);

#endif
