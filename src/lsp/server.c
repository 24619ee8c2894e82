/* server.c -- reads messages, has each answered by the function of its method, and works while none waits. */
#include "server.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/utf8.h"
#include "documents.h"
#include "message.h"
#include "places.h"
#include "tasks.h"

typedef struct {
    const char *method;
    json_t *(*handle)(qdot_server *server, const json_t *params, qdot_lsp_failure *failure);
    bool answered; /* it is a request */
} method;

static const method methods[] = {
#define REQUEST(name, function) {name, function, true},
#define NOTIFICATION(name, function) {name, function, false},
#include "methods.def"
#undef NOTIFICATION
#undef REQUEST
};

/* --- sending -------------------------------------------------------------------------- */

json_t *
qdot_lsp_fail(qdot_lsp_failure *failure, int code, const char *format, ...)
{
    va_list ap;

    failure->code = code;
    va_start(ap, format);
    (void)vsnprintf(failure->message, sizeof failure->message, format, ap);
    va_end(ap);
    qdot_utf8_mend(failure->message);
    return NULL;
}

/* Send a message, which is taken over. */
static void
send_message(qdot_server *server, json_t *message)
{
    char *text = message != NULL ? json_dumps(message, JSON_COMPACT) : NULL;

    if (text != NULL)
        qdot_transport_write(&server->transport, text, strlen(text));
    free(text);
    json_decref(message);
}

void
qdot_server_notify(qdot_server *server, const char *name, json_t *params)
{
    if (params != NULL)
        send_message(server, json_pack("{s:s, s:s, s:o}", "jsonrpc", "2.0", "method", name, "params", params));
}

void
qdot_server_request(qdot_server *server, const char *name, json_t *params)
{
    if (params != NULL)
        send_message(server, json_pack("{s:s, s:I, s:s, s:o}", "jsonrpc", "2.0", "id", (json_int_t)++server->tokens, "method", name,
                                       "params", params));
}

void
qdot_server_answer(qdot_server *server, const json_t *id, json_t *result, const qdot_lsp_failure *failure)
{
    json_t *own = id != NULL ? json_deep_copy(id) : json_null();

    if (result != NULL)
        send_message(server, json_pack("{s:s, s:o, s:o}", "jsonrpc", "2.0", "id", own, "result", result));
    else
        send_message(server, json_pack("{s:s, s:o, s:{s:i, s:s}}", "jsonrpc", "2.0", "id", own, "error", "code", failure->code,
                                       "message", failure->message));
}

/* --- one message ---------------------------------------------------------------------- */

static const method *
find_method(const char *name)
{
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].method, name) == 0)
            return &methods[i];
    return NULL;
}

/* Answer a request, or carry out a notification, which has no id. */
static void
handle_request(qdot_server *server, const json_t *message, const char *name)
{
    const json_t *id = json_object_get(message, "id");
    const method *found = find_method(name);
    qdot_lsp_failure failure = {QDOT_LSP_INTERNAL, "out of memory"};
    json_t *result = NULL;

    server->request = id;
    qdot_places_forget(server);
    if (server->shut_down && strcmp(name, "exit") != 0)
        (void)qdot_lsp_fail(&failure, QDOT_LSP_INVALID_REQUEST, "the server has been shut down");
    else if (!server->initialized && strcmp(name, "initialize") != 0 && strcmp(name, "exit") != 0)
        (void)qdot_lsp_fail(&failure, QDOT_LSP_NOT_INITIALIZED, "the first request is `initialize`");
    else if (found == NULL)
        (void)qdot_lsp_fail(&failure, QDOT_LSP_UNKNOWN_METHOD, "unknown method `%.200s`", name);
    else if (found->answered != (id != NULL))
        (void)qdot_lsp_fail(&failure, QDOT_LSP_INVALID_REQUEST, "`%s` is a notification, which has no id", name);
    else
        result = found->handle(server, json_object_get(message, "params"), &failure);
    server->request = NULL;
    if (result == NULL && failure.code == QDOT_LSP_LATER)
        return;
    if (id != NULL)
        qdot_server_answer(server, id, result, &failure);
    else
        json_decref(result);
}

static void
handle_message(qdot_server *server, const char *text, size_t length)
{
    json_t *message = qdot_message_read(text, length);
    const json_t *name = json_object_get(message, "method");
    qdot_lsp_failure failure = {QDOT_LSP_PARSE_ERROR, "this is no JSON"};

    if (message == NULL) {
        qdot_server_answer(server, NULL, NULL, &failure);
    } else if (json_is_string(name)) {
        handle_request(server, message, json_string_value(name));
    } else if (json_object_get(message, "result") == NULL && json_object_get(message, "error") == NULL) {
        (void)qdot_lsp_fail(&failure, QDOT_LSP_INVALID_REQUEST, "a message without a method");
        qdot_server_answer(server, json_object_get(message, "id"), NULL, &failure);
    } /* else an answer to what the server has asked: nothing depends on it */
    json_decref(message);
}

/* --- all messages --------------------------------------------------------------------- */

/* Handle the messages that have been read. */
static void
handle_pending(qdot_server *server)
{
    const qdot_lsp_failure failure = {QDOT_LSP_PARSE_ERROR, "no message with its Content-Length"};
    const char *text;
    size_t length;

    while (!server->ended && !server->transport.broken) {
        switch (qdot_transport_take(&server->transport, &text, &length)) {
        case QDOT_TRANSPORT_MESSAGE: handle_message(server, text, length); break;
        case QDOT_TRANSPORT_WRONG: qdot_server_answer(server, NULL, NULL, &failure); break;
        default: return;
        }
    }
}

/* Wait until there is input, or a task has written something. */
static bool
wait_for_work(qdot_server *server)
{
    struct pollfd *fds = qdot_malloc((1 + server->tasks.n) * sizeof *fds);
    bool input = true;

    if (fds != NULL) {
        fds[0] = (struct pollfd){.fd = server->transport.in, .events = POLLIN};
        qdot_tasks_poll(server, fds + 1);
        input = poll(fds, 1 + server->tasks.n, -1) > 0 && fds[0].revents != 0;
    }
    qdot_free(fds);
    return input;
}

int
qdot_lsp_run(const char *program, const char *task)
{
    qdot_server server = {
        .program = program, .until = HUGE_VAL, .transport = {.in = STDIN_FILENO, .out = STDOUT_FILENO}};

    (void)signal(SIGPIPE, SIG_IGN);
    if (task != NULL)
        return qdot_task_run();
    server.marks = qdot_places_new();
    while (server.marks != NULL && !server.ended && !server.transport.ended && !server.transport.broken) {
        if (wait_for_work(&server)) {
            if (qdot_transport_read(&server.transport) != QDOT_OK)
                break;
            handle_pending(&server);
        }
        qdot_tasks_work(&server);
        if (!server.ended && !server.shut_down)
            qdot_documents_work(&server);
    }
    qdot_tasks_free(&server);
    qdot_documents_free(&server);
    qdot_places_free(server.marks);
    qdot_text_clear(&server.transport.pending);
    return server.ended && server.shut_down ? 0 : 1;
}
