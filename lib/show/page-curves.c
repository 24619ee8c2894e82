/* page-curves.c -- draws curves on a page as SVG. */
#include "show/page-curves.h"

#include <math.h>
#include <string.h>

#include "show/animation.h"

/* Sizes of a picture's parts, in units in which the picture is WIDE wide. */
enum {
    WIDE = 640,
    LOW = 170, /* height of a plot of one quantity over time */
    TALL = 330,
    LEFT = 64,
    RIGHT = 18,
    TOP = 10,
    BOTTOM = 26,
    KEY = 22, /* height of a row of the legend */
    POINTS = 1500,
    LOOKS = 8, /* number of different colours, dashes and marks */
};

/* The ranges of the axes, and where they are drawn in the picture; y points upwards. */
typedef struct {
    double x0, x1, y0, y1;
    int bottom;
} frame;

static double
to_picture_x(const frame *f, double x)
{
    return LEFT + (x - f->x0) / (f->x1 - f->x0) * (WIDE - LEFT - RIGHT);
}

static double
to_picture_y(const frame *f, double y)
{
    return f->bottom - (y - f->y0) / (f->y1 - f->y0) * (f->bottom - TOP);
}

/* --- parts of a figure -------------------------------------------------------------- */

static void
svg_begin(qdot_text *out, int height, const char *caption, const char *behind)
{
    qdot_text_format(out,
                     "<figure>\n<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"",
                     WIDE, height);
    qdot_animation_escape(out, caption);
    qdot_text_format(out, "%s\">", behind);
}

static void
svg_end(qdot_text *out, const char *caption, const char *behind)
{
    qdot_text_add(out, "</svg>\n<figcaption>");
    qdot_animation_escape(out, caption);
    qdot_text_format(out, "%s</figcaption>\n</figure>\n", behind);
}

/* Write a vertical grid line at x, and begin the text of its number. */
static void
begin_vertical_grid_line(qdot_text *out, const frame *f, double x)
{
    qdot_text_format(out,
                     "<path class=\"grid\" d=\"M%.1f %d V%d\"/><text x=\"%.1f\" y=\"%d\" "
                     "text-anchor=\"middle\">",
                     to_picture_x(f, x), TOP, f->bottom, to_picture_x(f, x), f->bottom + 17);
}

static void
begin_horizontal_grid_line(qdot_text *out, const frame *f, double y)
{
    qdot_text_format(out,
                     "<path class=\"grid\" d=\"M%d %.1f H%d\"/><text x=\"%d\" y=\"%.1f\" "
                     "text-anchor=\"end\">",
                     LEFT, to_picture_y(f, y), WIDE - RIGHT, LEFT - 6, to_picture_y(f, y) + 4);
}

/* Draw mark number i at (x, y): five filled shapes, then the same ones hollow. */
static void
add_mark(qdot_text *out, size_t i, double x, double y)
{
    static const char *const shapes[] = {"m3 0a3 3 0 1 0 -6 0a3 3 0 1 0 6 0z",
                                         "m-3 -3h6v6h-6z", "m0 -4l4 7h-8z",
                                         "m0 -4l4 4l-4 4l-4 -4z", "m0 4l4 -7h-8z"};
    const size_t kinds = sizeof shapes / sizeof *shapes;

    qdot_text_format(out, "<path class=\"mark%s\" d=\"M%.1f %.1f%s\"/>",
                     i / kinds % 2 == 1 ? " hollow" : "", x, y, shapes[i % kinds]);
}

/* The horizontal position of entry i of n in the legend. */
static double
legend_position(size_t i, size_t n)
{
    return LEFT + (double)i * (WIDE - LEFT - RIGHT) / (double)n;
}

static void
svg_add_legend_text(qdot_text *out, double x, double y, const char *label)
{
    qdot_text_format(out, "<text x=\"%.1f\" y=\"%.1f\">", x, y + 4);
    qdot_animation_escape(out, label);
    qdot_text_add(out, "</text>");
}

/* --- curves against time ------------------------------------------------------------ */

/* A grid spacing, 1, 2 or 5 times a power of ten, that divides `span` into at most `most` intervals. */
static double
grid_spacing(double span, double most)
{
    double ten = pow(10, floor(log10(span / most)));

    for (int i = 0; i < 3; i++) {
        static const double times[] = {1, 2, 5};

        if (span / (times[i] * ten) <= most)
            return times[i] * ten;
    }
    return 10 * ten;
}

static void
svg_add_number(qdot_text *out, double x, double step)
{
    if (x <= -1e-6 * step)
        qdot_text_add(out, "\u2212");
    qdot_text_double(out, fabs(x) < 1e-6 * step ? 0 : fabs(x), 6);
    qdot_text_add(out, "</text>");
}

static void
add_axes(qdot_text *out, const frame *f)
{
    const double lo = fmin(f->x0, f->x1), hi = fmax(f->x0, f->x1);
    const double dx = grid_spacing(hi - lo, 8), dy = grid_spacing(f->y1 - f->y0, 5);

    for (double k = ceil(lo / dx - 1e-9); k * dx <= hi + 1e-9 * dx; k++) {
        begin_vertical_grid_line(out, f, k * dx);
        svg_add_number(out, k * dx, dx);
    }
    for (double k = ceil(f->y0 / dy - 1e-9); k * dy <= f->y1 + 1e-9 * dy; k++) {
        begin_horizontal_grid_line(out, f, k * dy);
        svg_add_number(out, k * dy, dy);
    }
}

/* Find the ranges of the curves, widened slightly; false if there is nothing to draw. */
static bool
find_ranges(size_t n, const qdot_page_course *list, frame *f)
{
    double margin;

    *f = (frame){list[0].t0, list[0].t1, INFINITY, -INFINITY, LOW - BOTTOM};
    for (size_t i = 0; i < n; i++) {
        const qdot_page_course *c = &list[i];

        if (n > 1) {
            f->x0 = fmin(i > 0 ? f->x0 : c->t0, fmin(c->t0, c->t1));
            f->x1 = fmax(i > 0 ? f->x1 : c->t1, fmax(c->t0, c->t1));
        }
        for (size_t k = 0; k < c->n; k++)
            if (isfinite(c->y[k])) {
                f->y0 = fmin(f->y0, c->y[k]);
                f->y1 = fmax(f->y1, c->y[k]);
            }
    }
    if (!(f->y0 <= f->y1) || f->x0 == f->x1)
        return false;
    margin = f->y1 - f->y0 > 1e-12 * fmax(fabs(f->y0), fabs(f->y1))
                 ? 0.05 * (f->y1 - f->y0)
             : f->y1 != 0 ? 0.1 * fabs(f->y1)
                          : 1;
    f->y0 -= margin;
    f->y1 += margin;
    return true;
}

static void
svg_add_curve(qdot_text *out, const frame *f, const qdot_page_course *c)
{
    const size_t step = c->n / POINTS + 1;
    bool open = false;

    qdot_text_add(out, "<path class=\"curve\" d=\"");
    for (size_t k = 0; k < c->n;
         k = k + step < c->n || k + 1 == c->n ? k + step : c->n - 1) {
        double t = c->t0 + (c->t1 - c->t0) * (double)k / (double)(c->n - 1);

        if (isfinite(c->y[k]))
            qdot_text_format(out, "%s%.1f %.1f", open ? "L" : "M", to_picture_x(f, t),
                             to_picture_y(f, c->y[k]));
        open = isfinite(c->y[k]);
    }
    qdot_text_add(out, "\"/>");
}

void
qdot_page_courses(qdot_text *out, const char *name, size_t n,
                  const qdot_page_course *list)
{
    const double key = LOW + KEY / 2;
    frame f;

    if (n == 0 || !find_ranges(n, list, &f))
        return;
    svg_begin(out, n > 1 ? LOW + KEY : LOW, name, " against t");
    add_axes(out, &f);
    if (n == 1)
        svg_add_curve(out, &f, &list[0]);
    for (size_t i = 0; n > 1 && i < n; i++) {
        double x = legend_position(i, n);

        qdot_text_format(out, "<g class=\"dashed k%zu\">", i % LOOKS);
        svg_add_curve(out, &f, &list[i]);
        qdot_text_format(out, "<path class=\"curve\" d=\"M%.1f %.1fh26\"/>", x, key);
        svg_add_legend_text(out, x + 32, key, list[i].label);
        qdot_text_add(out, "</g>\n");
    }
    svg_end(out, name, " against t");
}

/* --- figures with logarithmic axes -------------------------------------------------- */

static bool
fits_log_axes(double x, double y)
{
    return x > 0 && y > 0 && isfinite(x) && isfinite(y);
}

/* Find the powers of ten that enclose the positive values; false if there are none. */
static bool
find_decades(size_t n, const qdot_page_points *list, frame *f)
{
    *f = (frame){INFINITY, -INFINITY, INFINITY, -INFINITY, TALL - 2 * BOTTOM - KEY};
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < list[i].n; k++) {
            double x = list[i].x[k], y = list[i].y[k];

            if (!fits_log_axes(x, y))
                continue;
            f->x0 = fmin(f->x0, floor(log10(x)));
            f->x1 = fmax(f->x1, ceil(log10(x)));
            f->y0 = fmin(f->y0, floor(log10(y)));
            f->y1 = fmax(f->y1, ceil(log10(y)));
        }
    f->x1 += f->x0 == f->x1;
    f->y1 += f->y0 == f->y1;
    return f->x0 < f->x1;
}

static void
svg_add_power(qdot_text *out, double exponent)
{
    qdot_text_format(out, "10<tspan dy=\"-5\" font-size=\"9\">%s%.0f</tspan></text>",
                     exponent < 0 ? "\u2212" : "", fabs(exponent));
}

static void
svg_add_log_axes(qdot_text *out, const frame *f, const char *x, const char *y)
{
    const double dx = ceil((f->x1 - f->x0) / 7), dy = ceil((f->y1 - f->y0) / 8);
    const double middle = (f->bottom + TOP) / 2.0;

    for (double k = f->x0; k <= f->x1; k += dx) {
        begin_vertical_grid_line(out, f, k);
        svg_add_power(out, k);
    }
    for (double k = f->y0; k <= f->y1; k += dy) {
        begin_horizontal_grid_line(out, f, k);
        svg_add_power(out, k);
    }
    qdot_text_format(out, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">",
                     (LEFT + WIDE - RIGHT) / 2, f->bottom + 36);
    qdot_animation_escape(out, x);
    qdot_text_format(out,
                     "</text><text transform=\"translate(14 %.1f) rotate(-90)\" "
                     "text-anchor=\"middle\">",
                     middle);
    qdot_animation_escape(out, y);
    qdot_text_add(out, "</text>\n");
}

static void
svg_add_points(qdot_text *out, const frame *f, const qdot_page_points *p, size_t i, size_t n)
{
    const double key = legend_position(i, n);
    bool open = false;

    qdot_text_format(out, "<g class=\"k%zu\"><path class=\"marked\" d=\"", i % LOOKS);
    for (size_t k = 0; k < p->n; k++)
        if (fits_log_axes(p->x[k], p->y[k])) {
            qdot_text_format(out, "%s%.1f %.1f", open ? "L" : "M",
                             to_picture_x(f, log10(p->x[k])), to_picture_y(f, log10(p->y[k])));
            open = true;
        }
    qdot_text_add(out, "\"/>");
    for (size_t k = 0; k < p->n; k++)
        if (fits_log_axes(p->x[k], p->y[k]))
            add_mark(out, i, to_picture_x(f, log10(p->x[k])), to_picture_y(f, log10(p->y[k])));
    add_mark(out, i, key, TALL - 8);
    svg_add_legend_text(out, key + 8, TALL - 8, p->label);
    qdot_text_add(out, "</g>\n");
}

void
qdot_page_log_log(qdot_text *out, const char *caption, const char *x, const char *y,
                  size_t n, const qdot_page_points *list)
{
    frame f;

    if (!find_decades(n, list, &f))
        return;
    svg_begin(out, TALL, caption, "");
    svg_add_log_axes(out, &f, x, y);
    for (size_t i = 0; i < n; i++)
        svg_add_points(out, &f, &list[i], i, n);
    svg_end(out, caption, "");
}
