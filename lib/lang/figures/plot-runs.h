/* plot-runs.h -- callbacks that make the runs for `plot ... for l = [1, 2]`; they are implemented
 * in a higher layer. */
#ifndef QDOT_LANG_PLOT_RUNS_H
#define QDOT_LANG_PLOT_RUNS_H

#include "base/status.h"

/* How the latest run is repeated, with the parameter values of a loop, for a plot. */
typedef struct {
    qdot_status (*begin)(void *user); /* called before the loop: checks that the run can be repeated */
    qdot_status (*make)(void *user);  /* makes a run, which is the latest run of the session until it is dropped */
    void (*drop)(void *user);
    void *user;
} qdot_plot_runs;

#endif
