/* stage.h -- what may happen in a run: events, coordinates that leave their domains,
 * equations that switch; and a plan for every mode of these that was met.
 *
 * Tests  tests/script/events.lag, switching.lag, switch-nested.lag, event-ends.sh,
 *        tests/sim/test_switch.c
 */
#ifndef QDOT_SIM_STAGE_H
#define QDOT_SIM_STAGE_H

#include "sim/model/domain.h"
#include "sim/model/equations.h"
#include "sim/model/parameter-states.h"
#include "sim/model/switch.h"

typedef struct {
    char *name;
    qdot_expr function; /* left - right, the values put in */
    int way;            /* 1 rising, -1 falling as t grows, 0 either */
    bool stop;
    size_t changes;  /* assignments of `then`, to q, q' and parameters: */
    size_t *targets; /* [changes] places in y */
    qdot_tape *then; /* from q, q', t, q'' their values; NULL: none */
    bool accelerations; /* it reads q'' */
    bool positions, velocities; /* what it sets may break constraints of these */
} qdot_staged_event;

typedef enum { QDOT_WATCH_EVENT, QDOT_WATCH_DOMAIN, QDOT_WATCH_SURFACE } qdot_watched_kind;

/* A function that is watched in a mode. */
typedef struct {
    qdot_watched_kind kind;
    size_t index;   /* of the event, domain or surface */
    int inside;     /* its sign in this mode; 0: of an event, or where a surface's u stays 0 */
    long beyond;    /* of a surface: the side on the other side; not where u stays 0 */
    bool velocity;  /* of a surface: u holds velocities, so that its rate is the mode's */
    size_t coordinate; /* of a domain */
    double bound;
} qdot_watched;

typedef struct {
    qdot_plan *plan;
    long *side; /* [surfaces] */
    size_t m;
    qdot_tape *level; /* from q, q', t: what may jump of T - V (sim/model/switch.h); NULL: nothing */
    qdot_expr *functions;  /* [m] events, then domains, then surfaces */
    qdot_watched *watched; /* [m] */
} qdot_mode;

/* Start from {0}. */
typedef struct {
    qdot_scene *scene;               /* borrowed while modes are made */
    const qdot_run_request *request; /* likewise */
    qdot_plan *kept; /* of a run before, on its way into the first mode; else NULL */
    qdot_switches switches;
    qdot_domains domains;
    qdot_parameter_conditions conditions;
    size_t n, n_states; /* coordinates of the run, of them parameters that events set */
    qdot_vec(qdot_staged_event) events;
    qdot_vec(qdot_mode *) modes;
    qdot_tape *sides; /* from q, q', t, sides: u of every surface, then the magnitudes of their terms;
                         NULL: no surface */
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

/* stage->sides, of the scene's surfaces. Errors: as qdot_tape_new. */
QDOT_MUST_CHECK qdot_status qdot_stage_lower_sides(qdot_stage *stage);

/* The sides of all surfaces at a state, the inner ones first, into side [surfaces].
 *   old  [surfaces] or NULL: all are decided anew. A surface whose u is the same by the new
 *        inner sides as it is by the old ones, and moves, keeps what side has for it: u did
 *        not jump.
 * Else the side is that of u. Where u is 0, or an integer of a floor, it is 0 if u does not
 * move at all; if it does it is what side has, where that is a neighbour, and the upper one
 * of those decided anew: to which the motion leaves is not known here. QDOT_EDOMAIN: a floor that no integer holds. `work` is allocated inside. */
QDOT_MUST_CHECK qdot_status qdot_stage_sides(const qdot_stage *stage, double t,
                                             const double *y, const long *old, long *side);

/* A surface in words: "x' = 0". */
QDOT_MUST_CHECK qdot_status qdot_stage_describe(const qdot_stage *stage, size_t surface,
                                                long side, qdot_text *out);

#endif
