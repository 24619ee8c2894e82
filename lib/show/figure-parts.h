/* figure-parts.h -- the parts of a figure's script. Internal to show/. */
#ifndef QDOT_SHOW_FIGURE_PARTS_H
#define QDOT_SHOW_FIGURE_PARTS_H

#include "show/figure.h"

/* An axis as drawn: gnuplot gets (value - offset) / 10^power, between least and most. */
typedef struct {
    double least, most, step; /* range and tic step in gnuplot's numbers; step 0: gnuplot chooses both */
    double offset;
    char offset_text[64]; /* text of the offset in gnuplot's markup; "": none */
    int power;
    bool log;
    int times, over; /* tic step is times * pi / over; over 0: the step is a decimal number */
} qdot_figure_axis;

/* What the tics of an axis are: decimal numbers, powers of ten, multiples of pi, parts of a turn of 360. */
typedef enum { QDOT_TICS_DECIMAL, QDOT_TICS_LOG, QDOT_TICS_PI, QDOT_TICS_DEGREES } qdot_figure_tics;

/* --- writing labels ----------------------------------------------------------------- */

/* Append text in gnuplot's quotes, taken literally whatever it contains. */
void qdot_figure_add_quoted(qdot_text *script, const char *text);
/* Append a label in quotes, followed by `enhanced` or `noenhanced`. */
void qdot_figure_add_label(qdot_text *script, const qdot_figure_label *label);
/* Append the label in gnuplot's markup, without quotes. */
void qdot_figure_add_markup(qdot_text *out, const qdot_figure_label *label);
/* Append a unit, " [m/s^2]", in gnuplot's markup; as text of a LaTeX document. NULL: nothing. */
void qdot_figure_add_unit_markup(qdot_text *out, const char *unit);
void qdot_figure_add_unit_latex(qdot_text *out, const char *unit);
/* Append the label as text of a LaTeX document, a formula between dollars. */
void qdot_figure_add_latex(qdot_text *out, const qdot_figure_label *label);
/* Append a typed formula as one line of plain text, for a sketch made of characters. */
void qdot_figure_add_line(qdot_text *out, const char *formula);
/* The label of curve k in the legend. */
qdot_figure_label qdot_figure_curve_label(const qdot_panel *panel, size_t k);
/* The approximate width of the label in characters. */
size_t qdot_figure_label_width(const qdot_figure_label *label);

/* --- ranges and tics of axes -------------------------------------------------------- */

/* The power of ten by which the numbers of an axis are divided; 0 if they are short anyway. */
int qdot_figure_power(double least, double most);
/* An axis from least to most with about `steps` tics; power NULL: the power of ten is chosen. */
qdot_figure_axis qdot_figure_axis_of(double least, double most, qdot_figure_tics tics, double steps, const int *power);
/* Append the angle x as a multiple of pi, as -3π/4; false (nothing appended) if it is no multiple of pi/12. */
bool qdot_figure_add_pi(qdot_text *out, double x);
/* The number of tics of a linear axis; 0: gnuplot chooses them, or it is logarithmic. */
int qdot_figure_count_tics(const qdot_figure_axis *axis);
/* A tic of an axis: a large one with its number in gnuplot's markup, `letters` characters wide, or a small one without. */
typedef struct {
    double at;
    char label[48];
    size_t letters;
    bool minor;
} qdot_figure_tic;
enum { QDOT_FIGURE_TICS = 640 };
/* Find the tics of an axis in ascending order, at most QDOT_FIGURE_TICS; returns their number (0: gnuplot chooses). */
size_t qdot_figure_find_tics(const qdot_figure_axis *axis, qdot_figure_tic *tics);
/* Append `set xrange` and `set xtics`; bare: without numbers. *width: characters of the widest number. */
void qdot_figure_add_axis(qdot_text *script, char name, const qdot_figure_axis *axis,
                          bool bare, size_t *width);
/* What is written before the offset and power of ten of an axis: its label, or its letter if it has none; *compound: it
 * needs brackets there. */
qdot_figure_label qdot_figure_moved_label(char name, const qdot_figure_label *label, bool *compound);
/* Append the label of an axis in gnuplot's markup with offset and power of ten, if any, and the unit: (E - 9.81) / 10^-12 [J].
 * Then `set xlabel` with it. */
void qdot_figure_add_axis_markup(qdot_text *markup, char name, const qdot_figure_axis *axis, const qdot_figure_label *label,
                                 const char *unit);
void qdot_figure_add_axis_label(qdot_text *script, char name, const qdot_figure_axis *axis,
                                const qdot_figure_label *label, const char *unit);
/* The same at the edge k of the box of a path in space, all three axes given; width: letters of the
 * widest number there. */
void qdot_figure_add_edge_label(qdot_text *script, int k, const qdot_figure_axis *axes,
                                const qdot_figure_label *label, const char *unit, size_t width);
/* Append a data column, shifted and scaled for its axis, as an expression for gnuplot's `using`. */
void qdot_figure_add_column(qdot_text *script, int column, const qdot_figure_axis *axis);

/* --- sizes and views ---------------------------------------------------------------- */

/* Whether point k can be shown on these axes. */
bool qdot_figure_shows(const qdot_panel *panel, const qdot_curve *curve, size_t k);
/* Whether the panel shows paths in space. */
bool qdot_figure_is_space(const qdot_panel *panel);
/* Whether panel i has the same horizontal axis as panel i + 1, below it. */
bool qdot_figure_is_shared(const qdot_figure *figure, size_t i);
/* The angles of view of a path in space, in degrees, for gnuplot's `set view`. */
enum { QDOT_FIGURE_TILT = 62, QDOT_FIGURE_TURN = 32 };
/* The box of a path in space with the sides side[3] in a panel of width and height, in cm, with
 * letters of a size in points: *zoom is what `set view` has to scale it by so that it fills the panel,
 * seen[k] is how long its edges are then, in cm. */
typedef struct {
    double width, height, points;
    const qdot_panel *panel;
} qdot_figure_room;
void qdot_figure_see_box(const double *side, const qdot_figure_room *room, double *zoom,
                         double *seen);
/* Find the size of the whole figure in cm, and of its letters in points. */
QDOT_MUST_CHECK qdot_status qdot_figure_size(const qdot_figure *figure, double *width,
                                             double *height, double *points);

/* --- the looks of curves (figure-style.c) --------------------------------------------- */

/* How a curve is drawn: as a line through its points, as dots, or with the curve's own kind of mark. */
typedef struct {
    bool line, dots, marks;
    size_t look;        /* index of the curve's style in the lists of dashes and marks */
    const char *colour; /* #rrggbb */
    const char *dash;   /* dashes of the line, "1" (solid) or "(on,off,...)"; NULL: the medium's usual line */
} qdot_figure_style;
qdot_figure_style qdot_figure_style_of(const qdot_panel *panel, size_t k);
/* The colour of curve k in a terminal, as the number of its control sequence. */
const char *qdot_figure_terminal_colour(const qdot_panel *panel, size_t k);

/* --- maps in colours (figure-map.c) -------------------------------------------------- */

/* The coordinate along an axis of the map's column or row i. */
double qdot_figure_map_place(const qdot_figure_map *map, int axis, size_t i);
void qdot_figure_map_edges(const qdot_figure_map *map, int axis, double *least, double *most);
/* Append the values of a map over its grid as lines "x y value". Errors: QDOT_EINTR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_figure_map_add_data(const qdot_figure_map *map, qdot_text *out);
/* Append the map's colour palette, its range of values, and the colour scale. */
void qdot_figure_map_add_colours(const qdot_figure_map *map, qdot_text *script);
/* The colour of a part 0..1 of the range of values, as #rrggbb. */
void qdot_figure_map_colour(double part, char colour[8]);
/* Find the smallest and the largest value of a map into ends [2]; 0 if it has none. */
void qdot_figure_map_ends(const qdot_figure_map *map, double *ends);
/* Whether dot (i, j) of a sketch, at these parts [2] of the axes, is black: the more often the
 * greater the number is between the ends. */
bool qdot_figure_map_dot(const qdot_figure_map *map, const double *ends, const double *part, size_t i,
                         size_t j);

/* --- the whole script --------------------------------------------------------------- */

/* An image format; one without a gnuplot terminal is written by qdot itself. */
typedef struct {
    const char *ending;
    double dots;  /* dots (units) per cm */
    double line;  /* line width in units of the format */
    double point; /* units per point of font size */
    double lead;  /* line height in units of font size */
    const char *before, *behind; /* text before the size in gnuplot's terminal command, and after each length */
    const char *end;             /* last bytes of a complete image, apart from blanks */
} qdot_figure_kind;

/* A figure with the sizes and texts needed to draw it. */
typedef struct {
    const qdot_figure *figure;
    double width, height, points; /* size of the figure in cm; font size in points */
    const qdot_figure_kind *kind; /* format of the image; NULL: a window */
    const char *data;             /* name of the data file; NULL: data within the script */
    qdot_text *script;
} qdot_figure_drawing;

/* --- where its parts stand (figure-place.c) -------------------------------------------- */

/* Choose the axes [3] of a panel. Those with one scale have one power of ten and, unless one is short, one step. Errors:
 * QDOT_EDOMAIN, QDOT_EINVAL, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_figure_choose_axes(const qdot_figure_drawing *d, size_t i, qdot_figure_axis *axes);
/* The width of the widest entry of a legend in characters, with the sample of its line. */
size_t qdot_figure_legend_width(const qdot_panel *panel);
/* The rows of a legend above the axes; 0: there is none. Whether it stands beside them instead, and the spacing of its
 * lines there, relative to the usual one. */
size_t qdot_figure_legend_rows(const qdot_figure_drawing *d, const qdot_panel *panel);
bool qdot_figure_has_legend_beside(const qdot_figure_drawing *d, const qdot_panel *panel);
double qdot_figure_legend_spacing(const qdot_figure_drawing *d, const qdot_panel *panel);
/* Where the axes of a panel stand, in cm from the lower left corner of the figure; the strip that the panel has from low
 * to high. All panels have the same horizontal ends and the same height. */
typedef struct {
    double left, right, bottom, top, low, high;
} qdot_figure_place;
/* Errors: as of qdot_figure_choose_axes. */
QDOT_MUST_CHECK qdot_status qdot_figure_place_panel(const qdot_figure_drawing *d, size_t i, qdot_figure_place *at);

/* --- its writers ------------------------------------------------------------------------ */

/* Write the figure as a tikzpicture of pgfplots (figure-tikz.c). Errors: as qdot_figure_add_script. */
QDOT_MUST_CHECK qdot_status qdot_figure_add_tikz(const qdot_figure_drawing *d);
/* Write the figure as SVG (figure-svg.c). Errors: as qdot_figure_add_script. */
QDOT_MUST_CHECK qdot_status qdot_figure_add_svg(const qdot_figure_drawing *d);
/* Write the gnuplot script from after `set terminal` on. Errors: QDOT_EDOMAIN, QDOT_EINTR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_figure_add_script(const qdot_figure_drawing *d);
/* Write all curves as data sets for gnuplot, separated by two blank lines, with names as comments. */
QDOT_MUST_CHECK qdot_status qdot_figure_add_data(const qdot_figure *figure, qdot_text *out);

#endif
