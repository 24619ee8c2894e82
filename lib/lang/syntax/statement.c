/* statement.c -- the table of statements. */
#include "lang/syntax/statement.h"

#include <string.h>

#define DECLARE QDOT_DECLARING
#define ASK QDOT_ASKING
#define NUMBERS QDOT_NUMBERS
#define WORKBENCH QDOT_WORKBENCH

#define UNBUILT(word, group, usage, summary, example)
#define STATEMENT(word) extern const qdot_statement qdot_statement_row_##word;
#include "lang/syntax/statement.def"
#undef UNBUILT
#undef STATEMENT

static const qdot_statement *const table[] = {
#define UNBUILT(word, group, usage, summary, example)                                    \
    &(const qdot_statement){word, group, usage, summary, example, NULL, false, NULL, NULL},
#define STATEMENT(word) &qdot_statement_row_##word,
#include "lang/syntax/statement.def"
};

bool
qdot_statement_declares(const qdot_statement *row)
{
    return strcmp(row->group, QDOT_DECLARING) == 0;
}

bool
qdot_statement_asks(const qdot_statement *row)
{
    return strcmp(row->group, QDOT_ASKING) == 0;
}

const qdot_statement *
qdot_statement_at(size_t i)
{
    return i < sizeof table / sizeof *table ? table[i] : NULL;
}

const qdot_statement *
qdot_statement_find(const char *word)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strcmp(table[i]->word, word) == 0)
            return table[i];
    return NULL;
}
