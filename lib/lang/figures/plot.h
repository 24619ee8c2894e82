/* plot.h -- draws the figure of the statement `plot`. */
#ifndef QDOT_LANG_PLOT_H
#define QDOT_LANG_PLOT_H

#include "lang/figures/plot-runs.h"
#include "lang/syntax/record.h"

/* Draw and show the panels of the statement `plot`. */
QDOT_MUST_CHECK qdot_status qdot_plot_figure(qdot_record *r, const qdot_plot_runs *runs);

#endif
