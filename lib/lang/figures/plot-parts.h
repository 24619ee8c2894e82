/* plot-parts.h -- types and functions shared by the files of the statement `plot`. */
#ifndef QDOT_LANG_PLOT_PARTS_H
#define QDOT_LANG_PLOT_PARTS_H

#include "lang/figures/figure-option.h"
#include "lang/commands/operands.h"
#include "lang/figures/plot-loop.h"
#include "lang/figures/plot-runs.h"
#include "show/trace.h"
#include "tape/tape.h"

/* A curve and where its numbers come from: along a run (y of an operand, x of another or t), or
 * over a variable (a tape), or the response of a quotient in s (plot-bode.c); the points of data are in a file. */
typedef struct {
    char *label, *axis; /* name in the legend; label of the y axis */
    char *unit;         /* the unit of y, or of the places of a path; NULL: none */
    const qdot_operand *y;
    qdot_operand x;  /* operand of the abscissa; strings and columns borrowed; session NULL: the abscissa is t */
    size_t component; /* for a vector y: index of its component */
    bool drift;      /* draw y minus its value at `begin` */
    bool data;       /* the points are those of a data file */
    bool literal;    /* the label is plain text, not a formula */
    double begin;
    qdot_tape *tape; /* for a curve over a variable: y as a tape; owned */
    double *work;
    void *response; /* for `plot bode`: zeros and poles; owned, unless borrowed from the panel before */
    bool borrowed;
    qdot_trace_source source;
    qdot_trace points;
    qdot_figure_range shown; /* the range of the ordinate that is shown if the curve has a pole */
} qdot_plot_curve;

/* An item between commas: an operand; its abscissa, counted from 1 in `versus`, 0: t; the pass of a
 * loop, counted from 1 in `passes`. */
typedef struct {
    size_t versus, pass;
    bool drift;
} qdot_plot_item;

typedef struct {
    qdot_operands operands, versus;
    qdot_vec(qdot_plot_item) items; /* further curves besides `operands` */
    qdot_vec(qdot_plot_curve *) curves; /* the curves, each owned */
    qdot_vec(char *) passes;        /* text of each pass of a loop, as ", l = 1"; owned */
    qdot_vec(qdot_named_run) made;  /* the run of each pass of a loop; one use of each is held */
    char *variable;                 /* name of the abscissa of `vs NAME = A..B`; NULL: none */
    qdot_expr over;                 /* its symbol; nil: none */
    qdot_panel_choice choice;
} qdot_plot_panel;

void qdot_plot_panel_clear(qdot_plot_panel *panel);
/* Add a curve to the panel, as yet without points. */
QDOT_MUST_CHECK qdot_status qdot_plot_curve_add(qdot_plot_panel *panel, const char *label,
                                                const char *axis, qdot_plot_curve **added);

/* The unit of e is that of the curve. */
QDOT_MUST_CHECK qdot_status qdot_plot_curve_unit(qdot_session *session, qdot_plot_curve *curve, qdot_expr e);

/* Read `E, ... [vs E], ... [for ...]` and the options; compute the first points of each curve along its run. */
QDOT_MUST_CHECK qdot_status qdot_plot_run(const qdot_plot_said *said, const qdot_plot_runs *runs,
                                          qdot_plot_panel *panel, qdot_figure_choice *figure);
/* Read `E, ... vs NAME = A..B [for ...]` and the options; compute the first points of each curve. */
QDOT_MUST_CHECK qdot_status qdot_plot_over(const qdot_plot_said *said, qdot_plot_panel *panel,
                                           qdot_figure_choice *figure);

/* The first data file of a panel; said->to: none. The parts between it and the next file or option are columns. */
const qdot_filled *qdot_plot_data_find(const qdot_plot_said *said);
/* Read the files and add their columns as curves. Errors: as of qdot_csv_read; QDOT_ENAME, QDOT_EINVAL at a column. */
QDOT_MUST_CHECK qdot_status qdot_plot_data_add(const qdot_plot_said *said, qdot_plot_panel *panel);

#endif
