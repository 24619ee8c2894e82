/* sketch.c -- draws curves with characters: a braille character has 2 x 4 dots. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/utf8.h"
#include "show/figure-parts.h"

enum { ACROSS = 2, DOWN = 4, MARGIN = 11 };

typedef struct {
    size_t columns, rows;
    unsigned char *cells; /* the dots of braille, U+2800 + cell */
    unsigned char *looks; /* of each cell: 1 + the look of the curve drawn there last */
    size_t look;          /* of the present curve */
    bool solid;           /* without gaps: marks differ */
    long last[2], along;  /* its last dot, and how many there were before */
} grid;

/* Curves differ in dashes; in ASCII in their marks. */
enum { LOOKS = 4, DASHES = 8 };
static const char marks[LOOKS + 1] = "*+ox";
static const char dashes[LOOKS][DASHES + 1] = {"********", "*****   ", "*   *   ", "***** * "};

/* Set dot (x, y), with y counted from above, unless it falls into a gap of the curve's pattern. */
static void
grid_put(grid *g, double x, double y)
{
    static const unsigned char bits[DOWN][ACROSS] = {
        {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    long i = lround(x), j = lround(y);

    if (i != g->last[0] || j != g->last[1])
        g->along++;
    g->last[0] = i;
    g->last[1] = j;
    if (i < 0 || j < 0 || i >= (long)(ACROSS * g->columns) || j >= (long)(DOWN * g->rows) ||
        (!g->solid && dashes[g->look][g->along % DASHES] == ' '))
        return;
    g->cells[(size_t)j / DOWN * g->columns + (size_t)i / ACROSS] |= bits[j % DOWN][i % ACROSS];
    g->looks[(size_t)j / DOWN * g->columns + (size_t)i / ACROSS] = (unsigned char)(g->look + 1);
}

/* A path in space is seen from in front, to the right and above. */
static void
grid_place(const qdot_figure_view *v, const qdot_curve *c, size_t k, const grid *g, double *at)
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
        grid_put(g, a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n);
}

static void
draw_curve(grid *g, const qdot_panel *panel, const qdot_figure_view *v, const qdot_curve *c)
{
    double last[2], here[2];
    bool open = false;

    for (size_t k = 0; k < c->rows; k++) {
        if (!qdot_figure_shows(panel, c, k)) {
            open = false;
            continue;
        }
        grid_place(v, c, k, g, here);
        if (open)
            draw_line(g, last, here);
        grid_put(g, here[0], here[1]);
        memcpy(last, here, sizeof last);
        open = !c->points;
    }
}

/* Draw a map in halftones; in ASCII a whole character is black or not. */
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
                grid_put(g, (double)i, (double)j);
        }
}

static void
sketch_add_cell(qdot_text *out, unsigned char dots, size_t look, bool ascii)
{
    if (ascii || dots == 0) {
        qdot_text_char(out, dots != 0 ? marks[look] : ' ');
        return;
    }
    qdot_text_char(out, '\xE2');
    qdot_text_char(out, (char)(0xA0 + (dots >> 6)));
    qdot_text_char(out, (char)(0x80 + (dots & 0x3F)));
}

static void
add_label(qdot_text *out, const qdot_figure_label *label, bool ascii)
{
    if (label->formula && !ascii)
        qdot_figure_add_formula(out, label->text, false);
    else
        qdot_text_add(out, label->text != NULL ? label->text : "");
}

/* Write the key, which shows the pattern of each curve. */
static void
write_key(const qdot_panel *panel, bool ascii, qdot_text *out)
{
    static const char *const lines[LOOKS] = {"⠒⠒⠒⠒⠒⠒⠒", "⠒⠒⠂ ⠒⠒⠂", "⠂ ⠂ ⠂ ⠂", "⠒⠒⠂⠂⠒⠒⠂"};

    qdot_text_format(out, "%*s", MARGIN, "");
    for (size_t k = 0; k < panel->n; k++) {
        if (ascii)
            qdot_text_format(out, "%s%c ", k > 0 ? "   " : "", marks[k % LOOKS]);
        else
            qdot_text_format(out, "%s%s ", k > 0 ? "   " : "", lines[k % LOOKS]);
        add_label(out, &panel->curves[k].label, ascii);
    }
    qdot_text_char(out, '\n');
}

/* Write the sketch, with the ends of the vertical axis on the left and of the horizontal one below. */
static void
sketch_write(const grid *g, const qdot_panel *panel, const qdot_figure_view *v, bool ascii,
             qdot_text *out)
{
    char left[32], right[32];
    qdot_text label = {0};
    long free;

    for (size_t r = 0; r < g->rows; r++) {
        size_t n = g->columns;

        if (r == 0 || r + 1 == g->rows) {
            snprintf(left, sizeof left, "%.4g", r == 0 ? v->most[1] : v->least[1]);
            qdot_text_format(out, "%*s ", MARGIN - 1, panel->axis[2].text ? "" : left);
        } else {
            qdot_text_format(out, "%*s", MARGIN, "");
        }
        qdot_text_add(out, ascii ? "|" : "│");
        while (n > 0 && g->cells[r * g->columns + n - 1] == 0)
            n--;
        for (size_t i = 0; i < n; i++)
            sketch_add_cell(out, g->cells[r * g->columns + i],
                            (size_t)fmax(g->looks[r * g->columns + i] - 1.0, 0), ascii);
        qdot_text_char(out, '\n');
    }
    if (panel->axis[2].text != NULL)
        return;
    snprintf(left, sizeof left, "%.4g", v->least[0]);
    snprintf(right, sizeof right, "%.4g", v->most[0]);
    add_label(&label, &panel->axis[0], ascii);
    free = (long)g->columns - (long)strlen(left) - (long)strlen(right);
    if (free < (long)qdot_utf8_columns(qdot_text_str(&label), label.n))
        qdot_text_truncate(&label, 0); /* the numbers say more */
    free = (long)fmax((double)free - (double)qdot_utf8_columns(qdot_text_str(&label), label.n), 0);
    qdot_text_format(out, "%*s%s%*s%s%*s%s\n", MARGIN + 1, "", left, (int)(free / 2 + 1), "",
                     qdot_text_str(&label), (int)(free - free / 2), "", right);
    out->failed = out->failed || label.failed;
    qdot_text_clear(&label);
}

qdot_status
qdot_figure_sketch(const qdot_figure *figure, size_t i, size_t columns, size_t rows,
                   bool ascii, qdot_text *out)
{
    const qdot_panel *panel = &figure->panels[i];
    grid g = {.columns = columns > 30 ? columns - 14 : 16, .rows = rows > 5 ? rows - 2 : 3,
              .solid = ascii};
    qdot_figure_view view;

    QDOT_TRY(qdot_figure_get_view(figure, i, &view));
    g.cells = qdot_calloc(g.columns * g.rows, 2);
    if (g.cells == NULL)
        return QDOT_ENOMEM;
    g.looks = g.cells + g.columns * g.rows;
    if (panel->map != NULL)
        draw_map(&g, panel->map, ascii);
    for (size_t k = 0; k < panel->n; k++) {
        g.look = k % LOOKS;
        g.along = 0;
        g.last[0] = g.last[1] = -1;
        draw_curve(&g, panel, &view, &panel->curves[k]);
    }
    if (panel->n > 1 || (figure->n > 1 && panel->map == NULL))
        write_key(panel, ascii, out);
    sketch_write(&g, panel, &view, ascii, out);
    qdot_free(g.cells);
    return qdot_text_status(out);
}
