/* names.c -- where a name is declared and stands, another name for it, the names of a script. */
#include <string.h>

#include "documents.h"
#include "lang/analysis/names.h"
#include "lang/source/source.h"
#include "places.h"

static json_t *
fail_with_last_error(qdot_lsp_failure *failure)
{
    return qdot_lsp_fail(failure, QDOT_LSP_REQUEST_FAILED, "%s", qdot_last_error()->message);
}

/* A range in a script: the document itself, or another that it includes. */
static json_t *
pack_location(const qdot_server *server, const char *uri, const char *text, size_t length, qdot_stretch at)
{
    return json_pack("{s:s, s:o}", "uri", uri, "range", qdot_place_range(server, text, length, at));
}

/* Append the declarations of the name in the scripts that the document includes. */
static void
append_included(const qdot_server *server, const qdot_analysis *a, const char *name, json_t *locations)
{
    for (size_t i = 0; i < a->included.n; i++) {
        const qdot_source *source = a->included.at[i].source;
        qdot_occurrence_list list = {0};
        char *uri = qdot_documents_uri(server, a->included.at[i].path);

        if (uri != NULL && qdot_names_of_source(a, source, &list) == QDOT_OK)
            for (size_t k = 0; k < list.n; k++)
                if (list.at[k].declares && strcmp(list.at[k].name, name) == 0)
                    (void)json_array_append_new(locations,
                                                pack_location(server, uri, source->text, source->length, list.at[k].at));
        qdot_free(list.at);
        qdot_free(uri);
    }
}

/* The places of the name at the position of a request: only declarations, or all; as locations, or as highlights. */
static json_t *
answer_places(qdot_server *server, const json_t *params, bool declarations, bool uses, bool highlight, qdot_lsp_failure *failure)
{
    size_t at;
    const qdot_document *document = qdot_documents_find_place(server, params, &at, failure);
    qdot_occurrence_list list = {0};
    const qdot_occurrence *place;
    const qdot_analysis *a;
    json_t *found = json_array();

    if (document == NULL) {
        json_decref(found);
        return NULL;
    }
    a = document->analysis;
    if (qdot_names_of_source(a, a->source, &list) != QDOT_OK) {
        json_decref(found);
        qdot_free(list.at);
        return fail_with_last_error(failure);
    }
    place = qdot_names_at_byte(&list, at);
    for (size_t i = 0; place != NULL && i < list.n; i++) {
        const qdot_occurrence *o = &list.at[i];

        if (!qdot_names_are_same(o, place) || !(o->declares ? declarations : uses))
            continue;
        (void)json_array_append_new(
            found, highlight ? json_pack("{s:o, s:i}", "range", qdot_place_range(server, a->text, a->length, o->at), "kind",
                                         o->declares ? 3 : 2)
                             : pack_location(server, document->uri, a->text, a->length, o->at));
    }
    /* an argument or index is declared where it first stands */
    if (place != NULL && place->role == QDOT_ROLE_LOCAL && declarations && !uses && json_array_size(found) == 0)
        for (size_t i = 0; i < list.n && json_array_size(found) == 0; i++)
            if (qdot_names_are_same(&list.at[i], place))
                (void)json_array_append_new(found, pack_location(server, document->uri, a->text, a->length, list.at[i].at));
    if (place != NULL && declarations && !highlight)
        append_included(server, a, place->name, found);
    qdot_free(list.at);
    return found;
}

json_t *
qdot_lsp_definition(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    return answer_places(server, params, true, false, false, failure);
}

json_t *
qdot_lsp_references(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const json_t *declarations = json_object_get(json_object_get(params, "context"), "includeDeclaration");

    return answer_places(server, params, !json_is_false(declarations), true, false, failure);
}

json_t *
qdot_lsp_highlight(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    return answer_places(server, params, true, true, true, failure);
}

json_t *
qdot_lsp_prepare_rename(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    size_t at;
    const qdot_document *document = qdot_documents_find_place(server, params, &at, failure);
    qdot_occurrence place;

    if (document == NULL)
        return NULL;
    if (qdot_names_renameable(document->analysis, at, &place) != QDOT_OK)
        return fail_with_last_error(failure);
    return json_pack("{s:o, s:s}", "range", qdot_place_range(server, document->analysis->text, document->analysis->length, place.at),
                     "placeholder", place.name);
}

json_t *
qdot_lsp_rename(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    size_t at;
    const qdot_document *document = qdot_documents_find_place(server, params, &at, failure);
    const char *name = json_string_value(json_object_get(params, "newName"));
    qdot_occurrence_list places = {0};
    json_t *edits = json_array(), *changes;
    qdot_status status;

    if (document == NULL || name == NULL) {
        json_decref(edits);
        return document == NULL ? NULL : qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "no newName");
    }
    status = qdot_names_rename(document->analysis, at, name, &places);
    for (size_t i = 0; i < places.n; i++)
        (void)json_array_append_new(
            edits, json_pack("{s:o, s:s}", "range",
                             qdot_place_range(server, document->analysis->text, document->analysis->length, places.at[i].at),
                             "newText", name));
    qdot_free(places.at);
    changes = json_pack("{s:{s:o}}", "changes", document->uri, edits);
    if (status == QDOT_OK)
        return changes;
    json_decref(changes);
    return fail_with_last_error(failure);
}

/* The kind of a symbol as the protocol counts them. */
static int
symbol_kind(qdot_role role)
{
    enum { FIELD = 8, FUNCTION = 12, VARIABLE = 13, CONSTANT = 14, OBJECT = 19, EVENT = 24 };

    switch (role) {
    case QDOT_ROLE_PARAMETER: return CONSTANT;
    case QDOT_ROLE_COORDINATE: return VARIABLE;
    case QDOT_ROLE_FUNCTION: return FUNCTION;
    case QDOT_ROLE_LABEL: return OBJECT;
    case QDOT_ROLE_RUN: return EVENT;
    default: return FIELD;
    }
}

json_t *
qdot_lsp_symbols(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    static const char *const details[] = {[QDOT_ROLE_PARAMETER] = "parameter", [QDOT_ROLE_COORDINATE] = "coordinate",
                                          [QDOT_ROLE_FUNCTION] = "function",   [QDOT_ROLE_VALUE] = "expression",
                                          [QDOT_ROLE_LABEL] = "label",         [QDOT_ROLE_RUN] = "run"};
    const qdot_document *document = qdot_documents_find(server, params, true, failure);
    qdot_occurrence_list list = {0};
    const qdot_analysis *a;
    json_t *symbols;

    if (document == NULL)
        return NULL;
    a = document->analysis;
    if (qdot_names_of_source(a, a->source, &list) != QDOT_OK) {
        qdot_free(list.at);
        return fail_with_last_error(failure);
    }
    symbols = json_array();
    for (size_t i = 0; i < list.n; i++) {
        const qdot_occurrence *o = &list.at[i];

        if (o->declares)
            (void)json_array_append_new(
                symbols, json_pack("{s:s, s:s, s:i, s:o, s:o}", "name", o->name, "detail", details[o->role], "kind",
                                   symbol_kind(o->role), "range",
                                   qdot_place_range(server, a->text, a->length, a->pieces.at[o->piece].at), "selectionRange",
                                   qdot_place_range(server, a->text, a->length, o->at)));
    }
    qdot_free(list.at);
    return symbols;
}
