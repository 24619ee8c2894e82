/* sweep-lanes-parts.h -- members side by side between what fits lanes (sweep-lanes-members.c) and the rows that are
 * made of them (sweep-lanes-rows.c).
 */
#ifndef QDOT_LANG_SWEEP_LANES_PARTS_H
#define QDOT_LANG_SWEEP_LANES_PARTS_H

#include "lang/sweeps/sweep-lanes.h"
#include "sim/ensemble/fit.h"
#include "sim/ensemble/ensemble.h"
#include "tape/tape.h"

typedef struct {
    enum { QDOT_LANES_AT_END, QDOT_LANES_EVENT, QDOT_LANES_WAY } kind;
    size_t event, k; /* index of the event in `events`; number of the occurrence, from 0 */
    size_t output;   /* at the end: index of the tape's output */
} qdot_sweep_lanes_column;

struct qdot_sweep_lanes {
    qdot_sweep *s;
    qdot_ensemble *ensemble;
    size_t least, companions; /* numbers of companion runs: for all members; for those now read */
    qdot_ensemble_watching watching;
    qdot_ensemble_bounds bounds;
    qdot_vec(qdot_ensemble_event) events;
    qdot_vec(const char *) names; /* names of the events */
    qdot_sweep_lanes_column *columns;
    size_t outputs, n, places; /* numbers of expressions, of coordinates, of stored times */
    size_t ways;               /* number of columns that need the whole course of a run, not just its end */
    qdot_run *run; /* holds the run of each member in turn for such columns; NULL: no such column */
    qdot_tape *tape;           /* the tape that computes the expressions of the columns */
    double *in, *work, *out; /* inputs; scratch, twice that of the tape; [passes x outputs] values */
    qdot_vec(qdot_expr) varied;
    qdot_vec(size_t) axis; /* index of the axis of each varied parameter */
    double t1;
    const qdot_ensemble_result *results; /* results of the members being read */
    bool unsure; /* the error of the run read last is unsure: repeat that run with two companion runs */
    bool *made;            /* [members] whether the row of this run is complete */
    char **reasons;        /* [members] why the run failed; NULL: it did not */
};

/* Set the parameters of run (member) k of the sweep, written to `swept` too, and make the request of that run. */
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_request(qdot_sweep *s, size_t k, double *swept,
                                                     qdot_request *request);

/* Fill row k from member m of the ensemble; the row stays empty if that run must be made singly. */
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_fill_row(qdot_sweep_lanes *x, size_t m, size_t k);

#endif
