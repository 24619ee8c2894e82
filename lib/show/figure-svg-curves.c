/* figure-svg-curves.c -- curves, marks and maps of a panel in SVG. */
#include <math.h>

#include "base/interrupt.h"
#include "show/figure-svg.h"

/* Widths of lines, the unit of gnuplot's dashes, the radius of a mark of size 1; points nearer than NEAR to the one before
 * are not written, those farther than FAR, as near a pole, are written there: readers of SVG compute in single precision. */
static const double LINE = 1.68, DASH = 0.84, MARK = 6.5, NEAR = 0.05, FAR_AWAY = 1e6;

enum { BLOCK = 4096, FEW_DOTS = 600, MANY_MARKS = 24, SHADES = 128 };

/* Marks with a radius of 1 around (0, 0), in the order of the other media: first those that are filled. */
static const struct {
    const char *path;
    bool filled;
} marks[] = {
    {"M1 0A1 1 0 1 1 -1 0A1 1 0 1 1 1 0z", true},
    {"M-.9 -.9H.9V.9H-.9z", true},
    {"M0 -1.2L1.1 .75H-1.1z", true},
    {"M0 1.2L1.1 -.75H-1.1z", true},
    {"M0 -1.3L1 0 0 1.3 -1 0z", true},
    {"M1 0A1 1 0 1 1 -1 0A1 1 0 1 1 1 0z", false},
    {"M-.9 -.9H.9V.9H-.9z", false},
    {"M0 -1.2L1.1 .75H-1.1z", false},
    {"M0 1.2L1.1 -.75H-1.1z", false},
    {"M0 -1.3L1 0 0 1.3 -1 0z", false},
    {"M-1 0H1M0 -1V1", false},
    {"M-.8 -.8L.8 .8M-.8 .8L.8 -.8", false},
    {"M-1 0H1M0 -1V1M-.7 -.7L.7 .7M-.7 .7L.7 -.7", false},
    {"M0 -1.1L1.05 -.34 .65 .89H-.65L-1.05 -.34z", true},
    {"M0 -1.1L1.05 -.34 .65 .89H-.65L-1.05 -.34z", false},
};

enum { MARKS = sizeof marks / sizeof *marks };

/* --- one curve ------------------------------------------------------------------------------ */

/* Where point k of a curve is drawn; floor: below it, on the floor of the box. */
static void
place_point(const qdot_figure_frame *f, const qdot_curve *curve, size_t k, bool floor, double *at)
{
    const double part[3] = {qdot_figure_part_of(&f->axes[0], curve->x[k]), qdot_figure_part_of(&f->axes[1], curve->y[k]),
                            curve->z == NULL || floor ? 0 : qdot_figure_part_of(&f->axes[2], curve->z[k])};

    qdot_figure_frame_point(f, part, at);
    for (int i = 0; i < 2; i++)
        at[i] = fmin(fmax(at[i], -FAR_AWAY), FAR_AWAY);
}

static void
svg_add_point(qdot_text *s, const double *at, const char *before)
{
    qdot_text_add(s, before);
    qdot_figure_svg_add(s, at[0]);
    qdot_text_char(s, ' ');
    qdot_figure_svg_add(s, at[1]);
}

/* Append the line through the points of a curve, interrupted where a point cannot be shown. */
static qdot_status
svg_add_path(qdot_text *s, const qdot_figure_frame *f, const qdot_curve *curve, bool floor)
{
    bool open = false;
    double last[2] = {0, 0};

    for (size_t k = 0; k < curve->rows; k++) {
        double at[2];

        if (k % BLOCK == BLOCK - 1)
            QDOT_TRY(qdot_interrupt_check());
        if (!qdot_figure_shows(f->panel, curve, k)) {
            open = false;
            continue;
        }
        place_point(f, curve, k, floor, at);
        const bool ends = k + 1 == curve->rows || !qdot_figure_shows(f->panel, curve, k + 1);

        if (open && !ends && fabs(at[0] - last[0]) < NEAR && fabs(at[1] - last[1]) < NEAR)
            continue;
        svg_add_point(s, at, open ? "L" : "M");
        last[0] = at[0];
        last[1] = at[1];
        open = true;
    }
    return QDOT_OK;
}

/* Append dashes like gnuplot's, (12,5), in its unit. */
static void
svg_add_dashes(qdot_text *s, const char *dash)
{
    double n = 0;

    if (dash == NULL || *dash != '(')
        return;
    qdot_text_add(s, " stroke-dasharray=\"");
    for (const char *c = dash + 1; *c != '\0'; c++) {
        if (*c >= '0' && *c <= '9') {
            n = 10 * n + (*c - '0');
            continue;
        }
        qdot_text_double(s, n * DASH, 4);
        qdot_text_add(s, *c == ',' ? "," : "");
        n = 0;
    }
    qdot_text_char(s, '"');
}

static void
svg_begin_line(qdot_text *s, const qdot_figure_style *style)
{
    qdot_text_format(s, "<path fill=\"none\" stroke-linejoin=\"round\" stroke=\"%s\" stroke-width=\"", style->colour);
    qdot_figure_svg_add(s, LINE);
    qdot_text_char(s, '"');
    svg_add_dashes(s, style->dash);
    qdot_text_add(s, " d=\"");
}

/* Append a mark of a radius at a point. */
static void
svg_add_mark(qdot_text *s, const qdot_figure_style *style, const double *at, double radius)
{
    const size_t kind = style->dots ? 0 : style->look % MARKS;

    qdot_text_format(s, "<path transform=\"translate(");
    qdot_figure_svg_add(s, at[0]);
    qdot_text_char(s, ' ');
    qdot_figure_svg_add(s, at[1]);
    qdot_text_add(s, ")scale(");
    qdot_figure_svg_add(s, radius);
    qdot_text_format(s, ")\" d=\"%s\" ", marks[kind].path);
    if (marks[kind].filled)
        qdot_text_format(s, "fill=\"%s\"/>\n", style->colour);
    else
        qdot_text_format(s, "fill=\"none\" stroke=\"%s\" stroke-width=\".35\"/>\n", style->colour);
}

/* Append a dot at every point, as the round ends of lines without length: smaller if there are many. */
static qdot_status
svg_add_dots(qdot_text *s, const qdot_figure_frame *f, const qdot_curve *curve, const qdot_figure_style *style)
{
    const double size = curve->rows <= FEW_DOTS ? 0.3 : fmax(0.08, 0.3 * sqrt((double)FEW_DOTS / (double)curve->rows));

    qdot_text_format(s, "<path stroke-linecap=\"round\" stroke=\"%s\" stroke-width=\"", style->colour);
    qdot_figure_svg_add(s, 2 * MARK * size);
    qdot_text_add(s, "\" d=\"");
    for (size_t k = 0; k < curve->rows; k++) {
        double at[2];

        if (k % BLOCK == BLOCK - 1)
            QDOT_TRY(qdot_interrupt_check());
        if (!qdot_figure_shows(f->panel, curve, k))
            continue;
        place_point(f, curve, k, false, at);
        svg_add_point(s, at, "M");
        qdot_text_add(s, "h0");
    }
    qdot_text_add(s, "\"/>\n");
    return QDOT_OK;
}

static void
svg_add_marks(qdot_text *s, const qdot_figure_frame *f, const qdot_curve *curve, const qdot_figure_style *style)
{
    const size_t stride = f->panel->marks && curve->rows > MANY_MARKS ? curve->rows / (MANY_MARKS / 2) : 1;

    for (size_t k = 0; k < curve->rows; k += stride) {
        double at[2];

        if (!qdot_figure_shows(f->panel, curve, k))
            continue;
        place_point(f, curve, k, false, at);
        svg_add_mark(s, style, at, 0.7 * MARK);
    }
}

qdot_status
qdot_figure_svg_curves(qdot_text *s, const qdot_figure_frame *f)
{
    for (size_t k = 0; qdot_figure_is_space(f->panel) && k < f->panel->n; k++) {
        qdot_text_add(s, "<path fill=\"none\" stroke=\"#d0d0d0\" d=\"");
        QDOT_TRY(svg_add_path(s, f, &f->panel->curves[k], true));
        qdot_text_add(s, "\"/>\n");
    }
    for (size_t k = 0; k < f->panel->n; k++) {
        const qdot_curve *curve = &f->panel->curves[k];
        const qdot_figure_style style = qdot_figure_style_of(f->panel, k);

        if (style.line) {
            svg_begin_line(s, &style);
            QDOT_TRY(svg_add_path(s, f, curve, false));
            qdot_text_add(s, "\"/>\n");
        }
        if (style.dots)
            QDOT_TRY(svg_add_dots(s, f, curve, &style));
        else if (style.marks)
            svg_add_marks(s, f, curve, &style);
    }
    return qdot_text_status(s);
}

void
qdot_figure_svg_sample(qdot_text *s, const qdot_panel *panel, size_t k, double x, double y, double length)
{
    const qdot_figure_style style = qdot_figure_style_of(panel, k);
    const double middle[2] = {x + length / 2, y};

    if (style.line) {
        svg_begin_line(s, &style);
        svg_add_point(s, (double[]){x, y}, "M");
        svg_add_point(s, (double[]){x + length, y}, "L");
        qdot_text_add(s, "\"/>\n");
    }
    if (style.dots || style.marks)
        svg_add_mark(s, &style, middle, MARK * (style.dots ? 0.4 : 0.7));
}

/* --- maps ------------------------------------------------------------------------------------- */

/* The shade of a value between the ends of a map, 0 to SHADES - 1; SHADES: blank. */
static int
shade_of(const double *ends, double value)
{
    return !isfinite(value)      ? SHADES
           : ends[1] > ends[0] ? (int)fmin((value - ends[0]) / (ends[1] - ends[0]) * SHADES, SHADES - 1)
                                 : SHADES / 2;
}

/* Append the cells of one shade, those beside each other as one, in units of cells. */
static bool
svg_add_cells(qdot_text *s, const qdot_figure_map *map, const double *ends, int shade)
{
    bool any = false;

    for (size_t j = 0; j < map->n[1]; j++)
        for (size_t i = 0; i < map->n[0];) {
            size_t to = i;

            while (to < map->n[0] && shade_of(ends, map->value[j * map->n[0] + to]) == shade)
                to++;
            if (to > i) {
                qdot_text_format(s, "M%zu %zuh%zuv1h-%zuz", i, j, to - i, to - i);
                any = true;
            }
            i = to > i ? to : i + 1;
        }
    return any;
}

/* Append the scale of colours at the right of the axes, with its numbers and the label of the values. */
static void
svg_add_scale(const qdot_figure_canvas *c, const qdot_figure_frame *f, const double *ends)
{
    const double x = f->origin[0] + f->edge[0][0] + c->letter, wide = 1.2 * c->letter, low = f->origin[1], tall = -f->edge[1][1];
    const double more = ends[1] > ends[0] ? 0 : 1;
    const qdot_figure_axis axis = qdot_figure_axis_of(ends[0] - more, ends[1] + more, QDOT_TICS_DECIMAL, fmin(fmax(tall / 60, 2), 8), NULL);
    qdot_figure_tic tics[QDOT_FIGURE_TICS];
    const size_t n = qdot_figure_find_tics(&axis, tics);
    qdot_text markup = {0};
    size_t letters = 0;
    char colour[8];

    qdot_text_add(c->s, "<g shape-rendering=\"crispEdges\">\n"); /* no seams between the shades */
    for (int i = 0; i < SHADES; i++) {
        qdot_figure_map_colour((i + 0.5) / SHADES, colour);
        qdot_text_format(c->s, "<rect fill=\"%s\" x=\"", colour);
        qdot_figure_svg_add(c->s, x);
        qdot_text_add(c->s, "\" y=\"");
        qdot_figure_svg_add(c->s, low - tall * (i + 1) / SHADES);
        qdot_text_add(c->s, "\" width=\"");
        qdot_figure_svg_add(c->s, wide);
        qdot_text_add(c->s, "\" height=\"");
        qdot_figure_svg_add(c->s, tall / SHADES + 0.3);
        qdot_text_add(c->s, "\"/>\n");
    }
    qdot_text_add(c->s, "</g>\n");
    for (size_t i = 0; i < n; i++) {
        const double y = low - tall * (tics[i].at - axis.least) / (axis.most - axis.least);

        qdot_figure_svg_line(c->s, x + wide, y, x + wide + 0.3 * c->letter, y, "stroke=\"#404040\"");
        qdot_figure_svg_add_text(c->s, x + wide + 0.6 * c->letter, y + 0.35 * c->letter, "start", tics[i].label);
        letters = tics[i].letters > letters ? tics[i].letters : letters;
    }
    qdot_figure_add_axis_markup(&markup, 'z', &axis, &f->panel->map->label, NULL);
    const double at[2] = {x + wide + (1.9 + 0.6 * (double)letters) * c->letter, low - tall / 2};

    qdot_figure_svg_begin_text(c->s, at[0], at[1], "middle");
    qdot_text_add(c->s, " transform=\"rotate(-90 ");
    qdot_figure_svg_add(c->s, at[0]);
    qdot_text_char(c->s, ' ');
    qdot_figure_svg_add(c->s, at[1]);
    qdot_text_add(c->s, ")\"");
    qdot_figure_svg_end_text(c->s, qdot_text_str(&markup));
    c->s->failed = c->s->failed || markup.failed;
    qdot_text_clear(&markup);
}

qdot_status
qdot_figure_svg_map(const qdot_figure_canvas *c, const qdot_figure_frame *f)
{
    const qdot_figure_map *map = f->panel->map;
    double ends[2], least[2], most[2], low[2], high[2], part[3] = {0, 0, 0};
    char colour[8];

    qdot_figure_map_ends(map, ends);
    for (int k = 0; k < 2; k++)
        qdot_figure_map_edges(map, k, &least[k], &most[k]);
    for (int k = 0; k < 2; k++)
        part[k] = qdot_figure_part_of(&f->axes[k], least[k]);
    qdot_figure_frame_point(f, part, low);
    for (int k = 0; k < 2; k++)
        part[k] = qdot_figure_part_of(&f->axes[k], most[k]);
    qdot_figure_frame_point(f, part, high);
    qdot_text_add(c->s, "<g shape-rendering=\"crispEdges\" transform=\"translate(");
    qdot_figure_svg_add(c->s, low[0]);
    qdot_text_char(c->s, ' ');
    qdot_figure_svg_add(c->s, low[1]);
    qdot_text_add(c->s, ")scale(");
    qdot_text_double(c->s, (high[0] - low[0]) / (double)map->n[0], 7);
    qdot_text_char(c->s, ' ');
    qdot_text_double(c->s, (high[1] - low[1]) / (double)map->n[1], 7);
    qdot_text_add(c->s, ")\">\n");
    for (int i = 0; i < SHADES; i++) {
        const size_t before = c->s->n;

        QDOT_TRY(qdot_interrupt_check());
        qdot_figure_map_colour((i + 0.5) / SHADES, colour);
        qdot_text_format(c->s, "<path fill=\"%s\" d=\"", colour);
        if (svg_add_cells(c->s, map, ends, i))
            qdot_text_add(c->s, "\"/>\n");
        else
            qdot_text_truncate(c->s, before);
    }
    qdot_text_add(c->s, "</g>\n");
    svg_add_scale(c, f, ends);
    return qdot_text_status(c->s);
}
