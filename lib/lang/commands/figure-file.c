/* figure-file.c -- where a figure goes. */
#include "lang/commands/figure-file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lang/answer/answer.h"
#include "lang/language/read.h"

/* "dir/NAME-1.svg" for the script dir/NAME.lag, "qdot-1.svg" elsewhere. */
static qdot_status
default_path(qdot_session *session, qdot_text *path)
{
    const char *script =
        session->including.n > 0 ? session->including.at[session->including.n - 1] : "-";
    size_t n = strlen(script);

    if (strcmp(script, "-") == 0)
        qdot_text_add(path, "qdot");
    else if (n > 4 && strcmp(script + n - 4, ".lag") == 0)
        qdot_text_add_n(path, script, n - 4);
    else
        qdot_text_add(path, script);
    qdot_text_format(path, "-%zu.svg", ++session->figures);
    return qdot_text_status(path);
}

static bool
has_window(const qdot_session *session)
{
    return !session->json && isatty(STDOUT_FILENO) &&
           (getenv("DISPLAY") != NULL || getenv("WAYLAND_DISPLAY") != NULL);
}

qdot_status
qdot_figure_file_show(qdot_session *session, const qdot_figure *figure, const char *path)
{
    qdot_text own = {0};
    qdot_status status = QDOT_OK;

    if (path != NULL)
        qdot_text_add(&own, path);
    else if (!has_window(session))
        status = default_path(session, &own);
    if (status == QDOT_OK)
        status = qdot_text_status(&own);
    if (status == QDOT_OK)
        status = qdot_figure_write(figure, own.n > 0 ? qdot_text_str(&own) : NULL);
    if (status == QDOT_OK && own.n > 0)
        status = qdot_answer_file(session, qdot_text_str(&own));
    qdot_text_clear(&own);
    return status;
}

qdot_status
qdot_figure_file_read(qdot_cursor *c, const char **path)
{
    if (*path != NULL)
        return qdot_cursor_once(c, "to", true);
    if (c->at->kind != QDOT_TOKEN_STRING)
        return qdot_cursor_expected(c, "the name of a file in quotes");
    return qdot_read_string(c, path);
}
