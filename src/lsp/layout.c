/* layout.c -- formatting and folding. */
#include "lang/analysis/layout.h"

#include "documents.h"
#include "places.h"

/* The edits that lay the document out, those within the stretch. */
static json_t *
lay_out(const qdot_server *server, const qdot_analysis *a, qdot_stretch within)
{
    qdot_edit_list edits = {0};
    json_t *list = json_array();

    if (qdot_layout_edits(a, &edits) == QDOT_OK)
        for (size_t i = 0; i < edits.n; i++)
            if (edits.at[i].at.from >= within.from && edits.at[i].at.to <= within.to)
                (void)json_array_append_new(list, json_pack("{s:o, s:s}", "range",
                                                            qdot_place_range(server, a->text, a->length, edits.at[i].at), "newText",
                                                            edits.at[i].text));
    qdot_layout_clear(&edits);
    return list;
}

json_t *
qdot_lsp_format(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const qdot_document *document = qdot_documents_find(server, params, true, failure);

    return document != NULL ? lay_out(server, document->analysis, (qdot_stretch){0, document->analysis->length}) : NULL;
}

json_t *
qdot_lsp_format_range(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const qdot_document *document = qdot_documents_find(server, params, true, failure);
    qdot_stretch at;

    if (document == NULL)
        return NULL;
    if (!qdot_place_read_range(server, document->analysis->text, document->analysis->length, json_object_get(params, "range"), &at))
        return qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "no range");
    return lay_out(server, document->analysis, at);
}

json_t *
qdot_lsp_folding(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const qdot_document *document = qdot_documents_find(server, params, true, failure);
    qdot_fold_list folds = {0};
    json_t *list;

    if (document == NULL)
        return NULL;
    list = json_array();
    if (qdot_layout_folds(document->analysis, &folds) == QDOT_OK)
        for (size_t i = 0; i < folds.n; i++) {
            const qdot_analysis *a = document->analysis;
            const size_t first = qdot_place_at(server, a->text, a->length, folds.at[i].at.from).line,
                         last = qdot_place_at(server, a->text, a->length, folds.at[i].at.to).line;

            (void)json_array_append_new(list, json_pack("{s:I, s:I, s:s}", "startLine", (json_int_t)first, "endLine",
                                                        (json_int_t)last, "kind", folds.at[i].comment ? "comment" : "region"));
        }
    qdot_free(folds.at);
    return list;
}
