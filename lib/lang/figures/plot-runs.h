/* plot-runs.h -- callbacks that make the runs for `plot ... for l = [1, 2]`; they are implemented
 * in a higher layer. */
#ifndef QDOT_LANG_PLOT_RUNS_H
#define QDOT_LANG_PLOT_RUNS_H

#include "base/status.h"

/* How the latest run is repeated with the parameter values of a loop. */
typedef struct {
    qdot_status (*begin)(void *user); /* before the loop: can it be made once more? */
    qdot_status (*make)(void *user);  /* it is the latest run until it is dropped */
    void (*drop)(void *user);
    void *user;
} qdot_plot_runs;

#endif
