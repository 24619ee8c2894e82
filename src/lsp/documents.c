/* documents.c -- the scripts that are open in the editor. */
#include "documents.h"

#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "lang/analysis/follow.h"
#include "places.h"

enum {
    SOON = 25,   /* milliseconds after which diagnostics are told as far as they are known */
    TICK = 5000 /* microseconds */
};

/* --- files and URIs ------------------------------------------------------------------- */

static int
hex_value(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

char *
qdot_documents_path(const char *uri)
{
    static const char scheme[] = "file://";
    const char *from = uri;
    char *path, *to;

    if (strncmp(uri, scheme, sizeof scheme - 1) == 0) {
        from += sizeof scheme - 1;
        from = strchr(from, '/') != NULL ? strchr(from, '/') : from; /* the name of a machine is left out */
    }
    path = to = qdot_strdup(from);
    if (path == NULL || from == uri)
        return path;
    while (*from != '\0') {
        if (*from == '%' && hex_value(from[1]) >= 0 && hex_value(from[2]) >= 0 && (hex_value(from[1]) | hex_value(from[2])) != 0) {
            *to++ = (char)(16 * hex_value(from[1]) + hex_value(from[2]));
            from += 3;
        } else {
            *to++ = *from++;
        }
    }
    *to = '\0';
    return path;
}

/* --- finding -------------------------------------------------------------------------- */

static qdot_document *
find_by_uri(const qdot_server *server, const char *uri)
{
    for (size_t i = 0; i < server->documents.n; i++)
        if (strcmp(server->documents.at[i]->uri, uri) == 0)
            return server->documents.at[i];
    return NULL;
}

static bool
is_same_file(const char *a, const char *b)
{
    struct stat one, other;

    return strcmp(a, b) == 0 || (stat(a, &one) == 0 && stat(b, &other) == 0 && one.st_dev == other.st_dev && one.st_ino == other.st_ino);
}

const qdot_document *
qdot_documents_by_path(const qdot_server *server, const char *path)
{
    for (size_t i = 0; i < server->documents.n; i++)
        if (is_same_file(server->documents.at[i]->path, path))
            return server->documents.at[i];
    return NULL;
}

/* Take the parts `..` out of a path, with the folder before each. */
static void
shorten_path(char *path)
{
    char *up, *before;

    while ((up = strstr(path, "/../")) != NULL && up > path) {
        *up = '\0';
        before = strrchr(path, '/');
        if (before == NULL) {
            *up = '/';
            return;
        }
        memmove(before, up + 3, strlen(up + 3) + 1);
    }
}

char *
qdot_documents_uri(const qdot_server *server, const char *path)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    const qdot_document *open = qdot_documents_by_path(server, path);
    char *shorter = qdot_strdup(path), *whole = NULL, *uri;
    qdot_text text = {0};

    if (shorter != NULL)
        shorten_path(shorter);
    if (shorter == NULL || shorter[0] != '/' || !is_same_file(shorter, path)) /* `..` behind a symbolic link is another folder */
        whole = realpath(path, NULL);
    if (open != NULL)
        qdot_text_add(&text, open->uri);
    else
        qdot_text_add(&text, "file://");
    for (const char *k = open != NULL ? "" : whole != NULL ? whole : shorter != NULL ? shorter : path; *k != '\0'; k++) {
        if (strchr(plain, *k) != NULL)
            qdot_text_char(&text, *k);
        else
            qdot_text_format(&text, "%%%02X", (unsigned char)*k);
    }
    free(whole);
    qdot_free(shorter);
    uri = text.failed ? NULL : qdot_strdup(qdot_text_str(&text));
    qdot_text_clear(&text);
    return uri;
}

void
qdot_documents_analyse(qdot_analysis *a)
{
    const qdot_analysis_host host = a->host;
    bool done;

    a->host.waits = NULL;
    (void)!qdot_follow_on(a, &done);
    a->host = host;
}

qdot_document *
qdot_documents_find(qdot_server *server, const json_t *params, bool analysed, qdot_lsp_failure *failure)
{
    const char *uri = json_string_value(json_object_get(json_object_get(params, "textDocument"), "uri"));
    qdot_document *document = uri != NULL ? find_by_uri(server, uri) : NULL;

    if (document == NULL) {
        (void)qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, uri != NULL ? "this document is not open" : "no textDocument.uri");
        return NULL;
    }
    if (analysed)
        qdot_documents_analyse(document->analysis);
    return document;
}

qdot_document *
qdot_documents_find_place(qdot_server *server, const json_t *params, size_t *at, qdot_lsp_failure *failure)
{
    qdot_document *document = qdot_documents_find(server, params, true, failure);

    if (document != NULL && !qdot_place_read(server, document->analysis->text, document->analysis->length,
                                             json_object_get(params, "position"), at)) {
        (void)qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "no position");
        return NULL;
    }
    return document;
}

/* --- what an analysis asks ------------------------------------------------------------ */

static bool
read_open_document(void *data, const char *path, qdot_text *text)
{
    const qdot_document *document = qdot_documents_by_path(data, path);

    if (document == NULL)
        return false;
    qdot_text_add_n(text, document->analysis->text, document->analysis->length);
    return true;
}

/* Milliseconds of a clock that goes on. */
static double
milliseconds(void)
{
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec*1e3 + (double)now.tv_nsec*1e-6;
}

static bool
message_waits(void *data)
{
    const qdot_server *server = data;

    return qdot_transport_waits(&server->transport) || milliseconds() > server->until;
}

/* --- opening, changing, closing ------------------------------------------------------- */

static void
free_document(qdot_document *document)
{
    if (document == NULL)
        return;
    qdot_analysis_free(document->analysis);
    qdot_analysis_free(document->thorough);
    qdot_free(document->uri);
    qdot_free(document->path);
    qdot_free(document);
}

/* Give the document another text [length]. */
static qdot_status
set_text(qdot_document *document, const char *text, size_t length)
{
    document->changed = true;
    QDOT_TRY(qdot_follow_text(document->analysis, text, length));
    return qdot_follow_text(document->thorough, text, length);
}

/* What the documents read from files is read anew, since a document (NULL: a file) has changed, which itself is analysed anyway. */
static void
read_files_anew(qdot_server *server, const qdot_document *changed)
{
    for (size_t i = 0; i < server->documents.n; i++) {
        qdot_document *document = server->documents.at[i];
        const size_t before = document->analysis->done, thorough = document->thorough->done;

        if (document == changed)
            continue;
        (void)!qdot_follow_files(document->analysis);
        (void)!qdot_follow_files(document->thorough);
        document->changed = document->changed || document->analysis->done < before || document->thorough->done < thorough;
    }
}

static json_t *
fail_memory(qdot_lsp_failure *failure)
{
    return qdot_lsp_fail(failure, QDOT_LSP_INTERNAL, "%s", qdot_last_error()->message);
}

json_t *
qdot_lsp_open(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const json_t *item = json_object_get(params, "textDocument"), *text = json_object_get(item, "text");
    const char *uri = json_string_value(json_object_get(item, "uri"));
    const qdot_analysis_host host = {read_open_document, message_waits, server};
    qdot_document *document = uri != NULL ? find_by_uri(server, uri) : NULL;

    if (uri == NULL || !json_is_string(text))
        return qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "no uri or text");
    if (document == NULL) {
        document = qdot_calloc(1, sizeof *document);
        if (document == NULL)
            return fail_memory(failure);
        document->uri = qdot_strdup(uri);
        document->path = qdot_documents_path(uri);
        document->analysis = document->path != NULL ? qdot_analysis_new(document->path, true, &host) : NULL;
        document->thorough = document->path != NULL ? qdot_analysis_new(document->path, false, &host) : NULL;
        if (document->uri == NULL || document->analysis == NULL || document->thorough == NULL || qdot_vec_push(&server->documents, document) != QDOT_OK) {
            free_document(document);
            return fail_memory(failure);
        }
    }
    document->version = json_integer_value(json_object_get(item, "version"));
    if (set_text(document, json_string_value(text), json_string_length(text)) != QDOT_OK)
        return fail_memory(failure);
    read_files_anew(server, document);
    return NULL;
}

/* Apply one change to the text: a part of it, or all, is replaced. false: the change makes no sense. */
static bool
change_text(const qdot_server *server, const json_t *change, qdot_text *text)
{
    const json_t *range = json_object_get(change, "range"), *by = json_object_get(change, "text");
    qdot_stretch at = {0, text->n};
    qdot_text behind = {0};

    if (!json_is_string(by) || (json_is_object(range) && !qdot_place_read_range(server, qdot_text_str(text), text->n, range, &at)))
        return false;
    qdot_text_add_n(&behind, qdot_text_str(text) + at.to, text->n - at.to);
    qdot_text_truncate(text, at.from);
    qdot_text_add_n(text, json_string_value(by), json_string_length(by));
    qdot_text_add_n(text, qdot_text_str(&behind), behind.n);
    text->failed = text->failed || behind.failed;
    qdot_text_clear(&behind);
    return true;
}

json_t *
qdot_lsp_change(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const json_t *changes = json_object_get(params, "contentChanges"), *version;
    qdot_document *document = qdot_documents_find(server, params, false, failure);
    qdot_text text = {0};
    qdot_status status;
    bool fine = true;

    if (document == NULL)
        return NULL;
    qdot_text_add_n(&text, document->analysis->text, document->analysis->length);
    for (size_t i = 0; i < json_array_size(changes); i++)
        fine = change_text(server, json_array_get(changes, i), &text) && fine;
    version = json_object_get(json_object_get(params, "textDocument"), "version");
    if (json_is_integer(version))
        document->version = json_integer_value(version);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = set_text(document, qdot_text_str(&text), text.n);
    qdot_text_clear(&text);
    if (status != QDOT_OK)
        return fail_memory(failure);
    read_files_anew(server, document);
    return fine ? NULL : qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "a change without text or with a wrong range");
}

json_t *
qdot_lsp_close(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    qdot_document *document = qdot_documents_find(server, params, false, failure);

    for (size_t i = 0; document != NULL && i < server->documents.n; i++)
        if (server->documents.at[i] == document) {
            qdot_server_notify(server, "textDocument/publishDiagnostics",
                               json_pack("{s:s, s:[]}", "uri", document->uri, "diagnostics"));
            server->documents.at[i] = server->documents.at[--server->documents.n];
            free_document(document);
            read_files_anew(server, NULL); /* who includes it reads the file, which may say something else */
            break;
        }
    return NULL;
}

/* A file has been written: one that is open, or another. */
json_t *
qdot_lsp_files_changed(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    (void)params, (void)failure;
    read_files_anew(server, NULL);
    return NULL;
}

/* --- when nothing waits --------------------------------------------------------------- */

/* While an analysis goes on a timer looks whether it had better be put off, for one statement may last. */
static const qdot_server *at_work;

static void
look_at_clock(int signal_number)
{
    (void)signal_number;
    if (at_work != NULL && message_waits((void *)at_work))
        qdot_interrupt_set();
}

static void
set_timer(suseconds_t microseconds)
{
    const struct itimerval timer = {{0, microseconds}, {0, microseconds}};
    struct sigaction action = {.sa_handler = look_at_clock, .sa_flags = SA_RESTART};

    sigemptyset(&action.sa_mask);
    (void)sigaction(SIGALRM, &action, NULL);
    (void)setitimer(ITIMER_REAL, &timer, NULL);
}

/* Let an analysis go on until then; returns whether it is at its end. */
static bool
go_on(qdot_server *server, qdot_analysis *a, double until)
{
    bool done = false;

    server->until = until;
    at_work = server;
    set_timer(TICK);
    if (qdot_follow_on(a, &done) != QDOT_OK)
        done = true;
    set_timer(0);
    at_work = NULL;
    server->until = HUGE_VAL;
    qdot_interrupt_clear();
    return done;
}

void
qdot_documents_work(qdot_server *server)
{
    for (size_t i = 0; i < server->documents.n; i++) {
        qdot_document *document = server->documents.at[i];
        const double until = milliseconds() + SOON;
        bool done;

        if (!document->changed)
            continue;
        done = go_on(server, document->analysis, until) && go_on(server, document->thorough, until);
        if (!done && qdot_transport_waits(&server->transport))
            return;
        document->changed = false;
        document->unsettled = !done;
        qdot_diagnostics_publish(server, document, done ? document->thorough : document->analysis);
    }
    for (size_t i = 0; i < server->documents.n; i++) {
        qdot_document *document = server->documents.at[i];

        if (!document->unsettled)
            continue;
        if (!go_on(server, document->analysis, HUGE_VAL) || !go_on(server, document->thorough, HUGE_VAL))
            return;
        document->unsettled = false;
        qdot_diagnostics_publish(server, document, document->thorough);
    }
}

void
qdot_documents_free(qdot_server *server)
{
    for (size_t i = 0; i < server->documents.n; i++)
        free_document(server->documents.at[i]);
    qdot_free(server->documents.at);
}
