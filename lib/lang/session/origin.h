/* origin.h -- from which run a number comes and how it was read, so that its derivatives can be found. */
#ifndef QDOT_LANG_ORIGIN_H
#define QDOT_LANG_ORIGIN_H

#include "expr/id.h"
#include "sim/run/run.h"

typedef enum {
    QDOT_ORIGIN_OTHER, /* of several runs, or of none */
    QDOT_ORIGIN_VALUE, /* e at a time */
    QDOT_ORIGIN_RANGE, /* e over a range: `range`, between ends */
    QDOT_ORIGIN_EVENT  /* the time of an event */
} qdot_origin_kind;

typedef struct {
    qdot_origin_kind kind;
    qdot_range_kind range;
    qdot_expr e, time; /* as they were written, numbers of runs in them as symbols */
    double ends[2];
    qdot_expr said[2]; /* the ends as they were written, nil: those of the run */
    const char *run, *event; /* borrowed, for the statement; run NULL: the latest */
} qdot_origin;

#endif
