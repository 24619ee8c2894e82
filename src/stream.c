/* stream.c -- reads statements from a pipe and carries them out one after the other. */
#include "stream.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/text.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"
#include "signals.h"

/* Append a line of input to `text`; false: there are no more lines. Ctrl-C interrupts reading, not the line. */
static bool
stream_read_line(qdot_text *text)
{
    char *part = NULL;
    size_t room = 0;
    bool any = false, interrupted;

    do {
        const ssize_t n = getline(&part, &room, stdin);

        interrupted = ferror(stdin) && errno == EINTR;
        if (interrupted)
            clearerr(stdin);
        if (n > 0)
            qdot_text_add_n(text, part, (size_t)n);
        any = any || n > 0;
    } while (interrupted);
    free(part);
    return any;
}

/* What has been read of the input: lines of one or several statements, and how many lines precede them. */
typedef struct {
    qdot_text text;
    uint32_t before, lines;
} part;

/* Read lines until they are a statement or several: brackets closed, no line continued. Lines before a Ctrl-C are
 * dropped. false: there are no more. */
static bool
read_statements(part *p)
{
    qdot_text line = {0};
    bool more;

    qdot_signals_waiting();
    p->before += p->lines;
    p->lines = 0;
    qdot_text_truncate(&p->text, 0);
    do {
        qdot_text_truncate(&line, 0);
        more = stream_read_line(&line);
        if (qdot_signals_take()) {
            p->before += p->lines;
            p->lines = 0;
            qdot_text_truncate(&p->text, 0);
        }
        if (!more)
            break;
        qdot_text_add_n(&p->text, line.at, line.n);
        p->text.failed = p->text.failed || line.failed;
        p->lines++;
    } while (!p->text.failed && qdot_script_is_incomplete(p->text.at, p->text.n));
    qdot_text_clear(&line);
    return p->lines > 0;
}

void
qdot_stream_run(qdot_session *session)
{
    part p = {0};

    session->typed->told = true;
    qdot_signals_patient(true);
    while (!session->outcome->quit && read_statements(&p)) {
        if (p.text.failed) {
            fprintf(stderr, "qdot: out of memory\n");
            break;
        }
        qdot_signals_computing();
        (void)qdot_script_run_part(session, "standard input", p.before, p.text.at, p.text.n);
        fflush(session->output->out);
        fflush(session->output->err);
    }
    qdot_signals_patient(false);
    session->typed->told = false;
    qdot_text_clear(&p.text);
}
