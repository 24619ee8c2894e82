/* figure-place.c -- where the parts of a figure stand: how many tics an axis has room for, the legend, the panels. */
#include <math.h>
#include <string.h>

#include "show/figure-parts.h"

/* --- tics that have room ------------------------------------------------------------------ */

/* The number of characters of the widest number along an axis. */
static size_t
widest_number(const qdot_figure_axis *a)
{
    qdot_text unused = {0};
    size_t width = 0;

    qdot_figure_add_axis(&unused, 'x', a, false, &width);
    qdot_text_clear(&unused);
    return width;
}

/* Between two tics of axis k, in cm, so that their numbers do not touch: more beside each other than one
 * above the other. */
static double
space_for_tic(const qdot_figure_drawing *d, const qdot_figure_view *v, int k,
              const qdot_figure_axis *a)
{
    const double letter = d->points / 28.35;

    if (v->length[2] > 0) /* the axes lie along the edges of a box, drawn in perspective */
        return (k == 2 ? 1.8 : 2.2) * letter;
    return (k == 1 ? 1.4 : 0.6 + 0.64 * (double)widest_number(a)) * letter;
}

/* Axis k of a panel with about `steps` tics; more where these are fewer than three and there is room,
 * fewer where their numbers would touch. */
static qdot_figure_axis
choose_axis(const qdot_figure_drawing *d, const qdot_figure_view *v, int k, double steps,
            const int *power)
{
    const double length = v->length[k];
    const qdot_figure_tics tics = v->log[k]              ? QDOT_TICS_LOG
                                  : v->pi[k]             ? QDOT_TICS_PI
                                  : k == 1 && v->degrees ? QDOT_TICS_DEGREES
                                                         : QDOT_TICS_DECIMAL;
    qdot_figure_axis a = qdot_figure_axis_of(v->least[k], v->most[k], tics, steps, power);

    while (a.step > 0 && qdot_figure_count_tics(&a) < 3 &&
           length > (steps + 1) * space_for_tic(d, v, k, &a))
        a = qdot_figure_axis_of(v->least[k], v->most[k], tics, ++steps, power);
    while (a.step > 0 && steps > 1 &&
           length * a.step < space_for_tic(d, v, k, &a) * (a.most - a.least)) {
        steps = fmax(steps - 1, 1);
        a = qdot_figure_axis_of(v->least[k], v->most[k], tics, steps, power);
    }
    return a;
}

qdot_status
qdot_figure_choose_axes(const qdot_figure_drawing *d, size_t i, qdot_figure_axis *axes)
{
    static const double apart[] = {1.9, 1.2, 1.2};
    const qdot_panel *panel = &d->figure->panels[i];
    const bool space = qdot_figure_is_space(panel);
    qdot_figure_view v;
    double of_path; /* distance of tics in cm, common to both axes of a panel with equal scales */
    int power = 0;

    QDOT_TRY(qdot_figure_get_view(d->figure, i, &v));
    of_path = space ? 1.5 : fmin(fmax(fmin(v.length[0], v.length[1]) / 2.4, 1.5), 2);
    for (int k = 0; k < 3; k++) {
        int own = qdot_figure_power(v.least[k], v.most[k]);

        if (v.most[k] > v.least[k] && (k == 0 || power == 0 || own > power))
            power = own;
    }
    for (int k = 0; k < 3; k++) {
        double steps = panel->equal ? v.length[k] / of_path
                                    : fmin(fmax(v.length[k] / apart[k], 2), 12);

        axes[k] = choose_axis(d, &v, k, steps, panel->equal ? &power : NULL);
    }
    return QDOT_OK;
}

/* --- the legend --------------------------------------------------------------------------- */

size_t
qdot_figure_legend_width(const qdot_panel *panel)
{
    size_t most = 0;

    for (size_t i = 0; i < panel->n; i++) {
        const qdot_figure_label label = qdot_figure_curve_label(panel, i);
        const size_t width = qdot_figure_label_width(&label);

        most = width > most ? width : most;
    }
    return most + 7;
}

size_t
qdot_figure_legend_rows(const qdot_figure_drawing *d, const qdot_panel *panel)
{
    const double letter = 0.5 * d->points / 28.35;
    const double columns = floor((d->width - 2.5) / letter / (double)qdot_figure_legend_width(panel));

    return panel->n < 2 ? 0 : (size_t)ceil((double)panel->n / fmax(columns, 1));
}

/* Beside the axes there are many short entries, of the only panel. */
bool
qdot_figure_has_legend_beside(const qdot_figure_drawing *d, const qdot_panel *panel)
{
    return d->figure->n == 1 && qdot_figure_legend_rows(d, panel) > 2 &&
           0.5 * d->points / 28.35 * (double)qdot_figure_legend_width(panel) < 0.3 * d->width;
}

double
qdot_figure_legend_spacing(const qdot_figure_drawing *d, const qdot_panel *panel)
{
    const double line = 1.5 * d->points / 28.35, around = 3.6; /* gnuplot's line height and the legend's margins in cm */

    return fmax(0.5, fmin(1, (d->height - around) / (line * (double)panel->n)));
}

/* --- the panels --------------------------------------------------------------------------- */

/* Find the space needed above and below the axes of panel i, in cm. */
static void
space_above_and_below(const qdot_figure_drawing *d, size_t i, double *above, double *below)
{
    const qdot_panel *panel = &d->figure->panels[i];
    const double line = (d->kind != NULL ? d->kind->lead : 1.4) * d->points / 28.35;
    const bool titled = panel->title.text != NULL && panel->title.text[0] != '\0';

    *above = line * (0.5 + 1.2 * titled + (panel->note != NULL) +
                     (qdot_figure_has_legend_beside(d, panel) ? 0 : (double)qdot_figure_legend_rows(d, panel)));
    if (qdot_figure_legend_rows(d, panel) == 0 && panel->axis[1].text != NULL) /* space for a power of ten above the axis */
        *above += line * 0.8;
    *below = line * (qdot_figure_is_shared(d->figure, i) ? 0.5 : 2.9);
}

/* Whether a label and its unit contain a superscript, which would be cut off at the edge of the figure. */
static bool
has_superscript(const qdot_figure_label *label, const char *unit)
{
    qdot_text markup = {0};
    bool found;

    qdot_figure_add_markup(&markup, label);
    qdot_figure_add_unit_markup(&markup, unit);
    found = strchr(qdot_text_str(&markup), '^') != NULL;
    qdot_text_clear(&markup);
    return found;
}

/* The space right of the axes in characters: for half of the last number, the legend or the colour scale. */
static double
space_right_of_axes(const qdot_figure_drawing *d, const qdot_panel *panel)
{
    if (panel->map != NULL)
        return 11;
    return qdot_figure_has_legend_beside(d, panel) ? 1 + 0.62 * (double)qdot_figure_legend_width(panel) : 1;
}

/* Find the space left of the axes in characters, for numbers, tics and label; the same for all panels. */
static qdot_status
space_left_of_axes(const qdot_figure_drawing *d, double *letters)
{
    *letters = 0;
    for (size_t i = 0; i < d->figure->n; i++) {
        qdot_figure_axis axes[3];

        QDOT_TRY(qdot_figure_choose_axes(d, i, axes));
        *letters = fmax(*letters, 3.2 + 0.72 * (double)widest_number(&axes[1]) +
                                      (has_superscript(&d->figure->panels[i].axis[1], d->figure->panels[i].unit[1]) ? 0.6 : 0));
    }
    return QDOT_OK;
}

qdot_status
qdot_figure_place_panel(const qdot_figure_drawing *d, size_t i, qdot_figure_place *at)
{
    const qdot_figure *f = d->figure;
    double free = d->height, top = d->height, above, below, left;
    const double letter = d->points / 28.35;

    for (size_t k = 0; k < f->n; k++) {
        space_above_and_below(d, k, &above, &below);
        free -= above + below;
    }
    free = fmax(free / (double)f->n, 0.1);
    for (size_t k = 0; k <= i; k++) {
        space_above_and_below(d, k, &above, &below);
        top -= above + (k > 0 ? free : 0);
        if (k < i)
            top -= below;
    }
    QDOT_TRY(space_left_of_axes(d, &left));
    *at = (qdot_figure_place){.left = fmin(left * letter, 0.4 * d->width),
                              .right = d->width - space_right_of_axes(d, &f->panels[i]) * letter,
                              .top = top, .bottom = top - free, .high = top + above, .low = top - free - below};
    return QDOT_OK;
}
