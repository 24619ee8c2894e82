/* plot-rows.c -- the rows of a sweep as a figure. */
#include "lang/figures/plot-rows.h"

#include <math.h>

#include "lang/figures/figure-file.h"
#include "lang/figures/figure-option.h"
#include "lang/figures/plot-branches.h"
#include "lang/session/row-tables.h"

/* The branches that `plot` alone shows: those of the latest `continue` without a name. */
static qdot_row_table *
branches_alone(const qdot_cursor *c)
{
    return qdot_row_tables_find(c->session, "branches");
}

bool
qdot_plot_rows_is(const qdot_cursor *c)
{
    const qdot_token *behind = c->at + 1;

    if (qdot_cursor_is_end(c) || qdot_figure_option_is(c->at))
        return branches_alone(c) != NULL;
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

/* --- over two names ------------------------------------------------------------------- */

/* Whether axis k of what was swept has n values, evenly, the rows of each value of the first together;
 * its ends. */
static bool
is_even(const qdot_row_table *t, int k, size_t n, size_t fast, double *least, double *most)
{
    const size_t stride = k == 0 ? fast : 1;
    const double *v = t->values + k;

    *least = v[0];
    *most = v[(n - 1) * stride * t->n];
    for (size_t i = 0; i < t->rows; i++) {
        const double part = n > 1 ? (double)(i / stride % n) / ((double)n - 1) : 0;

        if (!(fabs(v[i * t->n] - (*least + part * (*most - *least)))
              <= 1e-9 * fabs(*most - *least)))
            return false;
    }
    return true;
}

/* A map for each number: maps and panels [columns], values [columns x rows]. */
static qdot_status
fill_maps(const qdot_row_table *t, qdot_figure_map *maps, qdot_panel *panels, double *values)
{
    size_t fast = 1, slow; /* values of the second name, of the first */
    double least[2], most[2];

    while (fast < t->rows && t->values[fast * t->n] == t->values[0])
        fast++;
    slow = t->rows / fast;
    if (slow * fast != t->rows)
        return qdot_fail(QDOT_EINVAL, "%s is interrupted: it has no rectangle of rows", t->name);
    if (!is_even(t, 0, slow, fast, &least[0], &most[0])
        || !is_even(t, 1, fast, fast, &least[1], &most[1]))
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: a figure over two names with uneven values");
    for (size_t j = 0; j < t->n - 2; j++) {
        qdot_figure_map *m = &maps[j];
        double *v = values + j * t->rows;

        *m = (qdot_figure_map){.label = {t->labels[2 + j], true}, .n = {slow, fast},
                               .least = {least[0], least[1]}, .most = {most[0], most[1]},
                               .value = v};
        for (size_t k = 0; k < t->rows; k++)
            v[k % fast * slow + k / fast] = t->values[k * t->n + 2 + j];
        panels[j].axis[0] = (qdot_figure_label){t->labels[0], true};
        panels[j].axis[1] = (qdot_figure_label){t->labels[1], true};
        panels[j].map = m;
    }
    return QDOT_OK;
}

/* --- the figure ----------------------------------------------------------------------- */

/* Panels [t->n] and what they need; *n of them. */
typedef struct {
    qdot_panel *panels;
    qdot_curve *curves;
    qdot_figure_map *maps;
    double *numbers;
    size_t n;
    qdot_branch_drawing branches; /* in place of all that */
} drawing;

static qdot_status
draw(const qdot_row_table *t, drawing *d)
{
    if (t->marks != NULL)
        return qdot_plot_branches_draw(t, &d->branches);
    d->panels = qdot_calloc(t->n, sizeof *d->panels);
    d->curves = qdot_calloc(t->n, sizeof *d->curves);
    d->maps = qdot_calloc(t->n, sizeof *d->maps);
    d->numbers = qdot_calloc(2 * t->n * t->rows + 1, sizeof *d->numbers);
    if (!d->panels || !d->curves || !d->maps || !d->numbers)
        return QDOT_ENOMEM;
    if (t->n_swept == 2 && !t->scattered && t->rows > 0) {
        d->n = t->n - 2;
        return fill_maps(t, d->maps, d->panels, d->numbers);
    }
    if (t->n_swept > 1 && !t->scattered)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: a figure of what was swept over %zu names",
                         t->n_swept);
    d->n = 1;
    d->panels[0] = (qdot_panel){.axis = {{t->labels[abscissa(t)], true}, {"", false}},
                                .curves = d->curves,
                                .points = t->scattered || t->measured || !is_ordered(t)};
    d->panels[0].n = fill(t, d->curves, d->numbers, d->numbers + t->n * t->rows);
    if (d->panels[0].n == 1)
        d->panels[0].axis[1] = d->curves[0].label;
    return QDOT_OK;
}

qdot_status
qdot_plot_rows(qdot_cursor *c)
{
    const bool alone = qdot_cursor_is_end(c) || qdot_figure_option_is(c->at);
    const qdot_row_table *t =
        alone ? branches_alone(c) : qdot_row_tables_find(c->session, c->at->text);
    qdot_figure_choice choice = {0};
    qdot_panel_choice of_panel = {0};
    drawing d = {0};
    qdot_status status;

    c->at += !alone;
    QDOT_TRY(qdot_figure_option_read(c, &choice, &of_panel));
    if (!qdot_cursor_is_end(c))
        return qdot_cursor_expected(c, QDOT_FIGURE_OPTIONS);
    status = draw(t, &d);
    if (status == QDOT_OK) {
        qdot_panel *const panels = t->marks != NULL ? d.branches.panels : d.panels;
        const qdot_figure figure = {.panels = panels,
                                    .n = t->marks != NULL ? d.branches.n : d.n,
                                    .width = choice.width,
                                    .height = choice.height,
                                    .keep = choice.keep};

        for (size_t i = 0; i < figure.n; i++)
            qdot_figure_option_apply(&of_panel, &panels[i]);
        status = qdot_figure_file_show(c->session, &figure, choice.path);
    }
    qdot_plot_branches_free(&d.branches);
    qdot_free(d.panels);
    qdot_free(d.curves);
    qdot_free(d.maps);
    qdot_free(d.numbers);
    return status;
}
