/* actions.c -- quick fixes, and lenses above lines with what can be done there. */
#include <string.h>

#include "base/utf8.h"
#include "documents.h"
#include "lang/analysis/fix.h"
#include "lang/source/source.h"
#include "places.h"

/* Append what mends a remark: a text in place of another, or a line above. */
static void
append_fixes(const qdot_server *server, const qdot_document *document, const qdot_remark *remark, json_t *actions)
{
    const qdot_analysis *a = document->thorough;
    qdot_edit_list fixes = {0};

    if (qdot_fix_find(a, remark, &fixes) == QDOT_OK)
        for (size_t i = 0; i < fixes.n; i++) {
            const char *text = fixes.at[i].text;
            const bool line = fixes.at[i].at.from == fixes.at[i].at.to;
            char title[200];

            (void)snprintf(title, sizeof title, "Write `%.*s`%s", (int)strcspn(text, "\n"), text, line ? " above" : "");
            qdot_utf8_mend(title);
            (void)json_array_append_new(
                actions, json_pack("{s:s, s:s, s:b, s:{s:{s:[{s:o, s:s}]}}}", "title", title, "kind", "quickfix", "isPreferred", i == 0,
                                   "edit", "changes", document->uri, "range",
                                   qdot_place_range(server, a->text, a->length, fixes.at[i].at), "newText", text));
        }
    qdot_layout_clear(&fixes);
}

json_t *
qdot_lsp_code_action(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const qdot_document *document = qdot_documents_find(server, params, true, failure);
    const qdot_analysis *a;
    json_t *actions;
    qdot_stretch at;
    qdot_remark remark;

    if (document == NULL)
        return NULL;
    a = document->analysis;
    if (!qdot_place_read_range(server, a->text, a->length, json_object_get(params, "range"), &at))
        return qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "no range");
    actions = json_array();
    for (size_t i = 0; qdot_analysis_remark(document->thorough, i, &remark); i++)
        if (remark.level == QDOT_REMARK_ERROR && remark.at.to >= at.from && remark.at.from <= at.to)
            append_fixes(server, document, &remark, actions);
    return actions;
}

/* A lens in the line of byte `at`. line < 0: the command has no second argument. */
static json_t *
pack_lens(const qdot_server *server, const qdot_document *document, size_t at, const char *title, const char *command, bool with_line)
{
    const qdot_analysis *a = document->analysis;
    json_t *range = qdot_place_range(server, a->text, a->length, (qdot_stretch){at, at});
    json_t *arguments = json_pack("[s]", document->uri);

    if (with_line)
        (void)json_array_append(arguments, json_object_get(json_object_get(range, "start"), "line"));
    return json_pack("{s:o, s:{s:s, s:s, s:o}}", "range", range, "command", "title", title, "command", command, "arguments", arguments);
}

json_t *
qdot_lsp_code_lens(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    static const struct {
        const char *word, *title, *command;
    } shown[] = {{"plot", "Plot", "qdot.plot"}, {"animate", "Animate", "qdot.animate"}, {"report", "Report", "qdot.report"}};
    const qdot_document *document = qdot_documents_find(server, params, true, failure);
    const qdot_analysis *a;
    json_t *lenses;

    if (document == NULL)
        return NULL;
    a = document->analysis;
    lenses = json_array();
    if (a->pieces.n > 0) {
        (void)json_array_append_new(lenses, pack_lens(server, document, 0, "Run this file", "qdot.run", false));
        (void)json_array_append_new(lenses, pack_lens(server, document, 0, "Show equations", "qdot.equations", false));
    }
    for (size_t i = 0; i < a->pieces.n; i++)
        for (size_t k = 0; k < sizeof shown / sizeof *shown; k++)
            if (qdot_token_is_word(&a->source->tokens.at[a->pieces.at[i].first], shown[k].word))
                (void)json_array_append_new(lenses,
                                            pack_lens(server, document, a->pieces.at[i].at.from, shown[k].title, shown[k].command, true));
    return lenses;
}
