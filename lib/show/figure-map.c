/* figure-map.c -- draws numbers over a grid as colours: data, palette, dithering of a sketch. */
#include <math.h>

#include "base/interrupt.h"
#include "show/figure-parts.h"

/* Dark to light: legible on grey paper and by eyes that do not see all colours. From Matplotlib's
 * viridis (N. Smith, S. van der Walt, E. Firing, 2015; public domain), every eighth of it. */
static const unsigned palette[] = {0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0xb4de2c, 0xfde725};

enum { PALETTE = sizeof palette / sizeof *palette };

void
qdot_figure_map_colour(double part, char colour[8])
{
    const double at = fmin(fmax(part, 0), 1) * (PALETTE - 1);
    const int low = (int)fmin(at, PALETTE - 2);
    unsigned rgb = 0;

    for (int shift = 16; shift >= 0; shift -= 8) {
        const double from = palette[low] >> shift & 255, to = palette[low + 1] >> shift & 255;

        rgb |= (unsigned)lround(from + (at - low) * (to - from)) << shift;
    }
    snprintf(colour, 8, "#%06x", rgb & 0xffffff);
}

double
qdot_figure_map_place(const qdot_figure_map *map, int axis, size_t i)
{
    const double n = (double)map->n[axis] - 1;

    return n > 0 ? map->least[axis] + (map->most[axis] - map->least[axis]) * ((double)i / n)
                 : map->least[axis];
}

/* Half the width of a cell of the grid, along an axis. */
static double
half_cell_width(const qdot_figure_map *map, int axis)
{
    return map->n[axis] > 1
               ? (map->most[axis] - map->least[axis]) / (2 * ((double)map->n[axis] - 1))
               : 0.5;
}

void
qdot_figure_map_edges(const qdot_figure_map *map, int axis, double *least, double *most)
{
    *least = map->least[axis] - half_cell_width(map, axis);
    *most = map->most[axis] + half_cell_width(map, axis);
}

qdot_status
qdot_figure_map_add_data(const qdot_figure_map *map, qdot_text *out)
{
    for (size_t j = 0; j < map->n[1]; j++) {
        QDOT_TRY(qdot_interrupt_check());
        for (size_t i = 0; i < map->n[0]; i++) {
            const double v = map->value[j * map->n[0] + i];

            qdot_text_double(out, qdot_figure_map_place(map, 0, i), 12);
            qdot_text_char(out, ' ');
            qdot_text_double(out, qdot_figure_map_place(map, 1, j), 12);
            if (isfinite(v)) {
                qdot_text_char(out, ' ');
                qdot_text_double(out, v, 7);
                qdot_text_char(out, '\n');
            } else {
                qdot_text_add(out, " NaN\n");
            }
        }
    }
    return qdot_text_status(out);
}

void
qdot_figure_map_ends(const qdot_figure_map *map, double *ends)
{
    bool any = false;

    ends[0] = ends[1] = 0;
    for (size_t k = 0; k < map->n[0] * map->n[1]; k++) {
        const double v = map->value[k];

        if (!isfinite(v))
            continue;
        ends[0] = any ? fmin(ends[0], v) : v;
        ends[1] = any ? fmax(ends[1], v) : v;
        any = true;
    }
}

void
qdot_figure_map_add_colours(const qdot_figure_map *map, qdot_text *script)
{
    double ends[2];

    for (int i = 0; i < PALETTE; i++)
        qdot_text_format(script, "%s%d '#%06x'", i == 0 ? "set palette defined (" : ", ", i, palette[i]);
    qdot_text_add(script, ")\n");
    qdot_figure_map_ends(map, ends);
    if (ends[0] == ends[1]) {
        ends[0] -= 1;
        ends[1] += 1;
    }
    qdot_text_add(script, "set datafile missing\nset minussign\nset colorbox\nset cbtics nomirror\nset cbrange [");
    qdot_text_double(script, ends[0], 17);
    qdot_text_char(script, ':');
    qdot_text_double(script, ends[1], 17);
    qdot_text_add(script, "]\nset cblabel ");
    qdot_figure_add_label(script, &map->label);
    qdot_text_char(script, '\n');
}

/* Brightness thresholds of an ordered dither for 4 x 4 points, in sixteenths. */
static const int thresholds[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

bool
qdot_figure_map_dot(const qdot_figure_map *map, const double *ends, const double *part, size_t i,
                    size_t j)
{
    double v;
    size_t at[2];

    for (int k = 0; k < 2; k++)
        at[k] = (size_t)fmin(fmax(part[k], 0) * (double)map->n[k], (double)map->n[k] - 1);
    v = map->value[at[1] * map->n[0] + at[0]];
    if (!isfinite(v))
        return false;
    v = ends[1] > ends[0] ? (v - ends[0]) / (ends[1] - ends[0]) : 1;
    return 16 * v > thresholds[j % 4][i % 4] + 0.5;
}
