/* origin.h -- from which run a number comes and how it was read, so that its derivatives can be found. */
#ifndef QDOT_LANG_ORIGIN_H
#define QDOT_LANG_ORIGIN_H

#include "expr/id.h"
#include "sim/run/run.h"

typedef enum {
    QDOT_ORIGIN_OTHER, /* from several runs, or otherwise than by the kinds below */
    QDOT_ORIGIN_VALUE, /* the value of e at a time */
    QDOT_ORIGIN_RANGE, /* extremum or mean of e between two times */
    QDOT_ORIGIN_EVENT  /* time of an event */
} qdot_origin_kind;

typedef struct {
    qdot_origin_kind kind;
    qdot_range_kind range;
    qdot_expr e, time; /* expression and time as typed; numbers of runs in them are symbols */
    double ends[2];
    qdot_expr said[2]; /* the two ends of the time range as written; nil: those of the run */
    const char *run, *event; /* names of run and event, borrowed during the statement; run NULL: the latest */
} qdot_origin;

#endif
