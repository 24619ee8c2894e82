/* stream.c -- statements from a pipe, one after the other. */
#include "stream.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/text.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"

/* Lines are read until they are a statement or several: brackets closed, no line continued. Appended to `text`; *lines
 * grows by their number. false: there are no more. */
static bool
read_statements(qdot_text *text, size_t *lines)
{
    char *line = NULL;
    size_t room = 0;
    bool any = false;
    ssize_t n;

    do {
        n = getline(&line, &room, stdin);
        if (n < 0)
            break;
        qdot_text_add_n(text, line, (size_t)n);
        any = true;
        ++*lines;
    } while (!text->failed && qdot_script_is_incomplete(text->at, text->n));
    free(line);
    return any;
}

void
qdot_stream_run(qdot_session *session)
{
    qdot_text text = {0};
    size_t lines = 0; /* read so far */

    session->typed->told = true;
    while (!session->outcome->quit) {
        qdot_text_truncate(&text, 0);
        for (size_t k = 0; k < lines; k++)
            qdot_text_char(&text, '\n'); /* so that lines have their numbers in all of the input */
        if (!read_statements(&text, &lines))
            break;
        if (text.failed) {
            fprintf(stderr, "qdot: out of memory\n");
            break;
        }
        (void)qdot_script_run_text(session, "standard input", text.at, text.n);
        fflush(session->output->out);
        fflush(session->output->err);
    }
    session->typed->told = false;
    qdot_text_clear(&text);
}
