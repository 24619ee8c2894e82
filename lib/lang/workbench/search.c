/* search.c -- finds the words of the language whose name, summary or example contains a text. */
#include "lang/workbench/search.h"

#include <stdint.h>
#include <string.h>
#include <strings.h>

#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/syntax/statement.h"
#include "lang/workbench/topics.h"
#include "ode/method.h"

typedef struct {
    const char *text;
    bool by_name; /* list the words whose name contains the text; otherwise the other matches */
    qdot_text *out;
    size_t n;
} search;

static bool
is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* Whether `where` holds the n bytes of `word`, whatever the case of letters. A single letter must
 * stand by itself. */
static bool
contains_word(const char *where, const char *word, size_t n)
{
    for (const char *at = where; *at != '\0'; at++)
        if (strncasecmp(at, word, n) == 0 &&
            (n > 1 || ((at == where || !is_letter(at[-1])) && !is_letter(at[1]))))
            return true;
    return false;
}

/* Whether every word of `text` occurs in at least one of the n texts `where`. */
static bool
texts_contain_words(size_t n, const char *const *where, const char *text)
{
    size_t length;

    for (text += strspn(text, " "); *text != '\0'; text += strspn(text, " ")) {
        bool found = false;

        length = strcspn(text, " ");
        for (size_t i = 0; i < n && !found; i++)
            found = where[i] != NULL && contains_word(where[i], text, length);
        if (!found)
            return false;
        text += length;
    }
    return true;
}

static void
list_if_matching(search *s, const char *name, const char *usage, const char *summary,
                 const char *example)
{
    const char *const all[] = {name, usage, summary, example};

    if (texts_contain_words(1, all, s->text) != s->by_name || (!s->by_name && !texts_contain_words(4, all, s->text)))
        return;
    qdot_text_format(s->out, "  %-18s %s\n", name, summary);
    s->n++;
}

static void
list_all_matching(search *s)
{
    const qdot_statement *statement;
    const qdot_quantity *quantity;
    const qdot_builtin *builtin;

    for (size_t i = 0; (statement = qdot_statement_at(i)) != NULL; i++)
        if (qdot_quantity_find(statement->word) == NULL)
            list_if_matching(s, statement->word, statement->usage, statement->summary,
                             statement->example);
    for (size_t i = 0; (quantity = qdot_quantity_at(i)) != NULL; i++)
        list_if_matching(s, quantity->name, quantity->usage, quantity->summary, quantity->example);
    for (size_t i = 0; (builtin = qdot_builtin_at(i)) != NULL; i++)
        list_if_matching(s, builtin->name, builtin->usage, builtin->summary, builtin->example);
    for (size_t i = 0; qdot_topic_at(i) != NULL; i++)
        list_if_matching(s, qdot_topic_at(i)->word, qdot_topic_at(i)->usage, qdot_topic_at(i)->summary,
                         qdot_topic_at(i)->example);
    for (size_t i = 0; qdot_ode_method_at(i) != NULL; i++)
        list_if_matching(s, qdot_ode_method_at(i)->name, "method", qdot_ode_method_at(i)->fits, NULL);
}

size_t
qdot_search(const char *text, qdot_text *out)
{
    search s = {.text = text, .by_name = true, .out = out};

    list_all_matching(&s);
    s.by_name = false;
    list_all_matching(&s);
    return s.n;
}
