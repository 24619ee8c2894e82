/* plot.h -- the figure of `plot`. */
#ifndef QDOT_LANG_PLOT_H
#define QDOT_LANG_PLOT_H

#include "lang/figures/plot-runs.h"
#include "lang/language/cursor.h"

/* Read the panels at the cursor, and draw and show them. */
QDOT_MUST_CHECK qdot_status qdot_plot_figure(qdot_cursor *c, const qdot_plot_runs *runs);

#endif
