/* help.c -- the statement `help`: prints lists of statements, functions and values. */
#include <string.h>

#include "base/spelling.h"
#include "expr/function.h"
#include "lang/answer/answer.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/hints.h"
#include "lang/session/output.h"
#include "lang/syntax/record.h"
#include "lang/syntax/statement.h"
#include "lang/workbench/search.h"
#include "lang/workbench/topics.h"
#include "ode/method.h"

static qdot_status carry_out_help(qdot_record *r);

QDOT_STATEMENT(help) = {
    .word = "help",
    .group = QDOT_WORKBENCH,
    .usage = "help [WORD] | help search WORD ...",
    .summary = "this list, what a word means - where it is none of the language, the words that have to do with it -, or the "
               "words whose help contains a text; at the prompt `?particle` "
               "and `??energy` are short for `help particle` and `help search energy`",
    .example = "help particle",
    .handler = carry_out_help,
};

enum { OFF_TERMINAL = 86 }; /* width of text in columns if the output is no terminal */

/* Append a line of two columns: a word and its summary. */
static void
add_help_entry(qdot_text *text, const char *word, const char *summary)
{
    qdot_text_format(text, "  %-14s %s\n", word, summary);
}

/* State for writing words one after another, in lines up to a width. */
typedef struct {
    size_t width, column;
} running;

static void
append_word_in_line(qdot_text *text, const char *word, running *line)
{
    size_t n = strlen(word) + 1;

    if (line->column + n > line->width) {
        qdot_text_add(text, "\n ");
        line->column = 1;
    }
    qdot_text_format(text, " %s", word);
    line->column += n;
}

static void
append_overview(qdot_text *text, size_t width)
{
    const qdot_statement *row;
    const char *group = "";
    running values = {.width = width, .column = 1}, functions = values;

    for (size_t i = 0; (row = qdot_statement_at(i)) != NULL; i++) {
        if (strcmp(group, row->group) != 0)
            qdot_text_format(text, "%s%s\n", i > 0 ? "\n" : "", row->group);
        group = row->group;
        add_help_entry(text, row->word, row->summary);
    }
    qdot_text_add(text, "\nvalues\n ");
    for (size_t i = 0; qdot_quantity_at(i) != NULL; i++)
        append_word_in_line(text, qdot_quantity_at(i)->name, &values);
    qdot_text_add(text, "\n\nfunctions\n ");
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++)
        append_word_in_line(text, qdot_builtin_at(i)->name, &functions);
    qdot_text_add(text, "\n\nhelp WORD says more of each, help search WORD finds it; any "
                        "statement may end in `for k = a..b`\n");
}

static void
append_explanation(qdot_text *text, const char *usage, const char *summary, const char *example)
{
    qdot_text_format(text, "%s\n    %s\n", usage, summary);
    if (example != NULL && example[0] != '\0' && strcmp(example, usage) != 0)
        qdot_text_format(text, "    example: %s\n", example);
}

/* List every statement that has the word as the keyword of an option. */
static void
list_statements_with_option(qdot_text *text, const char *word)
{
    const qdot_statement *row;

    if (word[0] < 'a' || word[0] > 'z')
        return;
    for (size_t i = 0; (row = qdot_statement_at(i)) != NULL; i++)
        if (qdot_has_word(row->usage, word))
            append_explanation(text, row->usage, row->summary, row->example);
}

/* Explain a topic; for an option also list the statements that have it. */
static void
explain_topic(qdot_text *text, const qdot_topic *topic)
{
    const qdot_statement *row;
    size_t n = 0;

    append_explanation(text, topic->usage, topic->summary, topic->example);
    for (size_t i = 0; topic->option && (row = qdot_statement_at(i)) != NULL; i++)
        if (qdot_has_word(row->usage, topic->word))
            qdot_text_format(text, "%s%s", n++ == 0 ? "    an option of " : ", ", row->word);
    qdot_text_add(text, n > 0 ? "\n" : "");
}

/* Append the explanation of a statement, function or quantity of that name; false if there is none. */
static bool
explain_word(qdot_text *text, const char *word)
{
    const qdot_statement *statement = qdot_statement_find(word);
    const qdot_quantity *quantity = qdot_quantity_find(word);
    const qdot_builtin *builtin = qdot_builtin_find(word);
    qdot_fun_id id;

    if (statement != NULL)
        append_explanation(text, statement->usage, statement->summary, statement->example);
    if (quantity != NULL)
        append_explanation(text, quantity->usage, quantity->summary, quantity->example);
    if (builtin != NULL)
        append_explanation(text, builtin->usage, builtin->summary, builtin->example);
    else if (qdot_fun_find(word, &id))
        qdot_text_format(text, "%s: an elementary function\n", qdot_fun_name(id));
    for (size_t i = 0; qdot_topic_at(i) != NULL; i++)
        if (strcmp(word, qdot_topic_at(i)->word) == 0)
            explain_topic(text, qdot_topic_at(i));
    if (qdot_ode_method_find(word) != NULL) {
        qdot_text_format(text, "run T0..T1 method %s", word);
        qdot_text_format(text, "\n    %s\n", qdot_ode_method_find(word)->fits);
    }
    if (text->n == 0)
        list_statements_with_option(text, word);
    return text->n > 0;
}

/* Append the words of the language that have to do with the word; false: none has, it is short, or a name of the session. */
static bool
list_related(const qdot_session *session, const char *word, qdot_text *text)
{
    return strlen(word) > 2 && !qdot_cursor_knows(session, word) && qdot_search(word, text) > 0;
}

/* Carry out `help search WORD ...` or `help search "TEXT"`. */
static qdot_status
carry_out_help_search(qdot_record *r)
{
    qdot_text words = {0}, text = {0};
    qdot_status status;

    for (size_t i = 2; i < r->parts.n; i++)
        qdot_text_format(&words, "%s%s", words.n > 0 ? " " : "", r->parts.at[i].from->text);
    status = qdot_text_status(&words);
    if (status == QDOT_OK && qdot_search(qdot_text_str(&words), &text) == 0) {
        qdot_record_blame(r, &r->parts.at[2]);
        (void)qdot_fail(QDOT_ENAME, "no help contains `%.100s`", qdot_text_str(&words));
        status = qdot_hint("`help` lists every word");
    }
    qdot_text_clear(&words);
    return qdot_answer_written(r->cursor.session, "help", status, &text);
}

/* The statement, function or quantity whose name is nearest; NULL if none is near. */
static const char *
find_nearest_word(qdot_session *session, const char *word)
{
    const char *other = qdot_hints_nearest(session, word);
    qdot_spelling near;

    qdot_spelling_begin(&near, word);
    for (size_t i = 0; qdot_statement_at(i) != NULL; i++)
        qdot_spelling_offer(&near, qdot_statement_at(i)->word);
    if (other != NULL)
        qdot_spelling_offer(&near, other);
    return near.best;
}

static qdot_status
carry_out_help(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *word = qdot_record_hole(r, "help", NULL);
    const size_t width = qdot_write_width(session, session->output->out);
    const char *near;
    qdot_text text = {0};

    if (qdot_record_word(r, "search") != NULL)
        return carry_out_help_search(r);
    r->cursor.error_at = r->start->start;
    if (word == NULL) {
        append_overview(&text, width > 0 ? width : OFF_TERMINAL);
    } else if (!explain_word(&text, word->from->text) && !list_related(session, word->from->text, &text)) {
        (void)qdot_fail(QDOT_ENAME, "there is no help on `%.100s`", word->from->text);
        near = find_nearest_word(session, word->from->text);
        return near != NULL
                   ? qdot_hint("did you mean `%s`?", near)
                   : qdot_hint("`help` lists every word; `show NAME` tells of your own names");
    }
    return qdot_answer_written(session, "help", QDOT_OK, &text);
}
