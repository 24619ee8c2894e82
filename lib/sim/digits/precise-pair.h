/* precise-pair.h -- the fields of a qdot_precise_pair: a run with `digits` and its companion run. */
#ifndef QDOT_SIM_PRECISE_PAIR_H
#define QDOT_SIM_PRECISE_PAIR_H

#include "base/interrupt.h"
#include "series/precise.h"
#include "sim/course/course-state.h"
#include "sim/form/precise-bind.h"

#define QDOT_LOG2_10 3.3219280948873626

/* A segment of a run between events and switches; a run without them is one segment. */
typedef struct {
    qdot_precise_run run;
    size_t mode;
    bool jumped;
} qdot_precise_segment;

/* One of the two runs of a pair: the run or its companion run. */
typedef struct {
    qdot_precise_bind **binds; /* [modes] equations of each mode in MPFR; NULL for modes that do not occur */
    size_t n_binds;
    qdot_vec(qdot_precise_segment) segments;
    const qdot_course *guide; /* the run in doubles that locates the events; NULL: no events or switches */
    struct qdot_precise_course *course; /* data for following the events, if there is a `guide` */
    qdot_reals times;         /* times of the events of the run in doubles */
    qdot_ode_result result;   /* integration result, summed over all segments */
    qdot_reals start; /* t0, t1 and start state y0 [2n] with all digits */
    double digits, log2_tol;
    int order;
    size_t near, near_segment; /* index of the point expanded last into a series (qdot_precise_at); index of its segment */
    qdot_status status;
    qdot_interrupt *interrupt; /* the flag of the thread that started this side's own */
    qdot_domains *domains; /* domains of coordinates, checked along the run; NULL for the companion run */
    double *y;             /* [2n] state in doubles, for checking the domains */
} qdot_precise_side;

typedef struct qdot_precise_pair qdot_precise_pair;
struct qdot_precise_pair {
    const qdot_plan *plan;
    const qdot_run_request *request; /* the request; used while the pair is made */
    const double *settled;    /* [2 plan->n] the start in doubles; used while the pair is made */
    const qdot_course *guide; /* the run in doubles that finds events and switches; NULL: none */
    size_t n;                        /* length of a state, 2 plan->n */
    int digits;
    qdot_precise_side run, companion;
    double log10_error; /* log10 of the estimated error; NaN: unknown */
};

/* log10 of the distance beyond which two runs count as unrelated: their errors have grown to everything. */
extern const double qdot_precise_parted;

/* Set pair->log10_error from distances at the end and before; NaN if the companion does not
 * arrive. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_precise_compare(qdot_precise_pair *pair);

/* Results of the earlier passes of a pair of runs, each with more digits; start from {.t = NaN}. */
typedef struct {
    double t; /* time at which the run and its companion run differed in the last pass; NaN: they did not */
    double digits, log10_error; /* digits and error of the first pass in which run and companion run agreed at the end */
} qdot_precise_progress;

/* Detect a singularity. In a chaotic scene twice the digits last twice the time; if run and
 * companion part at the same time again, there is a singularity. Past one, such as a cusp of
 * constraints, the error is a root of the precision carried, instead of proportional to it as
 * along a smooth motion. Both are QDOT_EFAILED, with the time or the digits gained.
 *
 * Tests  tests/bad/digits/digits-cusp.lag, digits-node.lag */
QDOT_MUST_CHECK qdot_status qdot_precise_check_progress(qdot_precise_pair *pair,
                                                        qdot_precise_progress *progress);

/* The first and the last point of a run in MPFR: time t, then state y [2n]. */
mpfr_t *qdot_precise_first(const qdot_precise_side *side);
mpfr_t *qdot_precise_last(const qdot_precise_side *side);

/* The segment of the run that contains t; at a time between two segments, the later one. */
size_t qdot_precise_segment_at(const qdot_precise_side *side, mpfr_srcptr t);

/* Evaluate the state y [2n] at t within a segment. */
QDOT_MUST_CHECK qdot_status qdot_precise_state_in(qdot_precise_side *side, size_t segment,
                                                  mpfr_srcptr t, mpfr_t *y);

/* Evaluate the state y [2n] of the run at t, which must lie within the run. */
QDOT_MUST_CHECK qdot_status qdot_precise_state(qdot_precise_side *side, mpfr_srcptr t,
                                               mpfr_t *y);

/* Evaluate a program whose inputs are those of the plan, at t and y [2n] in a mode;
 * `accelerations`: it reads q'' or multipliers. Errors: those of the mode's system. */
QDOT_MUST_CHECK qdot_status qdot_precise_evaluate(qdot_precise_side *side, size_t mode,
                                                  const qdot_plan *plan, qdot_precise *program,
                                                  bool accelerations, mpfr_srcptr t,
                                                  const mpfr_t *y);

/* Evaluate an exact constant, with the parameter values of the plan. */
QDOT_MUST_CHECK qdot_status qdot_precise_constant(const qdot_plan *plan, qdot_expr e,
                                                  mpfr_ptr x);

/* The number 10^x, never 0: an error below any double is rounded up. */
double qdot_precise_power(double x);

#endif
