/* meter.h -- counts the work of an integration, and ends one that costs too much beside another.
 *
 * Work is counted, not timed, so that a run says the same on every machine and under any load:
 * expansions to the order of the run by the model of their cost (qdot_ode_cost.kernels), else
 * evaluations of f, Jacobians and factorisations. The unit is about a nanosecond.
 *
 * A meter keeps marks: the work W(t) when the integration had come to t, one whenever W has grown
 * by an eighth. Let w be the run's, taken at its first mark at or beyond t, and w1 its whole. A
 * companion has cost too much if at some mark of its own
 *
 *     W(t) > early_factor w(t) + early   or   spent + W(t) > factor w1 + allowance,
 *
 * `spent` being the work of what was tried before it; marks beyond the end of a run that ended before its
 * goal do not count. So one that goes nowhere is given up early. It is
 * looked for while the companion runs, as far as the run has come, and in any case afterwards
 * (qdot_ode_meter_exceeds): the answer does not depend on which of the two threads was faster.
 *
 * Tests  tests/ode/test_meter.c
 */
#ifndef QDOT_ODE_METER_H
#define QDOT_ODE_METER_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "ode/run.h"

enum { QDOT_ODE_MARKS = 256 };

typedef struct {
    double t, work;
} qdot_ode_mark;

struct qdot_ode_meter {
    const qdot_ode_meter *beside; /* meter of the run with which this work is compared, borrowed; NULL: no limit */
    double factor, allowance;
    double early_factor, early; /* like `factor` and `allowance`, but beside the other run's work up to the same time */
    double most;       /* end with QDOT_ELIMIT beyond this much work; 0: no limit */
    double spent;      /* work of earlier attempts for the same purpose, which counts, too */
    double direction;  /* direction of time: +1 or -1 */
    double t0;
    bool whole_only;   /* decoupled parts each start at t0, so only the total can be compared */
    double work;       /* the work so far */
    double far;        /* the farthest time t reached so far */
    double next;       /* the work at which the next mark will be set */
    size_t judged;     /* number of marks of this run that have been compared with the other run */
    bool over;         /* the work exceeded its limit */
    atomic_size_t count;
    atomic_bool ended;
    qdot_ode_mark marks[QDOT_ODE_MARKS];
};

/* The reason that is stated when a companion run is ended; %.2g stands for the factor. */
#define QDOT_ODE_METER_REASON "it would take more than %.2g times the work of this one"

/* Begin to count the work of an integration from t0 towards t1; the fields beside, factor, allowance and most are kept. */
void qdot_ode_meter_begin(qdot_ode_meter *m, double t0, double t1);

/* Record that the integration has reached t with `work` more. QDOT_ELIMIT: it costs too much, beside the other
 * or by itself. */
QDOT_MUST_CHECK qdot_status qdot_ode_meter_add(qdot_ode_meter *m, double t, double work);

/* Record that the integration has ended: its total work then counts for all times beyond its end. */
void qdot_ode_meter_end(qdot_ode_meter *m);

/* Whether it has cost too much beside the run, which has ended. *work: what it had cost when that
 * could first be seen; else its whole work. */
bool qdot_ode_meter_exceeds(const qdot_ode_meter *m, double *work);

/* Whether it came to stand still: the later half of its work brought it on by less than a fiftieth
 * of what the first half did. */
bool qdot_ode_meter_is_stuck(const qdot_ode_meter *m);

/* The work in ns for the operations counted in `stats`, by a method without series. */
double qdot_ode_work(const qdot_ode_system *system, const qdot_ode_stats *stats);

/* The work in ns of one Taylor expansion to order p. */
double qdot_ode_expansion_work(const qdot_ode_series *series, int p);

#endif
