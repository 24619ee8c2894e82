/* diagnostics.c -- publishes what an analysis has to say of a document. */
#include "base/utf8.h"
#include "documents.h"
#include "places.h"

enum { MOST = 250 }; /* remarks that are told of one document */

/* A remark as the protocol has it: the hint is the second line of the message. */
static json_t *
pack_remark(const qdot_server *server, const qdot_analysis *a, const qdot_remark *remark)
{
    json_t *diagnostic;
    qdot_text text = {0};

    qdot_text_add(&text, remark->message);
    if (remark->hint[0] != '\0')
        qdot_text_format(&text, "\nhint: %s", remark->hint);
    if (text.n > 0)
        qdot_utf8_mend(text.at); /* it may name a file in other letters */
    diagnostic = json_pack("{s:o, s:i, s:s, s:s}", "range", qdot_place_range(server, a->text, a->length, remark->at), "severity",
                           (int)remark->level, "source", "qdot", "message", qdot_text_str(&text));
    if (diagnostic != NULL && remark->fix != NULL)
        (void)json_object_set_new(diagnostic, "data", json_pack("{s:s}", "fix", remark->fix));
    qdot_text_clear(&text);
    return diagnostic;
}

json_t *
qdot_diagnostics_of(const qdot_server *server, const qdot_analysis *a)
{
    json_t *list = json_array();
    qdot_remark remark;

    for (size_t i = 0; i < MOST && qdot_analysis_remark(a, i, &remark); i++)
        (void)json_array_append_new(list, pack_remark(server, a, &remark));
    return list;
}

void
qdot_diagnostics_publish(qdot_server *server, const qdot_document *document, const qdot_analysis *a)
{
    qdot_places_forget(server);
    qdot_server_notify(server, "textDocument/publishDiagnostics",
                       json_pack("{s:s, s:I, s:o}", "uri", document->uri, "version", document->version, "diagnostics",
                                 qdot_diagnostics_of(server, a)));
}

json_t *
qdot_lsp_diagnostic(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    qdot_document *document = qdot_documents_find(server, params, true, failure);

    if (document == NULL)
        return NULL;
    qdot_documents_analyse(document->thorough);
    return json_pack("{s:s, s:o}", "kind", "full", "items", qdot_diagnostics_of(server, document->thorough));
}
