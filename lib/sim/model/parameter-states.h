/* parameter-states.h -- parameters that events set, as further coordinates of a run.
 *
 *     al' = 0, al'' = 0 between events;     then al = f(q, q', t, al)
 *
 * Mechanics is derived with al as the parameter that it is. In the numbers of a run its place
 * is taken by a coordinate of the same name, behind those of the scene: a row of its own in
 * M q'' = f, with M = 1 and f = 0, coupled to none. So all that reads a state - equations,
 * constraints, events, switches, `value`, companions, MPFR - has the value of the moment. A value of
 * another parameter that holds al follows it.
 *
 * Tests  tests/sim/test_parameter_states.c, tests/script/event-parameters.lag
 */
#ifndef QDOT_SIM_PARAMETER_STATES_H
#define QDOT_SIM_PARAMETER_STATES_H

#include "mech/scene/scene.h"
#include "sim/model/equations.h"

/* A request with these coordinates in it. Start from {0}. */
typedef struct {
    qdot_run_request request; /* borrows from the one it was made of, and from: */
    qdot_expr *expressions;   /* states, symbols, values, q0, v0 */
    bool *named;
} qdot_parameter_states;

/* The request of a run of the scene; the same where no event sets a parameter, or where it has
 * been made already. QDOT_EUNSET: such a parameter has no value to begin with. */
QDOT_MUST_CHECK qdot_status qdot_parameter_states_init(qdot_parameter_states *states,
                                                       const qdot_scene *scene,
                                                       const qdot_run_request *asked);
/* The same of parameters [n] without a value, where every run brings its own: q0 and v0 are NULL. */
QDOT_MUST_CHECK qdot_status qdot_parameter_states_open(qdot_parameter_states *states,
                                                       const qdot_scene *scene,
                                                       const qdot_run_request *asked, size_t n,
                                                       const qdot_expr *parameters);
void qdot_parameter_states_clear(qdot_parameter_states *states);

/* Coordinate i of a run, the scene's first; how many there are. */
size_t qdot_parameter_states_coordinates(const qdot_scene *scene,
                                         const qdot_run_request *request);
qdot_expr qdot_parameter_states_coordinate(const qdot_scene *scene,
                                           const qdot_run_request *request, size_t i);

/* Whether e, values put in, holds one of these coordinates of a plan; whether it moves
 * between events: it holds anything else that does. */
QDOT_MUST_CHECK qdot_status qdot_parameter_states_occur(const qdot_plan *plan, qdot_expr e,
                                                        bool *some, bool *moves);

/* What is declared of parameters and must hold behind every event. */
typedef struct {
    char *text;   /* "al > 0" */
    int op;       /* a qdot_rel_op of left and right */
    bool turned;  /* said with the right side first */
    const char *why; /* "declared", "assumed" ... */
} qdot_parameter_condition;

typedef struct {
    size_t n;
    qdot_parameter_condition *at;
    qdot_tape *sides; /* from q, q', t: left, right of each; NULL: no condition */
} qdot_parameter_conditions;

/* The declared domains of parameters, the assumptions and the rest lengths of springs that hold
 * what events set, and nothing that moves between them. Start from {0}. */
QDOT_MUST_CHECK qdot_status qdot_parameter_conditions_find(const qdot_plan *plan,
                                                           const qdot_scene *scene,
                                                           qdot_parameter_conditions *c);
void qdot_parameter_conditions_clear(qdot_parameter_conditions *c);

/* QDOT_EDOMAIN with the first that does not hold of y [2n] at t, where `event` made it. */
QDOT_MUST_CHECK qdot_status qdot_parameter_conditions_check(
    const qdot_parameter_conditions *c, const char *event, double t, const double *y, size_t n);

#endif
