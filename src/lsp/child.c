/* child.c -- the process that runs a script for a command of the editor. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "base/utf8.h"
#include "qdot.h"
#include "tasks.h"

enum { MOST = 1 << 28 };

static void
handle_interrupt(int signal_number)
{
    (void)signal_number;
    qdot_interrupt_set();
}

static void
write_object(json_t *line)
{
    char *text = line != NULL ? json_dumps(line, JSON_COMPACT) : NULL;

    if (text != NULL) {
        fputs(text, stdout);
        fputc('\n', stdout);
        if (fflush(stdout) != 0)
            qdot_interrupt_set(); /* nobody reads it any more */
    }
    free(text);
    json_decref(line);
}

static void
tell_progress(void *data, const char *what, double done, double left)
{
    (void)data;
    write_object(json_pack("{s:s, s:f, s:o}", "progress", what, "done", isfinite(done) ? done : 0, "left",
                         isfinite(left) ? json_real(left) : json_null()));
}

/* --- what the answers say ------------------------------------------------------------- */

/* The parts of the result. */
typedef struct {
    json_t *figures, *latex;
    qdot_text text, html;
    json_t *rows; /* cells of the rows of a table that has not ended, each an array of texts; empty: there is none */
} sorted;

static const char *
text_in(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));

    return text != NULL ? text : "";
}

/* Write the rows of the table, each column as wide as its widest cell, with its cells on the right. */
static void
end_table(sorted *to)
{
    size_t widths[64] = {0};

    if (json_array_size(to->rows) == 0)
        return;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < json_array_size(to->rows); i++) {
            const json_t *cells = json_array_get(to->rows, i);

            for (size_t k = 0; k < json_array_size(cells); k++) {
                const char *cell = json_string_value(json_array_get(cells, k));
                const size_t width = cell != NULL ? qdot_utf8_columns(cell, strlen(cell)) : 0, column = k < 64 ? k : 63;

                if (pass == 0)
                    widths[column] = width > widths[column] ? width : widths[column];
                else
                    qdot_text_format(&to->text, "%s%*s%s", k > 0 ? "  " : "",
                                     (int)(widths[column] > width ? widths[column] - width : 0), "", cell != NULL ? cell : "");
            }
            if (pass == 1)
                qdot_text_char(&to->text, '\n');
        }
    qdot_text_add(&to->html, "</table>\n");
    (void)json_array_clear(to->rows);
}

/* Sort one object of an answer for display. */
static void
sort_object(const json_t *object, sorted *to)
{
    const char *kind = text_in(object, "kind");
    json_t *cells = json_object_get(object, "cells"), *latex = json_object_get(json_object_get(object, "typeset"), "latex");

    if (!json_is_array(cells) || strcmp(kind, "columns") == 0)
        end_table(to);
    if (strcmp(kind, "figure") == 0 || strcmp(kind, "page") == 0)
        (void)json_array_append(to->figures, (json_t *)object);
    if (json_is_string(latex))
        (void)json_array_append(to->latex, latex);
    if (json_is_array(cells)) {
        if (json_array_size(to->rows) == 0)
            qdot_text_add(&to->html, "<table>\n");
        (void)json_array_append(to->rows, cells);
    } else if (strcmp(kind, "error") != 0 && text_in(object, "text")[0] != '\0') {
        qdot_text_format(&to->text, "%s\n", text_in(object, "text"));
    }
    qdot_text_add(&to->html, text_in(object, "html"));
}

/* Sort the objects of an answer, one a line. */
static void
sort_answers(const char *answers, sorted *to)
{
    while (answers != NULL && *answers != '\0') {
        const char *end = strchr(answers, '\n');
        json_t *object = json_loadb(answers, end != NULL ? (size_t)(end - answers) : strlen(answers), 0, NULL);

        sort_object(object, to);
        json_decref(object);
        answers = end != NULL ? end + 1 : NULL;
    }
    end_table(to);
}

int
qdot_task_run(void)
{
    qdot_system *system = NULL;
    qdot_text script = {0};
    char *answers = NULL;
    sorted to = {.figures = json_array(), .latex = json_array(), .rows = json_array()};
    qdot_result status;

    (void)signal(SIGINT, handle_interrupt);
    if (!qdot_text_add_stream(&script, stdin, MOST) || script.failed || qdot_system_new(&system) != QDOT_RESULT_OK)
        return 1;
    (void)qdot_system_progress(system, tell_progress, NULL);
    (void)qdot_system_source(system, "script");
    status = qdot_system_ask(system, qdot_text_str(&script), QDOT_NOTATION_DISPLAY, &answers);
    sort_answers(answers, &to);
    write_object(json_pack("{s:s, s:s, s:s, s:s, s:i, s:o, s:o}", "text", qdot_text_str(&to.text), "html", qdot_text_str(&to.html), "style",
                           qdot_display_style(), "error", qdot_system_error(system), "status", (int)status, "latex", to.latex, "figures",
                           to.figures));
    json_decref(to.rows);
    qdot_string_free(answers);
    qdot_system_free(system);
    qdot_text_clear(&script);
    qdot_text_clear(&to.text);
    qdot_text_clear(&to.html);
    return 0;
}
