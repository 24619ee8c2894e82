/* figure-tikz.c -- writes a figure for LaTeX: a tikzpicture with an axis of pgfplots for each panel.
 *
 * Axes, tics, colours and sizes are those of the other kinds of figure; labels are formulas of LaTeX, in the letters of
 * the document. A document takes the file by \input.
 */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "show/figure-parts.h"

enum { DIGITS = 7, IN_A_LINE = 4, BLOCK = 1024, MANY_MARKS = 24, LONG_KEY = 8, MOST_POINTS = 8000, LEAST_CURVES = 3 };

static const char head[] = "% by qdot: \\input this file into a document with \\usepackage{amsmath,pgfplots},\n"
                           "% \\pgfplotsset{compat=1.16} or later\n";

static const char *const marks[] = {"*",        "square*",   "triangle*", "diamond*", "pentagon*", "square", "o",
                                    "triangle", "diamond",   "pentagon",  "+",        "x",         "asterisk"};

enum { MARKS = sizeof marks / sizeof *marks };

/* --- texts -------------------------------------------------------------------------------- */

/* Append a tic's number for LaTeX; UTF-8 signs as in 2·10^{−5} or π/2 become LaTeX commands. */
static void
tikz_add_number(qdot_text *out, const char *number)
{
    static const struct {
        const char *sign, *latex;
    } signs[] = {{"−", "-"}, {"·", "\\cdot "}, {"π", "\\pi "}};

    for (const char *c = number; *c != '\0';) {
        size_t n = 0;

        for (size_t i = 0; i < sizeof signs / sizeof *signs && n == 0; i++)
            if (strncmp(c, signs[i].sign, strlen(signs[i].sign)) == 0) {
                qdot_text_add(out, signs[i].latex);
                n = strlen(signs[i].sign);
            }
        if (n == 0)
            qdot_text_char(out, *c);
        c += n > 0 ? n : 1;
    }
}

/* Append the label of an axis with the offset and the power of ten of its numbers: (E - 9.81) / 10^{-12}. */
static void
tikz_add_axis_label(qdot_text *s, char name, const qdot_figure_axis *a, const qdot_figure_label *label, const char *unit)
{
    const bool moved = a->offset_text[0] != '\0', scaled = a->power != 0;
    bool compound = false;
    const qdot_figure_label own = moved || scaled ? qdot_figure_moved_label(name, label, &compound) : *label;

    qdot_text_add(s, "{");
    qdot_text_add(s, moved && scaled ? "(" : "");
    qdot_text_add(s, compound ? "(" : "");
    qdot_figure_add_latex(s, &own);
    qdot_text_add(s, compound ? ")" : "");
    if (moved) {
        qdot_text_add(s, a->offset > 0 ? " $- " : " $+ ");
        tikz_add_number(s, a->offset_text);
        qdot_text_char(s, '$');
    }
    qdot_text_add(s, moved && scaled ? ")" : "");
    if (scaled)
        qdot_text_format(s, " $/\\,10^{%d}$", a->power);
    if (label->text != NULL && label->text[0] != '\0')
        qdot_figure_add_unit_latex(s, unit);
    qdot_text_char(s, '}');
}

/* --- the axes of a panel ------------------------------------------------------------------ */

static void
add_option(qdot_text *s, const char *name, double value, const char *unit)
{
    qdot_text_format(s, "  %s=", name);
    qdot_text_double(s, value, DIGITS);
    qdot_text_format(s, "%s,\n", unit);
}

/* Append the list of positions of an axis's large (or small) tics; labels: append their numbers. */
static void
add_tic_list(qdot_text *s, const qdot_figure_tic *tics, size_t n, bool minor, bool labels)
{
    bool some = false;

    qdot_text_char(s, '{');
    for (size_t i = 0; i < n; i++) {
        if (tics[i].minor != minor)
            continue;
        qdot_text_add(s, some ? "," : "");
        some = true;
        if (labels) {
            qdot_text_char(s, '$');
            tikz_add_number(s, tics[i].label);
            qdot_text_char(s, '$');
        } else {
            qdot_text_double(s, tics[i].at, DIGITS);
        }
    }
    qdot_text_char(s, '}');
}

/* Append range, tics and label of axis k; bare: without numbers and label, which the panel below has. */
static void
tikz_add_axis(qdot_text *s, char name, const qdot_figure_axis *a, const qdot_figure_label *label,
              const char *unit, bool bare)
{
    char option[] = "xmin";
    qdot_figure_tic tics[QDOT_FIGURE_TICS];
    const size_t n = qdot_figure_find_tics(a, tics);

    option[0] = name;
    if (a->log || a->step > 0) {
        add_option(s, option, a->least, "");
        add_option(s, memcpy(option, (char[]){name, 'm', 'a', 'x'}, 4), a->most, "");
    }
    if (a->log)
        qdot_text_format(s, "  %cmode=log,\n", name);
    if (n > 0) {
        qdot_text_format(s, "  %ctick=", name);
        add_tic_list(s, tics, n, false, false);
        qdot_text_format(s, ", %cticklabels=", name);
        if (bare)
            qdot_text_add(s, "{}");
        else
            add_tic_list(s, tics, n, false, true);
        qdot_text_add(s, ",\n");
        if (a->log) {
            qdot_text_format(s, "  minor %ctick=", name);
            add_tic_list(s, tics, n, true, false);
            qdot_text_add(s, ",\n");
        }
    }
    if (bare || ((label->text == NULL || label->text[0] == '\0') && a->power == 0 && a->offset_text[0] == '\0'))
        return;
    qdot_text_format(s, "  %clabel=", name);
    tikz_add_axis_label(s, name, a, label, unit);
    qdot_text_add(s, ",\n");
}

static void
tikz_add_map_options(qdot_text *s, const qdot_figure_map *map)
{
    double ends[2];

    qdot_figure_map_ends(map, ends);
    qdot_text_add(s, "  axis on top, colormap/viridis, colorbar,\n");
    if (ends[1] > ends[0]) {
        add_option(s, "point meta min", ends[0], "");
        add_option(s, "point meta max", ends[1], "");
    }
    if (map->label.text != NULL && map->label.text[0] != '\0') {
        qdot_text_add(s, "  colorbar style={ylabel={");
        qdot_figure_add_latex(s, &map->label);
        qdot_text_add(s, "}},\n");
    }
}

/* Append the panel's title with the note below it, above the legend if that stands above the axes. */
static void
tikz_add_title(qdot_text *s, const qdot_panel *panel)
{
    const bool titled = panel->title.text != NULL && panel->title.text[0] != '\0';
    const qdot_figure_label note = {panel->note, false};

    if (!titled && panel->note == NULL)
        return;
    qdot_text_add(s, "  title={");
    qdot_figure_add_latex(s, &panel->title);
    if (panel->note != NULL) {
        qdot_text_add(s, titled ? "\\\\{\\small " : "{\\small ");
        qdot_figure_add_latex(s, &note);
        qdot_text_char(s, '}');
    }
    qdot_text_format(s, "}, title style={align=center, yshift=%.1fem},\n",
                     panel->n < 2 || panel->n > LONG_KEY ? 0 : 1.3 * (double)((panel->n + 1) / 2));
}

static void
tikz_add_legend(qdot_text *s, const qdot_panel *panel)
{
    if (panel->n < 2)
        return;
    qdot_text_add(s, "  legend cell align=left, legend style={draw=none, font=\\small, ");
    qdot_text_add(s, panel->n > LONG_KEY ? "at={(1.02,1)}, anchor=north west},\n"
                                         : "at={(1,1.02)}, anchor=south east, legend columns=2, "
                                           "/tikz/every even column/.append style={column sep=1em}},\n");
}

/* --- curves ------------------------------------------------------------------------------- */

/* The value of a point in units of its axis, limited far beyond the axis (near a pole) for TeX's arithmetic. */
static double
value_on_axis(const qdot_figure_axis *a, double value)
{
    const double v = (value - a->offset) / pow(10, a->power), far = 20 * (a->most - a->least);

    return a->log || a->step == 0 ? v : fmin(fmax(v, a->least - far), a->most + far);
}

static void
tikz_add_colour(qdot_text *s, const char *colour)
{
    unsigned rgb = 0;

    for (const char *c = colour + 1; *c != '\0'; c++)
        rgb = 16 * rgb + (unsigned)(*c <= '9' ? *c - '0' : *c - 'a' + 10);
    qdot_text_format(s, "color={rgb,255:red,%u; green,%u; blue,%u}", rgb >> 16, rgb >> 8 & 255, rgb & 255);
}

/* Append a dash pattern like (12,5), whose unit in gnuplot is about half a point. */
static void
tikz_add_dashes(qdot_text *s, const char *c)
{
    bool on = true;
    int n = 0;

    if (*c != '(')
        return;
    qdot_text_add(s, ", dash pattern=");
    for (c++; *c != '\0'; c++) {
        if (*c >= '0' && *c <= '9') {
            n = 10 * n + *c - '0';
            continue;
        }
        qdot_text_format(s, "%s %.1fpt%s", on ? "on" : "off", 0.5 * n, *c == ')' ? "" : " ");
        on = !on;
        n = 0;
    }
}

static void
tikz_add_curve_style(qdot_text *s, const qdot_panel *panel, size_t k)
{
    const qdot_figure_style style = qdot_figure_style_of(panel, k);
    const size_t rows = panel->curves[k].rows;

    tikz_add_colour(s, style.colour);
    qdot_text_format(s, ", line width=0.8pt%s", (style.dots || style.marks) && !style.line ? ", only marks" : "");
    if (style.dots)
        qdot_text_add(s, ", mark=*, mark size=0.6pt");
    else if (style.marks)
        qdot_text_format(s, ", mark=%s, mark size=1.6pt", marks[style.look % MARKS]);
    else
        qdot_text_add(s, ", no markers");
    if (panel->marks && rows > MANY_MARKS)
        qdot_text_format(s, ", mark repeat=%zu", rows / (MANY_MARKS / 2));
    if (style.dash != NULL)
        tikz_add_dashes(s, style.dash);
}

/* Selection of the points of a curve that are written, as TeX's memory holds only some 10,000. */
typedef struct {
    const qdot_panel *panel;
    const qdot_curve *curve;
    const qdot_figure_axis *axes;
    size_t bin;  /* 1: write all points; 0: omit points that lie on a straight line; > 1: see is_extremum_of_bin */
    double near; /* if bin = 0: largest distance of an omitted point from the drawn line, as a fraction of the axes */
} choice;

/* Largest distances of omitted points from the line, as fractions of an axis: 0.05 and 0.2 mm on 10 cm. */
static const double finest = 5e-4, coarsest = 2e-3;

/* The position of point k of the curve along an axis: 0 at the axis's beginning and 1 at its end. */
static double
position_on_axis(const choice *c, int axis, size_t k)
{
    const qdot_figure_axis *a = &c->axes[axis];
    const double *values = axis == 0 ? c->curve->x : axis == 1 ? c->curve->y : c->curve->z;
    const double x = value_on_axis(a, values[k]);

    return a->log ? log(x / a->least) / log(a->most / a->least) : (x - a->least) / (a->most - a->least);
}

/* Whether all points between points `from` and `to` lie so near to the chord that they can be omitted. */
static bool
is_straight(const choice *c, size_t from, size_t to)
{
    const int axes = c->curve->z != NULL ? 3 : 2;
    double start[3], along[3], length = 0;

    for (int i = 0; i < axes; i++) {
        start[i] = position_on_axis(c, i, from);
        along[i] = position_on_axis(c, i, to) - start[i];
        length += along[i] * along[i];
    }
    for (size_t k = from + 1; k <= to; k++) {
        double part = 0, apart = 0;

        if (!qdot_figure_shows(c->panel, c->curve, k))
            return false;
        for (int i = 0; i < axes; i++)
            part += (position_on_axis(c, i, k) - start[i]) * along[i];
        part = length > 0 ? fmin(fmax(part / length, 0), 1) : 0;
        for (int i = 0; i < axes; i++)
            apart += pow(position_on_axis(c, i, k) - start[i] - part * along[i], 2);
        if (!(apart <= c->near * c->near))
            return false;
    }
    return true;
}

/* Whether point k has the least or greatest y among the c->bin consecutive points of its group. */
static bool
is_extremum_of_bin(const choice *c, size_t k)
{
    const qdot_curve *curve = c->curve;
    const size_t from = k - k % c->bin, to = from + c->bin < curve->rows ? from + c->bin : curve->rows;
    size_t least = to, most = to;

    for (size_t i = from; i < to; i++) {
        if (!qdot_figure_shows(c->panel, curve, i))
            return true;
        least = least == to || curve->y[i] < curve->y[least] ? i : least;
        most = most == to || curve->y[i] > curve->y[most] ? i : most;
    }
    return k == least || k == most || k + 1 == curve->rows;
}

/* The index of the next point to be written after point k; points that cannot be drawn are stepped through singly. */
static size_t
next_point(const choice *c, size_t k)
{
    enum { MOST_BETWEEN = 64 };
    size_t next = k + 1;

    if (c->bin > 1)
        while (next < c->curve->rows && !is_extremum_of_bin(c, next))
            next++;
    if (c->bin == 0 && qdot_figure_shows(c->panel, c->curve, k))
        while (next + 1 < c->curve->rows && next - k < MOST_BETWEEN && is_straight(c, k, next + 1))
            next++;
    return next;
}

/* Whether x is monotonic along a plane curve, so that a group of consecutive points is a narrow vertical strip. */
static bool
is_monotonic_in_x(const qdot_curve *curve)
{
    bool up = true, down = true;

    for (size_t k = 1; k < curve->rows; k++) {
        up = up && !(curve->x[k] < curve->x[k - 1]);
        down = down && !(curve->x[k] > curve->x[k - 1]);
    }
    return curve->z == NULL && (up || down);
}

/* Count the points to be written, but not beyond `most` + 1. */
static qdot_status
count_points(const choice *c, size_t most, size_t *n)
{
    *n = 0;
    for (size_t k = 0; k < c->curve->rows && *n <= most; k = next_point(c, k))
        if (++*n % BLOCK == 0)
            QDOT_TRY(qdot_interrupt_check());
    return QDOT_OK;
}

/* Choose the points: all of a few and of marks; else those that the line needs, or if these are too many, as of a curve
 * that goes up and down within a line's width, the ends of its strips. A long path has all that it needs. */
static qdot_status
choose_points(choice *c)
{
    const qdot_panel *panel = c->panel;
    const bool graph = is_monotonic_in_x(c->curve);
    const size_t curves = panel->n < LEAST_CURVES && graph ? LEAST_CURVES : panel->n, most = MOST_POINTS / curves;
    size_t n;

    c->bin = c->curve->rows <= most || panel->points || panel->marks || c->curve->points ? 1 : 0;
    if (c->bin > 0)
        return QDOT_OK;
    c->near = finest;
    QDOT_TRY(count_points(c, most, &n));
    while (n > most && c->near < coarsest) {
        c->near *= 2;
        QDOT_TRY(count_points(c, most, &n));
    }
    if (n > most && graph)
        c->bin = 2 * c->curve->rows / most + 1;
    return QDOT_OK;
}

/* Append the points of a curve, with nan where the line is interrupted. */
static qdot_status
tikz_add_points(qdot_text *s, const qdot_panel *panel, const qdot_curve *curve, const qdot_figure_axis *axes)
{
    choice chosen = {.panel = panel, .curve = curve, .axes = axes};
    bool open = false;
    size_t n = 0;

    QDOT_TRY(choose_points(&chosen));
    for (size_t k = 0; k < curve->rows; k = next_point(&chosen, k)) {
        const double point[3] = {curve->x[k], curve->y[k], curve->z != NULL ? curve->z[k] : 0};

        if (!qdot_figure_shows(panel, curve, k)) {
            qdot_text_add(s, open ? curve->z != NULL ? " (nan,nan,nan)" : " (nan,nan)" : "");
            open = false;
            continue;
        }
        if (n % BLOCK == BLOCK - 1)
            QDOT_TRY(qdot_interrupt_check());
        qdot_text_add(s, n++ % IN_A_LINE == 0 ? "\n    (" : " (");
        for (int i = 0; i < (curve->z != NULL ? 3 : 2); i++) {
            qdot_text_add(s, i > 0 ? "," : "");
            qdot_text_double(s, value_on_axis(&axes[i], point[i]), DIGITS);
        }
        qdot_text_char(s, ')');
        open = true;
    }
    return qdot_text_status(s);
}

static qdot_status
tikz_add_curves(qdot_text *s, const qdot_panel *panel, const qdot_figure_axis *axes)
{
    for (size_t k = 0; k < panel->n; k++) {
        const qdot_curve *curve = &panel->curves[k];
        const qdot_figure_label label = qdot_figure_curve_label(panel, k);

        qdot_text_format(s, "  \\addplot%s[", qdot_figure_is_space(panel) ? "3" : "");
        tikz_add_curve_style(s, panel, k);
        qdot_text_add(s, "] coordinates {");
        QDOT_TRY(tikz_add_points(s, panel, curve, axes));
        qdot_text_add(s, "\n  };\n");
        if (panel->n < 2)
            continue;
        qdot_text_add(s, "  \\addlegendentry{");
        qdot_figure_add_latex(s, &label);
        qdot_text_add(s, "}\n");
    }
    return qdot_text_status(s);
}

static qdot_status
tikz_add_map_cells(qdot_text *s, const qdot_figure_map *map, const qdot_figure_axis *axes)
{
    qdot_text_format(s, "  \\addplot[matrix plot*, mesh/cols=%zu, point meta=explicit] coordinates {", map->n[0]);
    for (size_t j = 0; j < map->n[1]; j++) {
        QDOT_TRY(qdot_interrupt_check());
        for (size_t i = 0; i < map->n[0]; i++) {
            const double v = map->value[j * map->n[0] + i];

            qdot_text_add(s, i % IN_A_LINE == 0 ? "\n    (" : " (");
            qdot_text_double(s, value_on_axis(&axes[0], qdot_figure_map_place(map, 0, i)), DIGITS);
            qdot_text_char(s, ',');
            qdot_text_double(s, value_on_axis(&axes[1], qdot_figure_map_place(map, 1, j)), DIGITS);
            qdot_text_add(s, ") [");
            if (isfinite(v))
                qdot_text_double(s, v, DIGITS);
            else
                qdot_text_add(s, "nan");
            qdot_text_char(s, ']');
        }
        qdot_text_char(s, '\n');
    }
    qdot_text_add(s, "  };\n");
    return qdot_text_status(s);
}

/* --- panels ------------------------------------------------------------------------------- */

/* Append the axes of a panel, sizes in cm, their upper left corner `top` below that of the figure. */
static qdot_status
tikz_add_panel(const qdot_figure_drawing *d, size_t i, double top)
{
    const qdot_panel *panel = &d->figure->panels[i];
    const bool space = qdot_figure_is_space(panel), shared = qdot_figure_is_shared(d->figure, i);
    qdot_text *s = d->script;
    qdot_figure_axis axes[3];
    qdot_figure_view view;

    QDOT_TRY(qdot_figure_get_view(d->figure, i, &view));
    QDOT_TRY(qdot_figure_choose_axes(d, i, axes));
    qdot_text_add(s, "\\begin{axis}[\n  at={(0cm,");
    qdot_text_double(s, top > 0 ? -top : 0, DIGITS);
    qdot_text_add(s, "cm)}, anchor=north west,\n");
    if (space) {
        add_option(s, "width", d->width, "cm");
        qdot_text_format(s, "  view={%d}{%d}, axis equal image,\n", QDOT_FIGURE_TURN, 90 - QDOT_FIGURE_TILT);
    } else {
        qdot_text_add(s, "  scale only axis,\n");
        add_option(s, "width", view.length[0], "cm");
        add_option(s, "height", view.length[1], "cm");
        qdot_text_add(s, panel->map != NULL ? "  enlargelimits=false, tick align=outside,\n"
                                            : "  axis lines=left, axis line style={-}, tick align=outside, grid=major, "
                                              "grid style={black!12},\n");
    }
    qdot_text_add(s, "  unbounded coords=jump, xticklabel style={text height=1.5ex},\n");
    tikz_add_title(s, panel);
    for (int k = 0; k < (space ? 3 : 2); k++)
        tikz_add_axis(s, "xyz"[k], &axes[k], &panel->axis[k], panel->unit[k], k == 0 && shared);
    if (panel->map != NULL)
        tikz_add_map_options(s, panel->map);
    tikz_add_legend(s, panel);
    qdot_text_add(s, "]\n");
    QDOT_TRY(panel->map != NULL ? tikz_add_map_cells(s, panel->map, axes) : tikz_add_curves(s, panel, axes));
    qdot_text_add(s, "\\end{axis}\n");
    return qdot_text_status(s);
}

qdot_status
qdot_figure_add_tikz(const qdot_figure_drawing *d)
{
    qdot_text_add(d->script, head);
    qdot_text_add(d->script, "\\begin{tikzpicture}\n");
    for (size_t i = 0; i < d->figure->n; i++)
        QDOT_TRY(tikz_add_panel(d, i, d->height / (double)d->figure->n * (double)i));
    qdot_text_add(d->script, "\\end{tikzpicture}\n");
    return qdot_text_status(d->script);
}
