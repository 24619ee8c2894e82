/* lifecycle.c -- the requests with which a server begins and ends. */
#include <string.h>

#include "parts.h"

/* Whether the array contains the text. */
static bool
contains(const json_t *array, const char *text)
{
    for (size_t i = 0; i < json_array_size(array); i++) {
        const char *entry = json_string_value(json_array_get(array, i));

        if (entry != NULL && strcmp(entry, text) == 0)
            return true;
    }
    return false;
}

/* What the server offers. */
static json_t *
capabilities(const qdot_server *server)
{
    static const char *const simple[] = {
        "hoverProvider",     "definitionProvider",         "declarationProvider",             "referencesProvider",
        "codeActionProvider", "documentHighlightProvider", "documentSymbolProvider",          "foldingRangeProvider",
        "documentFormattingProvider", "documentRangeFormattingProvider"};
    json_t *all = json_pack("{s:s, s:{s:b, s:i, s:b}, s:{s:[s,s,s,s]}, s:{s:[s,s]}, s:{s:b}, s:{s:b}, s:{s:o, s:b}}",
                            "positionEncoding", server->utf8 ? "utf-8" : "utf-16", "textDocumentSync", "openClose", 1, "change", 2,
                            "save", 1, "completionProvider", "triggerCharacters", ".", "[", "(", "\\", "signatureHelpProvider",
                            "triggerCharacters", "(", ",", "renameProvider", "prepareProvider", 1, "codeLensProvider",
                            "resolveProvider", 0, "semanticTokensProvider", "legend", qdot_lsp_colours_legend(), "full", 1);

    for (size_t i = 0; i < sizeof simple / sizeof *simple; i++)
        (void)json_object_set_new(all, simple[i], json_true());
    (void)json_object_set_new(all, "executeCommandProvider", json_pack("{s:o}", "commands", qdot_lsp_commands()));
    return all;
}

json_t *
qdot_lsp_initialize(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const json_t *client = json_object_get(params, "capabilities");
    const json_t *general = json_object_get(client, "general"), *window = json_object_get(client, "window");

    if (server->initialized)
        return qdot_lsp_fail(failure, QDOT_LSP_INVALID_REQUEST, "the server has been initialized");
    server->initialized = true;
    server->utf8 = contains(json_object_get(general, "positionEncodings"), "utf-8");
    server->progress = json_is_true(json_object_get(window, "workDoneProgress"));
    return json_pack("{s:o, s:{s:s, s:s}}", "capabilities", capabilities(server), "serverInfo", "name", "qdot", "version",
                     PACKAGE_VERSION);
}

json_t *
qdot_lsp_initialized(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    (void)server, (void)params, (void)failure;
    return NULL;
}

json_t *
qdot_lsp_shutdown(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    (void)params, (void)failure;
    server->shut_down = true;
    return json_null();
}

json_t *
qdot_lsp_exit(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    (void)params, (void)failure;
    server->ended = true;
    return NULL;
}
