/* parts.h -- inside of src/lsp: the state of the server, and what its files offer each other. */
#ifndef QDOT_LSP_PARTS_H
#define QDOT_LSP_PARTS_H

#include <jansson.h>
#include <sys/types.h>

#include "lang/analysis/analysis.h"
#include "transport.h"

/* A script that is open in the editor. */
typedef struct {
    char *uri, *path;
    json_int_t version;
    qdot_analysis *analysis; /* without the answers to questions: soon ready */
    qdot_analysis *thorough; /* with them */
    bool changed;   /* it was changed since the diagnostics of `analysis` were published */
    bool unsettled; /* those of `thorough` have not been published */
} qdot_document;

/* A script that is being run for a request (tasks.h). */
typedef struct qdot_task qdot_task;
typedef struct qdot_place_marks qdot_place_marks;

typedef struct qdot_server {
    const char *program; /* how this program was called */
    qdot_transport transport;
    qdot_vec(qdot_document *) documents;
    qdot_vec(qdot_task *) tasks;
    bool initialized, shut_down, ended;
    bool utf8;     /* places within a line are counted in bytes, not in units of UTF-16 */
    bool progress; /* the editor shows progress that the server begins */
    double until;  /* the time in ms at which an analysis is put off */
    const json_t *request; /* id of the request that is being answered; NULL: it is a notification */
    char *folder;  /* of files that commands have made; NULL: there are none */
    size_t files;  /* their number */
    size_t tokens; /* number of progress tokens given */
    qdot_place_marks *marks; /* of the text whose places were asked for last (places.h) */
} qdot_server;

/* Why a request has no result: a code of the protocol, and a sentence. */
typedef struct {
    int code;
    char message[512];
} qdot_lsp_failure;

enum {
    QDOT_LSP_PARSE_ERROR = -32700,
    QDOT_LSP_INVALID_REQUEST = -32600,
    QDOT_LSP_UNKNOWN_METHOD = -32601,
    QDOT_LSP_INVALID_PARAMS = -32602,
    QDOT_LSP_INTERNAL = -32603,
    QDOT_LSP_NOT_INITIALIZED = -32002,
    QDOT_LSP_CANCELLED = -32800,
    QDOT_LSP_REQUEST_FAILED = -32803,
    QDOT_LSP_LATER = 1 /* no failure: the answer follows when a task has ended */
};

/* Record why a request fails; returns NULL, the missing result. */
json_t *qdot_lsp_fail(qdot_lsp_failure *failure, int code, const char *format, ...) QDOT_PRINTF(3, 4);

/* The handlers of requests. The result is the caller's; NULL: *failure says why. A handler of a notification returns NULL. */
#define REQUEST(method, function) \
    json_t *function(qdot_server *server, const json_t *params, qdot_lsp_failure *failure);
#define NOTIFICATION REQUEST
#include "methods.def"
#undef NOTIFICATION
#undef REQUEST

/* Send a notification or an answer; `params`, `result` are taken over. */
void qdot_server_notify(qdot_server *server, const char *method, json_t *params);
void qdot_server_answer(qdot_server *server, const json_t *id, json_t *result, const qdot_lsp_failure *failure);
void qdot_server_request(qdot_server *server, const char *method, json_t *params);

/* The kinds of semantic tokens; the commands that can be executed. */
json_t *qdot_lsp_colours_legend(void);
json_t *qdot_lsp_commands(void);

/* What is to be said of a document: an array, the caller's. */
json_t *qdot_diagnostics_of(const qdot_server *server, const qdot_analysis *a);
/* Publish it, as far as an analysis knows it. */
void qdot_diagnostics_publish(qdot_server *server, const qdot_document *document, const qdot_analysis *a);

#endif
