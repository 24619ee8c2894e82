/* figure-layout.c -- chooses the ranges of axes, and the sizes of a figure. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "show/figure-parts.h"

/* Sizes in cm; the usual figure is 14 cm wide: legible when reduced to a column of 8.6 cm. */
static const double usual_width = 14, usual_height = 8.75, panel_height = 5.2,
                    left_room = 1.8, right_room = 0.5, high_room = 0.9, low_room = 1.3;

enum { BLOCK = 4096 };

/* --- ranges of the data --------------------------------------------------------------- */

bool
qdot_figure_shows(const qdot_panel *panel, const qdot_curve *curve, size_t k)
{
    double x = curve->x[k], y = curve->y[k];

    return isfinite(x) && isfinite(y) && (!panel->log[0] || x > 0) &&
           (!panel->log[1] || y > 0) && (curve->z == NULL || isfinite(curve->z[k]));
}

bool
qdot_figure_is_space(const qdot_panel *panel)
{
    return panel->n > 0 && panel->curves[0].z != NULL;
}

typedef struct {
    double least[3], most[3];
    size_t points;
    bool course; /* x is monotonic along every curve, as in a graph of a function */
} extent;

static void
widen_extent(extent *e, int axis, double value)
{
    e->least[axis] = e->points == 0 ? value : fmin(e->least[axis], value);
    e->most[axis] = e->points == 0 ? value : fmax(e->most[axis], value);
}

static bool
range_contains(const qdot_figure_range *range, double value)
{
    return !range->set || (value >= range->least && value <= range->most);
}

/* Points beyond the range of one axis say nothing of the other; but a course is shown over all of its
 * abscissa. */
static qdot_status
measure_panel(const qdot_panel *panel, extent *e)
{
    double from = INFINITY, to = -INFINITY; /* least and greatest x of the points at which y is finite */

    *e = (extent){.course = true};
    if (panel->map != NULL) {
        for (int k = 0; k < 2; k++)
            qdot_figure_map_edges(panel->map, k, &e->least[k], &e->most[k]);
        return QDOT_OK;
    }
    for (size_t i = 0; i < panel->n; i++) {
        const qdot_curve *c = &panel->curves[i];
        bool up = true, down = true;

        for (size_t k = 0; k < c->rows; k++) {
            if (k % BLOCK == BLOCK - 1)
                QDOT_TRY(qdot_interrupt_check());
            up = up && (k == 0 || !(c->x[k] < c->x[k - 1]));
            down = down && (k == 0 || !(c->x[k] > c->x[k - 1]));
            if (!qdot_figure_shows(panel, c, k) || !range_contains(&panel->range[0], c->x[k]))
                continue;
            from = fmin(from, c->x[k]);
            to = fmax(to, c->x[k]);
            if (!range_contains(&panel->range[1], c->y[k]) || (!panel->log[1] && !range_contains(&c->shown, c->y[k])))
                continue;
            widen_extent(e, 0, c->x[k]);
            widen_extent(e, 1, c->y[k]);
            if (c->z != NULL)
                widen_extent(e, 2, c->z[k]);
            e->points++;
        }
        e->course = e->course && (up || down);
    }
    if (e->course && e->points > 0) {
        e->least[0] = from;
        e->most[0] = to;
    }
    if (e->points == 0)
        return qdot_fail(QDOT_EDOMAIN, "no point of the plot is finite%s%s",
                         panel->log[0] || panel->log[1] ? " and positive" : "",
                         panel->range[0].set || panel->range[1].set ? " and in its range"
                                                                    : "");
    return QDOT_OK;
}

/* Add some margin to a range. */
static void
widen_range(double *least, double *most, bool log, double part)
{
    if (log) {
        double factor = *most > *least ? pow(*most / *least, part) : 2;

        *least /= factor;
        *most *= factor;
    } else if (*most > *least) {
        double more = part * (*most - *least);

        if (isfinite(more)) {
            *least -= more;
            *most += more;
        }
    } else {
        double more = fmax(0.1 * fabs(*least), *least == 0 ? 1 : 0);

        *least -= more;
        *most += more;
    }
}

/* Paths have one scale: an axis along which little moves is as wide as a part of the widest, so that
 * it has room for its tics. */
static void
limit_aspect_ratio(qdot_figure_view *view, const bool *fixed, int axes)
{
    const double part = axes == 2 ? 1.0 / 4 : 1.0 / 10;
    double span = 0;

    for (int i = 0; i < axes; i++)
        span = fmax(span, view->most[i] - view->least[i]);
    for (int i = 0; i < axes; i++)
        if (!fixed[i] && view->most[i] - view->least[i] < part * span) {
            double middle = view->least[i] + (view->most[i] - view->least[i]) / 2;

            view->least[i] = middle - part * span / 2;
            view->most[i] = middle + part * span / 2;
        }
}

/* gnuplot makes the longer of x and y as wide as a part of what its margins leave of the lesser of
 * width and height, and z follows however long it is. So the whole is scaled until the box, as it is
 * seen, leaves room for numbers and labels around it, of so many letters. */
void
qdot_figure_see_box(const double *side, const qdot_figure_room *room, double *zoom,
                    double *seen)
{
    const double degree = acos(-1) / 180, c = cos(QDOT_FIGURE_TURN * degree),
                 s = sin(QDOT_FIGURE_TURN * degree), flat = cos(QDOT_FIGURE_TILT * degree),
                 high = sin(QDOT_FIGURE_TILT * degree);
    const double part = 4.0 / 7, margins = 6.7, above = 6;
    const double name = (double)qdot_figure_label_width(&room->panel->axis[1]);
    const double beside = 12 + 1.1 * fmax(name - 2, 0); /* space for an axis label at both the left and the right of the box */
    const double letter = room->points / 28.35;
    const double longest = fmax(side[0], side[1]);
    const double wide = (c * side[0] + s * side[1]) / longest;
    const double tall = ((s * side[0] + c * side[1]) * flat + side[2] * high) / longest;
    const double least = fmin(room->width, room->height);
    const double unit = part * fmax(least - margins * letter, least / 4);
    const double box =
        fmin(fmax(room->width - beside * letter, room->width / 3) / wide,
             fmax(room->height - above * letter, room->height / 3) / tall);

    *zoom = box / unit;
    seen[0] = box * side[0] / longest * hypot(c, s * flat);
    seen[1] = box * side[1] / longest * hypot(s, c * flat);
    seen[2] = box * side[2] / longest * high;
}

/* --- panels with a common horizontal axis --------------------------------------------- */

static bool
is_same_text(const char *a, const char *b)
{
    return strcmp(a != NULL ? a : "", b != NULL ? b : "") == 0;
}

static bool
is_same_range(const qdot_figure_range *a, const qdot_figure_range *b)
{
    return a->set == b->set && (!a->set || (a->least == b->least && a->most == b->most));
}

bool
qdot_figure_is_shared(const qdot_figure *figure, size_t i)
{
    const qdot_panel *p = &figure->panels[i], *q = p + 1;

    return i + 1 < figure->n && !p->equal && !q->equal && !qdot_figure_is_space(p) &&
           !qdot_figure_is_space(q) && p->log[0] == q->log[0] && p->pi[0] == q->pi[0] &&
           is_same_text(p->axis[0].text, q->axis[0].text) &&
           is_same_range(&p->range[0], &q->range[0]);
}

/* Find the extent of panel i; its horizontal axis covers all panels that share it. */
static qdot_status
measure_panel_with_shared_axis(const qdot_figure *figure, size_t i, extent *e)
{
    size_t first = i, last = i;

    QDOT_TRY(measure_panel(&figure->panels[i], e));
    while (first > 0 && qdot_figure_is_shared(figure, first - 1))
        first--;
    while (qdot_figure_is_shared(figure, last))
        last++;
    for (size_t k = first; k <= last; k++) {
        extent other;

        if (k == i)
            continue;
        QDOT_TRY(measure_panel(&figure->panels[k], &other));
        e->least[0] = fmin(e->least[0], other.least[0]);
        e->most[0] = fmax(e->most[0], other.most[0]);
        e->course = e->course && other.course;
    }
    return QDOT_OK;
}

/* --- sizes of a figure ---------------------------------------------------------------- */

static qdot_status
find_view_without_lengths(const qdot_figure *figure, size_t i, qdot_figure_view *view)
{
    const qdot_panel *panel = &figure->panels[i];
    const int axes = qdot_figure_is_space(panel) ? 3 : 2;
    bool fixed[3] = {panel->range[0].set, panel->range[1].set, false};
    const bool joined = !panel->marks && !panel->points;
    extent e;

    *view = (qdot_figure_view){.log = {panel->log[0], panel->log[1]}, .pi = {panel->pi[0], panel->pi[1]},
                               .degrees = panel->degrees};
    for (int k = 0; k < 2; k++)
        if (fixed[k] && panel->log[k] && !(panel->range[k].least > 0))
            return qdot_fail(QDOT_EINVAL, "a logarithmic axis begins above 0, not at %.6g",
                             panel->range[k].least);
    QDOT_TRY(measure_panel_with_shared_axis(figure, i, &e));
    for (int k = 0; k < axes; k++) {
        view->least[k] = fixed[k] ? panel->range[k].least : e.least[k];
        view->most[k] = fixed[k] ? panel->range[k].most : e.most[k];
        if (!fixed[k] && panel->map == NULL && (k > 0 || !e.course || !joined || !(e.most[0] > e.least[0])))
            widen_range(&view->least[k], &view->most[k], view->log[k], 0.04);
    }
    if (panel->equal)
        limit_aspect_ratio(view, fixed, axes);
    return QDOT_OK;
}

/* How high a figure of one panel of paths is: as their shape asks for, with a line for a title and
 * one for a key. */
static double
height_of_equal_scale_panel(const qdot_panel *panel, const qdot_figure_view *view, double width,
                            double points)
{
    const double line = 1.4 * points / 28.35;
    const bool titled = panel->title.text != NULL && panel->title.text[0] != '\0';
    double x = view->most[0] - view->least[0], y = view->most[1] - view->least[1];
    double height = (width - left_room - right_room) * y / x + high_room + low_room +
                    line * (titled + (panel->n > 1));

    return isfinite(height) ? fmin(fmax(height, 0.4 * width), width) : width;
}

qdot_status
qdot_figure_size(const qdot_figure *figure, double *width, double *height, double *points)
{
    const qdot_panel *first = &figure->panels[0];

    *width = figure->width > 0 ? figure->width : usual_width;
    *points = fmin(fmax(0.8 * *width, 8), 14);
    if (figure->height > 0) {
        *height = figure->height;
        return QDOT_OK;
    }
    *height = *width * usual_height / usual_width;
    if (figure->n > 1) {
        *height = *width * ((double)figure->n * panel_height + low_room) / usual_width;
    } else if (qdot_figure_is_space(first)) {
        *height = 0.85 * *width;
    } else if (first->equal) {
        qdot_figure_view view;

        QDOT_TRY(find_view_without_lengths(figure, 0, &view));
        *height = height_of_equal_scale_panel(first, &view, *width, *points);
    }
    return QDOT_OK;
}

qdot_status
qdot_figure_get_view(const qdot_figure *figure, size_t i, qdot_figure_view *view)
{
    const qdot_panel *panel = &figure->panels[i];
    double width, height, points, scale = INFINITY;

    QDOT_TRY(find_view_without_lengths(figure, i, view));
    QDOT_TRY(qdot_figure_size(figure, &width, &height, &points));
    view->length[0] = fmax(width - left_room - right_room, width / 2);
    view->length[1] = fmax(height / (double)figure->n - high_room - low_room,
                           height / (double)figure->n / 2);
    view->length[2] = 0;
    if (!panel->equal)
        return QDOT_OK;
    if (qdot_figure_is_space(panel)) {
        double side[3], zoom;

        for (int k = 0; k < 3; k++)
            side[k] = view->most[k] - view->least[k];
        qdot_figure_see_box(
            side,
            &(qdot_figure_room){width, height / (double)figure->n, points, panel}, &zoom,
            view->length);
        return QDOT_OK;
    }
    for (int k = 0; k < 2; k++)
        scale = fmin(scale, view->length[k] / (view->most[k] - view->least[k]));
    for (int k = 0; k < 2; k++)
        view->length[k] = scale * (view->most[k] - view->least[k]);
    return QDOT_OK;
}
