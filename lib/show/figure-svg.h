/* figure-svg.h -- what the files share that write a figure as SVG. Internal to show/.
 *
 * Lengths are in units of 1/96 inch, of which the figure is as many wide and high as its size says; y grows downward.
 */
#ifndef QDOT_SHOW_FIGURE_SVG_H
#define QDOT_SHOW_FIGURE_SVG_H

#include "show/figure-parts.h"

/* A drawing with its scale. */
typedef struct {
    const qdot_figure_drawing *d;
    qdot_text *s;  /* where the SVG is written */
    double cm;     /* units per cm */
    double letter; /* size of the letters */
} qdot_figure_canvas;

/* The axes of a panel where they stand: the point with parts p[k] of the axes (0 at their beginning, 1 at their end) is at
 * origin + sum p[k] edge[k]. In the plane edge[2] is 0. */
typedef struct {
    const qdot_panel *panel;
    const qdot_figure_axis *axes;
    double origin[2], edge[3][2];
} qdot_figure_frame;

/* The position of a value along an axis: 0 at its beginning, 1 at its end. */
double qdot_figure_part_of(const qdot_figure_axis *axis, double value);
/* The point with these parts [3] of the axes into at [2]. */
void qdot_figure_frame_point(const qdot_figure_frame *f, const double *part, double *at);

/* Append a length, to a hundredth. */
void qdot_figure_svg_add(qdot_text *s, double length);
/* Append a line from (x, y) to (x1, y1) with its attributes. */
void qdot_figure_svg_line(qdot_text *s, double x, double y, double x1, double y1, const char *attributes);

/* Append a label, given in gnuplot's markup: anchor is start, middle or end. begin_text leaves the element open for
 * further attributes, which end_text closes. */
void qdot_figure_svg_add_text(qdot_text *s, double x, double y, const char *anchor, const char *markup);
void qdot_figure_svg_begin_text(qdot_text *s, double x, double y, const char *anchor);
void qdot_figure_svg_end_text(qdot_text *s, const char *markup);

/* Append the curves of a panel, or its map; a sample of curve k in the legend, a line from (x, y) of this length, or its
 * mark (figure-svg-curves.c). Errors: QDOT_EINTR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_figure_svg_curves(qdot_text *s, const qdot_figure_frame *f);
void qdot_figure_svg_sample(qdot_text *s, const qdot_panel *panel, size_t k, double x, double y, double length);
QDOT_MUST_CHECK qdot_status qdot_figure_svg_map(const qdot_figure_canvas *c, const qdot_figure_frame *f);

#endif
