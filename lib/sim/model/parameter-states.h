/* parameter-states.h -- parameters that events set, as further coordinates of a run.
 *
 *     al' = 0, al'' = 0 between events;     then al = f(q, q', t, al)
 *
 * The equations are derived with al as a parameter. In a run a coordinate of the same name
 * replaces it, after those of the scene: a row of its own in M q'' = f, with M = 1 and f = 0,
 * coupled to none. So everything that reads a state - equations, constraints, events, switches,
 * `value`, companions, MPFR - reads the present value of al. The value of another parameter that
 * contains al follows it.
 *
 * Tests  tests/sim/model/test_parameter-states.c, tests/script/events/event-parameters.lag
 */
#ifndef QDOT_SIM_PARAMETER_STATES_H
#define QDOT_SIM_PARAMETER_STATES_H

#include "mech/scene/scene.h"
#include "sim/model/equations.h"

/* A request in which parameters that events set are further coordinates. Start from {0}. */
typedef struct {
    qdot_run_request request; /* the new request; it borrows from the original request and from `expressions` */
    qdot_expr *expressions;   /* memory for the request's lists states, symbols, values, q0, v0 */
    bool *named;
} qdot_parameter_states;

/* Extend the request of a run of the scene; unchanged if no event sets a parameter, or if it is
 * extended already. QDOT_EUNSET: such a parameter has no initial value. */
QDOT_MUST_CHECK qdot_status qdot_parameter_states_init(qdot_parameter_states *states,
                                                       const qdot_scene *scene,
                                                       const qdot_run_request *asked);
/* Extend the request by parameters [n] without a value, which every run supplies: q0, v0 are
 * NULL. */
QDOT_MUST_CHECK qdot_status qdot_parameter_states_open(qdot_parameter_states *states,
                                                       const qdot_scene *scene,
                                                       const qdot_run_request *asked, size_t n,
                                                       const qdot_expr *parameters);
void qdot_parameter_states_clear(qdot_parameter_states *states);

/* The number of coordinates of a run; coordinate i, those of the scene first. */
size_t qdot_parameter_states_coordinates(const qdot_scene *scene,
                                         const qdot_run_request *request);
qdot_expr qdot_parameter_states_coordinate(const qdot_scene *scene,
                                           const qdot_run_request *request, size_t i);

/* *some: whether e, with parameter values, contains one of these coordinates of a plan; *moves:
 * whether e changes between events, because it contains anything else that does. */
QDOT_MUST_CHECK qdot_status qdot_parameter_states_occur(const qdot_plan *plan, qdot_expr e,
                                                        bool *some, bool *moves);

/* A declared condition on parameters that must hold after every event. */
typedef struct {
    char *text;   /* the condition as text: "al > 0" */
    int op;       /* relation between left and right, a qdot_rel_op */
    bool turned;  /* messages print the relation with its two sides exchanged */
    const char *why; /* where the condition comes from: "declared", "assumed" ... */
} qdot_parameter_condition;

typedef struct {
    size_t n;
    qdot_parameter_condition *at;
    qdot_tape *sides; /* outputs: left and right side of each condition, from q, q', t; NULL: no conditions */
} qdot_parameter_conditions;

/* Find the declared domains of parameters, the assumptions and the rest lengths of springs that
 * contain what events set, and nothing that changes between events. Start from {0}. */
QDOT_MUST_CHECK qdot_status qdot_parameter_conditions_find(const qdot_plan *plan,
                                                           const qdot_scene *scene,
                                                           qdot_parameter_conditions *c);
void qdot_parameter_conditions_clear(qdot_parameter_conditions *c);

/* Check the conditions on parameters at t and y [2n] after an event; QDOT_EDOMAIN names the first violated. */
QDOT_MUST_CHECK qdot_status qdot_parameter_conditions_check(
    const qdot_parameter_conditions *c, const char *event, double t, const double *y, size_t n);

#endif
