/* outline.h -- where the statements and blocks of a source begin and end, before they are read by their usages.
 *
 *   T for k = 1..3 to "x.tex"      first, loop, end
 *   { ...; ... } for k = 1..3      blocks
 *
 * Tests  tests/script/language/, tests/bad/language/
 */
#ifndef QDOT_LANG_OUTLINE_H
#define QDOT_LANG_OUTLINE_H

#include "lang/session/parts.h"
#include "lang/source/token.h"

typedef struct {
    const qdot_token *first;
    const qdot_token *loop; /* the word `for` of its loop; NULL: none */
    const qdot_token *end;  /* its end, behind the loop */
} qdot_outline;

/* What is at a token with which a statement may begin. */
typedef enum { QDOT_OUTLINE_END, QDOT_OUTLINE_BLOCK, QDOT_OUTLINE_STATEMENT } qdot_outline_kind;

qdot_outline_kind qdot_outline_at(const qdot_token *first);
/* The statement that begins at `first`. plot keeps a loop that goes with `vs NAME =` or is over a declared NAME. */
qdot_outline qdot_outline_statement(const qdot_session *session, const qdot_token *first);
/* The end of the statement in which the token is. */
const qdot_token *qdot_outline_end(const qdot_token *token);

/* For each `{` of the source the index of its `}`; NULL: there are no blocks. Free it. */
QDOT_MUST_CHECK qdot_status qdot_outline_blocks(const qdot_source *source, uint32_t **close);
/* The word `for` behind the `}` of a block; NULL: another token stands there. */
const qdot_token *qdot_outline_block_loop(const qdot_token *close);

/* The word `to` of `to "FILE"` at the end of the statement; NULL: it does not end so. */
const qdot_token *qdot_outline_file(const qdot_token *first);

/* While a part of a statement is carried out, the word behind it, `for` or `to`, is its end; then a word again. */
void qdot_outline_cut(const qdot_token *word);
void qdot_outline_join(const qdot_token *word);

/* Whether a failure at byte `at` is in the first tokens of the statement [first, end): then an example of it helps. *open:
 * it is behind the last of them. */
bool qdot_outline_fails_early(const qdot_token *first, const qdot_token *end, size_t at, bool *open);

#endif
