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
    const qdot_token *loop; /* the word `for` of the statement's loop; NULL: it has none */
    const qdot_token *end;  /* the end of the statement, after its loop */
} qdot_outline;

/* What begins at a token at which a statement may begin: a statement, a block, an end. */
typedef enum { QDOT_OUTLINE_END, QDOT_OUTLINE_BLOCK, QDOT_OUTLINE_STATEMENT } qdot_outline_kind;

qdot_outline_kind qdot_outline_at(const qdot_token *first);
/* The statement that begins at `first`. plot keeps a loop that goes with `vs NAME =`, a range
 * behind `bode`, and one that is over a declared NAME. */
qdot_outline qdot_outline_statement(const qdot_session *session, const qdot_token *first);
/* The end of the statement that contains the token. */
const qdot_token *qdot_outline_end(const qdot_token *token);

/* For each `{` of the source the index of its `}`; NULL: there are no blocks. The caller frees it. */
QDOT_MUST_CHECK qdot_status qdot_outline_blocks(const qdot_source *source, uint32_t **close);
/* The word `for` after the `}` of a block; NULL if another token stands there. */
const qdot_token *qdot_outline_block_loop(const qdot_token *close);

/* The word `to` of `to "FILE"` at the end of the statement; NULL if the statement does not end like that. */
const qdot_token *qdot_outline_file(const qdot_token *first);

/* While a part of a statement is read or carried out, the token behind it, such as `for` or `to`, is its end; then it has
 * again the kind that _cut returned. */
qdot_token_kind qdot_outline_cut(const qdot_token *token);
void qdot_outline_join(const qdot_token *token, qdot_token_kind kind);

/* Whether a failure at byte `at` is in the first tokens of the statement [first, end): then an example of it helps. *open:
 * it is behind the last of them. */
bool qdot_outline_fails_early(const qdot_token *first, const qdot_token *end, size_t at, bool *open);

#endif
