/* documents.h -- the scripts that are open in the editor. */
#ifndef QDOT_LSP_DOCUMENTS_H
#define QDOT_LSP_DOCUMENTS_H

#include "parts.h"

/* The document of a request, {"textDocument": {"uri": ...}}, analysed to its end if `analysed`. NULL: *failure says why. */
qdot_document *qdot_documents_find(qdot_server *server, const json_t *params, bool analysed, qdot_lsp_failure *failure);
/* The same with the byte of its "position". */
qdot_document *qdot_documents_find_place(qdot_server *server, const json_t *params, size_t *at, qdot_lsp_failure *failure);
/* The document with that file, by whatever path; NULL: it is not open. */
const qdot_document *qdot_documents_by_path(const qdot_server *server, const char *path);
/* The path of a URI file:///a%20b.lag; another URI is its own path. The caller's; NULL if memory runs out. */
char *qdot_documents_path(const char *uri);
/* The URI of a file: as the editor names it if it is open. The caller's; NULL if memory runs out. */
char *qdot_documents_uri(const qdot_server *server, const char *path);

/* Analyse to the end, although something waits. */
void qdot_documents_analyse(qdot_analysis *a);
/* Analyse documents that have changed, while nothing waits, and publish their diagnostics. */
void qdot_documents_work(qdot_server *server);
void qdot_documents_free(qdot_server *server);

#endif
