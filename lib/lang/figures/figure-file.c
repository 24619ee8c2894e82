/* figure-file.c -- shows a figure in a window or the terminal, or writes it to a file. */
#include "lang/figures/figure-file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/terminal.h"
#include "expr/print-name.h"
#include "lang/answer/answer.h"
#include "lang/language/read.h"
#include "lang/session/output.h"
#include "lang/session/text-list.h"

enum { SKETCH_COLUMNS = 100, SKETCH_ROWS = 16, MOST_FILES = 1000000 };

/* --- numbered file names -------------------------------------------------------------- */

/* Append the path of a figure without number and ending: "dir/NAME" for the script dir/NAME.lag, else "qdot". */
static void
append_path_stem(const qdot_session *session, qdot_text *path)
{
    const char *script =
        session->including->n > 0 ? session->including->at[session->including->n - 1] : "-";
    size_t n = strlen(script);

    if (strcmp(script, "-") == 0)
        qdot_text_add(path, "qdot");
    else if (qdot_ends_in(script, ".lag"))
        qdot_text_add_n(path, script, n - 4);
    else
        qdot_text_add(path, script);
}

/* Choose the first of STEM-1.svg, STEM-2.svg ... that does not exist. */
static qdot_status
choose_default_path(const qdot_session *session, qdot_text *path)
{
    size_t stem;

    append_path_stem(session, path);
    stem = path->n;
    for (size_t k = 1; k < MOST_FILES; k++) {
        qdot_text_truncate(path, stem);
        qdot_text_format(path, "-%zu.svg", k);
        QDOT_TRY(qdot_text_status(path));
        if (access(path->at, F_OK) != 0) /* if the file cannot be examined, writing it gives the error */
            return QDOT_OK;
    }
    return qdot_fail(QDOT_ELIMIT, "there are too many numbered figures: remove some of `%s`", path->at);
}

/* --- sketch in the terminal ----------------------------------------------------------- */

static bool
has_terminal(const qdot_session *session)
{
    return !session->output->json && session->output->out == stdout && qdot_terminal_is(stdout);
}

/* Sketch every panel in characters, as wide as the terminal. */
static qdot_status
sketch_in_characters(qdot_session *session, const qdot_figure *figure)
{
    size_t columns = 80, rows = 24;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    (void)qdot_terminal_size(stdout, &columns, &rows);
    columns = columns > SKETCH_COLUMNS ? SKETCH_COLUMNS : columns;
    rows = rows > SKETCH_ROWS + 4 ? SKETCH_ROWS : rows > 8 ? rows - 4 : 4;
    for (size_t i = 0; i < figure->n && status == QDOT_OK; i++) {
        const qdot_figure_sketching how = {.columns = columns,
                                           .rows = figure->n > 1 ? rows / 2 + 2 : rows,
                                           .ascii = session->output->style != QDOT_UNICODE,
                                           .colours = (session->output->colours & QDOT_COLOURS_ANSWERS) != 0};

        status = qdot_figure_sketch(figure, i, &how, &text);
    }
    return qdot_answer_written(session, "sketch", status, &text);
}

/* --- a window, or a file -------------------------------------------------------------- */

static bool
is_environment_variable_set(const char *variable)
{
    const char *value = getenv(variable);

    return value != NULL && value[0] != '\0';
}

static bool
should_open_window(const qdot_session *session)
{
    return has_terminal(session) && (is_environment_variable_set("DISPLAY") || is_environment_variable_set("WAYLAND_DISPLAY"));
}

/* Show the figure in a window; *open: a window was opened. If that is impossible, give a notice. */
static qdot_status
try_to_open_window(qdot_session *session, const qdot_figure *figure, bool *open)
{
    qdot_status status = qdot_figure_write(figure, NULL);

    *open = status == QDOT_OK;
    if (status != QDOT_EIO)
        return status;
    return qdot_answer_notice_once(session, "no window: %.200s; figures go to files",
                                   qdot_last_error()->message);
}

/* --- in a program that shows answers ---------------------------------------------------- */

/* Append what the figure is of: its title, else the labels of its curves. */
static void
append_subject(const qdot_figure *figure, qdot_text *name)
{
    const qdot_panel *panel = &figure->panels[0];

    if (panel->title.text != NULL) {
        qdot_text_add(name, panel->title.text);
        return;
    }
    for (size_t i = 0; i < panel->n; i++)
        if (panel->curves[i].label.text != NULL)
            qdot_text_format(name, "%s%s", name->n > 0 ? ", " : "", panel->curves[i].label.text);
    if (name->n == 0 && panel->axis[1].text != NULL)
        qdot_text_add(name, panel->axis[1].text);
    if (name->n == 0 && panel->map != NULL && panel->map->label.text != NULL)
        qdot_text_add(name, panel->map->label.text);
}

static qdot_status
answer_image(qdot_session *session, const qdot_figure *figure)
{
    qdot_text name = {0}, image = {0};
    qdot_status status = qdot_figure_svg(figure, &image);

    append_subject(figure, &name);
    if (status == QDOT_OK)
        status = qdot_text_status(&name);
    status = qdot_answer_shown(session, "figure", "image/svg+xml", qdot_text_str(&name), status, &image);
    qdot_text_clear(&name);
    if (status == QDOT_OK && figure->keep)
        status = qdot_answer_notice(session, "`keep` keeps the script and the data beside a file: add `to \"figure.svg\"`");
    return status;
}

qdot_status
qdot_figure_file_show(qdot_session *session, const qdot_figure *figure, const char *path)
{
    qdot_text own = {0};
    qdot_status status = QDOT_OK;
    bool open = false;

    if (path == NULL && qdot_write_displays(session))
        return answer_image(session, figure);
    if (path == NULL && !figure->keep && should_open_window(session))
        QDOT_TRY(try_to_open_window(session, figure, &open));
    if (open)
        return QDOT_OK;
    if (path == NULL && has_terminal(session))
        QDOT_TRY(sketch_in_characters(session, figure));
    if (path != NULL)
        qdot_text_add(&own, path);
    else
        status = choose_default_path(session, &own);
    if (status == QDOT_OK)
        status = qdot_text_status(&own);
    if (status == QDOT_OK)
        status = qdot_figure_write(figure, qdot_text_str(&own));
    if (status == QDOT_OK)
        status = qdot_answer_file(session, qdot_text_str(&own));
    qdot_text_clear(&own);
    return status;
}
