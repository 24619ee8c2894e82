/* help.c -- the tables, told: statements, functions, values. */
#include "lang/statement.h"

#include <string.h>

#include "lang/answer.h"

/* A word and what follows it, in two columns. */
static void
entry(qdot_text *text, const char *word, const char *summary)
{
    qdot_text_format(text, "  %-14s %s\n", word, summary);
}

/* Words in running lines. */
static void
flow(qdot_text *text, const char *word, size_t *column)
{
    size_t n = strlen(word) + 1;

    if (*column + n > 86) {
        qdot_text_add(text, "\n ");
        *column = 1;
    }
    qdot_text_format(text, " %s", word);
    *column += n;
}

static void
overview(qdot_text *text)
{
    const qdot_statement *row;
    const char *group = "";
    size_t column = 1;

    for (size_t i = 0; (row = qdot_statement_at(i)) != NULL; i++) {
        if (row->run == NULL)
            continue;
        if (strcmp(group, row->group) != 0)
            qdot_text_format(text, "%s%s\n", i > 0 ? "\n" : "", row->group);
        group = row->group;
        entry(text, row->word, row->summary);
    }
    qdot_text_add(text, "\nvalues\n ");
    for (size_t i = 0; qdot_quantity_at(i) != NULL; i++)
        flow(text, qdot_quantity_at(i)->name, &column);
    qdot_text_add(text, "\n\nfunctions\n ");
    column = 1;
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++)
        flow(text, qdot_builtin_at(i)->name, &column);
    qdot_text_add(text, "\n\nhelp WORD says more of each; any statement may end in "
                        "`for k = a..b`\n");
}

static void
explain(qdot_text *text, const char *usage, const char *summary, const char *example)
{
    qdot_text_format(text, "%s\n    %s\n", usage, summary);
    if (example != NULL && example[0] != '\0' && strcmp(example, usage) != 0)
        qdot_text_format(text, "    example: %s\n", example);
}

/* Everything that a word is; false: nothing. */
static bool
look_up(qdot_text *text, const char *word)
{
    const qdot_statement *statement = qdot_statement_find(word);
    const qdot_quantity *quantity = qdot_quantity_find(word);
    const qdot_builtin *builtin = qdot_builtin_find(word);
    qdot_fun_id id;

    if (statement != NULL) {
        explain(text, statement->usage, statement->summary, statement->example);
        if (statement->run == NULL)
            qdot_text_add(text, "    not built yet\n");
    }
    if (quantity != NULL)
        explain(text, quantity->usage, quantity->summary, quantity->example);
    if (builtin != NULL)
        explain(text, builtin->usage, builtin->summary, builtin->example);
    else if (qdot_fun_find(word, &id))
        qdot_text_format(text, "%s: an elementary function\n", qdot_fun_name(id));
    return text->n > 0;
}

qdot_status
qdot_help(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    const char *word = "help";
    qdot_text text = {0};
    qdot_status status;

    if (c->at->kind == QDOT_TOKEN_NAME)
        word = c->at++->text;
    else if (c->at->kind == QDOT_TOKEN_STRING)
        QDOT_TRY(qdot_read_string(c, &word));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    if (c->at == start) {
        overview(&text);
    } else if (!look_up(&text, word)) {
        (void)qdot_fail(QDOT_ENAME, "there is no help on `%.100s`", word);
        return qdot_hint("`help` lists every word; `show NAME` tells of your own names");
    }
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_text(c->session, "help", qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}
