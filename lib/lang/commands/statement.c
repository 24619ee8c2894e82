/* statement.c -- the table of statements. */
#include "lang/commands/statement.h"

#include <string.h>

#define DECLARE "declaring a scene"
#define ASK "asking"
#define NUMBERS "numbers"
#define WORKBENCH "workbench"

static const qdot_statement table[] = {
#define ROW(word, group, usage, summary, example, handler, alone)                        \
    {word, group, usage, summary, example, handler, alone},
#define UNBUILT(word, group, usage, summary, example)                                    \
    {word, group, usage, summary, example, NULL, false},
#include "lang/commands/statement.def"
};

bool
qdot_statement_declares(const qdot_statement *row)
{
    return strcmp(row->group, DECLARE) == 0;
}

bool
qdot_statement_asks(const qdot_statement *row)
{
    return strcmp(row->group, ASK) == 0;
}

const qdot_statement *
qdot_statement_at(size_t i)
{
    return i < sizeof table / sizeof *table ? &table[i] : NULL;
}

const qdot_statement *
qdot_statement_find(const char *word)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strcmp(table[i].word, word) == 0)
            return &table[i];
    return NULL;
}
