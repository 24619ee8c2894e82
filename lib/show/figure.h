/* figure.h -- curves as a figure: panels one below the other, drawn by gnuplot or as a sketch of
 * characters.
 *
 * Knows numbers and labels, not scenes. Labels and file names reach gnuplot quoted; numbers are
 * written in the C locale. Sizes are those of the printed figure: letters of 8 to 14 points, so
 * that a figure is legible in a column of a journal and on a wall.
 *
 * Tests  tests/show/test_figure.c, tests/script/figures/figures.sh
 */
#ifndef QDOT_SHOW_FIGURE_H
#define QDOT_SHOW_FIGURE_H

#include <stddef.h>

#include "base/text.h"

/* A text as it stands, or a formula in plain style, which is set with Greek letters, dots,
 * subscripts and powers: theta1' as θ̇₁, V_eff as V with its subscript. text NULL: none. */
typedef struct {
    const char *text; /* the text in UTF-8, borrowed */
    bool formula;
} qdot_figure_label;

/* The range of an axis, least < most; `set` false: chosen from the data. */
typedef struct {
    double least, most;
    bool set;
} qdot_figure_range;

typedef struct {
    qdot_figure_label label;  /* name in the legend; a single curve has no legend */
    size_t rows;
    const double *x, *y, *z;  /* [rows] borrowed; z NULL: in the plane */
    size_t look;              /* 1 + index in the lists of colours, dashes and marks; 0: the curve's own index in the panel */
    bool points;              /* draw separate marks, not joined by a line */
    qdot_figure_range shown;  /* if y grows to infinity: the range of y from which the axis is chosen */
} qdot_curve;

/* Numbers over a grid, drawn as colours. */
typedef struct {
    qdot_figure_label label; /* label of the values */
    size_t n[2];             /* number of columns and rows */
    double least[2], most[2]; /* x, y of the first and last column and row; evenly spaced */
    const double *value;     /* [n[1] x n[0]] values, borrowed, x varies fastest; NaN: blank */
} qdot_figure_map;

enum { QDOT_FIGURE_LEGEND = 16 };

/* A panel: one pair of axes; three axes if the first curve is a path in space. */
typedef struct {
    qdot_figure_label title, axis[3]; /* title; labels of the axes x, y, z */
    const char *unit[3];        /* units behind these labels, as "m/s^2"; NULL: none */
    const char *note;           /* text below the title; NULL: none */
    const qdot_curve *curves;
    size_t n;
    qdot_figure_range range[2]; /* ranges of x and y */
    bool log[2];                /* logarithmic x, y axis */
    bool pi[2];                 /* x and y are angles, with tics at multiples of pi */
    bool degrees;               /* y is an angle in degrees, with tics at parts of a turn */
    bool equal;                 /* same scale on all axes, as for paths */
    bool marks;                 /* draw a mark at every point, besides the line */
    bool points;                /* draw points without a line */
    bool lines;                 /* with `points`: also join the points by lines */
    const char *legend[QDOT_FIGURE_LEGEND]; /* names of the first curves in the legend, instead of their labels */
    size_t n_legend;
    size_t colours[QDOT_FIGURE_LEGEND]; /* colours of the first curves, by index in the list of colour names */
    size_t n_colours;
    const qdot_figure_map *map; /* a map, drawn instead of curves; NULL: curves */
} qdot_panel;

typedef struct {
    const qdot_panel *panels; /* [n] panels from top to bottom; equal x axes are shared */
    size_t n;
    double width, height; /* size in cm; 0: the default size */
    bool keep; /* keep the files NAME.gp (script) and NAME.dat (data) */
} qdot_figure;

/* The name of colour i that the user can choose; NULL for i beyond the last one. */
const char *qdot_figure_colour_name(size_t i);

/* What the axes of a panel show before anything is drawn: of x, y, z the least and the greatest
 * value, and the length in cm that lies between them. */
typedef struct {
    double least[3], most[3], length[3];
    bool log[3], pi[3], degrees;
} qdot_figure_view;

/* Whether the ending of the name is that of a figure: .svg .png .pdf .eps .tikz. */
bool qdot_figure_is_file(const char *path);

/* Type by ending: .svg .png .pdf .eps, drawn by gnuplot, or a .svg without it where it is missing; .tikz for LaTeX. path NULL: a window of
 * gnuplot that persists.
 *
 * Errors: QDOT_EINVAL for another ending, a figure without curves, a legend or colours of more curves than there are;
 * QDOT_EDOMAIN if no point can be shown; QDOT_EIO where gnuplot is missing or fails, has no window, or a file cannot be written;
 * QDOT_EINTR; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_figure_write(const qdot_figure *figure, const char *path);

/* The figure as an element <svg> for a page of HTML, appended; `keep` is not looked at. Errors as of
 * qdot_figure_write. */
QDOT_MUST_CHECK qdot_status qdot_figure_svg(const qdot_figure *figure, qdot_text *element);

/* Find the ranges and axis lengths of panel i from its settings and curves. Errors: QDOT_EDOMAIN. */
QDOT_MUST_CHECK qdot_status qdot_figure_get_view(const qdot_figure *figure, size_t i,
                                                 qdot_figure_view *view);

/* How a sketch is drawn: with characters of braille, or with stars. */
typedef struct {
    size_t columns, rows;
    bool ascii;
    bool colours; /* distinguish curves by terminal colours; else by dashes, in ASCII by marks */
} qdot_figure_sketching;

/* A panel in characters, with the names of its axes and their ends, in as many digits as these need to differ. Errors:
 * QDOT_EDOMAIN, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_figure_sketch(const qdot_figure *figure, size_t i, const qdot_figure_sketching *how,
                                               qdot_text *out);

#endif
