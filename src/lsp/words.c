/* words.c -- completion, what stands at a place, how a function is called. */
#include <string.h>

#include "documents.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/analysis/names.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/statement.h"
#include "lang/workbench/complete.h"
#include "lang/workbench/explain.h"
#include "places.h"

/* --- completion ----------------------------------------------------------------------- */

/* The kind of a completion as the protocol counts them. */
static int
completion_kind(const char *word)
{
    enum { FUNCTION = 3, VARIABLE = 6, VALUE = 12, KEYWORD = 14 };

    return qdot_statement_find(word) != NULL   ? KEYWORD
           : qdot_builtin_find(word) != NULL   ? FUNCTION
           : qdot_quantity_find(word) != NULL ? VALUE
                                               : VARIABLE;
}

/* Append a completion that replaces the stretch. */
static void
append_item(const qdot_server *server, const qdot_analysis *a, json_t *items, qdot_stretch at, const char *word)
{
    const qdot_statement *statement = qdot_statement_find(word);
    const qdot_builtin *builtin = qdot_builtin_find(word);
    const qdot_quantity *quantity = qdot_quantity_find(word);
    const char *usage = builtin != NULL ? builtin->usage : quantity != NULL ? quantity->usage : statement != NULL ? statement->usage : NULL;
    json_t *item = json_pack("{s:s, s:i, s:{s:o, s:s}}", "label", word, "kind", completion_kind(word), "textEdit", "range",
                             qdot_place_range(server, a->text, a->length, at), "newText", word);

    if (usage != NULL)
        (void)json_object_set_new(item, "detail", json_string(usage));
    (void)json_array_append_new(items, item);
}

/* Whether the word is declared by a statement behind byte `at` only. */
static bool
is_declared_behind(const qdot_occurrence_list *list, const char *word, size_t at)
{
    const size_t n = strcspn(word, "[");
    bool behind = false;

    for (size_t i = 0; i < list->n; i++)
        if (list->at[i].declares && strlen(list->at[i].name) == n && strncmp(list->at[i].name, word, n) == 0) {
            if (list->at[i].at.from < at)
                return false;
            behind = true;
        }
    return behind;
}

/* Append the names of runs and tables declared above, which the session does not have, where names of declared things may stand. */
static void
append_runs(const qdot_server *server, const qdot_analysis *a, const qdot_occurrence_list *list, qdot_stretch at, json_t *items)
{
    const size_t n = at.to - at.from;
    const qdot_piece *piece = qdot_analysis_piece(a, at.from);
    const bool first = piece == NULL || piece->at.from >= at.from || piece->at.to + 1 < at.from;

    for (size_t i = 0; i < list->n && !first; i++) {
        const qdot_occurrence *o = &list->at[i];
        bool again = false;

        if (!o->declares || o->role != QDOT_ROLE_RUN || o->at.to >= at.from || strncmp(o->name, a->text + at.from, n) != 0)
            continue;
        for (size_t k = 0; k < i && !again; k++)
            again = list->at[k].declares && strcmp(list->at[k].name, o->name) == 0;
        if (!again)
            append_item(server, a, items, at, o->name);
    }
}

json_t *
qdot_lsp_completion(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    size_t at, from, n = 0;
    const qdot_document *document = qdot_documents_find_place(server, params, &at, failure);
    qdot_occurrence_list list = {0};
    const qdot_analysis *a;
    json_t *items;
    char **words = NULL;

    if (document == NULL)
        return NULL;
    a = document->analysis;
    if (qdot_complete_at(a->session, a->text, at, &from, &words, &n) != QDOT_OK ||
        qdot_names_of_source(a, a->source, &list) != QDOT_OK)
        (void)qdot_lsp_fail(failure, QDOT_LSP_INTERNAL, "%s", qdot_last_error()->message);
    items = json_array();
    for (size_t i = 0; i < n; i++) {
        if (!is_declared_behind(&list, words[i], at))
            append_item(server, a, items, (qdot_stretch){from, at}, words[i]);
        qdot_free(words[i]);
    }
    qdot_free(words);
    if (qdot_complete_place(a->text, from) == QDOT_PLACE_PLAIN)
        append_runs(server, a, &list, (qdot_stretch){from, at}, items);
    qdot_free(list.at);
    /* functions are offered once a letter of theirs is typed: then the editor asks again */
    return json_pack("{s:b, s:o}", "isIncomplete", from == at, "items", items);
}

/* --- hover ---------------------------------------------------------------------------- */

/* Append a paragraph: code, or text. */
static void
append_paragraph(qdot_text *text, const char *paragraph, bool code)
{
    if (paragraph[0] != '\0')
        qdot_text_format(text, code ? "%s```qdot\n%s\n```" : "%s%s", text->n > 0 ? "\n\n" : "", paragraph);
}

static json_t *
pack_hover(const qdot_server *server, const qdot_analysis *a, const qdot_text *text, qdot_stretch at)
{
    return json_pack("{s:{s:s, s:s}, s:o}", "contents", "kind", "markdown", "value", qdot_text_str(text), "range",
                     qdot_place_range(server, a->text, a->length, at));
}

/* The line that holds byte `at`, without the blanks around it. */
static qdot_stretch
find_line(const qdot_analysis *a, size_t at)
{
    qdot_stretch line = {at, at};

    while (line.from > 0 && a->text[line.from - 1] != '\n')
        line.from--;
    while (line.to < a->length && a->text[line.to] != '\n')
        line.to++;
    line.from += strspn(a->text + line.from, " \t\r");
    while (line.to > at && strchr(" \t\r", a->text[line.to - 1]) != NULL)
        line.to--;
    return line;
}

/* The hover of a name that the session does not have, a run or an argument or one that is removed further below: what it is, and the
 * line that declares it. NULL: nothing declares it. */
static json_t *
hover_declaration(const qdot_server *server, const qdot_analysis *a, size_t at)
{
    enum { MOST = 200 }; /* bytes of a line that are shown */
    static const char *const words[] = {
        [QDOT_ROLE_PARAMETER] = "a parameter", [QDOT_ROLE_COORDINATE] = "a coordinate", [QDOT_ROLE_FUNCTION] = "a function of yours",
        [QDOT_ROLE_VALUE] = "a name of yours", [QDOT_ROLE_LABEL] = "a label", [QDOT_ROLE_RUN] = "a run or table",
        [QDOT_ROLE_LOCAL] = "an argument or index"};
    qdot_occurrence_list list = {0};
    const qdot_occurrence *place, *declared = NULL;
    qdot_text text = {0}, code = {0};
    json_t *hover = NULL;

    if (qdot_names_of_source(a, a->source, &list) != QDOT_OK)
        return NULL;
    place = qdot_names_at_byte(&list, at);
    /* an argument or index is declared where it first stands */
    for (size_t i = 0; place != NULL && place->role != QDOT_ROLE_UNKNOWN && declared == NULL && i < list.n; i++)
        if (qdot_names_are_same(&list.at[i], place) && (list.at[i].declares || place->role == QDOT_ROLE_LOCAL))
            declared = &list.at[i];
    if (declared != NULL) {
        const qdot_stretch line = find_line(a, declared->at.from);

        if (line.to - line.from <= MOST)
            qdot_text_add_n(&code, a->text + line.from, line.to - line.from);
        append_paragraph(&text, qdot_text_str(&code), true);
        append_paragraph(&text, words[place->role], false);
        hover = pack_hover(server, a, &text, place->at);
    }
    qdot_text_clear(&code);
    qdot_text_clear(&text);
    qdot_free(list.at);
    return hover;
}

json_t *
qdot_lsp_hover(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    size_t at;
    const qdot_document *document = qdot_documents_find_place(server, params, &at, failure);
    const qdot_analysis *a;
    qdot_explained explained = {0};
    qdot_text text = {0};
    json_t *hover = NULL;

    if (document == NULL)
        return NULL;
    a = document->analysis;
    if (qdot_explain(a->session, a->text, a->length, at, QDOT_UNICODE, &explained) == QDOT_OK &&
        explained.kind != QDOT_EXPLAINED_NOTHING) {
        append_paragraph(&text, qdot_text_str(&explained.usage), true);
        append_paragraph(&text, qdot_text_str(&explained.sentence), false);
        append_paragraph(&text, qdot_text_str(&explained.formula), true);
        append_paragraph(&text, qdot_text_str(&explained.dimension), false);
        append_paragraph(&text, qdot_text_str(&explained.example), true);
        hover = pack_hover(server, a, &text, (qdot_stretch){explained.from, explained.to});
    } else {
        hover = hover_declaration(server, a, at);
    }
    qdot_explained_clear(&explained);
    qdot_text_clear(&text);
    return hover != NULL ? hover : json_null();
}

/* --- how a function is called --------------------------------------------------------- */

/* The innermost call whose brackets are open at byte `at`: its name; *commas: how many of its arguments are before. NULL: none. */
static const qdot_token *
find_call(const qdot_source *source, size_t at, size_t *commas)
{
    const qdot_token *tokens = source->tokens.at;
    size_t k = source->tokens.n;
    int depth = 0;

    *commas = 0;
    while (k > 0 && tokens[k - 1].start >= at)
        k--;
    for (; k > 0 && tokens[k - 1].kind != QDOT_TOKEN_END; k--) {
        const qdot_token *t = &tokens[k - 1];

        depth -= qdot_token_bracket(t);
        if (depth == 0 && qdot_token_is(t, ","))
            ++*commas;
        if (depth < 0 && qdot_token_is(t, "(") && k > 1 && t->glued && t[-1].kind == QDOT_TOKEN_NAME)
            return t - 1;
        if (depth < 0) {
            depth = 0;
            *commas = 0;
        }
    }
    return NULL;
}

/* How the function of the name is called: its usage, or the left side of the user's definition or declaration. */
static bool
write_signature(const qdot_analysis *a, const char *name, qdot_text *label, qdot_text *sentence)
{
    const qdot_builtin *builtin = qdot_builtin_find(name);
    const qdot_quantity *quantity = qdot_quantity_find(name);
    const qdot_token *tokens = a->source->tokens.at;

    for (size_t i = 0; i + 1 < a->source->tokens.n; i++) {
        const qdot_token *k = &tokens[i];
        const bool declares = i == 0 || k[-1].kind == QDOT_TOKEN_END || qdot_token_is(k - 1, "{") || qdot_token_is_word(k - 1, "function") ||
                              qdot_token_is(k - 1, ",");

        if (qdot_token_is_word(k, name) && qdot_token_is(k + 1, "(") && k[1].glued && declares) {
            const qdot_token *behind = qdot_token_behind_bracket(k + 1);

            if (behind > k + 1 && (qdot_token_is(behind, "=") || qdot_token_is(behind, ",") || behind->kind == QDOT_TOKEN_END)) {
                qdot_text_add_n(label, a->text + k->start, behind[-1].start + behind[-1].length - k->start);
                return true;
            }
        }
    }
    if (builtin == NULL && quantity == NULL)
        return false;
    qdot_text_add(label, builtin != NULL ? builtin->usage : quantity->usage);
    qdot_text_add(sentence, builtin != NULL ? builtin->summary : quantity->summary);
    return true;
}

/* The arguments of the label NAME(A, B, ...) as pairs of bytes, which are ASCII in usages; a name in letters of two bytes has none. */
static json_t *
pack_arguments(const char *label)
{
    json_t *list = json_array();
    const char *open = strchr(label, '('), *from = open != NULL ? open + 1 : NULL;
    int depth = 0;

    for (const char *k = from; k != NULL && *k != '\0' && (*k & 0x80) == 0; k++) {
        if ((*k == ',' && depth == 0) || (*k == ')' && depth == 0)) {
            (void)json_array_append_new(list, json_pack("{s:[I,I]}", "label", (json_int_t)(from - label), (json_int_t)(k - label)));
            if (*k == ')')
                break;
            from = k + 1 + strspn(k + 1, " ");
        }
        depth += (*k == '(' || *k == '[') - (*k == ')' || *k == ']');
    }
    return list;
}

json_t *
qdot_lsp_signature(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    size_t at, commas;
    const qdot_document *document = qdot_documents_find_place(server, params, &at, failure);
    const qdot_source *source = NULL;
    qdot_source *begun = NULL;
    const qdot_token *name;
    qdot_text label = {0}, sentence = {0};
    size_t wrong, n;
    json_t *result = NULL, *arguments;

    if (document == NULL)
        return NULL;
    /* what is being typed has open brackets: the tokens before them are those of the text up to here */
    (void)!qdot_source_new("", document->analysis->text, at, &begun, &wrong);
    source = begun;
    name = source != NULL ? find_call(source, at, &commas) : NULL;
    if (name != NULL && write_signature(document->analysis, name->text, &label, &sentence)) {
        arguments = pack_arguments(qdot_text_str(&label));
        n = json_array_size(arguments);
        result = json_pack("{s:[{s:s, s:s, s:o}], s:i, s:I}", "signatures", "label", qdot_text_str(&label), "documentation",
                           qdot_text_str(&sentence), "parameters", arguments, "activeSignature", 0, "activeParameter",
                           (json_int_t)(commas < n || n == 0 ? commas : n - 1));
    }
    qdot_source_free(begun);
    qdot_text_clear(&label);
    qdot_text_clear(&sentence);
    return result != NULL ? result : json_null();
}
