/* watch-parts.h -- what a watch is made of.
 *
 * For watch.c only, which goes over a step part by part: values of the functions
 * (watch-values.c), what is sure of them (watch-exclusion.c), and the polynomial of one function
 * on one part with its roots (watch-roots.c).
 *
 * Tests  as watch.h
 */
#ifndef QDOT_SIM_WATCH_PARTS_H
#define QDOT_SIM_WATCH_PARTS_H

#include "num/chebyshev.h"
#include "num/series.h"
#include "sim/course/polynomial-bounds.h"
#include "sim/course/root.h"
#include "sim/model/equations.h"

enum { QDOT_WATCH_NODES = QDOT_CHEBYSHEV_MOST };

/* How far a step has been looked at. */
struct qdot_watch_state {
    int *sign;  /* [m] the last that was not 0; 0: none yet */
    bool *on;   /* [m] g is 0 here, and so is it behind: */
    double *g0; /* [m] g here */
};

typedef struct qdot_watch qdot_watch;
struct qdot_watch {
    const qdot_plan *plan;
    const qdot_series_kernels *kernels;
    qdot_watch_reader reader; /* of the piece */
    qdot_tape *tape, *sizes; /* g; the sums of the sizes of their terms */
    size_t m, n;             /* functions; coordinates */
    bool accelerations;
    double tol;
    size_t *coordinate; /* [m] SIZE_MAX: not a bound */
    double *bound;      /* [m] */
    double *in;         /* of the tape */
    double *work, *g;   /* [m] g */
    double *moved;      /* [m] scratch of noise */
    double *z;          /* [2n] likewise */
    double *noise;      /* [m] of g in this step; NaN: not asked for */
    double *size;       /* [m] of the polynomial fitted last, */
    double *clear;      /* [m] and how far its bound keeps it from 0, if positive */
    qdot_polynomial_bounds bounds; /* what lies between the nodes, */
    bool bound_at_step;  /* or on the whole step: it is there */
    bool all_bounds;
    double *final;      /* [m] g at its end */
    double length;      /* of the step */
    double direction;   /* of time in it */

    /* The step's start, and how far it has been looked at. */
    double t, *y; /* [2n] */
    struct qdot_watch_state start, now;
    int *first;      /* [m] */
    bool *slow;      /* [m] it leaves its zero slower than can be told at the start */
    bool *fresh;     /* [m] nothing of `first` is known yet */
    bool *grazed;    /* [m] it touches 0 at the end of the step */
    bool *live;      /* [m] may have a root in this step */
    int nodes;       /* that did the last time */
    double *samples; /* [m x QDOT_WATCH_NODES] */
    double *ends;    /* [(DEEPEST + 2) x m] g at the ends of the parts that wait */
    qdot_vec(qdot_root) roots;
};

/* A part of a step, and a function on it. */
typedef struct {
    double a, b; /* times */
    int n;
    double c[QDOT_WATCH_NODES];
    bool from_zero; /* it is (g - g(a)) (b - a)/(t - a) */
    double at_end;  /* g(b) */
} qdot_watch_part;

/* What a part needs, the worst last. */
typedef enum {
    QDOT_PART_GOOD,
    QDOT_PART_MORE_NODES,
    QDOT_PART_HALVED,
    QDOT_PART_PARTED, /* beside the middle, where it may be singular */
    QDOT_PART_START_CUT /* a short part at its start alone */
} qdot_watch_verdict;

static inline int
qdot_watch_sign(double x)
{
    return (x > 0) - (x < 0);
}

QDOT_MUST_CHECK static inline qdot_status
qdot_watch_push(qdot_watch *w, qdot_root root)
{
    return qdot_vec_push(&w->roots, root);
}

/* --- values (watch-values.c) --------------------------------------------------------- */

/* The tapes of g [m], the values of the plan put in; shaken and errors as qdot_watch_new. */
QDOT_MUST_CHECK qdot_status qdot_watch_lower(qdot_watch *w, const qdot_expr *g,
                                             bool shaken);

/* g [m] at the state in w->in. QDOT_EDOMAIN where one is not finite. */
QDOT_MUST_CHECK qdot_status qdot_watch_value(qdot_watch *w, double t, double *g);

/* g [m] at t within the step; w->in is the state there. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_at(qdot_watch *w, double t, double *g);

/* How far g_i moves where t and every number of the state y [2n] does by the part `by` of
 * itself, of at least `least`: the sum over the numbers. What is undefined there counts
 * nothing. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise(qdot_watch *w, double t, const double *y,
                                             double by, double least, size_t i,
                                             double *noise);

/* --- what is sure (watch-exclusion.c) ------------------------------------------------ */

/* Of polynomials that fit all values at `nodes`: whether no root hides between these. */
qdot_watch_verdict qdot_watch_judge(qdot_watch *w, const qdot_watch_part *p, int nodes);

/* Whether functions on the step, by its series (NULL: none), are bounded: then g_i keeps its sign
 * where _excludes says so. */
void qdot_watch_bound(qdot_watch *w, const qdot_ode_expanded *step);
bool qdot_watch_excludes(const qdot_watch *w, size_t i);

/* --- roots (watch-roots.c) ----------------------------------------------------------- */

/* The time at x in -1 ... 1 of a part. */
double qdot_watch_time(const qdot_watch_part *p, double x);

/* Function i on the part as a polynomial p->c, from w->samples at `nodes` nodes. */
qdot_watch_verdict qdot_watch_fit(qdot_watch *w, qdot_watch_part *p, size_t i, int nodes);

/* What of it is not told from rounding there, after a fit. */
double qdot_watch_least(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* Its roots on the part, added to w->roots; w->now goes on to the part's end. */
QDOT_MUST_CHECK qdot_status qdot_watch_roots(qdot_watch *w, const qdot_watch_part *p,
                                             size_t i);

#endif
