/* range-parts.h -- data of a scan over a range of runs for extrema or a mean.
 *
 * range.c goes over the steps, range-step.c over the parts of one; range-poles.c treats parts too
 * short to be halved, range-seek.c searches for the largest values by intervals.
 *
 * Tests  tests/script/prove/narrow.lag
 */
#ifndef QDOT_SIM_RANGE_PARTS_H
#define QDOT_SIM_RANGE_PARTS_H

#include <float.h>
#include <math.h>

#include "num/chebyshev.h"
#include "sim/bind/polynomial-bounds.h"
#include "sim/course/reader.h"
#include "sim/course/run-state.h"
#include "sim/run/run.h"

/* Chebyshev coefficients below this multiple of the evaluation noise count as noise. */
#define QDOT_RANGE_NOISES 8

typedef struct {
    qdot_reader reader;
    qdot_polynomial_bounds bounds;
    qdot_range_kind kind;
    const size_t *pieces;     /* index of the present piece of each run */
    int nodes;
    double first;             /* value of the expression at the start of the time range */
    double largest, smallest; /* the extrema found so far */
    long double integral;
    double highest, lowest;   /* largest and smallest possible value where the expression was not evaluated */
    double rough;             /* error bound of the values of the expression */
    double sure[2];           /* certain values: the maximum is at least sure[0], the minimum at most sure[1] */
    double left;              /* error bound of the integral over intervals that no polynomial fits */
    double noise;             /* rounding noise of evaluating the expression in this step */
    double blur;              /* change of the expression by errors of the state within this step */
    double *least;            /* [inputs] smaller changes of inputs are rounding errors */
    size_t parts;             /* number of parts into which this step has been divided */
    size_t most_parts;        /* limit of `parts`: lowered after a step that exceeded it */
    double typical;           /* typical size of the expression's values in this step */
    double length;            /* duration of this step */
    bool above, below;        /* the expression is unbounded above, below, at the time `pole` */
    bool diverges;            /* the integral of the expression is infinite, too */
    double pole;
    bool sought; /* qdot_range_seek was called in this step */
    bool begun;
    bool open;   /* no bound of the expression is known in some interval */
    bool odd[2]; /* equations switch at the start, at the end of the step: there sign(0) is not the limit of sign */
    double ends[2]; /* start and end of this step */
} qdot_range_scan;

typedef struct {
    double a, b;
    int n;
    double tail; /* size of the last Chebyshev coefficients; INFINITY: not computed */
    bool rough;  /* the interval was accepted although its coefficients do not decrease to noise */
    double values[QDOT_CHEBYSHEV_MOST], c[QDOT_CHEBYSHEV_MOST];
} qdot_range_part;

/* The rounding error of the nodes' times, relative to the duration of the interval. */
static inline double
qdot_range_blur(const qdot_range_part *p)
{
    return DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)) / fabs(p->b - p->a);
}

/* By how much, relative to its size, a state between two points of the run is off from a smooth curve
 * through it: where a method has no polynomial, steps to there are made anew for each. */
static inline double
qdot_range_roughness(const qdot_trajectory *tr)
{
    return tr->method->series || tr->method->kernel ? 0x1p-53 : 4 * tr->tol;
}

static inline double
qdot_range_time(const qdot_range_part *p, double x)
{
    return qdot_chebyshev_place(p->a, p->b, x);
}

/* Whether the interval is so short that rounding dominates the differences of its nodes' times. */
static inline bool
qdot_range_is_short(const qdot_range_scan *s, const qdot_range_part *p)
{
    return fabs(p->b - p->a)
           <= fmax(64 * DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)), 0x1p-50 * s->length);
}

/* Whether the part begins or ends at a switch of the equations: within rounding its inputs are on
 * both sides. */
static inline bool
qdot_range_is_beside_switch(const qdot_range_scan *s, const qdot_range_part *p)
{
    return (s->odd[0] && p->a == s->ends[0]) || (s->odd[1] && p->b == s->ends[1]);
}

/* How far an interval's polynomial may be from the true values, by the bounds in s->bounds. */
static inline double
qdot_range_miss(const qdot_range_scan *s, const qdot_range_part *p)
{
    return 4 * p->tail + (isnan(s->bounds.miss[0]) ? 0 : s->bounds.miss[0]);
}

/* Include a value of the expression among the largest and smallest found so far. */
static inline void
qdot_range_meet(qdot_range_scan *s, double x)
{
    s->largest = fmax(s->largest, x);
    s->smallest = fmin(s->smallest, x);
    s->sure[0] = fmax(s->sure[0], x);
    s->sure[1] = fmin(s->sure[1], x);
}

/* --- one step (range-step.c) ---------------------------------------------------------- */

/* Evaluate the expression at time t; QDOT_EDOMAIN if it is undefined there. */
QDOT_MUST_CHECK qdot_status qdot_range_at(qdot_range_scan *s, double t, double *x);

/* All that lies between a and b, where no course begins another step. s->most_parts limits the
 * number of its parts. */
QDOT_MUST_CHECK qdot_status qdot_range_step(qdot_range_scan *s, double a, double b);

/* --- finding poles (range-poles.c) --------------------------------------------------- */

/* Find out whether a part that cannot be halved holds a pole; s->bounds.box of the part is known
 * (if it is finite there is none). */
void qdot_range_look_for_pole(qdot_range_scan *s, const qdot_range_part *p);

/* Extrapolate the values towards a short interval from both sides; s->bounds.box must be known. */
void qdot_range_look_towards(qdot_range_scan *s, const qdot_range_part *p);

/* --- bounds by intervals (range-seek.c) ---------------------------------------------- */

/* Find values near the largest and the smallest of this step, halving the part whose interval
 * reaches farthest first. */
QDOT_MUST_CHECK qdot_status qdot_range_seek(qdot_range_scan *s);

/* Whether the interval of a part, whose nodes are in s->bounds, shows that it holds no value
 * beyond those found, or, for a mean, contributes negligibly. The remaining error is added to s.
 *  */
bool qdot_range_is_beneath(qdot_range_scan *s, const qdot_range_part *p);

/* Add the error of the polynomial, or of an interval if that is less, for a part with values low
 * ... high so short that rounding of times shows in them. */
void qdot_range_bound_blurred(qdot_range_scan *s, const qdot_range_part *p, double low,
                              double high);

/* Add the bound of the values of a part that is not halved any further. Of a shortest part
 * without bound nothing is added: it may be a pole, or none. */
void qdot_range_leave_open(qdot_range_scan *s, const qdot_range_part *p, bool shortest);

#endif
