/* plot-branches.h -- a bifurcation diagram: stable branches full, unstable ones dashed, those that are
 * undecided dotted; a mark at each bifurcation, another for each type. A panel for each coordinate.
 *
 * Tests  tests/script/continue/continue-files.sh
 */
#ifndef QDOT_LANG_PLOT_BRANCHES_H
#define QDOT_LANG_PLOT_BRANCHES_H

#include "lang/session/row-table.h"
#include "show/figure.h"

/* The panels of a figure of branches, with the arrays that they use; freed in any case. */
typedef struct {
    qdot_panel *panels;  /* [n] the panels */
    qdot_curve *curves;
    double *numbers;
    size_t n;
} qdot_branch_drawing;

/* Make the panels of a table of branches. QDOT_ENOMEM; QDOT_EDOMAIN: there is nothing to draw. */
QDOT_MUST_CHECK qdot_status qdot_plot_branches_draw(const qdot_row_table *branches,
                                                    qdot_branch_drawing *d);
void qdot_plot_branches_free(qdot_branch_drawing *d);

#endif
