/* plot-branches.c -- draws branches of solutions as curves, styled by stability, with marks at bifurcations. */
#include "lang/figures/plot-branches.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Line styles of branches; the order is that of the list of looks in figure.h. */
enum { FULL, DASHED, DOTTED, KINDS, MOST_PANELS = 6, MOST_TYPES = 8 };

static bool
is_bifurcation(const qdot_row_table *t, size_t k)
{
    return !isnan(t->values[k * t->n + t->n - 1]);
}

/* The line style between rows k and k + 1 of one branch; at a bifurcation stability is undecided,
 * so the other row counts. */
static int
line_style_of_row(const qdot_row_table *t, size_t k)
{
    const double stable = t->values[(is_bifurcation(t, k) ? k + 1 : k) * t->n + t->n - 2];

    return isnan(stable) ? DOTTED : stable > 0 ? FULL : DASHED;
}

static void
add_point(qdot_curve *c, double *x, double *y, double px, double py)
{
    x[c->rows] = px;
    y[c->rows++] = py;
}

/* Collect the segments of one line style, with gaps between them; column i gives the ordinate. */
static void
fill_curve_of_style(const qdot_row_table *t, size_t i, int kind, qdot_curve *c, double *x, double *y)
{
    bool open = false;

    for (size_t k = 0; k + 1 < t->rows; k++) {
        const double *row = t->values + k * t->n;

        if (row[0] != row[t->n] || line_style_of_row(t, k) != kind) {
            if (open)
                add_point(c, x, y, NAN, NAN);
            open = false;
            continue;
        }
        if (!open)
            add_point(c, x, y, row[1], row[i]);
        add_point(c, x, y, row[t->n + 1], row[t->n + i]);
        open = true;
    }
}

/* Find the types of the bifurcations, such as a fold, each once. */
static size_t
find_types(const qdot_row_table *marks, const char **types)
{
    size_t n = 0;

    for (size_t k = 0; k < marks->rows; k++) {
        size_t i = 0;

        while (i < n && strcmp(types[i], marks->reasons[k]) != 0)
            i++;
        if (i == n && n < MOST_TYPES)
            types[n++] = marks->reasons[k];
    }
    return n;
}

static void
fill_curve_of_marks(const qdot_row_table *t, size_t i, const char *type, qdot_curve *c, double *x, double *y)
{
    for (size_t k = 0; k < t->rows; k++) {
        const double *row = t->values + k * t->n;

        if (!is_bifurcation(t, k) || strcmp(t->marks->reasons[(size_t)row[t->n - 1] - 1], type) != 0)
            continue;
        add_point(c, x, y, row[1], row[i]);
    }
}

static void
fill_panel(const qdot_row_table *t, size_t i, qdot_panel *p, qdot_curve *curves, double *numbers)
{
    static const char *const names[KINDS] = {"stable", "unstable", "undecided"};
    const char *types[MOST_TYPES];
    const size_t n_types = find_types(t->marks, types), room = 3 * t->rows + 1;

    *p = (qdot_panel){.axis = {{t->labels[1], true}, {t->labels[i], true}}, .curves = curves};
    for (size_t k = 0; k < KINDS + n_types; k++) {
        qdot_curve *const c = &curves[p->n];
        double *const x = numbers + 2 * p->n * room, *const y = x + room;

        *c = (qdot_curve){.label = {k < KINDS ? names[k] : types[k - KINDS], false},
                          .x = x, .y = y, .look = k + 1, .points = k >= KINDS};
        if (k < KINDS)
            fill_curve_of_style(t, i, (int)k, c, x, y);
        else
            fill_curve_of_marks(t, i, types[k - KINDS], c, x, y);
        p->n += c->rows > 0;
    }
}

qdot_status
qdot_plot_branches_draw(const qdot_row_table *t, qdot_branch_drawing *d)
{
    const size_t per = KINDS + MOST_TYPES, room = 2 * per * (3 * t->rows + 1);
    const size_t all = t->drawn; /* number of columns drawn, those after branch number and parameter */

    d->n = all < MOST_PANELS ? all : MOST_PANELS;
    d->panels = qdot_calloc(d->n + 1, sizeof *d->panels);
    d->curves = qdot_calloc(d->n * per + 1, sizeof *d->curves);
    d->numbers = qdot_calloc(d->n * room + 1, sizeof *d->numbers);
    if (!d->panels || !d->curves || !d->numbers)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < d->n; i++)
        fill_panel(t, 2 + i, &d->panels[i], d->curves + i * per, d->numbers + i * room);
    return QDOT_OK;
}

void
qdot_plot_branches_free(qdot_branch_drawing *d)
{
    qdot_free(d->panels);
    qdot_free(d->curves);
    qdot_free(d->numbers);
    *d = (qdot_branch_drawing){0};
}
