/* run.h -- integrates a scene, with an estimate of the error.
 *
 * Parameters are substituted exactly before the equations are lowered to a tape, so terms that
 * vanish are not computed.
 *
 *   M(q, t) q'' = f(q, q', t)      y = (q_1 ... q_n, q_1' ... q_n')
 *
 * Events, coordinates that leave their domains and switches of the equations divide the run into
 * pieces (sim/course/course.h).
 *
 * M is factored numerically (Cholesky; LDL^T for a stated Lagrangian); a singular M is an error
 * that names the coordinate. With constraints q'' and the multipliers are solved for together and
 * states are projected onto the constraints: sim/model/constrained.h.
 *
 * Tests  tests/sim/
 */
#ifndef QDOT_SIM_RUN_H
#define QDOT_SIM_RUN_H

#include "sim/course/report.h"
#include "sim/model/request.h"

/* Integrate. On QDOT_OK *run is owned by the caller; report->status may still be FAILED (a
 * singularity, a domain left: reason says where and when), the run so far is kept. QDOT_EINTR:
 * *run is the run so far when it is not NULL. Errors before anything was integrated: QDOT_EUNSET
 * names the parameter, QDOT_ESINGULAR the coordinate, QDOT_EINVAL, QDOT_ENOTBUILT. */
QDOT_MUST_CHECK qdot_status qdot_run_new(qdot_scene *scene, const qdot_run_request *request,
                                         qdot_run **run);
void qdot_run_free(qdot_run *run);
size_t qdot_run_bytes(const qdot_run *run); /* memory used by the stored points, in bytes, approximately */
const qdot_run_report *qdot_run_get_report(const qdot_run *run);
double qdot_run_requested_end(const qdot_run *run); /* the requested end time, reached or not */

/* How far both companions of the run end from where it ends, apart [2 x 2n] like report->q, then report->v: by this much
 * companions of a run from there start aside, so that its error holds that of this one. *known: false where their ends say
 * nothing of it (other coordinates, `digits`, unknown errors). */
QDOT_MUST_CHECK qdot_status qdot_run_end_apart(qdot_run *run, double *apart, bool *known);

/* Any expressions [m] of the scene (coordinates, velocities, accelerations, t, parameters)
 * along the run at times [k], ascending or not: values [k*m] row by row, as accurate as the run;
 * errors [k*m] (NULL: not wanted) from the companion run, NaN unknown. Constants of the run are
 * the request's. QDOT_EDOMAIN: outside the run, with its range. */
QDOT_MUST_CHECK qdot_status qdot_run_values(qdot_run *run, size_t m, const qdot_expr *exprs,
                                            size_t k, const double *times, double *values,
                                            double *errors);

/* A list of times at[i] + low[i], i < n; low NULL: all low parts are 0. */
typedef struct {
    size_t n;
    const double *at, *low;
} qdot_exact_times;

/* As qdot_run_values at exact times: the slope of an expression at at[i] gives its change over
 * low[i]. */
QDOT_MUST_CHECK qdot_status qdot_run_values_beyond(qdot_run *run, size_t m,
                                                   const qdot_expr *exprs,
                                                   const qdot_exact_times *times, double *values,
                                                   double *errors);

/* As qdot_run_values at point k of qdot_run_times as the run came to it: where an event follows at the
 * same time, values [m] before that. Not of runs with `digits`. */
QDOT_MUST_CHECK qdot_status qdot_run_point_values(qdot_run *run, size_t m, const qdot_expr *exprs,
                                                  size_t k, double *values);
/* Whether point k + 1 has the same time as point k, because an event occurred between. */
bool qdot_run_is_before_event(const qdot_run *run, size_t k);

/* As qdot_run_values for a run with `digits`, at one time, an exact constant: values [m]
 * rationals, errors [m] (may be NULL) absolute, NaN unknown. */
QDOT_MUST_CHECK qdot_status qdot_run_exact_values(qdot_run *run, size_t m, const qdot_expr *exprs,
                                                  qdot_expr time, qdot_expr *values,
                                                  double *errors);

/* Exact values at point k of qdot_run_times beside an event: the state before it at the earlier of the two
 * points of one time, the state after it at the later. */
QDOT_MUST_CHECK qdot_status qdot_run_exact_point_values(qdot_run *run, size_t m,
                                                        const qdot_expr *exprs, size_t k,
                                                        qdot_expr *values, double *errors);

/* Over a range of a run: the largest or least value of e between its ends, extrema inside steps
 * included; its mean over time; its drift, max |e - e0| / max(1, |e0|) with e0 where the range
 * begins; its reach, max |e|. The error, from the companion: NaN where unknown. QDOT_EDOMAIN: outside the run, or e is
 * undefined in it. */
typedef enum {
    QDOT_RANGE_MAX,
    QDOT_RANGE_MIN,
    QDOT_RANGE_MEAN,
    QDOT_RANGE_DRIFT,
    QDOT_RANGE_REACH
} qdot_range_kind;
QDOT_MUST_CHECK qdot_status qdot_run_range(qdot_run *run, qdot_range_kind kind, qdot_expr e,
                                           double from, double to, double *value, double *error);

/* A symbol in an expression of several runs: it stands for the expression `value` along runs[run]. */
typedef struct {
    qdot_expr symbol, value;
    size_t run;
} qdot_run_member;

typedef struct {
    qdot_expr e; /* the expression; without members it is read along runs[0] */
    size_t n, m;
    qdot_run *const *runs;          /* [n] the runs, all different */
    const qdot_run_member *members; /* [m] values along named runs in e; includes unnamed varying symbols */
} qdot_run_expression;

/* As qdot_run_range, for an expression of several runs; range [2], NULL: all times that the runs
 * have in common. The error is the sum of those that each run makes. */
QDOT_MUST_CHECK qdot_status qdot_run_range_along(const qdot_run_expression *x,
                                                 qdot_range_kind kind, const double *range,
                                                 double *value, double *error);

/* Event k of the run, *name, NULL if there are no more; *undecided: whether it occurs at the end of the run,
 * which the errors leave open. */
QDOT_MUST_CHECK qdot_status qdot_run_event_at_end(qdot_run *run, size_t k, const char **name,
                                                  bool *undecided);

/* The occurrences of events [*n], in the order of the run, with the errors of their times from
 * the companion; borrowed. */
QDOT_MUST_CHECK qdot_status qdot_run_occurrences(qdot_run *run,
                                                 const qdot_run_occurrence **list, size_t *n);
/* Find the time spans [*n] in which errors hide whether an event occurs; borrowed. */
QDOT_MUST_CHECK qdot_status qdot_run_faded_events(qdot_run *run, const qdot_run_faded **list, size_t *n);
/* Whether the scene of the run had an event with this name. */
bool qdot_run_has_event(const qdot_run *run, const char *name);

/* The times of the accepted steps [*n], borrowed. */
const double *qdot_run_times(const qdot_run *run, size_t *n);

/* `plan`: how the scene would be integrated, and why, in words: coordinates, structure of M,
 * operations of the tape, method. Parameters need values as for a run. */
QDOT_MUST_CHECK qdot_status qdot_run_plan(qdot_scene *scene, const qdot_run_request *request,
                                          qdot_text *out);
#endif
