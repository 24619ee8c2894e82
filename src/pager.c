/* pager.c -- shows answers that are longer than the screen page by page. */
#include "pager.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/terminal.h"
#include "base/utf8.h"
#include "lang/session/output.h"

static FILE *collected, *out, *err; /* stream for answers while they are collected; the session's own streams */
static char *text;
static size_t length;

/* The command that shows text page by page; NULL if no pager is wanted. */
static const char *
pager_command(void)
{
    const char *pager = getenv("PAGER"), *term = getenv("TERM");

    if (term == NULL || strcmp(term, "dumb") == 0)
        return NULL;
    if (pager == NULL)
        return "less -FRX";
    return pager[0] == '\0' || strcmp(pager, "cat") == 0 ? NULL : pager;
}

bool
qdot_pager_begin(qdot_session *session)
{
    size_t columns, rows;

    if (session->output->json || pager_command() == NULL ||
        !qdot_terminal_size(session->output->out, &columns, &rows))
        return false;
    collected = open_memstream(&text, &length);
    if (collected == NULL)
        return false;
    out = session->output->out;
    err = session->output->err;
    session->output->pages = session->output->out = collected;
    session->output->screen = out;
    if (isatty(fileno(err)))
        session->output->err = collected; /* so that errors come after the answers before them */
    return true;
}

/* The number of columns of a line, not counting colour codes. */
static size_t
columns_of(const char *line, size_t n)
{
    size_t codes = 0;

    for (size_t i = 0; i < n; i++)
        if (line[i] == '\033') {
            const size_t end = i + strcspn(line + i, "m\n");

            codes += end - i + 1;
            i = end;
        }
    return qdot_utf8_columns(line, n) - codes;
}

static bool
is_longer_than_the_screen(void)
{
    size_t columns, rows, lines = 0;

    if (!qdot_terminal_size(out, &columns, &rows))
        return false;
    for (const char *at = text; at < text + length && lines < rows;) {
        const size_t n = strcspn(at, "\n");

        lines += 1 + (n > 0 ? (columns_of(at, n) - 1) / columns : 0);
        at += n + 1;
    }
    return lines >= rows; /* the prompt needs one more line */
}

/* Show the collected answers; false: the command could not be started. */
static bool
show_pages(void)
{
    void (*before)(int) = signal(SIGPIPE, SIG_IGN); /* the user may leave the pager early */
    FILE *pager;
    int status = -1;

    setenv("LESS", "FRX", 0);
    fflush(NULL);
    pager = popen(pager_command(), "w");
    if (pager != NULL) {
        (void)fwrite(text, 1, length, pager);
        status = pclose(pager);
    }
    signal(SIGPIPE, before);
    qdot_interrupt_clear(); /* the Ctrl-C was meant for the pager */
    return status != -1 && !(WIFEXITED(status) &&
                             (WEXITSTATUS(status) == 126 || WEXITSTATUS(status) == 127));
}

void
qdot_pager_end(qdot_session *session)
{
    fclose(collected);
    session->output->out = out;
    session->output->err = err;
    session->output->pages = session->output->screen = NULL;
    if (length > 0 && !(is_longer_than_the_screen() && show_pages()))
        (void)fwrite(text, 1, length, out);
    fflush(out);
    free(text); /* allocated by open_memstream */
    text = NULL;
}
