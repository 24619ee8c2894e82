/* colours.c -- what each word of a script is, for colours (semantic tokens). */
#include <string.h>

#include "documents.h"
#include "lang/analysis/names.h"
#include "lang/source/source.h"
#include "lang/workbench/highlight.h"
#include "places.h"

/* The kinds of tokens, in the order in which `initialize` names them. */
enum { KEYWORD, PARAMETER, VARIABLE, FUNCTION, PROPERTY, NAMESPACE, NUMBER, STRING, COMMENT, NONE };
enum { DECLARATION = 1, LANGUAGE = 2 }; /* modifiers, as bits */

json_t *
qdot_lsp_colours_legend(void)
{
    return json_pack("{s:[s,s,s,s,s,s,s,s,s], s:[s,s]}", "tokenTypes", "keyword", "parameter", "variable", "function", "property",
                     "namespace", "number", "string", "comment", "tokenModifiers", "declaration", "defaultLibrary");
}

static int
kind_of_role(qdot_role role)
{
    switch (role) {
    case QDOT_ROLE_PARAMETER:
    case QDOT_ROLE_LOCAL: return PARAMETER;
    case QDOT_ROLE_COORDINATE:
    case QDOT_ROLE_VALUE: return VARIABLE;
    case QDOT_ROLE_FUNCTION: return FUNCTION;
    case QDOT_ROLE_LABEL: return PROPERTY;
    case QDOT_ROLE_RUN: return NAMESPACE;
    default: return NONE;
    }
}

static int
kind_of_byte(uint8_t kind)
{
    switch (kind) {
    case QDOT_HIGHLIGHT_WORD: return KEYWORD;
    case QDOT_HIGHLIGHT_NAME: return FUNCTION;
    case QDOT_HIGHLIGHT_NUMBER: return NUMBER;
    case QDOT_HIGHLIGHT_STRING: return STRING;
    case QDOT_HIGHLIGHT_COMMENT: return COMMENT;
    default: return NONE;
    }
}

/* What is written: each token relative to the one before it. */
typedef struct {
    const qdot_server *server;
    const qdot_analysis *a;
    json_t *data;
    qdot_place_walk walk;
    size_t line, character;
} writer;

/* Write a stretch that holds no end of a line. */
static void
write_token(writer *w, qdot_stretch at, int kind, int modifiers)
{
    const size_t units = qdot_place_units(w->server, w->a->text, at);
    size_t lines;

    qdot_place_walk_to(w->server, w->a->text, w->a->length, at.from, &w->walk);
    if (units == 0 || kind == NONE)
        return;
    lines = w->walk.line - w->line;
    (void)json_array_append_new(w->data, json_integer((json_int_t)lines));
    (void)json_array_append_new(w->data, json_integer((json_int_t)(w->walk.character - (lines > 0 ? 0 : w->character))));
    (void)json_array_append_new(w->data, json_integer((json_int_t)units));
    (void)json_array_append_new(w->data, json_integer(kind));
    (void)json_array_append_new(w->data, json_integer(modifiers));
    w->line = w->walk.line;
    w->character = w->walk.character;
}

/* Write all stretches of bytes of one kind; names as what they are declared as. */
static void
write_tokens(writer *w, const uint8_t *kinds, const qdot_occurrence_list *list)
{
    const qdot_analysis *a = w->a;
    size_t next = 0;

    for (size_t i = 0; i < a->length;) {
        size_t to = i + 1;

        while (next < list->n && list->at[next].at.to <= i)
            next++;
        if (next < list->n && list->at[next].at.from == i && list->at[next].role != QDOT_ROLE_UNKNOWN) {
            to = list->at[next].at.to;
            write_token(w, list->at[next].at, kind_of_role(list->at[next].role), list->at[next].declares ? DECLARATION : 0);
        } else {
            while (to < a->length && kinds[to] == kinds[i] && a->text[to] != '\n' && a->text[to] != '\r' &&
                   (next >= list->n || list->at[next].at.from != to))
                to++;
            if (a->text[i] != '\n' && a->text[i] != '\r')
                write_token(w, (qdot_stretch){i, to}, kind_of_byte(kinds[i]), kinds[i] == QDOT_HIGHLIGHT_NAME ? LANGUAGE : 0);
        }
        i = to;
    }
}

json_t *
qdot_lsp_colours(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const qdot_document *document = qdot_documents_find(server, params, true, failure);
    qdot_occurrence_list list = {0};
    uint8_t *kinds;
    writer w = {.server = server};
    qdot_status status;

    if (document == NULL)
        return NULL;
    w.a = document->analysis;
    kinds = qdot_malloc(w.a->length + 1);
    status = kinds != NULL ? qdot_names_of_source(w.a, w.a->source, &list) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_highlight_text(w.a->session, w.a->text, w.a->length, kinds);
    w.data = json_array();
    if (status == QDOT_OK)
        write_tokens(&w, kinds, &list);
    qdot_free(list.at);
    qdot_free(kinds);
    return json_pack("{s:o}", "data", w.data);
}
