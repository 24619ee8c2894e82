/* plot-rows.c -- draws the rows of a sweep (runs with different parameter values) as curves or maps. */
#include "lang/figures/plot-rows.h"

#include <math.h>

#include "lang/figures/figure-file.h"
#include "lang/figures/figure-option.h"
#include "lang/figures/plot-branches.h"
#include "lang/session/row-tables.h"

/* FINE: the number of points on an axis with uneven steps; MOST_PANELS: the panels that fit in a figure. */
enum { FINE = 400, MOST_PANELS = 12 };

/* The table that the statement names; without a name the branches of the latest `continue`. NULL:
 * there is none. */
static const qdot_row_table *
find_row_table(const qdot_record *r)
{
    const qdot_filled *name = qdot_record_hole(r, NULL, "ROWS");

    return qdot_row_tables_find(r->cursor.session, name != NULL ? name->from->text : "branches");
}

bool
qdot_plot_rows_is(const qdot_record *r)
{
    return qdot_record_hole(r, NULL, "ROWS") != NULL || (qdot_record_hole(r, "plot", "EXPR") == NULL && qdot_record_word(r, "bode") == NULL &&
                                                         qdot_record_hole(r, "plot", "\"DATA\"") == NULL);
}

/* The column that is the abscissa: what was swept; of points with several numbers the first of these,
 * so that they are a cloud, or a section. */
static size_t
abscissa_column(const qdot_row_table *t)
{
    return t->scattered && t->n - t->n_swept > 1 ? t->n_swept : 0;
}

/* Make the curves of all columns; x and y [columns x rows] are filled with rows that have numbers;
 * returns the number of curves. */
static size_t
fill_curves(const qdot_row_table *t, qdot_curve *curves, double *x, double *y)
{
    const size_t first = abscissa_column(t);
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

/* Whether the swept parameter is monotonic from row to row, so that points can be joined by lines. */
static bool
rows_are_monotonic(const qdot_row_table *t)
{
    bool up = true, down = true;

    for (size_t k = 1; k < t->rows; k++) {
        const double d = t->values[k * t->n] - t->values[(k - 1) * t->n];

        up = up && d > 0;
        down = down && d < 0;
    }
    return up || down;
}

/* --- maps of sweeps over several names ------------------------------------------------ */

/* The values of one of the last two names; `shown` places even between their ends, and which value stands at each: that
 * nearest to it, so that a cell of an uneven axis ends halfway to the next. */
typedef struct {
    size_t column, stride, n; /* index of the table's column; rows between two successive values; number of values */
    size_t shown;
    double least, most;
    size_t *of; /* [shown] index of the value drawn at each grid place of the axis */
} axis;

/* The panels of a figure with the arrays that they use, of length n. */
typedef struct {
    qdot_panel *panels;
    qdot_curve *curves;
    qdot_figure_map *maps;
    double *numbers;
    qdot_text *titles; /* [n] title of each panel */
    axis axis[2];
    size_t n;
    qdot_branch_drawing branches; /* used for branches, in place of the members above */
} drawing;

static double
get_axis_value(const qdot_row_table *t, const axis *a, size_t i)
{
    return t->values[i * a->stride * t->n + a->column];
}

static bool
has_even_steps(const qdot_row_table *t, const axis *a)
{
    for (size_t i = 0; i < a->n && a->n > 1; i++) {
        const double even = a->least + (a->most - a->least) * (double)i / ((double)a->n - 1);

        if (!(fabs(get_axis_value(t, a, i) - even) <= 1e-9 * fabs(a->most - a->least)))
            return false;
    }
    return true;
}

/* Find the ends of an axis from values in any order; the axis descends if the values do. */
static void
find_axis_ends(const qdot_row_table *t, axis *a)
{
    const double first = get_axis_value(t, a, 0), last = get_axis_value(t, a, a->n - 1);

    a->least = a->most = first;
    for (size_t i = 1; i < a->n; i++) {
        a->least = fmin(a->least, get_axis_value(t, a, i));
        a->most = fmax(a->most, get_axis_value(t, a, i));
    }
    if (first > last) {
        const double least = a->least;

        a->least = a->most;
        a->most = least;
    }
}

static qdot_status
place_values_on_axis(const qdot_row_table *t, axis *a)
{
    bool even;

    find_axis_ends(t, a);
    even = has_even_steps(t, a);
    a->shown = even ? a->n : FINE;
    a->of = qdot_calloc(a->shown, sizeof *a->of);
    if (a->of == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < a->shown; k++) {
        const double x = a->least + (a->most - a->least) * (double)k / ((double)a->shown - 1);

        a->of[k] = even ? k : 0;
        for (size_t i = 1; i < a->n && !even; i++)
            if (fabs(get_axis_value(t, a, i) - x) < fabs(get_axis_value(t, a, a->of[k]) - x))
                a->of[k] = i;
    }
    return QDOT_OK;
}

/* Whether rows i and j have the same values of the first `count` swept parameters. */
static bool
have_rows_same_values(const qdot_row_table *t, size_t i, size_t j, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (t->values[i * t->n + k] != t->values[j * t->n + k])
            return false;
    return true;
}

/* Find the last two swept parameters as axes, and the number of rows for each set of values of the others. */
static qdot_status
find_axes(const qdot_row_table *t, axis *axes, size_t *rows)
{
    const size_t outer = t->n_swept - 2;
    size_t fast = 1;

    *rows = 1;
    while (*rows < t->rows && have_rows_same_values(t, *rows, 0, outer))
        ++*rows;
    while (fast < *rows && have_rows_same_values(t, fast, 0, outer + 1))
        fast++;
    if (*rows % fast != 0 || t->rows % *rows != 0)
        return qdot_fail(QDOT_EINVAL, "%s has no rectangle of rows: it is interrupted, or a value occurs twice", t->name);
    axes[0] = (axis){.column = outer, .stride = fast, .n = *rows / fast};
    axes[1] = (axis){.column = outer + 1, .stride = 1, .n = fast};
    QDOT_TRY(place_values_on_axis(t, &axes[0]));
    return place_values_on_axis(t, &axes[1]);
}

/* Write a title such as "k = 1, m = 2": the values of the swept parameters before the last two. */
static qdot_status
write_title(const qdot_row_table *t, size_t row, qdot_text *out)
{
    for (size_t k = 0; k + 2 < t->n_swept; k++)
        qdot_text_format(out, "%s%s = %.6g", k > 0 ? ", " : "", t->labels[k], t->values[row * t->n + k]);
    return qdot_text_status(out);
}

/* Make a map (a picture of values over two parameters) of quantity j from the rows that begin at `row`. */
static void
fill_map(const qdot_row_table *t, const axis *axes, size_t row, size_t j, qdot_figure_map *m, double *v)
{
    const size_t wide = axes[0].shown, high = axes[1].shown;

    *m = (qdot_figure_map){.label = {t->labels[t->n_swept + j], true}, .n = {wide, high},
                           .least = {axes[0].least, axes[1].least}, .most = {axes[0].most, axes[1].most},
                           .value = v};
    for (size_t y = 0; y < high; y++)
        for (size_t x = 0; x < wide; x++)
            v[y * wide + x] = t->values[(row + axes[0].of[x] * axes[0].stride + axes[1].of[y]) * t->n +
                                        t->n_swept + j];
}

/* Draw a map for each quantity, and for each set of values of the swept parameters before the last two. */
static qdot_status
draw_maps(const qdot_row_table *t, drawing *d)
{
    const size_t numbers = t->n - t->n_swept;
    size_t rows, cells;

    QDOT_TRY(find_axes(t, d->axis, &rows));
    if (t->rows / rows * numbers > MOST_PANELS) {
        (void)qdot_fail(QDOT_EINVAL, "a figure of %zu panels, one for each value of %s and each number: at most %d",
                        t->rows / rows * numbers, t->labels[0], MOST_PANELS);
        return qdot_hint("sweep %.40s over fewer values", t->labels[0]);
    }
    cells = d->axis[0].shown * d->axis[1].shown;
    d->n = t->rows / rows * numbers;
    d->panels = qdot_calloc(d->n, sizeof *d->panels);
    d->maps = qdot_calloc(d->n, sizeof *d->maps);
    d->titles = qdot_calloc(d->n, sizeof *d->titles);
    d->numbers = qdot_calloc(d->n * cells, sizeof *d->numbers);
    if (!d->panels || !d->maps || !d->titles || !d->numbers)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < d->n; k++) {
        const size_t row = k / numbers * rows;

        fill_map(t, d->axis, row, k % numbers, &d->maps[k], d->numbers + k * cells);
        QDOT_TRY(write_title(t, row, &d->titles[k]));
        if (t->n_swept > 2)
            d->panels[k].title = (qdot_figure_label){qdot_text_str(&d->titles[k]), true};
        d->panels[k].axis[0] = (qdot_figure_label){t->labels[d->axis[0].column], true};
        d->panels[k].axis[1] = (qdot_figure_label){t->labels[d->axis[1].column], true};
        d->panels[k].map = &d->maps[k];
    }
    return QDOT_OK;
}

/* --- drawing the figure --------------------------------------------------------------- */

static qdot_status
draw_rows(const qdot_row_table *t, drawing *d)
{
    if (t->marks != NULL)
        return qdot_plot_branches_draw(t, &d->branches);
    if (t->n_swept > 1 && !t->scattered && t->rows > 0)
        return draw_maps(t, d);
    d->panels = qdot_calloc(1, sizeof *d->panels);
    d->curves = qdot_calloc(t->n, sizeof *d->curves);
    d->numbers = qdot_calloc(2 * t->n * t->rows + 1, sizeof *d->numbers);
    if (!d->panels || !d->curves || !d->numbers)
        return QDOT_ENOMEM;
    d->n = 1;
    d->panels[0] = (qdot_panel){.axis = {{t->labels[abscissa_column(t)], true}, {"", false}},
                                .curves = d->curves,
                                .points = t->scattered || t->measured || !rows_are_monotonic(t)};
    d->panels[0].n = fill_curves(t, d->curves, d->numbers, d->numbers + t->n * t->rows);
    if (d->panels[0].n == 1)
        d->panels[0].axis[1] = d->curves[0].label;
    return QDOT_OK;
}

static void
free_drawing(drawing *d)
{
    qdot_plot_branches_free(&d->branches);
    for (size_t k = 0; k < d->n && d->titles != NULL; k++)
        qdot_text_clear(&d->titles[k]);
    for (size_t k = 0; k < 2; k++)
        qdot_free(d->axis[k].of);
    qdot_free(d->titles);
    qdot_free(d->panels);
    qdot_free(d->curves);
    qdot_free(d->maps);
    qdot_free(d->numbers);
}

/* Refuse what the figure of a table of rows cannot have: a loop, several panels. */
static qdot_status
check_is_single_panel(qdot_record *r)
{
    for (const qdot_filled *part = r->parts.at; part < r->parts.at + r->parts.n; part++)
        if (qdot_filled_is(part, "for") || qdot_filled_is(part, "|")) {
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_EINVAL, "the figure of a table stands alone, without `%s`", part->node->text);
        }
    return QDOT_OK;
}

qdot_status
qdot_plot_rows(qdot_record *r)
{
    const qdot_row_table *t = find_row_table(r);
    qdot_figure_choice choice = {0};
    qdot_panel_choice of_panel = {0};
    drawing d = {0};
    qdot_status status;

    if (t == NULL && r->parts.n == 1)
        return qdot_record_expected(r, r->start, "an expression");
    if (t == NULL) {
        r->cursor.error_at = r->start->start;
        return qdot_fail(QDOT_ESYNTAX, "expected an expression before `%s`", r->start->text);
    }
    QDOT_TRY(check_is_single_panel(r));
    QDOT_TRY(qdot_figure_option_find(r, r->parts.at, r->parts.at + r->parts.n, &choice, &of_panel));
    status = draw_rows(t, &d);
    if (status == QDOT_OK) {
        qdot_panel *const panels = t->marks != NULL ? d.branches.panels : d.panels;
        const qdot_figure figure = {.panels = panels,
                                    .n = t->marks != NULL ? d.branches.n : d.n,
                                    .width = choice.width,
                                    .height = choice.height,
                                    .keep = choice.keep};

        for (size_t i = 0; i < figure.n && status == QDOT_OK; i++)
            status = qdot_figure_option_apply(r, &of_panel, &panels[i]);
        if (status == QDOT_OK)
            status = qdot_figure_file_show(r->cursor.session, &figure, choice.path);
    }
    free_drawing(&d);
    return status;
}
