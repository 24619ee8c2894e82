/* statement.h -- the table of statements of the language, for parsing, completion and help.
 *
 * A statement is a row of statement.def. Its handler gets a cursor after the statement's word,
 * reads its operands, checks that nothing is left (qdot_cursor_expect_end) and only then
 * acts, so that a statement that fails changes nothing. script.c handles a trailing `for` and
 * blocks: a handler sees each pass as a separate statement that ends before `for`.
 *
 * Tests  tests/script/, tests/bad/, tests/lang/session/test_session.c
 */
#ifndef QDOT_LANG_STATEMENT_H
#define QDOT_LANG_STATEMENT_H

#include "lang/language/cursor.h"

typedef struct {
    const char *word, *group;
    const char *usage, *summary, *example;
    qdot_status (*run)(qdot_cursor *c); /* NULL: not built yet */
    bool alone; /* a value of the language that prints more if it is the whole statement */
} qdot_statement;

/* Row of a word, NULL if there is none; row i, NULL past the end. Rows of a group are
 * together. */
const qdot_statement *qdot_statement_find(const char *word);
const qdot_statement *qdot_statement_at(size_t i);
/* Whether it declares a scene. */
bool qdot_statement_declares(const qdot_statement *row);
/* Whether it asks of the scene or of an expression, not of a run. */
bool qdot_statement_asks(const qdot_statement *row);

/* The handlers. Adding a statement is adding its row and its handler. */
#define ROW(word, group, usage, summary, example, handler, alone)                        \
    qdot_status handler(qdot_cursor *c);
#define UNBUILT(word, group, usage, summary, example)
#include "lang/commands/statement.def"
#undef ROW
#undef UNBUILT
qdot_status qdot_declare_definition(qdot_cursor *c); /* NAME = EXPR, at the name */
qdot_status qdot_ask_expression(qdot_cursor *c);     /* at its first token */

#endif
