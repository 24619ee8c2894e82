/* stage.h -- what may happen in a run: events, coordinates that leave their domains,
 * equations that switch; and a plan for every mode of these that was met.
 *
 * Tests  tests/script/events.lag, switching.lag, event-ends.sh
 */
#ifndef QDOT_SIM_STAGE_H
#define QDOT_SIM_STAGE_H

#include "sim/domain.h"
#include "sim/plan.h"
#include "sim/switch.h"

typedef struct {
    char *name;
    qdot_expr function; /* left - right, the values put in */
    int way;            /* 1 rising, -1 falling as t grows, 0 either */
    bool stop;
    size_t changes;  /* assignments of `then`: */
    size_t *targets; /* [changes] places in y */
    qdot_tape *then; /* from q, q', t, q'' their values; NULL: none */
    bool accelerations; /* it reads q'' */
} qdot_staged_event;

typedef enum { QDOT_WATCH_EVENT, QDOT_WATCH_DOMAIN, QDOT_WATCH_SURFACE } qdot_watched_kind;

/* A function that is watched in a mode. */
typedef struct {
    qdot_watched_kind kind;
    size_t index;   /* of the event, domain or surface */
    int inside;     /* its sign in this mode; 0: of an event */
    long beyond;    /* of a surface: the side on the other side */
    size_t coordinate; /* of a domain */
    double bound;
} qdot_watched;

typedef struct {
    qdot_plan *plan;
    long *side; /* [surfaces] */
    size_t m;
    qdot_tape *level; /* from q, q', t: what may jump of T - V (sim/switch.h); NULL: nothing */
    qdot_expr *functions;  /* [m] events, then domains, then surfaces */
    qdot_watched *watched; /* [m] */
} qdot_mode;

/* Start from {0}. */
typedef struct {
    qdot_scene *scene;               /* borrowed while modes are made */
    const qdot_run_request *request; /* likewise */
    qdot_switches switches;
    qdot_domains domains;
    qdot_vec(qdot_staged_event) events;
    qdot_vec(qdot_mode *) modes;
    qdot_tape *sides; /* from q, q', t, q'': u of every surface; NULL: none */
} qdot_stage;

/* The mode of the start is the first: y [2n] at t. Surfaces that the start is on lie on
 * their upper side. Errors as qdot_run_new. */
QDOT_MUST_CHECK qdot_status qdot_stage_begin(qdot_stage *stage, qdot_scene *scene,
                                             const qdot_run_request *request);
void qdot_stage_clear(qdot_stage *stage);
/* The start was brought onto the constraints, to y [2n]: where that is on another side of a
 * surface the stage is made anew from there, its plans too; *anew whether it was. */
QDOT_MUST_CHECK qdot_status qdot_stage_settle(qdot_stage *stage, const double *y,
                                              bool *anew);

/* The mode with these sides [surfaces], made if it is new. QDOT_EFAILED where that comes after
 * the run (stage->scene is NULL). */
QDOT_MUST_CHECK qdot_status qdot_stage_mode(qdot_stage *stage, const long *side,
                                            size_t *mode);

/* The sides of all surfaces at a state: side [surfaces]; on [surfaces]: it is that of
 * its upper neighbour, the state being on it. `work` is allocated inside. */
QDOT_MUST_CHECK qdot_status qdot_stage_sides(const qdot_stage *stage, double t,
                                             const double *y, long *side, bool *on);

/* A surface in words: "x' = 0". */
QDOT_MUST_CHECK qdot_status qdot_stage_describe(const qdot_stage *stage, size_t surface,
                                                long side, qdot_text *out);

#endif
