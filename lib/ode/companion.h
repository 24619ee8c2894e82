/* companion.h -- estimates the error of the end of a run from further runs, its companions.
 *
 * Let y be the end state of a run under tol from y0. Its companion integrates the same system
 *
 *     by Taylor series if the system has them (not for radau), else by the partner of the
 *       method (method.h), for a stiff method by radau, also if series get stuck,
 *     under tol* = tol/100 (tol/5 for radau, tol/10 for msbdf; tol/10^6 for bsimp, which at loose tolerances is
 *       more accurate than they ask for by as much), or by series beside series as much less tight as the budget
 *       needs, at most tol/10; not below the method's companion_tol. If a
 *       method is its own partner and its tolerance cannot be 4 times tighter, tol* = 10 max(tol,
 *       companion_tol): then the companion errs more, on the safe side (a tighter one would share
 *       the rounding of the coefficients, which is a drift and not noise). taylor, whose
 *       coefficients
 *       are computed and not rounded once for all, takes tol/100 down to 1e-16, and three
 *       orders more than that asks for,
 *     from the double beside y0, the second of them from the next but one on the other side, +2^-53 s_i and -2^-52 s_i
 *     for a zero, signs mixed,
 *
 * to y*. The tighter tolerance shows the error of the method, the moved start the
 * rounding of the inputs (its zeros too) and, as all roundings of the second run differ,
 * that of the run itself.
 *
 *     apart_i = |y_i - (2 y*_1,i + y*_2,i)/3|,   own_i = 2/3 |y*_1,i - y*_2,i|
 *     error   = max(floor, max_i bound(apart_i, own_i))     (qdot_companion_bound)
 *     floor   = 2^-52 min(sqrt(steps), 32)
 *
 * relative to max(s_i, |y_i|), s_i the scales of the system (scale.h); `plain` is the same with s_i = 1.
 *
 * There are two companions, moved to either side, with three orders and one order more; no term of
 * theirs is so large that its rounding counts beside about the run's tolerance, not tol*. One is
 * not enough: if all is rounding, the difference of two random walks may be small by chance; near
 * an instability it is a single number; and if the tolerance dominates, a method may be so much
 * more accurate than requested that a companion errs as much as the run. They start on opposite
 * sides: their distance shows the amplification of the scene, of which their middle, by these weights,
 * is free. One double would be lost where a root halves it (the time of a fall); two of the first companion
 * make it dearer than a run beside a stiff force that they excite.
 *
 * A run whose first orders are sums of two doubles (leading.h) has exact inputs and errs by far
 * less than a rounding a step. Its companions are of the same kind and start
 *
 *     QDOT_COMPANION_AIMS eps max(s_i, |y_i|)
 *
 * away, and twice that, where eps is the error that its steps aim at; the floor is 2^-53,
 * by which its end is rounded, four times that if velocities follow from momenta.
 *
 * Ways. All that is spent on the error of a run is at most QDOT_COMPANION_MOST times what the run had
 * cost, and 2 QDOT_COMPANION_LEAST: the first companion has 1.55, the second 1.3 of that, by all ways
 * together. One that costs too much (meter.h) is given up, and another way is tried by what is left:
 *
 *     SERIES   Taylor series under tol*; beside a stiff method while they cost less than 0.4 of the run
 *     PARTNER  the partner of the method under its tol*: without series; radau beside a stiff method (radau
 *              itself only near its companion_tol, where the next way is not)
 *     FINER    a stiff method itself, the first under tol/16, the second under tol/32: it errs by a
 *              few times less, and the distance of the two shows by how much; not a multistep method,
 *              whose errors follow the tolerance only roughly, and not below its companion_tol
 *     COARSE   the run's own method under 4 tol, at least 10 companion_tol: it errs more than the run,
 *              on the safe side, and costs less
 *
 * A step may go over what a finer one would see, and the coarse one with it. So where a finer way was given
 * up and the run is then ten times farther from it than from the coarse one, and than tol, there is no number.
 *
 * If there is one, as the second is given up by its cost, `own` is 2 apart. If the first does not
 * arrive there is no number: known is false, the error a NaN.
 *
 * The caller moves the numbers in f (parameters), in the companion's own system. If a limit is
 * not a double exactly and the method has no t1_low, the caller passes its neighbour as the
 * companion's t1.
 *
 * Tests  tests/ode/test_companion.c
 */
#ifndef QDOT_ODE_COMPANION_H
#define QDOT_ODE_COMPANION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/status.h"
#include "ode/integrate.h"
#include "ode/meter.h"
#include "ode/trajectory.h"

/* The method by which a companion run (a repetition that estimates the run's error) is integrated. */
typedef enum {
    QDOT_COMPANION_SERIES,
    QDOT_COMPANION_PARTNER,
    QDOT_COMPANION_FINER,
    QDOT_COMPANION_COARSE,
    QDOT_COMPANION_WAYS /* number of these methods; also: no method is left */
} qdot_companion_way;

typedef struct {
    bool known;
    double error, plain;    /* the run's estimated error, relative to the scales s_i; the same for s_i = 1; NaN if unknown */
    double tol;             /* the tolerance tol* of the companion run */
    qdot_companion_way way; /* the last method that was tried for the companion */
    qdot_ode_result result; /* result of the companion run: its cost, why it did not arrive */
    double work;            /* work of both companion runs by all methods tried (meter.h) */
    double of_point;        /* work of reading the states of both companions at one time */
    bool kept[2]; /* whether companion k is stored in request->kept[k] and may be used for errors of values along the run */
} qdot_companion_estimate;

typedef struct qdot_companion qdot_companion;

/* The error stated for a number, from its distance `apart` from the middle of those of the companions
 * and QDOT_COMPANION_SHARE of the distance of these, `own`,
 *
 *     bound = 5/4 apart + 3 min(apart, own) + own.
 *
 * If the method's error dominates, companions are off by a small part of `apart`, and agree. If all is
 * the rounding of the three runs, errors with one normal distribution in one unstable direction, it is below
 * the run's in 3.5 cases of 100, and below half of it in 0.8; its median is 4.5 times that. If rounding is little
 * beside what moving the start by one double makes, it is 2 of these. */
double qdot_companion_bound(double apart, double own);
/* With a single companion, the error `own` counts as this many times `apart`, so that the bound is 13/4 `apart`. */
#define QDOT_COMPANION_ALONE 0.5

/* The distance of a value x of the run from the weighted mean of the values [count] of its companions, 1 or 2. */
double qdot_companion_apart(double x, size_t count, const double *theirs);

/* The error `own` of companion runs: 2/3 of the distance between the values of both. */
double qdot_companion_own(const double *theirs);

/* The error bound of a value x of the run, from the values of its companions. NaN if one of them has no value. */
double qdot_companion_bound_of(double x, size_t count, const double *theirs);

typedef struct {
    const qdot_ode_system *system;  /* for the companion alone if `threaded`; borrowed
                                       until _finish */
    const qdot_ode_system *twin; /* the system for the second companion run, borrowed until _finish; NULL: only one companion */
    const qdot_ode_method *method;  /* the method of the run */
    double tol, t0, t1;             /* tolerance, start and end time of the run */
    double t1_low;                  /* exact end time minus its double t1 (run.h) */
    const double *y0;               /* [n] start state; borrowed during _start */
    const double *carry;            /* [n] exact start state minus y0; NULL: 0; borrowed during _start */
    const double *units;            /* [n] in what y0 is moved where it is 0 (qdot_companion_unit);
                                       NULL: the system's scales; likewise */
    bool alternates; /* the run changes between a stiff method and series (alternate.c) */
    bool leading;                   /* the run computes the first orders of its series in two doubles (run.h) */
    double t0_low;                  /* exact start time minus its double t0 (run.h) */
    const qdot_ode_meter *meter;    /* of the run, begun (meter.h); NULL: companions may cost what
                                       they like; likewise */
    qdot_trajectory *kept[2];       /* {0}, where to store what each goes through, until _finish; NULL:
                                       it is dropped; likewise */
    bool threaded; /* run them on threads of their own; if there are none, or false, they run
                      within _finish */
} qdot_companion_request;

/* Start the companions. The moved start of a system that projects is projected. Errors:
 * QDOT_ENOMEM, those of projection. */
QDOT_MUST_CHECK qdot_status qdot_companion_start(const qdot_companion_request *request,
                                                 qdot_companion **out);

/* The times [*count], in the order of the run, at which the caller must show states of the run.
 * The difference at one time may be small by chance, so a companion by Taylor series compares
 * them at some times of its latter half, and the error becomes
 *
 *     max(error at the end, median of the errors at those times),
 *
 * but not more than 30 times that at the end: if errors die out, as in stiff scenes, the last
 * step may leave far less than those before. *count is 0 for other methods. */
const double *qdot_companion_times(const qdot_companion *c, size_t *count);
/* The times before the end at which companions are compared with the run, as fractions of the interval. */
const double *qdot_companion_places(size_t *count);

/* Give the companions the state y [n] of the run at comparison time k; it is copied. */
void qdot_companion_show(qdot_companion *c, size_t k, const double *y);

/* Show all states of the run, borrowed until _finish: where a way was given up, the run is compared with
 * how far that had come. */
void qdot_companion_show_course(qdot_companion *c, const qdot_trajectory *tr,
                                const qdot_ode_system *system);

typedef struct {
    const qdot_ode_method *method;
    double tol;
} qdot_companion_plan;

/* The first way, from `way` on, that there is for companion `number` of a run of that system by
 * that method, and *plan, its method and tolerance. */
qdot_companion_way qdot_companion_way_from(qdot_companion_way way, size_t number,
                                           const qdot_ode_system *system,
                                           const qdot_ode_method *method, double tol,
                                           qdot_companion_plan *plan);

/* All that is spent on the error of a run, in its work, and what each of two companions may cost in
 * any case, in about nanoseconds: together less than the process takes to start. It is for runs of a
 * few steps, and for a scene at rest: the run may need one step, while a companion moved by a rounding
 * oscillates all the time. */
#define QDOT_COMPANION_MOST 3.0
#define QDOT_COMPANION_LEAST 1e6

/* What remains of the work QDOT_COMPANION_MOST allowed for companions of a run of the given work, after `spent`. */
double qdot_companion_left(double work, double spent);

/* The meter of companion `number` by that way beside that of a run by `method`, after
 * `spent` on the ways before.
 * The last way may use what is left of the whole, wherever; parts of a system each begin anew, so only
 * their wholes are compared. */
void qdot_companion_meter(qdot_ode_meter *m, const qdot_ode_meter *run,
                          const qdot_ode_system *system, const qdot_ode_method *method, qdot_companion_way way,
                          size_t number, double spent);

/* Whether another way is worth trying, after one that `failed` or was found to cost too much: a
 * stiff method may spare what stops series, and go where a tight tolerance finds no step; else not
 * where the companion came to stand still, for it may have met what the run has stepped over. */
bool qdot_companion_leads_nowhere(const qdot_ode_method *method, bool failed,
                                  const qdot_ode_meter *meter);

/* Tell the companions the number of steps of the run, by which comparison times and the smallest error are chosen. */
void qdot_companion_limit(qdot_companion *c, uint64_t steps);

/* The first step of a companion, as a part of that which the run would take: a few steps may grow
 * alike whatever the tolerance, and err alike. */
double qdot_companion_first_share(size_t number);

/* The smallest error stated for a run of `steps` steps; `leading`: for one with first orders in two doubles. */
double qdot_companion_floor(const qdot_ode_system *system, bool leading, uint64_t steps);

/* The run has ended at t_end with y [n]: wait for the companions (if it ended before t1, until they
 * are beyond t_end), compare, and free them.
 *   difference  [n] out, may be NULL; NaN: unknown
 * Never fails: after a failure the error is unknown and result.reason says why. */
void qdot_companion_finish(qdot_companion *c, double t_end, const double *y,
                           double *difference, qdot_companion_estimate *out);

/* How many more orders a companion run by Taylor series has (qdot_ode_options.order_more), and the largest number. */
int qdot_companion_orders(size_t number);
#define QDOT_COMPANION_ORDERS 3

/* The tolerance beside which no rounding of a term counts in it (qdot_ode_options.term_tol), of a run
 * under tol: about that of the run, which near rounding it would else exceed in steps by several times. */
double qdot_companion_term_tol(double tol, size_t number);

/* Whether companions are first tried by series, where there are any: not those of radau, which is
 * for scenes that would stop series and is accurate enough itself. */
bool qdot_companion_is_by_series(const qdot_ode_method *method);

/* The method of a companion run; the second function: its tolerance, from the tolerance tol of the run. */
const qdot_ode_method *qdot_companion_method(const qdot_ode_system *system,
                                             const qdot_ode_method *method);
double qdot_companion_tolerance(const qdot_ode_system *system,
                                const qdot_ode_method *method, double tol);

/* In what component i of a start y [n] = (q, q') is moved if it is 0: its scale (scales NULL: 1), or |q_i|
 * for q'_i and |q'_i| for q_i, if that is less and not nothing beside it. What starts at 1e-8 and at rest has not the errors of what
 * starts at 1; where both are 0 nothing is known of the size that it will have. */
double qdot_companion_unit(const double *scales, size_t n, const double *y, size_t i);

/* The start of companion 0 or 1 in component i: the double beside y; for 1 so many away, on the other side; for a zero
 * multiples of 2^-53 of `scale`. */
#define QDOT_COMPANION_FAR 2
#define QDOT_COMPANION_SHARE (2.0 / (QDOT_COMPANION_FAR + 1))
double qdot_companion_moved(double y, double scale, size_t i, size_t number);

/* The start [n] of companion `number` beside that of its run, y [n]: moved by that; or, for a run whose first orders are
 * sums of two doubles, y itself, and low [n], what is known of it beyond, is moved by the distance
 * above. low NULL: it is no such run, and tol does not count. `alike`: coordinates of the same size are moved alike, opposite
 * ones oppositely, and so are velocities: bodies that meet something together do so in the companion. */
#define QDOT_COMPANION_AIMS 0.125
void qdot_companion_beside(const double *scales, size_t n, const double *y, size_t number, bool alike, double tol,
                           double *start, double *low);
/* Whether some coordinates of y [n], or some velocities, are of the same size. */
bool qdot_companion_has_alike(size_t n, const double *y);

#endif
