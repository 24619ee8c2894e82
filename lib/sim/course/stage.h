/* stage.h -- the functions that a run watches (events, bounds of domains, surfaces where
 * equations switch), and a plan for every mode met so far.
 *
 * Tests  tests/script/events/events.lag, switching.lag, switch-nested.lag, event-ends.sh,
 *        tests/sim/model/test_switch.c
 */
#ifndef QDOT_SIM_STAGE_H
#define QDOT_SIM_STAGE_H

#include "sim/model/domain.h"
#include "sim/model/equations.h"
#include "sim/model/parameter-states.h"
#include "sim/model/sliding.h"
#include "sim/model/switch.h"

/* For a run backwards in time (sim/course/piece-back.c): the inverse of the event's `then`
 * (sim/model/undone.h). */
typedef struct {
    const char *why;  /* why the event cannot be undone; NULL: it can */
    bool nowhere;     /* not even the time at which the event occurred can be determined */
    bool keeps_speed; /* the event's `then` does not change the rate of change of the event's function */
    bool moved; /* the inverse's function differs from the event's, as `then` changes positions or parameters */
    qdot_tape *rates; /* from q, q', t, q'': g', g'' (0 if g contains q'), dg/dq [n] of the event's function g */
    /* the event as declared, with the targets of its inverse */
    struct qdot_staged_event *forward;
} qdot_staged_undoing;

typedef struct qdot_staged_event {
    char *name;
    qdot_expr function; /* left - right of the event, with parameter values; u if the condition is |u| = 0 or u^2 = 0 */
    bool touches;       /* the function is u: where u changes sign, |u| or u^2 only touches 0 */
    qdot_expr turn; /* left - right changes its sign where function * turn does (sim/model/repeated-zeros.h); nil: turn = 1 */
    bool half;          /* a zero of the function counts as the event only if turn > 0 there */
    int way;            /* direction in which the function passes 0 as t grows: 1 rising, -1 falling, 0 either */
    bool stop;
    size_t changes;  /* number of assignments in the event's `then`, to q, q' and parameters */
    size_t *targets; /* [changes] index in y of each assigned value */
    qdot_tape *then; /* new values from q, q', t, q''; NULL: no assignments */
    bool accelerations; /* `then` reads q'' */
    bool positions, velocities; /* `then` may violate constraints on positions; it may violate constraints on velocities */
    qdot_staged_undoing *undoing; /* the inverse event, for a backward run; NULL: forward run, or `then` changes nothing */
} qdot_staged_event;

/* Whether the event changes or stops the motion, or may do so. */
static inline bool
qdot_staged_event_acts(const qdot_staged_event *e)
{
    return e->stop || e->then || (e->undoing && e->undoing->why);
}

typedef enum { QDOT_WATCH_EVENT, QDOT_WATCH_DOMAIN, QDOT_WATCH_SURFACE } qdot_watched_kind;

/* A function whose roots are searched for while the motion is in a mode. */
typedef struct {
    qdot_watched_kind kind;
    size_t index;   /* index of the event, domain or surface */
    int inside;     /* its sign in this mode; 0: an event, or a surface whose u stays 0. A surface along
                       which the motion slides has s + 1 and s - 1, s its share */
    int64_t beyond;    /* for a surface: side after a crossing; unused if u stays 0 */
    bool velocity;  /* for a surface: u contains velocities, so du/dt depends on the mode */
    size_t coordinate; /* for a domain: index of the coordinate */
    double bound;
} qdot_watched;

typedef struct {
    qdot_plan *plan;
    int64_t *side; /* [surfaces] the side of each surface in this mode */
    size_t m;
    qdot_tape *level; /* from q, q', t: the terms of T - V that switch (sim/model/switch.h); NULL:
                         none */
    qdot_expr *functions;  /* [m] watched functions: events, then domains, then surfaces */
    qdot_watched *watched; /* [m] the event, domain or surface to which each function belongs */
    qdot_tape *shares; /* from q, q', t: values in place of sign(u) while sliding [surfaces], else 0; NULL: no sliding */
    qdot_sliding_rows held; /* conditions kept while sliding along surfaces; no rows: not sliding */
} qdot_mode;

/* The scene of a run, compiled for each of its modes. Start from {0}. */
typedef struct {
    qdot_scene *scene;               /* the scene; borrowed while modes are made */
    const qdot_run_request *request; /* the request; borrowed while modes are made */
    qdot_plan *kept; /* plan of an earlier run, reused for the first mode; else NULL */
    qdot_switches switches;
    qdot_domains domains;
    qdot_parameter_conditions conditions;
    double *scales; /* [2n] scales of the state (ode/scale.h); NULL: all are 1 */
    size_t n, n_states; /* coordinates of the run; how many of these are parameters that events
                           set */
    bool back;          /* the run goes backwards in time */
    qdot_vec(qdot_staged_event) events;
    qdot_vec(qdot_mode *) modes;
    qdot_tape *sides; /* from q, q', t, sides: u of every surface, then the magnitudes of their terms;
                         NULL: no surface */
    bool *in_pieces; /* [own surfaces] u is constant between the points of tables of data */
    qdot_tape *pucks; /* from q, q', t: quantities qdot_stage_puck of each sliding disc; NULL: no discs */
} qdot_stage;

/* Make the stage and its first mode, that of the start. A surface that the start lies on gets its
 * upper side. Errors as qdot_run_new. */
QDOT_MUST_CHECK qdot_status qdot_stage_begin(qdot_stage *stage, qdot_scene *scene,
                                             const qdot_run_request *request);
void qdot_stage_clear(qdot_stage *stage);
/* After the start was brought onto the constraints, to y [2n]: if that is on another side of a
 * surface the stage and its plans are made anew; *anew whether they were. */
QDOT_MUST_CHECK qdot_status qdot_stage_settle(qdot_stage *stage, const double *y,
                                              bool *anew);

/* (stage-events.c) Fill s->events, by the plan of the first mode. Errors as qdot_stage_begin. */
QDOT_MUST_CHECK qdot_status qdot_stage_events(qdot_stage *s, const qdot_plan *plan);
void qdot_staged_event_clear(qdot_staged_event *e);

/* The mode with these sides [surfaces], made if it is new. QDOT_EFAILED if it is new and the run
 * has ended (stage->scene is NULL), or as qdot_sliding_freeze. */
QDOT_MUST_CHECK qdot_status qdot_stage_mode(qdot_stage *stage, const int64_t *side,
                                            size_t *mode);

/* Write the symbols of q, q', t to in [2n + 1]; returns their number. */
size_t qdot_stage_inputs(const qdot_stage *stage, qdot_expr *in);

/* Make stage->sides, the tape that evaluates the functions of all surfaces. Errors: as qdot_tape_new. */
QDOT_MUST_CHECK qdot_status qdot_stage_lower_sides(qdot_stage *stage);

/* The sign of u of a surface just behind t, seen before `until`, if u is a function of the time alone, as of delayed values; else, and if
 * u is 0 so long, 0. Sides as below. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_stage_sign_ahead(const qdot_stage *s, size_t surface, double t, double until, const double *y,
                                                  const int64_t *side, int *sign);
/* The sides of all surfaces at a state, the inner ones first, into side [surfaces].
 *   old  [surfaces] the sides before; NULL: all are decided anew. If u has the same value with
 *   the
 *        new inner sides as with the old ones (it did not jump) and is not constant, the surface
 *        keeps its entry in `side`.
 * Otherwise the side is that of u. If u is exactly 0, or an integer of a floor: 0 if u is
 * constant; else the entry in `side` if it is a neighbour, or the upper side if decided anew. To
 * which side the motion leaves is not known here. QDOT_EDOMAIN: a floor too large for a long.
 * Allocates. */
QDOT_MUST_CHECK qdot_status qdot_stage_sides(const qdot_stage *stage, double t,
                                             const double *y, const int64_t *old, int64_t *side);

/* Measure the layers of the surfaces (sim/model/layer.h) at the start of a run that looks at times
 * up to `latest` under tol (0: as thin as possible). Allocates. */
QDOT_MUST_CHECK qdot_status qdot_stage_layers(qdot_stage *stage, double t, const double *y,
                                              double latest, double tol);

/* Make stage->pucks, and measure the radii of the pucks at the start of a run that looks at times up to
 * `latest`. Allocates. */
QDOT_MUST_CHECK qdot_status qdot_stage_pucks(qdot_stage *stage, double t, const double *y,
                                             double latest);
/* Quantities of sliding disc i at a state, evaluated by the tape stage->pucks. */
typedef struct {
    size_t k;
    double speed;                                         /* speed |w| of the disc */
    double d[QDOT_PUCK_MOST], rate[QDOT_PUCK_MOST]; /* [k] velocities d; their derivatives without the terms of q'' */
    double G[QDOT_PUCK_MOST * QDOT_PUCK_MOST];      /* [k x k] the matrix G of |w|^2 = d.G d */
    double *slopes; /* [k x n] derivatives dd/dq', memory of the caller; NULL: not needed */
} qdot_puck_state;
QDOT_MUST_CHECK qdot_status qdot_stage_puck(const qdot_stage *stage, size_t i, double t,
                                            const double *y, qdot_puck_state *of);

/* Append a surface as text, such as "x' = 0". */
QDOT_MUST_CHECK qdot_status qdot_stage_describe(const qdot_stage *stage, size_t surface,
                                                int64_t side, qdot_text *out);

#endif
