/* stream.c -- statements from a pipe, one after the other. */
#include "stream.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/text.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"
#include "signals.h"

/* A line, appended to `text`; false: there are no more. Ctrl-C interrupts the reading, not the line. */
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

/* Lines are read until they are a statement or several: brackets closed, no line continued. Into `text`, behind as many
 * empty lines as were read before, so that lines have their numbers in all of the input; *lines grows by their number.
 * Lines before a Ctrl-C are dropped. false: there are no more. */
static bool
read_statements(qdot_text *text, size_t *lines)
{
    qdot_text line = {0};
    bool any = false, more;

    qdot_signals_waiting();
    do {
        qdot_text_truncate(&line, 0);
        more = stream_read_line(&line);
        if (qdot_signals_take() || !any) {
            qdot_text_truncate(text, 0);
            for (size_t k = 0; k < *lines; k++)
                qdot_text_char(text, '\n');
            any = false;
        }
        if (!more)
            break;
        qdot_text_add_n(text, line.at, line.n);
        text->failed = text->failed || line.failed;
        any = true;
        ++*lines;
    } while (!text->failed && qdot_script_is_incomplete(text->at, text->n));
    qdot_text_clear(&line);
    return any;
}

void
qdot_stream_run(qdot_session *session)
{
    qdot_text text = {0};
    size_t lines = 0; /* read so far */

    session->typed->told = true;
    while (!session->outcome->quit) {
        if (!read_statements(&text, &lines))
            break;
        if (text.failed) {
            fprintf(stderr, "qdot: out of memory\n");
            break;
        }
        qdot_signals_computing();
        (void)qdot_script_run_text(session, "standard input", text.at, text.n);
        fflush(session->output->out);
        fflush(session->output->err);
    }
    session->typed->told = false;
    qdot_text_clear(&text);
}
