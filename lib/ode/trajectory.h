/* trajectory.h -- stores a run and gives its state at any time.
 *
 * Every accepted step is stored. GSL's steppers have no dense output, so between stored
 * points the state is found by integrating again: from the stored point t_k before t one
 * step of h = t - t_k (more if its error estimate requires) by the partner of the run's
 * method (method.h: rk8pd, or bsimp for stiff methods), under the tolerance of the run.
 * A part of an accepted step is accurate too: the state at t is as accurate as the run, and does
 * not depend on earlier queries. It costs 13 evaluations (rk8pd), and one more for the first
 * query within a step. DOP853 has a polynomial: half the step is repeated, from t_k or back from
 * t_k+1, which costs 16 evaluations for all queries in that half. For a run by Taylor series
 * (taylor.h) the series of the step itself is expanded again from t_k for the first query within
 * it.
 *
 * A run may be of several pieces: each begins where the one before ended, from another
 * state or by another system (its mode). Then two points stand at one time, and a query
 * at that time gives the later one.
 *
 * Tests  tests/ode/test_trajectory.c
 */
#ifndef QDOT_ODE_TRAJECTORY_H
#define QDOT_ODE_TRAJECTORY_H

#include <stddef.h>

#include "base/memory.h"
#include "base/status.h"
#include "ode/step.h"

typedef struct {
    size_t first; /* index of the first point of the piece */
    size_t mode;  /* index (mode) of the system of equations that the piece uses */
    bool jumped;  /* the piece starts from a state other than the end of the piece before */
} qdot_trajectory_piece;

/* A change of the integration method during a run (alternate.c). */
typedef struct {
    size_t first; /* index of the point from which the new method is used */
    const qdot_ode_method *method;
} qdot_trajectory_turn;

typedef struct qdot_trajectory {
    size_t n;     /* number of components of the state */
    size_t count; /* number of stored points, the initial state included */
    double *t;    /* [count] times of the points, strictly monotone within a piece, in the direction of the run */
    double *y;    /* [count x n] states, row-major */
    const qdot_ode_method *method; /* the integration method of the steps before the first entry of `turns` */
    double tol;
    int order_more;         /* increase of the order, as in the run's options (run.h) */
    bool leading;           /* as in the run's options: first orders in two doubles */
    double t0_low;          /* exact start time minus its double t[0] */
    double *low;            /* [count x n] exact states minus their doubles y, if `leading` */
    qdot_ode_result result; /* result of the run */
    bool entered;           /* its solution was entered before its first point: it is a part of a
                               longer one (`following` of ode/system.h) */
    size_t t_capacity, y_capacity, low_capacity;
    qdot_vec(qdot_trajectory_piece) pieces;
    qdot_vec(qdot_trajectory_turn) turns;
    /* For a system integrated in parts (ode/apart.h): the trajectory of each part; the points
     * above are those of the part with the most. One piece only. */
    struct qdot_trajectory *tracks; /* [n_tracks] trajectories (tracks) of the decoupled parts */
    size_t n_tracks;
    /* Of a run by another variable s, in which t is a component of the state
     * (qdot_trajectory_by_clock): */
    double *s;    /* [count] the variable s by which the run was integrated, at the points; NULL: s is t itself */
    size_t clock; /* index of the component of the state that is the time t, if s is not t */
} qdot_trajectory;

/* Release a trajectory, which must have been initialised with {0}. */
void qdot_trajectory_clear(qdot_trajectory *tr);

/* Integrate as qdot_ode_integrate does and store the run (earlier contents are dropped).
 *   y0  [n] initial state; borrowed during the call; may be a row of tr->y
 * Returns what qdot_ode_integrate returns, or QDOT_ELIMIT beyond 2 GB of points, always
 * with the run so far kept and tr->result filled. options->accepted is called before a
 * point is stored. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_run(qdot_trajectory *tr,
                                                const qdot_ode_system *system,
                                                const qdot_ode_method *method,
                                                const qdot_ode_options *options,
                                                double t0, double t1, const double *y0);

/* Begin a piece at the time of the last point, from y0 [n] (no row of tr->y), by the system with the index `mode`
 * among those that the run will be read with. If the last piece has one point only, the new one
 * replaces it. Then either record it to t1, as qdot_trajectory_run does, or add its steps and end it with
 * the result of their controller. The counts of tr->result are continued. Errors as there. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_begin_piece(qdot_trajectory *tr, size_t mode, bool jumped,
                                                        const qdot_ode_options *options, const double *y0);
QDOT_MUST_CHECK qdot_status qdot_trajectory_record(qdot_trajectory *tr, const qdot_ode_system *system,
                                                   const qdot_ode_options *options, double t1);
/* Store the end of a step that was taken, before it is accepted, in a run to t1. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_add(qdot_trajectory *tr, const qdot_ode_options *options, double t1,
                                                const qdot_ode_step *step);
void qdot_trajectory_end_piece(qdot_trajectory *tr, const qdot_ode_result *result);

/* Replace the last point by (t, y [n]), which lies within the last step. If that is the start of
 * the step, the last point is removed. */
void qdot_trajectory_shorten(qdot_trajectory *tr, double t, const double *y);

/* The state at t into y [n]; a stored point is given back bit by bit.
 *   system  the one of the run, or [modes] of its pieces
 * Errors: QDOT_EDOMAIN if t is outside the run (the message says what it covers),
 * QDOT_EFAILED if no step from the stored point works, QDOT_ENOMEM, or what a callback
 * returned. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_at(const qdot_trajectory *tr,
                                               const qdot_ode_system *system, double t,
                                               double *y);

/* For many times: keeps its work space, the position in the run and f at the stored point.
 * Times may come in any order; neighbouring ones are fast. */
typedef struct qdot_trajectory_cursor qdot_trajectory_cursor;

/* `tr` and `system` are borrowed until _close. Errors: QDOT_EDOMAIN (no run is stored),
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_open(const qdot_trajectory *tr,
                                                 const qdot_ode_system *system,
                                                 qdot_trajectory_cursor **out);
void qdot_trajectory_close(qdot_trajectory_cursor *c);

/* Read the state at t with a cursor; results and errors are those of qdot_trajectory_at. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_read(qdot_trajectory_cursor *c, double t,
                                                 double *y);

/* The number of evaluations of f that reading with this cursor has needed so far; 0 for Taylor series. */
uint64_t qdot_trajectory_evaluations(const qdot_trajectory_cursor *c);

/* The mode (index of the system of equations) of the piece to which the state just read belongs. */
size_t qdot_trajectory_mode_read(const qdot_trajectory_cursor *c);

/* The series of the step that the last read was within, of the system *of; false: it was by none, or at
 * a stored point. step->t_end is the end of the step. */
bool qdot_trajectory_expanded(const qdot_trajectory_cursor *c, const qdot_ode_system **of,
                              qdot_ode_expanded *step);

/* Read the state of the given piece of the run at t; outside of the piece, at its end that is nearer to t. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_read_piece(qdot_trajectory_cursor *c,
                                                       size_t piece, double t, double *y);

/* --- for files of trajectories: runs in decoupled parts (trajectory-apart.c) --- */
/* Continue a trajectory of one point to t1 with a track for each part; the points of
 * the whole become those of the part with the most steps. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_record_apart(qdot_trajectory *tr,
                                                         const qdot_ode_system *system,
                                                         const qdot_ode_options *options,
                                                         double t1);
/* Append a point; qdot_trajectory_read_tracks: read the state from the trajectories of the parts only. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_store(qdot_trajectory *tr, double t,
                                                  const double *y);
QDOT_MUST_CHECK qdot_status qdot_trajectory_read_tracks(qdot_trajectory_cursor *c,
                                                        double t, double *y);

/* Put points between those that are stored, so that each step is of so many equal ones. Nothing is
 * done to a run in parts, or with points in two doubles. Errors: those of reading. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_refine(qdot_trajectory *tr,
                                                   const qdot_ode_system *system,
                                                   size_t parts);

/* From here on the time of a run that was made by another variable s is component `clock`, which is
 * monotone; its rate stands n/2 components behind it. Points are found, and read, by it: t of the
 * points is that component, s what t was. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_trajectory_by_clock(qdot_trajectory *tr, size_t clock);

/* Tell the cursor that stored points of its trajectory have been changed. */
void qdot_trajectory_renew(qdot_trajectory_cursor *c);

/* The index of the piece of the run to which stored point k belongs. */
size_t qdot_trajectory_piece_of(const qdot_trajectory *tr, size_t k);

/* The integration method of the step that begins at stored point k. */
const qdot_ode_method *qdot_trajectory_method_of(const qdot_trajectory *tr, size_t k);

/* The method of the last step, with which one that changes methods goes on. */
static inline const qdot_ode_method *
qdot_trajectory_method_now(const qdot_trajectory *tr)
{
    return tr->turns.n > 0 ? tr->turns.at[tr->turns.n - 1].method : tr->method;
}

/* The index of the last stored point of a piece. */
size_t qdot_trajectory_last_of(const qdot_trajectory *tr, size_t piece);

/* Restrict the interval of times *low ... *high to times that the run covers. */
void qdot_trajectory_narrow(const qdot_trajectory *tr, double *low, double *high);

/* Whether the run goes backwards in time. */
static inline bool
qdot_trajectory_is_backward(const qdot_trajectory *tr)
{
    return tr->t[tr->count - 1] < tr->t[0];
}

/* Index k of the last stored point that is not beyond t, in the direction of the run;
 * t must lie within it. `near`: where to look first. */
size_t qdot_trajectory_locate(const qdot_trajectory *tr, double t, size_t near);

#endif
