/* plot-rows.c -- the rows of a sweep as a figure. */
#include "lang/figures/plot-rows.h"

#include <math.h>

#include "lang/figures/figure-file.h"
#include "lang/figures/figure-option.h"
#include "lang/session/row-tables.h"

bool
qdot_plot_rows_is(const qdot_cursor *c)
{
    const qdot_token *behind = c->at + 1;

    return c->at->kind == QDOT_TOKEN_NAME
           && (behind->kind == QDOT_TOKEN_END || qdot_figure_option_is(behind))
           && qdot_row_tables_find(c->session, c->at->text) != NULL;
}

/* The column that is the abscissa: what was swept; of points with several numbers the first of these,
 * so that they are a cloud, or a section. */
static size_t
abscissa(const qdot_row_table *t)
{
    return t->scattered && t->n - t->n_swept > 1 ? t->n_swept : 0;
}

/* The curves, of the rows that have numbers; x and y [columns x rows]; how many curves. */
static size_t
fill(const qdot_row_table *t, qdot_curve *curves, double *x, double *y)
{
    const size_t first = abscissa(t);
    size_t n = 0;

    for (size_t i = first < t->n_swept ? t->n_swept : first + 1; i < t->n; i++, n++) {
        double *const cx = x + n * t->rows, *const cy = y + n * t->rows;

        curves[n] = (qdot_curve){.label = {t->labels[i], true}, .x = cx, .y = cy};
        for (size_t k = 0; k < t->rows; k++) {
            const double *row = t->values + k * t->n;

            if (isnan(row[i]) || isnan(row[first]))
                continue;
            cx[curves[n].rows] = row[first];
            cy[curves[n].rows++] = row[i];
        }
    }
    return n;
}

/* Whether what was swept grows or falls from row to row: points that belong together. */
static bool
is_ordered(const qdot_row_table *t)
{
    bool up = true, down = true;

    for (size_t k = 1; k < t->rows; k++) {
        const double d = t->values[k * t->n] - t->values[(k - 1) * t->n];

        up = up && d > 0;
        down = down && d < 0;
    }
    return up || down;
}

qdot_status
qdot_plot_rows(qdot_cursor *c)
{
    const qdot_row_table *t = qdot_row_tables_find(c->session, c->at->text);
    qdot_figure_choice choice = {0};
    qdot_panel_choice of_panel = {0};
    qdot_curve *curves;
    double *x;
    qdot_panel panel = {.axis = {{t->labels[abscissa(t)], true}, {"", false}}};
    qdot_figure figure = {.panels = &panel, .n = 1};
    qdot_status status;

    c->at++;
    QDOT_TRY(qdot_figure_option_read(c, &choice, &of_panel));
    if (!qdot_cursor_is_end(c))
        return qdot_cursor_expected(c, QDOT_FIGURE_OPTIONS);
    if (t->n_swept > 1 && !t->scattered)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: a figure of what was swept over %zu names",
                         t->n_swept);
    curves = qdot_calloc(t->n, sizeof *curves);
    x = qdot_calloc(2 * t->n * t->rows + 1, sizeof *x);
    status = curves && x ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        panel.n = fill(t, curves, x, x + t->n * t->rows);
        panel.curves = curves;
        panel.points = t->scattered || !is_ordered(t);
        if (panel.n == 1)
            panel.axis[1] = curves[0].label;
        qdot_figure_option_apply(&of_panel, &panel);
        figure.width = choice.width;
        figure.height = choice.height;
        figure.keep = choice.keep;
        status = qdot_figure_file_show(c->session, &figure, choice.path);
    }
    qdot_free(curves);
    qdot_free(x);
    return status;
}
