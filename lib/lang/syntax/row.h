/* row.h -- a statement of the language: how it is written, what it does, its handler.
 *
 * The row stands at the begin of the statement's file. Its usage is the grammar by which the
 * statement is read (usage.h), completed, coloured and explained; the handler gets the record of
 * what was read and acts: a statement that fails changes nothing.
 */
#ifndef QDOT_LANG_ROW_H
#define QDOT_LANG_ROW_H

#include "lang/language/cursor.h"

#define QDOT_DECLARING "declaring a scene"
#define QDOT_ASKING "asking"
#define QDOT_NUMBERS "numbers"
#define QDOT_WORKBENCH "workbench"

struct qdot_record;

typedef struct {
    const char *word, *group;
    const char *usage, *summary, *example;
    const char *displayed; /* the usage where a program displays answers, which need no file; NULL: no other one */
    const char *form; /* shown instead of `usage` in the hint at a missing clause; NULL: none */
    bool alone; /* the word is also a value; as a whole statement it prints more */
    bool linear; /* concerns rest and motion near it: of a scene that states H alone the first-order equations */
    bool nameable; /* WORD = EXPR defines a name of the user's, beside which the statement goes on to work */
    qdot_status (*handler)(struct qdot_record *r); /* carries the statement out */
    /* Declares the names of the statement. A loop does so in all its passes before the first is carried out, so that a
     * pass may read names of a later one. NULL: the statement declares none that others of its loop read. */
    qdot_status (*names)(struct qdot_record *r);
} qdot_statement;

/* Define the table row of a statement, at the beginning of its file: QDOT_STATEMENT(run) = {.word = "run", ...}; */
#define QDOT_STATEMENT(word)                                                             \
    extern const qdot_statement qdot_statement_row_##word;                                   \
    const qdot_statement qdot_statement_row_##word

#endif
