/* gnuplot.c -- runs gnuplot as a child process. */
#include "show/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt.h"

extern char **environ;

enum { IN, OUT, SAID, FDS };

/* The child process's standard streams; the descriptors are above 2, so dup2 overwrites none of them. */
typedef struct {
    int fd[FDS];
    int from; /* our end of the pipe from the child's output; -1: none */
} plumbing;

static qdot_status
fail_with_errno(const char *what)
{
    return qdot_fail(QDOT_EIO, "cannot %s: %s", what, strerror(errno));
}

/* Move a file descriptor above 2 (the standard ones), closed on exec; -1 stays -1. */
static int
move_descriptor_up(int fd)
{
    int moved;

    if (fd < 0)
        return -1;
    moved = fcntl(fd, F_DUPFD_CLOEXEC, FDS);
    close(fd);
    return moved;
}

/* Open an unnamed temporary file that contains `text`, positioned at its start; -1 on failure. */
static int
open_temporary_file(const char *text, size_t length)
{
    FILE *file = tmpfile();
    int fd = -1;

    if (file == NULL)
        return -1;
    if (fwrite(text, 1, length, file) == length && fflush(file) == 0 &&
        lseek(fileno(file), 0, SEEK_SET) == 0)
        fd = fcntl(fileno(file), F_DUPFD_CLOEXEC, FDS);
    fclose(file);
    return fd;
}

static void
close_streams(plumbing *p)
{
    for (int i = 0; i < FDS; i++)
        if (p->fd[i] >= 0)
            close(p->fd[i]);
    if (p->from >= 0)
        close(p->from);
}

static qdot_status
open_streams(plumbing *p, const qdot_text *script, bool wants_output)
{
    *p = (plumbing){{-1, -1, -1}, -1};
    p->fd[IN] = open_temporary_file(qdot_text_str(script), script->n);
    p->fd[SAID] = open_temporary_file("", 0);
    if (p->fd[IN] < 0 || p->fd[SAID] < 0)
        return fail_with_errno("write a temporary file");
    if (wants_output) {
        int ends[2];

        if (pipe(ends) != 0)
            return fail_with_errno("open a pipe");
        p->from = move_descriptor_up(ends[0]);
        p->fd[OUT] = move_descriptor_up(ends[1]);
    } else {
        p->fd[OUT] = move_descriptor_up(open("/dev/null", O_WRONLY));
    }
    if (p->fd[OUT] < 0 || (wants_output && p->from < 0))
        return fail_with_errno("open a pipe");
    return QDOT_OK;
}

static int
spawn_gnuplot(pid_t *child, const plumbing *p, posix_spawn_file_actions_t *actions,
              posix_spawnattr_t *attributes)
{
    char name[] = "gnuplot", defaults[] = "-d", persist[] = "-persist";
    char *image[] = {name, defaults, NULL}, *window[] = {name, defaults, persist, NULL};
    sigset_t usual, none;
    int failed = 0;

    for (int i = 0; i < FDS && failed == 0; i++)
        failed = posix_spawn_file_actions_adddup2(actions, p->fd[i], i);
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    sigaddset(&usual, SIGPIPE);
    sigaddset(&usual, SIGXFSZ);
    if (failed == 0)
        failed = posix_spawnattr_setsigdefault(attributes, &usual);
    if (failed == 0)
        failed = posix_spawnattr_setsigmask(attributes, &none);
    if (failed == 0)
        failed = posix_spawnattr_setflags(attributes,
                                          POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    if (failed == 0)
        failed = posix_spawnp(child, name, actions, attributes,
                              p->from >= 0 ? image : window, environ);
    return failed;
}

static qdot_status
fail_gnuplot_missing(void)
{
    qdot_fail(QDOT_EIO, "figures are drawn by gnuplot, which is not installed");
    return qdot_hint("apt install gnuplot-nox; only a .svg needs no gnuplot");
}

bool
qdot_gnuplot_is_here(void)
{
    const char *path = getenv("PATH");
    bool found = false;

    if (path == NULL)
        path = "/bin:/usr/bin";
    for (size_t n; path != NULL && !found; path = path[n] == ':' ? path + n + 1 : NULL) {
        char name[PATH_MAX];

        n = strcspn(path, ":");
        found = snprintf(name, sizeof name, "%.*s/gnuplot", n > 0 ? (int)n : 1, n > 0 ? path : ".") < (int)sizeof name &&
                access(name, X_OK) == 0;
    }
    return found;
}

static qdot_status
start_gnuplot(pid_t *child, const plumbing *p)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int failed = posix_spawn_file_actions_init(&actions);

    if (failed == 0) {
        failed = posix_spawnattr_init(&attributes);
        if (failed == 0) {
            failed = spawn_gnuplot(child, p, &actions, &attributes);
            posix_spawnattr_destroy(&attributes);
        }
        posix_spawn_file_actions_destroy(&actions);
    }
    if (failed == 0)
        return QDOT_OK;
    errno = failed;
    return fail_with_errno("start gnuplot");
}

/* Append everything read from `fd`, until the end of the file or pipe. */
static qdot_status
read_to_end(int fd, qdot_text *out)
{
    char block[1 << 14];

    for (;;) {
        ssize_t n = read(fd, block, sizeof block);

        if (n == 0)
            return qdot_text_status(out);
        if (n > 0)
            qdot_text_add_n(out, block, (size_t)n);
        else if (errno != EINTR)
            return fail_with_errno("read from gnuplot");
        QDOT_TRY(qdot_interrupt_check());
    }
}

/* Wait for gnuplot to end; returns its wait status, 0 if another part of the program has waited for it. */
static int
wait_for_gnuplot(pid_t child, bool stop)
{
    int status = 0;

    if (stop)
        kill(child, SIGTERM);
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return 0;
    return status;
}

/* The first line in `said` (gnuplot's standard error) that tells what is wrong, as the
 * failure. Its errors read `line 12: what`, after an echo of the line and a caret. Some systems
 * tell of a program that is not there only by how the child ended. */
static qdot_status
fail_with_gnuplot_message(int said, int ended)
{
    qdot_text all = {0};
    const char *line = "it printed no reason", *found = NULL;
    qdot_status status;

    if (lseek(said, 0, SEEK_SET) == 0 && read_to_end(said, &all) == QDOT_OK && all.n > 0) {
        char *next = all.at;

        while (next != NULL) {
            char *here = next;

            next = strchr(here, '\n');
            if (next != NULL)
                *next++ = '\0';
            here += strspn(here, " \t^");
            if (*here == '\0' || strstr(here, "arning:") != NULL)
                continue;
            if (found == NULL || strncmp(found, "line ", 5) != 0)
                found = here;
        }
        if (found != NULL && strncmp(found, "line ", 5) == 0 &&
            strstr(found, ": ") != NULL)
            found = strstr(found, ": ") + 2;
        if (found != NULL)
            line = found;
    }
    if (found == NULL && WIFEXITED(ended) && WEXITSTATUS(ended) == 127)
        status = fail_gnuplot_missing();
    else
        status = qdot_fail(QDOT_EIO, "gnuplot failed: %.300s", line);
    qdot_text_clear(&all);
    return status;
}

/* Check that an image has its last bytes: a wrapper script may hide that gnuplot was killed. */
static qdot_status
check_image_is_complete(const char *image, size_t n, const char *end)
{
    const size_t length = strlen(end), all = n;

    while (n > 0 && strchr(" \t\r\n", image[n - 1]) != NULL)
        n--;
    if (n >= length && memcmp(image + n - length, end, length) == 0)
        return QDOT_OK;
    return qdot_fail(QDOT_EIO, "gnuplot stopped within the image, after %zu bytes", all);
}

qdot_status
qdot_gnuplot_run(const qdot_text *script, const char *end, qdot_text *image)
{
    size_t before = image != NULL ? image->n : 0;
    plumbing p;
    pid_t child;
    int ended;
    qdot_status status;

    QDOT_TRY(qdot_text_status(script));
    if (!qdot_gnuplot_is_here())
        return fail_gnuplot_missing();
    status = open_streams(&p, script, image != NULL);
    if (status == QDOT_OK)
        status = start_gnuplot(&child, &p);
    if (status != QDOT_OK) {
        qdot_error first = *qdot_last_error();

        close_streams(&p);
        return qdot_fail_again(&first);
    }
    close(p.fd[OUT]);
    p.fd[OUT] = -1;
    if (image != NULL)
        status = read_to_end(p.from, image);
    ended = wait_for_gnuplot(child, status != QDOT_OK);
    if (status == QDOT_OK)
        status = qdot_interrupt_check();
    if (status == QDOT_OK && (ended != 0 || (image != NULL && image->n == before)))
        status = fail_with_gnuplot_message(p.fd[SAID], ended);
    if (status == QDOT_OK && image != NULL)
        status = check_image_is_complete(image->at + before, image->n - before, end);
    close_streams(&p);
    return status;
}
