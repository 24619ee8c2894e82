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
    size_t event, k; /* of `events`; the occurrence less 1 */
    size_t output;   /* at the end, of the tape */
} qdot_sweep_lanes_column;

struct qdot_sweep_lanes {
    qdot_sweep *s;
    qdot_ensemble *ensemble;
    size_t least, companions; /* of all members; of those that are run or read */
    qdot_ensemble_watching watching;
    qdot_ensemble_bounds bounds;
    qdot_vec(qdot_ensemble_event) events;
    qdot_vec(const char *) names; /* of them */
    qdot_sweep_lanes_column *columns;
    size_t outputs, n, places; /* expressions; coordinates */
    size_t ways;               /* columns that read the way of a run */
    qdot_run *run;             /* each member in turn, for these; NULL: there are none */
    qdot_tape *tape;           /* of `outputs` columns */
    double *in, *work, *out;   /* inputs; work space, twice that of the tape; [passes x outputs] */
    qdot_vec(qdot_expr) varied;
    qdot_vec(size_t) axis; /* of varied parameters */
    double t1;
    const qdot_ensemble_result *results; /* of the members that are read */
    bool unsure;           /* of the latest of them: it is to have two companions */
    bool *made;            /* [members] */
    char **reasons;        /* [members] */
};

/* Set the values of member k (also written to `swept`) and make its request. */
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_request(qdot_sweep *s, size_t k, double *swept,
                                                     qdot_request *request);

/* Fill row k from member m of the ensemble; the row stays empty if the member must be run singly. */
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_fill_row(qdot_sweep_lanes *x, size_t m, size_t k);

#endif
