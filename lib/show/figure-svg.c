/* figure-svg.c -- writes a figure as SVG, where gnuplot does not: axes, tics, legends, titles.
 *
 * Ranges, tics, places, colours and sizes are those of the other media; paths in space are projected as gnuplot does.
 */
#include <math.h>

#include "show/figure-svg.h"

static const double PX_PER_CM = 96 / 2.54, DEGREE = 0.017453292519943295;

/* In letters: the length of a large tic, the height of a line, the width of a letter, and of a line's sample in a legend
 * with the gap behind it. */
static const double TIC = 0.35, ROW = 1.5, WIDE = 0.55, SAMPLE = 2.6, GAP = 0.6;

/* --- lengths and points --------------------------------------------------------------------- */

void
qdot_figure_svg_add(qdot_text *s, double length)
{
    const double hundredths = fmin(fmax(round(100 * length), -1e9), 1e9);
    const int whole = (int)fabs(hundredths);

    qdot_text_format(s, "%s%d", hundredths < 0 ? "-" : "", whole / 100);
    if (whole % 10 != 0)
        qdot_text_format(s, ".%02d", whole % 100);
    else if (whole % 100 != 0)
        qdot_text_format(s, ".%d", whole % 100 / 10);
}

void
qdot_figure_svg_line(qdot_text *s, double x, double y, double x1, double y1, const char *attributes)
{
    const double length[] = {x, y, x1, y1};
    static const char *const name[] = {"x1", "y1", "x2", "y2"};

    qdot_text_add(s, "<line");
    for (int i = 0; i < 4; i++) {
        qdot_text_format(s, " %s=\"", name[i]);
        qdot_figure_svg_add(s, length[i]);
        qdot_text_char(s, '"');
    }
    qdot_text_format(s, " %s/>\n", attributes);
}

double
qdot_figure_part_of(const qdot_figure_axis *a, double value)
{
    return a->log ? log(value / a->least) / log(a->most / a->least)
                  : ((value - a->offset) / pow(10, a->power) - a->least) / (a->most - a->least);
}

void
qdot_figure_frame_point(const qdot_figure_frame *f, const double *part, double *at)
{
    for (int i = 0; i < 2; i++)
        at[i] = f->origin[i] + part[0] * f->edge[0][i] + part[1] * f->edge[1][i] + part[2] * f->edge[2][i];
}

/* --- frames --------------------------------------------------------------------------------- */

/* The axes as they are drawn: an axis whose values do not differ, or too little for doubles, has some width. */
static void
give_width(qdot_figure_axis *a)
{
    const double more = fmax(fabs(a->least) * 1e-3, 1e-300);

    if (a->log ? a->most > a->least : a->most > a->least && isfinite(a->most - a->least))
        return;
    a->log = false;
    a->step = 0;
    a->least -= more;
    a->most += more;
}

/* The axes of a panel in the plane: between its margins, or in the middle there if both have one scale. */
static void
frame_plane(const qdot_figure_canvas *c, const qdot_figure_place *at, qdot_figure_frame *f)
{
    double wide = (at->right - at->left) * c->cm, high = (at->top - at->bottom) * c->cm;
    double x = at->left * c->cm, y = (c->d->height - at->bottom) * c->cm;

    if (f->panel->equal) {
        const double span[] = {f->axes[0].most - f->axes[0].least, f->axes[1].most - f->axes[1].least};
        const double scale = fmin(wide / span[0], high / span[1]);

        x += (wide - scale * span[0]) / 2;
        y -= (high - scale * span[1]) / 2;
        wide = scale * span[0];
        high = scale * span[1];
    }
    f->origin[0] = x;
    f->origin[1] = y;
    f->edge[0][0] = wide;
    f->edge[1][1] = -high;
}

/* The box of paths in space: turned about its vertical edge, tilted, seen from far away, in the middle of its strip. */
static void
frame_space(const qdot_figure_canvas *c, const qdot_figure_place *at, qdot_figure_frame *f)
{
    const double cos_turn = cos(QDOT_FIGURE_TURN * DEGREE), sin_turn = sin(QDOT_FIGURE_TURN * DEGREE);
    const double flat = cos(QDOT_FIGURE_TILT * DEGREE), high = sin(QDOT_FIGURE_TILT * DEGREE);
    const double height = c->d->height / (double)c->d->figure->n;
    const qdot_figure_room room = {c->d->width, height, c->d->points, f->panel};
    double side[3], zoom, seen[3], scale, wide, tall;

    for (int k = 0; k < 3; k++)
        side[k] = f->axes[k].most - f->axes[k].least;
    qdot_figure_see_box(side, &room, &zoom, seen);
    scale = c->cm * seen[2] / (side[2] * high);
    f->edge[0][0] = scale * side[0] * cos_turn;
    f->edge[0][1] = scale * side[0] * sin_turn * flat;
    f->edge[1][0] = scale * side[1] * sin_turn;
    f->edge[1][1] = -scale * side[1] * cos_turn * flat;
    f->edge[2][1] = -scale * side[2] * high;
    wide = f->edge[0][0] + f->edge[1][0];
    tall = f->edge[0][1] - f->edge[1][1] - f->edge[2][1];
    f->origin[0] = (c->d->width * c->cm - wide) / 2;
    f->origin[1] = (c->d->height - (at->high + at->low) / 2) * c->cm + tall / 2 - f->edge[0][1];
}

/* --- axes ----------------------------------------------------------------------------------- */

/* The tics of axis k; without any of its own where its values hardly differ. */
static size_t
tics_of(const qdot_figure_frame *f, int k, qdot_figure_tic *tics)
{
    return f->axes[k].log || f->axes[k].step > 0 ? qdot_figure_find_tics(&f->axes[k], tics) : 0;
}

/* The part of its axis at which a tic stands. */
static double
part_of_tic(const qdot_figure_axis *a, const qdot_figure_tic *tic)
{
    return a->log ? log(tic->at / a->least) / log(a->most / a->least) : (tic->at - a->least) / (a->most - a->least);
}

/* Append the lines of the grid across axis k, on the floor of a box. */
static void
svg_add_grid(qdot_text *s, const qdot_figure_frame *f, int k)
{
    qdot_figure_tic tics[QDOT_FIGURE_TICS];
    const size_t n = tics_of(f, k, tics);

    for (size_t i = 0; i < n; i++) {
        double from[2], to[2], part[3] = {0, 0, 0};

        if (tics[i].minor)
            continue;
        part[k] = part_of_tic(&f->axes[k], &tics[i]);
        qdot_figure_frame_point(f, part, from);
        part[1 - k] = 1;
        qdot_figure_frame_point(f, part, to);
        qdot_figure_svg_line(s, from[0], from[1], to[0], to[1], "stroke=\"#e0e0e0\"");
    }
}

/* How the tics of an axis stand: on an edge that begins at these parts of the axes, outward in a direction of unit
 * length, with the numbers behind them. */
typedef struct {
    double begin[3], out[2], gap[2];
    const char *anchor;
} edge_look;

/* Append the tics of axis k and, unless `bare`, its numbers; returns the width of the widest in letters. */
static size_t
svg_add_tics(const qdot_figure_canvas *c, const qdot_figure_frame *f, int k, const edge_look *look, bool bare)
{
    qdot_figure_tic tics[QDOT_FIGURE_TICS];
    const size_t n = tics_of(f, k, tics);
    size_t widest = 0;

    for (size_t i = 0; i < n; i++) {
        double at[2], part[3] = {look->begin[0], look->begin[1], look->begin[2]};
        const double length = (tics[i].minor ? TIC / 2 : TIC) * c->letter;

        part[k] = part_of_tic(&f->axes[k], &tics[i]);
        qdot_figure_frame_point(f, part, at);
        qdot_figure_svg_line(c->s, at[0], at[1], at[0] + length * look->out[0], at[1] + length * look->out[1],
                             "stroke=\"#404040\"");
        widest = tics[i].letters > widest ? tics[i].letters : widest;
        /* a long number at the end of x does not leave the figure; half of it is 0.3 letters wide for each of its own */
        if (k == 0 && !bare)
            at[0] = fmin(at[0], c->d->width * c->cm - 0.3 * (double)tics[i].letters * c->letter);
        if (!bare && !tics[i].minor)
            qdot_figure_svg_add_text(c->s, at[0] + length * look->out[0] + look->gap[0] * c->letter,
                                     at[1] + length * look->out[1] + look->gap[1] * c->letter, look->anchor, tics[i].label);
    }
    return widest;
}

/* Append the label of axis k at a point, turned upward if `turned`. */
static void
svg_add_axis_label(const qdot_figure_canvas *c, const qdot_figure_frame *f, int k, const double *at, const char *anchor,
                   bool turned)
{
    qdot_text markup = {0};

    qdot_figure_add_axis_markup(&markup, "xyz"[k], &f->axes[k], &f->panel->axis[k], f->panel->unit[k]);
    if (markup.n > 0) {
        qdot_figure_svg_begin_text(c->s, at[0], at[1], anchor);
        if (turned) {
            qdot_text_add(c->s, " transform=\"rotate(-90 ");
            qdot_figure_svg_add(c->s, at[0]);
            qdot_text_char(c->s, ' ');
            qdot_figure_svg_add(c->s, at[1]);
            qdot_text_add(c->s, ")\"");
        }
        qdot_figure_svg_end_text(c->s, qdot_text_str(&markup));
    }
    c->s->failed = c->s->failed || markup.failed;
    qdot_text_clear(&markup);
}

static void
svg_add_plane_axes(const qdot_figure_canvas *c, const qdot_figure_frame *f, bool shared)
{
    static const edge_look look[] = {{{0, 0, 0}, {0, 1}, {0, 1.05}, "middle"}, {{0, 0, 0}, {-1, 0}, {-0.3, 0.35}, "end"}};
    const double left = f->origin[0], low = f->origin[1], right = left + f->edge[0][0], top = low + f->edge[1][1];
    const bool above = f->axes[1].offset_text[0] != '\0'; /* the label is long */

    qdot_figure_svg_line(c->s, left, low, right, low, "stroke=\"#404040\"");
    qdot_figure_svg_line(c->s, left, low, left, top, "stroke=\"#404040\"");
    svg_add_tics(c, f, 0, &look[0], shared);
    const size_t letters = svg_add_tics(c, f, 1, &look[1], false);

    if (!shared)
        svg_add_axis_label(c, f, 0, (double[]){(left + right) / 2, low + 3.1 * c->letter}, "middle", false);
    if (above)
        svg_add_axis_label(c, f, 1, (double[]){left - 2.2 * c->letter, top - 0.8 * c->letter}, "start", false);
    else
        svg_add_axis_label(c, f, 1, (double[]){left - (1.7 + 0.6 * (double)letters) * c->letter, (low + top) / 2}, "middle", true);
}

/* Append the edges of a box that are drawn: its floor and the vertical one at the left. */
static void
svg_add_box(qdot_text *s, const qdot_figure_frame *f)
{
    static const double corner[][3] = {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    double from[2], to[2];

    for (size_t i = 1; i < sizeof corner / sizeof *corner; i++) {
        qdot_figure_frame_point(f, corner[i - 1], from);
        qdot_figure_frame_point(f, corner[i], to);
        qdot_figure_svg_line(s, from[0], from[1], to[0], to[1], "stroke=\"#404040\"");
    }
}

static void
svg_add_space_axes(const qdot_figure_canvas *c, const qdot_figure_frame *f)
{
    const double x = hypot(f->edge[0][0], f->edge[0][1]), y = hypot(f->edge[1][0], f->edge[1][1]);
    const edge_look look[] = {{{0, 0, 0}, {-f->edge[1][0] / y, -f->edge[1][1] / y}, {-0.1, 0.9}, "end"},
                              {{1, 0, 0}, {f->edge[0][0] / x, f->edge[0][1] / x}, {0.2, 0.7}, "start"},
                              {{0, 0, 0}, {-1, 0}, {-0.3, 0.35}, "end"}};
    double at[2];
    size_t letters[3];

    svg_add_box(c->s, f);
    for (int k = 0; k < 3; k++)
        letters[k] = svg_add_tics(c, f, k, &look[k], false);
    qdot_figure_frame_point(f, (double[]){0.5, 0, 0}, at);
    svg_add_axis_label(c, f, 0, (double[]){at[0] - (1.4 + 0.4 * (double)letters[0]) * c->letter, at[1] + 2.6 * c->letter}, "end",
                       false);
    qdot_figure_frame_point(f, (double[]){1, 0.5, 0}, at);
    svg_add_axis_label(c, f, 1, (double[]){at[0] + (1.3 + 0.55 * (double)letters[1]) * c->letter, at[1] + 2 * c->letter}, "start",
                       false);
    qdot_figure_frame_point(f, (double[]){0, 0, 1}, at);
    svg_add_axis_label(c, f, 2, (double[]){at[0], at[1] - 0.9 * c->letter}, "middle", false);
}

/* --- titles and legends ------------------------------------------------------------------------ */

/* Append title and note, in the middle of the axes: `low` is how far the note's line is above them. */
static void
svg_add_title(const qdot_figure_canvas *c, const qdot_panel *panel, double x, double y)
{
    const bool titled = panel->title.text != NULL && panel->title.text[0] != '\0';
    qdot_text markup = {0};

    if (panel->note != NULL) {
        qdot_figure_add_markup(&markup, &(qdot_figure_label){panel->note, false});
        qdot_figure_svg_begin_text(c->s, x, y, "middle");
        qdot_text_add(c->s, " font-size=\"80%\"");
        qdot_figure_svg_end_text(c->s, qdot_text_str(&markup));
        y -= 1.3 * c->letter;
    }
    if (titled) {
        qdot_text_truncate(&markup, 0);
        qdot_figure_add_markup(&markup, &panel->title);
        qdot_figure_svg_add_text(c->s, x, y, "middle", qdot_text_str(&markup));
    }
    c->s->failed = c->s->failed || markup.failed;
    qdot_text_clear(&markup);
}

/* Append n entries of the legend of a panel in columns of so many rows, the first at (x, y). */
static void
svg_add_entries(const qdot_figure_canvas *c, const qdot_panel *panel, const double *at, size_t rows, double row, double column)
{
    for (size_t k = 0; k < panel->n; k++) {
        const qdot_figure_label label = qdot_figure_curve_label(panel, k);
        const double x = at[0] + (double)(k / rows) * column, y = at[1] + (double)(k % rows) * row;
        qdot_text markup = {0};

        qdot_figure_add_markup(&markup, &label);
        qdot_figure_svg_sample(c->s, panel, k, x, y - 0.32 * c->letter, SAMPLE * c->letter);
        qdot_figure_svg_add_text(c->s, x + (SAMPLE + GAP) * c->letter, y, "start", qdot_text_str(&markup));
        c->s->failed = c->s->failed || markup.failed;
        qdot_text_clear(&markup);
    }
}

/* Append the legend: above the axes at their right end, beside them, or in the upper right corner of a box. */
static void
svg_add_legend(const qdot_figure_canvas *c, const qdot_panel *panel, double right, double top)
{
    const size_t rows = qdot_figure_legend_rows(c->d, panel);
    const double column = (double)qdot_figure_legend_width(panel) * WIDE * c->letter;
    const double row = ROW * c->letter;

    if (rows == 0)
        return;
    if (qdot_figure_has_legend_beside(c->d, panel)) {
        svg_add_entries(c, panel, (double[]){right + c->letter, top + c->letter}, panel->n,
                        row * qdot_figure_legend_spacing(c->d, panel), column);
    } else if (qdot_figure_is_space(panel)) {
        svg_add_entries(c, panel, (double[]){c->d->width * c->cm - column - c->letter, top + row}, panel->n, row, column);
    } else {
        const double columns = ceil((double)panel->n / (double)rows);

        svg_add_entries(c, panel, (double[]){right - columns * column, top - 0.6 * c->letter - (double)(rows - 1) * row}, rows, row,
                        column);
    }
}

/* --- panels -------------------------------------------------------------------------------------- */

/* Begin a drawing within the drawing, in the same units, of which nothing is seen outside of the axes and half a line's
 * width around them. */
static void
svg_begin_clip(qdot_text *s, const qdot_figure_frame *f)
{
    const double box[] = {f->origin[0] - 1, f->origin[1] + f->edge[1][1] - 1, f->edge[0][0] + 2, 2 - f->edge[1][1]};
    static const char *const name[] = {"x", "y", "width", "height"};

    qdot_text_add(s, "<svg");
    for (int i = 0; i < 4; i++) {
        qdot_text_format(s, " %s=\"", name[i]);
        qdot_figure_svg_add(s, box[i]);
        qdot_text_char(s, '"');
    }
    qdot_text_add(s, " viewBox=\"");
    for (int i = 0; i < 4; i++) {
        qdot_text_add(s, i > 0 ? " " : "");
        qdot_figure_svg_add(s, box[i]);
    }
    qdot_text_add(s, "\">\n");
}

static qdot_status
svg_add_panel(const qdot_figure_canvas *c, size_t i)
{
    const qdot_panel *panel = &c->d->figure->panels[i];
    const bool space = qdot_figure_is_space(panel);
    qdot_figure_axis axes[3];
    qdot_figure_place at;
    qdot_figure_frame f = {.panel = panel, .axes = axes};

    QDOT_TRY(qdot_figure_choose_axes(c->d, i, axes));
    QDOT_TRY(qdot_figure_place_panel(c->d, i, &at));
    for (int k = 0; k < 3; k++)
        give_width(&axes[k]);
    if (space)
        frame_space(c, &at, &f);
    else
        frame_plane(c, &at, &f);

    const double right = f.origin[0] + f.edge[0][0], top = space ? (c->d->height - at.high) * c->cm : f.origin[1] + f.edge[1][1];
    const double above = space ? -1.2 : qdot_figure_has_legend_beside(c->d, panel) ? 0 : (double)qdot_figure_legend_rows(c->d, panel);

    if (panel->map == NULL)
        for (int k = 0; k < 2; k++)
            svg_add_grid(c->s, &f, k);
    if (!space && panel->map == NULL)
        svg_begin_clip(c->s, &f);
    QDOT_TRY(panel->map != NULL ? qdot_figure_svg_map(c, &f) : qdot_figure_svg_curves(c->s, &f));
    if (!space && panel->map == NULL)
        qdot_text_add(c->s, "</svg>\n");
    if (space)
        svg_add_space_axes(c, &f);
    else
        svg_add_plane_axes(c, &f, qdot_figure_is_shared(c->d->figure, i));
    svg_add_title(c, panel, space ? c->d->width * c->cm / 2 : (f.origin[0] + right) / 2, top - (0.7 + ROW * above) * c->letter);
    svg_add_legend(c, panel, right, top);
    return qdot_text_status(c->s);
}

qdot_status
qdot_figure_add_svg(const qdot_figure_drawing *d)
{
    const qdot_figure_canvas c = {.d = d, .s = d->script, .cm = PX_PER_CM, .letter = d->points * 96 / 72};
    const double size[] = {round(d->width * c.cm), round(d->height * c.cm)};

    qdot_text_format(c.s,
                     "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
                     "font-family=\"sans-serif\" fill=\"#202020\" font-size=\"",
                     size[0], size[1], size[0], size[1]);
    qdot_figure_svg_add(c.s, c.letter);
    qdot_text_format(c.s, "\">\n<rect width=\"%.0f\" height=\"%.0f\" fill=\"#ffffff\"/>\n", size[0], size[1]);
    for (size_t i = 0; i < d->figure->n; i++)
        QDOT_TRY(svg_add_panel(&c, i));
    qdot_text_add(c.s, "</svg>\n");
    return qdot_text_status(c.s);
}
