/* statement.h -- the table of statements of the language, for parsing, completion and help.
 *
 * A statement has its row at the begin of its file (lang/syntax/row.h), and statement.def names it. script.c handles a trailing `for` and blocks: a handler sees each pass as a
 * separate statement that ends before `for`.
 *
 * Tests  tests/script/, tests/bad/, tests/lang/session/test_session.c
 */
#ifndef QDOT_LANG_STATEMENT_H
#define QDOT_LANG_STATEMENT_H

#include "lang/syntax/row.h"

/* Row of a word, NULL if there is none; row i, NULL past the end. Rows of a group are
 * together. */
const qdot_statement *qdot_statement_find(const char *word);
const qdot_statement *qdot_statement_at(size_t i);
/* Whether the statement declares something of a scene. */
bool qdot_statement_declares(const qdot_statement *row);
/* Whether the statement asks about the scene or an expression, not about a run. */
bool qdot_statement_asks(const qdot_statement *row);

#endif
