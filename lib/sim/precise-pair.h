/* precise-pair.h -- a qdot_precise_pair from inside. */
#ifndef QDOT_SIM_PRECISE_PAIR_H
#define QDOT_SIM_PRECISE_PAIR_H

#include "sim/precise-bind.h"
#include "sim/precise.h"

#define QDOT_LOG2_10 3.3219280948873626

/* One of the two runs. */
typedef struct {
    qdot_precise_bind *bind;
    qdot_precise_run run;
    qdot_reals start; /* t0, t1, y0 [2n] */
    double digits;
    int order;
    size_t near; /* of qdot_precise_at */
    qdot_status status;
    qdot_domains *domains; /* watched by the run itself; else NULL */
    double *y;             /* [2n] for them */
} qdot_precise_side;

struct qdot_precise_pair {
    const qdot_plan *plan;
    const qdot_run_request *request; /* while it is made */
    size_t n;                        /* 2 plan->n */
    int digits;
    qdot_precise_side run, companion;
    double log10_error; /* NaN: unknown */
};

/* The state y [2n] of one of them at t, which must lie within it. */
QDOT_MUST_CHECK qdot_status qdot_precise_state(qdot_precise_side *side, mpfr_srcptr t,
                                               mpfr_t *y);

/* An exact constant, the values of the plan in place. */
QDOT_MUST_CHECK qdot_status qdot_precise_constant(const qdot_plan *plan, qdot_expr e,
                                                  mpfr_ptr x);

/* 10^x, never 0: what is below any double is stated too large. */
double qdot_precise_power(double x);

#endif
