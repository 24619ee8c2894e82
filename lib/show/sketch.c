/* sketch.c -- draws curves with characters: a braille character has 2 x 4 dots. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/utf8.h"
#include "show/figure-parts.h"

enum { ACROSS = 2, DOWN = 4, MARGIN = 11, END_TEXT = 32 };

typedef struct {
    size_t columns, rows;
    unsigned char *cells; /* [rows x columns] braille dots: the character is U+2800 + cell */
    unsigned char *looks; /* [rows x columns] 1 + the curve drawn there last, up to CURVES; 0: none */
    size_t look;          /* index of the curve being drawn */
    bool solid;           /* draw lines without gaps, as the curves differ by their marks */
    int64_t last[2], along;  /* the last dot drawn of a curve, and the number of dots before it */
} grid;

/* Curves are told apart by dashes, in ASCII by marks, on a terminal with colours by colours. */
enum { LOOKS = 4, DASHES = 8, CURVES = 252 };
static const char marks[LOOKS + 1] = "*+ox";
static const char dashes[LOOKS][DASHES + 1] = {"********", "*****   ", "*   *   ", "***** * "};

/* Set the dot at (x, y), y counted from the top, unless it falls into a gap of the curve's dash pattern. */
static void
set_dot(grid *g, double x, double y)
{
    static const unsigned char bits[DOWN][ACROSS] = {
        {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    int64_t i = llround(x), j = llround(y);

    if (i != g->last[0] || j != g->last[1])
        g->along++;
    g->last[0] = i;
    g->last[1] = j;
    if (i < 0 || j < 0 || i >= (int64_t)(ACROSS * g->columns) || j >= (int64_t)(DOWN * g->rows) ||
        (!g->solid && dashes[g->look % LOOKS][g->along % DASHES] == ' '))
        return;
    g->cells[(size_t)j / DOWN * g->columns + (size_t)i / ACROSS] |= bits[j % DOWN][i % ACROSS];
    g->looks[(size_t)j / DOWN * g->columns + (size_t)i / ACROSS] = (unsigned char)(g->look % CURVES + 1);
}

/* Find the place of a point on the grid; a path in space is seen from the front, the right and above. */
static void
find_grid_position(const qdot_figure_view *v, const qdot_curve *c, size_t k, const grid *g, double *at)
{
    double part[3] = {0, 0, 0};
    const double x[3] = {c->x[k], c->y[k], c->z != NULL ? c->z[k] : 0};

    for (int i = 0; i < (c->z != NULL ? 3 : 2); i++)
        part[i] = v->log[i] ? log(x[i] / v->least[i]) / log(v->most[i] / v->least[i])
                            : (x[i] - v->least[i]) / (v->most[i] - v->least[i]);
    if (c->z != NULL) {
        const double across = (part[0] - part[1] + 1) / 2;

        part[1] = (part[0] + part[1]) / 4 + part[2] / 2;
        part[0] = across;
    }
    at[0] = part[0] * (double)(ACROSS * g->columns - 1);
    at[1] = (1 - part[1]) * (double)(DOWN * g->rows - 1);
}

static void
draw_line(grid *g, const double *a, const double *b)
{
    const double n = ceil(fmax(fabs(b[0] - a[0]), fabs(b[1] - a[1])));
    const double most = (double)(ACROSS * g->columns + DOWN * g->rows);

    for (double k = 0; k <= n && n < 8 * most; k++)
        set_dot(g, a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n);
}

static void
draw_curve(grid *g, const qdot_panel *panel, const qdot_figure_view *v, size_t curve)
{
    const qdot_curve *c = &panel->curves[curve];
    const bool line = qdot_figure_style_of(panel, curve).line;
    double last[2], here[2];
    bool open = false;

    for (size_t k = 0; k < c->rows; k++) {
        if (!qdot_figure_shows(panel, c, k)) {
            open = false;
            continue;
        }
        find_grid_position(v, c, k, g, here);
        if (open)
            draw_line(g, last, here);
        set_dot(g, here[0], here[1]);
        memcpy(last, here, sizeof last);
        open = line;
    }
}

/* Draw a map in halftones; in ASCII a character cell is wholly black or blank. */
static void
draw_map(grid *g, const qdot_figure_map *map, bool ascii)
{
    const size_t across = ACROSS * g->columns, down = DOWN * g->rows;
    double ends[2];

    qdot_figure_map_ends(map, ends);
    g->solid = true;
    for (size_t j = 0; j < down; j++)
        for (size_t i = 0; i < across; i++) {
            const size_t x = ascii ? i / ACROSS * ACROSS : i, y = ascii ? j / DOWN * DOWN : j;
            const double part[2] = {((double)x + 0.5) / (double)across,
                                    1 - ((double)y + 0.5) / (double)down};

            if (qdot_figure_map_dot(map, ends, part, ascii ? x / ACROSS : x, ascii ? y / DOWN : y))
                set_dot(g, (double)i, (double)j);
        }
}

static void
sketch_add_cell(qdot_text *out, unsigned char dots, size_t look, bool ascii)
{
    if (ascii || dots == 0) {
        qdot_text_char(out, dots != 0 ? marks[look % LOOKS] : ' ');
        return;
    }
    qdot_text_char(out, '\xE2');
    qdot_text_char(out, (char)(0xA0 + (dots >> 6)));
    qdot_text_char(out, (char)(0x80 + (dots & 0x3F)));
}

/* Write a row of the grid, without blanks at its end; panel: whose curves have colours (else NULL). */
static void
sketch_add_row(const grid *g, size_t row, bool ascii, const qdot_panel *panel, qdot_text *out)
{
    const unsigned char *cells = g->cells + row * g->columns, *looks = g->looks + row * g->columns;
    size_t n = g->columns, shown = 0;

    while (n > 0 && cells[n - 1] == 0)
        n--;
    for (size_t i = 0; i < n; i++) {
        if (panel != NULL && looks[i] > 0 && looks[i] != shown)
            qdot_text_format(out, "\033[%sm", qdot_figure_terminal_colour(panel, looks[i] - 1u));
        shown = looks[i] > 0 ? looks[i] : shown;
        sketch_add_cell(out, cells[i], (size_t)fmax(looks[i] - 1.0, 0), ascii);
    }
    qdot_text_add(out, panel != NULL && shown > 0 ? "\033[39m" : "");
}

static void
sketch_add_label(qdot_text *out, const qdot_figure_label *label, bool ascii)
{
    if (label->formula && !ascii)
        qdot_figure_add_line(out, label->text);
    else
        qdot_text_add(out, label->text != NULL ? label->text : "");
}

/* The label of axis k with its unit. */
static void
sketch_add_axis_label(qdot_text *out, const qdot_panel *panel, int k, bool ascii)
{
    sketch_add_label(out, &panel->axis[k], ascii);
    if (out->n > 0 && panel->unit[k] != NULL)
        qdot_text_format(out, " [%s]", panel->unit[k]);
}

/* Write the legend, which shows the dash pattern or the colour of each curve. */
static void
sketch_write_legend(const qdot_panel *panel, const qdot_figure_sketching *how, qdot_text *out)
{
    static const char *const lines[LOOKS] = {"⠒⠒⠒⠒⠒⠒⠒", "⠒⠒⠂ ⠒⠒⠂", "⠂ ⠂ ⠂ ⠂", "⠒⠒⠂⠂⠒⠒⠂"};

    qdot_figure_label label;

    qdot_text_format(out, "%*s", MARGIN, "");
    for (size_t k = 0; k < panel->n; k++) {
        qdot_text_add(out, k > 0 ? "   " : "");
        if (how->colours)
            qdot_text_format(out, "\033[%sm", qdot_figure_terminal_colour(panel, k));
        if (how->ascii)
            qdot_text_char(out, marks[k % LOOKS]);
        else
            qdot_text_add(out, lines[how->colours ? 0 : k % LOOKS]);
        qdot_text_add(out, how->colours ? "\033[39m " : " ");
        label = qdot_figure_curve_label(panel, k);
        sketch_add_label(out, &label, how->ascii);
    }
    qdot_text_char(out, '\n');
}

/* Write the ends of an axis with four digits, or with as many as make them differ if there is room. */
static void
write_axis_ends(double least, double most, size_t room, char text[2][END_TEXT])
{
    int digits = 4;

    do {
        snprintf(text[0], END_TEXT, "%.*g", digits, least);
        snprintf(text[1], END_TEXT, "%.*g", digits, most);
    } while (strcmp(text[0], text[1]) == 0 && digits++ < 17);
    if (digits > 4 && (strlen(text[0]) > room || strlen(text[1]) > room)) {
        snprintf(text[0], END_TEXT, "%.4g", least);
        snprintf(text[1], END_TEXT, "%.4g", most);
    }
}

/* Write a number or label at the left of the axis, padded to the width of the margin. */
static void
write_left_margin(size_t margin, const char *text, qdot_text *out)
{
    const size_t n = qdot_utf8_columns(text, strlen(text));

    qdot_text_format(out, "%*s%s ", (int)(n < margin ? margin - 1 - n : 0), "", text);
}

/* Write what a map shows: its label, and the values at which it is light and dense. */
static void
write_map_scale(const qdot_figure_map *map, bool ascii, qdot_text *out)
{
    char text[2][END_TEXT];
    double ends[2];

    qdot_figure_map_ends(map, ends);
    write_axis_ends(ends[0], ends[1], END_TEXT, text);
    qdot_text_format(out, "%*s", MARGIN, "");
    sketch_add_label(out, &map->label, ascii);
    qdot_text_format(out, ": %s %s, %s %s\n", ascii ? "blank" : "⠁", text[0], ascii ? "*" : "⣿", text[1]);
}

/* Write the sketch: on the left the ends of the vertical axis and, of a single curve or a map, its name; below those of the
 * horizontal one. */
static void
sketch_write(const grid *g, const qdot_panel *panel, const qdot_figure_view *v, const qdot_figure_sketching *how,
             size_t margin, qdot_text *out)
{
    const bool space = panel->axis[2].text != NULL, named = !space && (panel->n == 1 || panel->map != NULL) && g->rows > 2;
    const bool coloured = how->colours && (panel->n > 1 || panel->n_colours > 0);
    char ends[2][END_TEXT];
    qdot_text label = {0};
    int64_t free;

    write_axis_ends(v->least[1], v->most[1], margin - 1, ends);
    if (named)
        sketch_add_axis_label(&label, panel, 1, how->ascii);
    if (qdot_utf8_columns(qdot_text_str(&label), label.n) >= margin)
        qdot_text_truncate(&label, 0);
    for (size_t r = 0; r < g->rows; r++) {
        const char *text = r == 0 ? ends[1] : r + 1 == g->rows ? ends[0] : r == g->rows / 2 ? qdot_text_str(&label) : "";

        write_left_margin(margin, space ? "" : text, out);
        qdot_text_add(out, how->ascii ? "|" : "│");
        sketch_add_row(g, r, how->ascii, coloured ? panel : NULL, out);
        qdot_text_char(out, '\n');
    }
    qdot_text_truncate(&label, 0);
    if (space)
        return;
    write_axis_ends(v->least[0], v->most[0], g->columns / 2 - 2, ends);
    sketch_add_axis_label(&label, panel, 0, how->ascii);
    free = (int64_t)g->columns - (int64_t)strlen(ends[0]) - (int64_t)strlen(ends[1]);
    if (free < (int64_t)qdot_utf8_columns(qdot_text_str(&label), label.n))
        qdot_text_truncate(&label, 0); /* without room for both, leave out the label: the numbers are more important */
    free = (int64_t)fmax((double)free - (double)qdot_utf8_columns(qdot_text_str(&label), label.n), 0);
    qdot_text_format(out, "%*s%s%*s%s%*s%s\n", (int)margin + 1, "", ends[0], (int)(free / 2 + 1), "",
                     qdot_text_str(&label), (int)(free - free / 2), "", ends[1]);
    out->failed = out->failed || label.failed;
    qdot_text_clear(&label);
}

/* The number of columns left of the vertical axis: as many as the numbers need, if the plot keeps most columns. */
static size_t
margin_width(const qdot_panel *panel, const qdot_figure_view *v, size_t columns)
{
    char ends[2][END_TEXT];
    size_t n = MARGIN;

    write_axis_ends(v->least[1], v->most[1], columns / 2 - 2, ends);
    for (int k = 0; k < 2 && panel->axis[2].text == NULL; k++)
        n = strlen(ends[k]) + 1 > n ? strlen(ends[k]) + 1 : n;
    return n;
}

qdot_status
qdot_figure_sketch(const qdot_figure *figure, size_t i, const qdot_figure_sketching *how, qdot_text *out)
{
    const qdot_panel *panel = &figure->panels[i];
    qdot_figure_view view;
    size_t margin;
    grid g = {.rows = how->rows > 5 ? how->rows - 2 : 3, .solid = how->ascii || how->colours};

    QDOT_TRY(qdot_figure_get_view(figure, i, &view));
    margin = margin_width(panel, &view, how->columns);
    g.columns = how->columns > margin + 19 ? how->columns - margin - 3 : 16;
    g.cells = qdot_calloc(g.columns * g.rows, 2);
    if (g.cells == NULL)
        return QDOT_ENOMEM;
    g.looks = g.cells + g.columns * g.rows;
    if (panel->map != NULL)
        draw_map(&g, panel->map, how->ascii);
    for (size_t k = 0; k < panel->n; k++) {
        g.look = k;
        g.along = 0;
        g.last[0] = g.last[1] = -1;
        draw_curve(&g, panel, &view, k);
    }
    if (panel->n > 1 || (figure->n > 1 && panel->map == NULL))
        sketch_write_legend(panel, how, out);
    if (panel->map != NULL)
        write_map_scale(panel->map, how->ascii, out);
    sketch_write(&g, panel, &view, how, margin, out);
    qdot_free(g.cells);
    return qdot_text_status(out);
}
