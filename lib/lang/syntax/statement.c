/* statement.c -- the table of statements. */
#include "lang/syntax/statement.h"

#include <string.h>

#define STATEMENT(word) extern const qdot_statement qdot_statement_row_##word;
#include "lang/syntax/statement.def"
#undef STATEMENT

static const qdot_statement *const table[] = {
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
