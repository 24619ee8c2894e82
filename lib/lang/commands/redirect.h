/* redirect.h -- `to FILE` behind any statement that answers (`T to "t.txt"`).
 *
 * Type by ending: .txt and .tex hold what would be printed, .json the objects of --json.
 * table, plot, save and their like read a `to` of their own.
 *
 * Tests  tests/script/to-file.sh
 */
#ifndef QDOT_LANG_REDIRECT_H
#define QDOT_LANG_REDIRECT_H

#include "lang/commands/statement.h"

typedef struct {
    qdot_session *session;
    const char *path; /* borrowed */
    FILE *file, *out, *console; /* what is kept; where answers and notices go otherwise */
    bool json;
    char *text;
    size_t length;
} qdot_redirect;

/* The `to` of the statement that begins at `first`, NULL if it has none; row NULL: an
 * expression. */
const qdot_token *qdot_redirect_find(const qdot_statement *row, const qdot_token *first);

/* From here on answers are kept. QDOT_ENOTBUILT: not to a file of this ending. */
QDOT_MUST_CHECK qdot_status qdot_redirect_begin(qdot_redirect *r, qdot_session *session,
                                                const char *path);

/* Answers go where they went before; if `status`, that of the statement, is QDOT_OK the
 * file is written. Returns `status`, or why the file could not be written. */
qdot_status qdot_redirect_end(qdot_redirect *r, qdot_status status);

#endif
