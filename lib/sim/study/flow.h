/* flow.h -- the flow phi of a scene, z(t1) = phi(z(t0); p), with its slopes by z = (q, q') and parameters p.
 *
 * Any state may be begun at: under constraints it is brought onto them first, and so are slopes (tangents.h). The motion
 * over a long time is cut into segments so that slopes grow little in each of them (multiple shooting).
 *
 * Tests   tests/sim/study/test_shooting.c, test_orbits.c
 */
#ifndef QDOT_SIM_FLOW_H
#define QDOT_SIM_FLOW_H

#include "sim/study/response.h"

/* The tolerances of two flow maps; the difference of their results is taken as the error. */
extern const double qdot_flow_tolerance[2];

enum { QDOT_FLOW_LOOKS = 16, QDOT_FLOW_MOST_SEGMENTS = 32 };

/* The flow map of a scene: states after a time, with derivatives. Do not copy it: its response borrows from it. */
typedef struct {
    size_t n, z, p, m; /* numbers: coordinates n, z = 2n, parameters p; expressions: q, q', q'', perhaps one more */
    qdot_run_request request;
    qdot_expr *exprs, *unknowns; /* [m] expressions, [z + p] unknowns */
    const char **names;
    double *in;    /* [z + p] values of the unknowns */
    double *value; /* [QDOT_FLOW_LOOKS x m] values read last */
    double *by;    /* [QDOT_FLOW_LOOKS x m x (z + p)] derivatives of the values by the unknowns */
    qdot_response *response;
} qdot_flow;

/* Values of the request with the parameters [p] free; its start is not used. more: a further expression, or nil. From
 * {0}; ended in any case. Errors: those of qdot_response_new. */
QDOT_MUST_CHECK qdot_status qdot_flow_begin(qdot_flow *x, qdot_scene *scene, const qdot_run_request *request,
                                            size_t p, const qdot_expr *parameters, qdot_expr more, double tol,
                                            double length);
void qdot_flow_end(qdot_flow *x);

/* The motion from a state [z] and parameters [p], read at the end, or at `count` equal parts of the time; count 0: at its
 * beginning, then its end. Errors: those of qdot_response_run. */
QDOT_MUST_CHECK qdot_status qdot_flow_go(qdot_flow *x, const double *state, const double *parameters, double from,
                                         double to, size_t count);

/* The largest derivative of a state at time number `look` by its initial value, in units size [z]
 * of the states. */
double qdot_flow_growth(const qdot_flow *x, size_t look, const double *size);
/* Segments that are needed over T from a state, 1 where slopes stay tame. Of the guess of an orbit, if all grows on as fast
 * as until it was no longer tame: its run may have left for places where nothing does; *size [z] as far as slopes are. Of an
 * orbit, by the largest growth along it, as few as runs can bear; *size [z] (NULL: not wanted) how far states go, or where none
 * of a kind moves, units in which slopes are alike. That a run fails is none: it has grown to no end. */
QDOT_MUST_CHECK qdot_status qdot_flow_segments_of_guess(qdot_flow *x, const double *state, const double *parameters,
                                                        double t0, double T, double *size, size_t *segments);
QDOT_MUST_CHECK qdot_status qdot_flow_segments_of_orbit(qdot_flow *x, const double *state, const double *parameters,
                                                        double t0, double T, double *size, size_t *segments);

/* A closed orbit of period T in K segments; the states are z_k at t0 + k T/K. */
typedef struct {
    size_t K;
    double t0, T;
    const double *first, *others; /* start states of the segments: z_0 [z]; then z_1 ... z_(K-1) */
    const double *parameters;
} qdot_flow_orbit;

double qdot_flow_time(const qdot_flow_orbit *o, size_t k);
/* dz_i/dT at the end of segment k of K, z at its beginning held: with a longer period it begins later, and ends later. values
 * [2 x m], slopes [2 x m x (z + p)]: at its beginning, then its end (qdot_flow_go, count 0). */
double qdot_flow_by_period(const qdot_flow *x, const double *values, const double *slopes, size_t k, size_t K,
                           size_t i);
const double *qdot_flow_state(const qdot_flow *x, const qdot_flow_orbit *o, size_t k);
/* The flow's expressions at times within the period, in their order, by the motion in the segment of each: values
 * [count x m]. *at: the segment of the latest motion, SIZE_MAX: of none; it is the last one read afterwards. */
QDOT_MUST_CHECK qdot_status qdot_flow_read(qdot_flow *x, const qdot_flow_orbit *o, size_t *at, size_t count,
                                           const double *times, double *values);
/* What the tangents of the constraints at z_k become at z_(k+1), of those there: B [K x c x c], from the slopes at the ends of
 * the segments, ends + k step [z x (z + p)]. Without constraints c = z, and B are these. */
QDOT_MUST_CHECK qdot_status qdot_flow_factors(qdot_flow *x, const qdot_flow_orbit *o, const double *ends, size_t step,
                                              size_t *c, double *B);
/* Find the errors of the fine flow's matrices B [count] by those of the coarse flow, whose place they take. */
void qdot_flow_errors(size_t count, const double *B, double *coarse);
/* Add to E [K x c x c] what rounding leaves in these factors where both flows round alike, as in a slope that is 0 by
 * cancellation: some epsilons of the largest slope in units size [z] of the states. */
QDOT_MUST_CHECK qdot_status qdot_flow_rounding(qdot_flow *x, const qdot_flow_orbit *o, const double *ends, size_t step,
                                               const double *size, double *E);

#endif
