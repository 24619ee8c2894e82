/* redirect.h -- `to FILE` after any statement with an answer (`T to "t.txt"`).
 *
 * The ending decides the type: .txt gets the printed text, .json the objects of --json, .tex a
 * fragment of LaTeX and .html a page with MathML (show/formula-page.h). table, plot, save and the
 * like read their own `to`.
 *
 * Tests  tests/script/files/to-file.sh, tests/script/files/formula-file.sh
 */
#ifndef QDOT_LANG_REDIRECT_H
#define QDOT_LANG_REDIRECT_H

#include "expr/print-name.h"
#include "lang/source/token.h"
#include "lang/syntax/statement.h"
#include "show/formula-page.h"

typedef struct {
    qdot_session *session;
    const char *path; /* name of the file; borrowed */
    FILE *file, *out, *console; /* stream that collects answers; the session's `out`, `console` to be restored */
    bool json;
    qdot_style style; /* the session's style, to be restored at the end */
    const struct qdot_redirect_type *type;
    qdot_formula_page page;
    char *text;
    size_t length;
} qdot_redirect;

/* Whether `to FILE` is read here for this statement: it answers, and reads no `to` of its own; NULL:
 * an expression. */
bool qdot_redirect_answers(const qdot_statement *row);

/* The `to "FILE"` at the end of the statement that begins at `first`, if it is read here; NULL: it is not, or `to` is NULL.
 * row NULL: an expression. */
const qdot_token *qdot_redirect_find(const qdot_statement *row, const qdot_token *first, const qdot_token *to);

/* Collect the answers of the session from now on. QDOT_EINVAL: a file with this ending cannot hold them. */
QDOT_MUST_CHECK qdot_status qdot_redirect_begin(qdot_redirect *r, qdot_session *session,
                                                const char *path);

/* Answers go where they went before; if `status`, that of the statement, is QDOT_OK the
 * file is written. Returns `status`, or why the file could not be written. */
qdot_status qdot_redirect_end(qdot_redirect *r, qdot_status status);

#endif
