/* tasks.c -- scripts that are run for a command of the editor: starting processes, and answering with what they write. */
#include "tasks.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <unistd.h>

#include "documents.h"

struct qdot_task {
    pid_t process;
    int out; /* what the process writes */
    json_t *id, *token; /* of the request; of its progress, NULL: none is shown */
    char kind[16];
    qdot_text written;
    bool begun, cancelled;
};

static const char *const commands[] = {"qdot.run", "qdot.equations", "qdot.plot", "qdot.animate", "qdot.report"};

json_t *
qdot_lsp_commands(void)
{
    json_t *list = json_array();

    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        (void)json_array_append_new(list, json_string(commands[i]));
    return list;
}

/* --- starting ------------------------------------------------------------------------- */

/* In the new process: run this program with its input and output in pipes, in the folder of the script. */
static __attribute__((noreturn)) void
become_task(const qdot_server *server, const char *kind, const char *path, int in, int out)
{
    char option[32], *folder = qdot_strdup(path), *slash = folder != NULL ? strrchr(folder, '/') : NULL;
    char own[4096];
    const ssize_t n = readlink("/proc/self/exe", own, sizeof own - 1);
    const int nowhere = open("/dev/null", O_WRONLY);

    (void)snprintf(option, sizeof option, "--lsp=%s", kind);
    if (slash != NULL && slash > folder) {
        *slash = '\0';
        if (chdir(folder) != 0)
            errno = 0; /* the folder of a new script need not exist */
    }
    (void)dup2(in, STDIN_FILENO);
    (void)dup2(out, STDOUT_FILENO);
    (void)dup2(nowhere, STDERR_FILENO);
    for (int fd = STDERR_FILENO + 1; fd < 64; fd++)
        (void)close(fd);
    (void)setpgid(0, 0);
#ifdef __linux__
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL); /* the server cannot end it if it is killed itself */
#endif
    if (n > 0) {
        own[n] = '\0';
        (void)execl(own, "qdot", option, (char *)NULL);
    }
    (void)execlp(server->program, "qdot", option, (char *)NULL);
    _exit(127);
}

/* Start the process, and give it the statements. */
static bool
start_process(const qdot_server *server, qdot_task *task, const char *path, const char *statements)
{
    int in[2], out[2];
    size_t n = strlen(statements);

    if (pipe(in) != 0)
        return false;
    if (pipe(out) != 0) {
        (void)close(in[0]);
        (void)close(in[1]);
        return false;
    }
    task->process = fork();
    if (task->process == 0)
        become_task(server, task->kind, path, in[0], out[1]);
    if (task->process > 0) /* it does so too: whoever is first, the group is there when it is to be interrupted */
        (void)setpgid(task->process, task->process);
    (void)close(in[0]);
    (void)close(out[1]);
    task->out = out[0];
    while (task->process > 0 && n > 0) { /* it reads all before it does anything */
        const ssize_t written = write(in[1], statements, n);

        if (written < 0 && errno != EINTR)
            break;
        statements += written > 0 ? written : 0;
        n -= written > 0 ? (size_t)written : 0;
    }
    (void)close(in[1]);
    (void)fcntl(task->out, F_SETFD, FD_CLOEXEC);
    (void)fcntl(task->out, F_SETFL, O_NONBLOCK);
    return task->process > 0;
}

static void
free_task(qdot_task *task)
{
    if (task == NULL)
        return;
    json_decref(task->id);
    json_decref(task->token);
    qdot_text_clear(&task->written);
    qdot_free(task);
}

/* The token by which progress is told: that of the request, or a new one for which the editor is asked. */
static json_t *
find_token(qdot_server *server, const json_t *params)
{
    json_t *token = json_object_get(params, "workDoneToken");
    char name[32];

    if (token != NULL)
        return json_incref(token);
    if (!server->progress)
        return NULL;
    (void)snprintf(name, sizeof name, "qdot-%zu", server->tokens + 1);
    qdot_server_request(server, "window/workDoneProgress/create", json_pack("{s:s}", "token", name));
    return json_string(name);
}

static void
tell_progress(qdot_server *server, const qdot_task *task, json_t *value)
{
    if (task->token != NULL)
        qdot_server_notify(server, "$/progress", json_pack("{s:O, s:o}", "token", task->token, "value", value));
    else
        json_decref(value);
}

json_t *
qdot_lsp_execute(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const char *command = json_string_value(json_object_get(params, "command"));
    const json_t *arguments = json_object_get(params, "arguments"), *line = json_array_get(arguments, 1);
    json_t *item = json_pack("{s:{s:O}}", "textDocument", "uri", json_array_get(arguments, 0));
    qdot_document *document;
    qdot_task *task;
    char *statements;
    bool known = false;

    for (size_t i = 0; command != NULL && i < sizeof commands / sizeof *commands; i++)
        known = known || strcmp(command, commands[i]) == 0;
    document = known ? qdot_documents_find(server, item, true, failure) : NULL;
    json_decref(item);
    if (!known)
        return qdot_lsp_fail(failure, QDOT_LSP_INVALID_PARAMS, "unknown command `%.100s`", command != NULL ? command : "");
    if (document == NULL)
        return NULL;
    task = qdot_calloc(1, sizeof *task);
    statements = qdot_task_statements(document->analysis, strchr(command, '.') + 1, json_is_integer(line) ? json_integer_value(line) : -1);
    if (task == NULL || statements == NULL || qdot_vec_push(&server->tasks, task) != QDOT_OK) {
        qdot_free(task);
        qdot_free(statements);
        return qdot_lsp_fail(failure, QDOT_LSP_INTERNAL, "out of memory");
    }
    (void)snprintf(task->kind, sizeof task->kind, "%s", strchr(command, '.') + 1);
    if (!start_process(server, task, document->path, statements)) {
        server->tasks.n--;
        free_task(task);
        qdot_free(statements);
        return qdot_lsp_fail(failure, QDOT_LSP_INTERNAL, "no process can be started: %s", strerror(errno));
    }
    qdot_free(statements);
    task->id = server->request != NULL ? json_deep_copy(server->request) : json_null();
    task->token = find_token(server, params);
    tell_progress(server, task, json_pack("{s:s, s:s, s:b}", "kind", "begin", "title", command, "cancellable", 1));
    failure->code = QDOT_LSP_LATER;
    return NULL;
}

json_t *
qdot_lsp_cancel(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    (void)failure;
    qdot_tasks_cancel(server, json_object_get(params, "id"));
    return NULL;
}

/* The user has pressed the button of a progress. */
json_t *
qdot_lsp_cancel_progress(qdot_server *server, const json_t *params, qdot_lsp_failure *failure)
{
    const json_t *token = json_object_get(params, "token");

    (void)failure;
    for (size_t i = 0; i < server->tasks.n; i++)
        if (server->tasks.at[i]->token != NULL && json_equal(server->tasks.at[i]->token, token))
            qdot_tasks_cancel(server, server->tasks.at[i]->id);
    return NULL;
}

/* --- what a process has written ------------------------------------------------------- */

/* Write a figure or page to a file of its own in the folder of this server; its path, or NULL. */
static json_t *
write_figure(qdot_server *server, const json_t *figure)
{
    const char *data = json_string_value(json_object_get(figure, "data")), *mime = json_string_value(json_object_get(figure, "mime"));
    const char *temporary = getenv("TMPDIR");
    const size_t n = json_string_length(json_object_get(figure, "data"));
    qdot_text path = {0};
    json_t *result = NULL;
    FILE *file;

    if (server->folder == NULL) {
        qdot_text_format(&path, "%s/qdot-XXXXXX", temporary != NULL && temporary[0] == '/' ? temporary : "/tmp");
        server->folder = path.failed || mkdtemp(path.at) == NULL ? NULL : qdot_strdup(path.at);
        qdot_text_clear(&path);
    }
    if (server->folder == NULL || data == NULL)
        return NULL;
    qdot_text_format(&path, "%s/%zu.%s", server->folder, ++server->files, mime != NULL && strcmp(mime, "image/svg+xml") == 0 ? "svg" : "html");
    file = path.failed ? NULL : fopen(path.at, "w");
    if (file != NULL && fwrite(data, 1, n, file) == n)
        result = json_string(path.at);
    if (file != NULL)
        (void)fclose(file);
    qdot_text_clear(&path);
    return result;
}

/* Answer the request with the last line that the process has written. */
static void
answer_task(qdot_server *server, qdot_task *task)
{
    char *line = task->written.n > 0 ? task->written.at : NULL;
    qdot_lsp_failure failure = {QDOT_LSP_REQUEST_FAILED, "the process that ran the script has ended before its time"};
    json_t *result, *figures, *files = json_array();

    if (line != NULL) {
        line[task->written.n - (line[task->written.n - 1] == '\n')] = '\0';
        line = strrchr(line, '\n') != NULL ? strrchr(line, '\n') + 1 : line;
    }
    result = line != NULL ? json_loads(line, 0, NULL) : NULL;
    if (json_object_get(result, "status") == NULL) {
        json_decref(result);
        result = NULL;
    }
    figures = json_object_get(result, "figures");
    for (size_t i = 0; i < json_array_size(figures); i++) {
        json_t *file = write_figure(server, json_array_get(figures, i));

        if (file != NULL)
            (void)json_array_append_new(files, file);
    }
    if (result != NULL) {
        (void)json_object_del(result, "figures");
        (void)json_object_set(result, "files", files);
    }
    json_decref(files);
    tell_progress(server, task, json_pack("{s:s}", "kind", "end"));
    if (task->cancelled) {
        json_decref(result);
        result = NULL;
        (void)qdot_lsp_fail(&failure, QDOT_LSP_CANCELLED, "interrupted");
    }
    qdot_server_answer(server, task->id, result, &failure);
}

/* Tell the progress of a line that the process has written. false: it is its result. */
static bool
tell_line(qdot_server *server, const qdot_task *task, const char *text, size_t length)
{
    json_t *line = json_loadb(text, length, 0, NULL);
    const json_t *done = json_object_get(line, "done"), *left = json_object_get(line, "left");
    const char *what = json_string_value(json_object_get(line, "progress"));
    char message[80] = "";

    if (json_is_real(left))
        (void)snprintf(message, sizeof message, ", %.0f s left", json_real_value(left));
    if (done != NULL)
        tell_progress(server, task,
                      json_pack("{s:s, s:s+, s:I}", "kind", "report", "message", what != NULL ? what : "", message, "percentage",
                                (json_int_t)(100 * json_number_value(done))));
    json_decref(line);
    return done != NULL;
}

/* Tell the progress that the whole lines contain, and drop these; the result stays. */
static void
read_progress(qdot_server *server, qdot_task *task)
{
    char *text = task->written.at, *end;
    size_t taken = 0;

    while (text != NULL && taken < task->written.n && (end = memchr(text + taken, '\n', task->written.n - taken)) != NULL &&
           tell_line(server, task, text + taken, (size_t)(end - text) - taken))
        taken = (size_t)(end - text) + 1;
    if (taken > 0) {
        memmove(text, text + taken, task->written.n - taken);
        qdot_text_truncate(&task->written, task->written.n - taken);
    }
}

void
qdot_tasks_poll(const qdot_server *server, struct pollfd *fds)
{
    for (size_t i = 0; i < server->tasks.n; i++)
        fds[i] = (struct pollfd){.fd = server->tasks.at[i]->out, .events = POLLIN};
}

void
qdot_tasks_work(qdot_server *server)
{
    for (size_t i = 0; i < server->tasks.n;) {
        qdot_task *task = server->tasks.at[i];
        char block[65536];
        ssize_t n;
        bool later;

        while ((n = read(task->out, block, sizeof block)) > 0)
            qdot_text_add_n(&task->written, block, (size_t)n);
        later = n < 0 && (errno == EAGAIN || errno == EINTR);
        read_progress(server, task);
        if (later) {
            i++;
            continue;
        }
        (void)close(task->out);
        while (waitpid(task->process, NULL, 0) < 0 && errno == EINTR)
            continue;
        answer_task(server, task);
        server->tasks.at[i] = server->tasks.at[--server->tasks.n];
        free_task(task);
    }
}

/* --- ending --------------------------------------------------------------------------- */

void
qdot_tasks_cancel(qdot_server *server, const json_t *id)
{
    for (size_t i = 0; i < server->tasks.n; i++) {
        qdot_task *task = server->tasks.at[i];

        if (id == NULL || !json_equal(task->id, id))
            continue;
        /* the second time it is ended */
        (void)kill(-task->process, task->cancelled ? SIGKILL : SIGINT);
        task->cancelled = true;
    }
}

void
qdot_tasks_free(qdot_server *server)
{
    for (size_t i = 0; i < server->tasks.n; i++) {
        (void)kill(-server->tasks.at[i]->process, SIGKILL);
        (void)close(server->tasks.at[i]->out);
        (void)waitpid(server->tasks.at[i]->process, NULL, 0);
        free_task(server->tasks.at[i]);
    }
    qdot_free(server->tasks.at);
    for (size_t i = 1; server->folder != NULL && i <= server->files; i++)
        for (int k = 0; k < 2; k++) {
            qdot_text path = {0};

            qdot_text_format(&path, "%s/%zu.%s", server->folder, i, k == 0 ? "svg" : "html");
            (void)unlink(qdot_text_str(&path));
            qdot_text_clear(&path);
        }
    if (server->folder != NULL)
        (void)rmdir(server->folder);
    qdot_free(server->folder);
}
