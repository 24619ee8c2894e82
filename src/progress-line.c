/* progress-line.c -- shows the progress of a long computation in one line: `run: t = 12.3 of 20, ...`. */
#include "progress-line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "base/terminal.h"
#include "base/text.h"

static size_t columns_shown;

/* Append a duration such as 42 s, 3 min or 5.1 h. */
static void
add_duration(qdot_text *line, double seconds)
{
    if (seconds < 100)
        qdot_text_format(line, "%.0f s", ceil(seconds));
    else if (seconds < 6000)
        qdot_text_format(line, "%.0f min", seconds / 60);
    else
        qdot_text_format(line, "%.1f h", seconds / 3600);
}

static void
clear_progress_line(void)
{
    fprintf(stderr, "\r%*s\r", (int)columns_shown, "");
    fflush(stderr);
    columns_shown = 0;
}

static void
show_progress_line(const qdot_progress *p)
{
    qdot_text line = {0};
    size_t columns, rows, n;

    qdot_text_format(&line, "%s: t = %.4g of %.4g", p->what, p->t, p->t1);
    if (p->speed > 0)
        qdot_text_format(&line, ", %.3g steps/s", p->speed);
    if (isfinite(p->left)) {
        qdot_text_add(&line, ", ");
        add_duration(&line, p->left);
        qdot_text_add(&line, " left");
    }
    if (qdot_text_status(&line) == QDOT_OK &&
        qdot_terminal_size(stderr, &columns, &rows)) {
        /* stop before the last column, after which some terminals begin the next line */
        n = line.n < columns ? line.n : columns - 1;
        fprintf(stderr, "\r%.*s", (int)n, line.at);
        if (columns_shown > n)
            fprintf(stderr, "%*s", (int)(columns_shown - n), "");
        fflush(stderr);
        columns_shown = n;
    }
    qdot_text_clear(&line);
}

void
qdot_progress_line_install(void)
{
    static qdot_progress progress = {.show = show_progress_line, .clear = clear_progress_line};

    qdot_progress_open = &progress;
}
