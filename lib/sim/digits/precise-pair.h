/* precise-pair.h -- a qdot_precise_pair from inside. */
#ifndef QDOT_SIM_PRECISE_PAIR_H
#define QDOT_SIM_PRECISE_PAIR_H

#include "series/precise.h"
#include "sim/course/course-state.h"
#include "sim/form/precise-bind.h"

#define QDOT_LOG2_10 3.3219280948873626

/* A piece of it: one, where nothing divides the run. */
typedef struct {
    qdot_precise_run run;
    size_t mode;
    bool jumped;
} qdot_precise_segment;

/* One of the two runs. */
typedef struct {
    qdot_precise_bind **binds; /* [modes], as far as they were met; NULL else */
    size_t n_binds;
    qdot_vec(qdot_precise_segment) segments;
    const qdot_course *guide; /* NULL: nothing divides the run */
    struct qdot_precise_course *course; /* with a guide */
    qdot_reals times;         /* of the guide's occurrences */
    qdot_ode_result result;   /* of all segments */
    qdot_reals start; /* t0, t1, y0 [2n] */
    double digits, log2_tol;
    int order;
    size_t near, near_segment; /* of qdot_precise_at */
    qdot_status status;
    qdot_domains *domains; /* watched by the run itself; else NULL */
    double *y;             /* [2n] for them */
} qdot_precise_side;

typedef struct qdot_precise_pair qdot_precise_pair;
struct qdot_precise_pair {
    const qdot_plan *plan;
    const qdot_run_request *request; /* while it is made */
    const double *settled;    /* [2 plan->n] the start in doubles; likewise */
    const qdot_course *guide; /* what divides it; NULL */
    size_t n;                        /* 2 plan->n */
    int digits;
    qdot_precise_side run, companion;
    double log10_error; /* NaN: unknown */
};

/* log10 of a distance at which two runs have nothing to do with each other. */
extern const double qdot_precise_parted;

/* pair->log10_error, at the end and between; NaN where the companion does not reach it.
 * Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_precise_compare(qdot_precise_pair *pair);

/* What the passes of a pair, with more digits each, have shown so far; from {.t = NaN}. */
typedef struct {
    double t;                   /* when they parted the last time; NaN */
    double digits, log10_error; /* of the first pass that came together */
} qdot_precise_progress;

/* In a chaotic scene twice the digits last twice the time; where they part at the same time
 * again there is a singularity. Through one, such as a cusp of constraints, an error follows
 * a root of what is carried, where it follows that itself along any smooth motion. Both are
 * QDOT_EFAILED, with the time or what was gained.
 *
 * Tests  tests/bad/digits-cusp.lag, digits-node.lag */
QDOT_MUST_CHECK qdot_status qdot_precise_check_progress(qdot_precise_pair *pair,
                                                        qdot_precise_progress *progress);

/* Its first and its last point. */
mpfr_t *qdot_precise_first(const qdot_precise_side *side);
mpfr_t *qdot_precise_last(const qdot_precise_side *side);

/* The segment that t lies in: of two the later. */
size_t qdot_precise_segment_at(const qdot_precise_side *side, mpfr_srcptr t);

/* The state y [2n] at t of a segment. */
QDOT_MUST_CHECK qdot_status qdot_precise_state_in(qdot_precise_side *side, size_t segment,
                                                  mpfr_srcptr t, mpfr_t *y);

/* The state y [2n] of one of them at t, which must lie within it. */
QDOT_MUST_CHECK qdot_status qdot_precise_state(qdot_precise_side *side, mpfr_srcptr t,
                                               mpfr_t *y);

/* A program whose inputs are those of the plan at the state y [2n] of t, by a mode; `accelerations`:
 * it reads q'' or multipliers. Errors: as the mode's system has. */
QDOT_MUST_CHECK qdot_status qdot_precise_evaluate(qdot_precise_side *side, size_t mode,
                                                  const qdot_plan *plan, qdot_precise *program,
                                                  bool accelerations, mpfr_srcptr t,
                                                  const mpfr_t *y);

/* An exact constant, the values of the plan in place. */
QDOT_MUST_CHECK qdot_status qdot_precise_constant(const qdot_plan *plan, qdot_expr e,
                                                  mpfr_ptr x);

/* 10^x, never 0: what is below any double is stated too large. */
double qdot_precise_power(double x);

#endif
