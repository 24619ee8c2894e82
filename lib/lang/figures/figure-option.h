/* figure-option.h -- the options of a figure, which follow its operands in any order. */
#ifndef QDOT_LANG_FIGURE_OPTION_H
#define QDOT_LANG_FIGURE_OPTION_H

#include "lang/syntax/record.h"
#include "show/figure.h"

/* Options of the whole figure: to "FILE", size W, H, keep (the files with its gnuplot script and data). */
typedef struct {
    const char *path; /* NULL: not given */
    double width, height;
    bool keep;
} qdot_figure_choice;

/* Options of one panel, as in QDOT_FIGURE_USAGE. */
typedef struct {
    qdot_figure_range range[2];
    bool logs, log[2]; /* axes with logarithmic scale; logs: the option was given */
    const qdot_filled *ticks; /* the word of `ticks pi`; NULL: not given */
    bool pi[2];               /* the axes that it names; neither where it names none */
    bool equal, points, lines, degrees; /* degrees: the ordinate is an angle in degrees */
    const char *title, *labels[3] /* of each axis; NULL: not given */, *legend[QDOT_FIGURE_LEGEND];
    size_t n_labels, n_legend, colours[QDOT_FIGURE_LEGEND], n_colours;
} qdot_panel_choice;

/* The options of a figure as text, for the usage texts of statements. */
#define QDOT_FIGURE_USAGE                                                                 \
    "[from A to B] [range A..B] [log x|y|xy] [ticks pi [x|y|xy]] [equal] [points] [lines] "                                   \
    "[colour COLOUR, ...] [title \"TEXT\"] [labels \"X\", ...] "                                                            \
    "[xlabel \"X\"] [ylabel \"Y\"] [legend \"NAME\", ...] [size W, H] [keep] [to \"FILE\"]"
/* Read the options among parts [from, to) of a statement; an option of the whole figure only once. QDOT_EINVAL. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_find(qdot_record *r, const qdot_filled *from,
                                                    const qdot_filled *to, qdot_figure_choice *figure,
                                                    qdot_panel_choice *panel);
/* Refuse `ticks pi` in a figure of which no axis is an angle. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_no_angles(qdot_record *r, const qdot_panel_choice *choice);
/* Set the fields of the panel for which an option was given. QDOT_EINVAL for `ticks pi` of a logarithmic axis; r is read
 * then only: NULL where the choice has no `ticks`. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_apply(qdot_record *r, const qdot_panel_choice *choice, qdot_panel *panel);

#endif
