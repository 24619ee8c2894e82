/* range-parts.h -- what a scan over a range is made of.
 *
 * For range.c only, which goes over the steps of a run part by part: where a part is too short to be
 * halved (range-poles.c), and where the largest values are, as intervals have it (range-seek.c).
 *
 * Tests  tests/script/narrow.lag
 */
#ifndef QDOT_SIM_RANGE_PARTS_H
#define QDOT_SIM_RANGE_PARTS_H

#include <float.h>
#include <math.h>

#include "num/chebyshev.h"
#include "sim/course/polynomial-bounds.h"
#include "sim/course/reader.h"
#include "sim/course/run-state.h"
#include "sim/run/run.h"

/* Of the noise of evaluating: coefficients below it are nothing else. */
#define QDOT_RANGE_NOISES 8

typedef struct {
    qdot_reader reader;
    qdot_polynomial_bounds bounds;
    qdot_range_kind kind;
    size_t piece;
    int nodes;
    double first;             /* the value where the range begins */
    double largest, smallest; /* so far */
    long double integral;
    double highest, lowest;   /* limits at points that no value reaches */
    double rough;             /* what values are off by */
    double sure[2];           /* the largest is not below, the smallest not above */
    double left;              /* what parts that stay rough leave open of the integral */
    double noise;             /* of evaluating it in the step at hand */
    double blur;              /* what a state off by 2^-53 max(1, |x|) makes of it there */
    size_t parts;             /* of that step so far, */
    size_t most_parts;        /* and at most: less after one that was not enough for */
    double typical;           /* value in that step */
    double length;            /* of that step */
    bool above, below;        /* it has no bound there, at the time */
    bool diverges;            /* nor has its integral */
    double pole;
    bool sought; /* qdot_range_seek was here in this step */
    bool begun;
    bool open;   /* what it is somewhere is not known at all */
    bool odd[2]; /* the step begins, ends where equations switch: sign(0) is no limit */
    double ends[2];
} qdot_range_scan;

typedef struct {
    double a, b;
    int n;
    double tail; /* the last coefficients; INFINITY before they are known */
    bool rough;  /* taken for what it is */
    double values[QDOT_CHEBYSHEV_MOST], c[QDOT_CHEBYSHEV_MOST];
} qdot_range_part;

/* How far rounding moves the nodes, of the length of the part. */
static inline double
qdot_range_blur(const qdot_range_part *p)
{
    return DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)) / fabs(p->b - p->a);
}

static inline double
qdot_range_time(const qdot_range_part *p, double x)
{
    return qdot_chebyshev_place(p->a, p->b, x);
}

/* A part so short that rounding of times is all that is in it. */
static inline bool
qdot_range_is_short(const qdot_range_scan *s, const qdot_range_part *p)
{
    return fabs(p->b - p->a)
           <= fmax(64 * DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)), 0x1p-50 * s->length);
}

/* A part that begins or ends where equations switch: what its inputs may be there, by rounding, lies
 * on both sides. */
static inline bool
qdot_range_is_beside_switch(const qdot_range_scan *s, const qdot_range_part *p)
{
    return (s->odd[0] && p->a == s->ends[0]) || (s->odd[1] && p->b == s->ends[1]);
}

/* A value of the expression. */
static inline void
qdot_range_meet(qdot_range_scan *s, double x)
{
    s->largest = fmax(s->largest, x);
    s->smallest = fmin(s->smallest, x);
    s->sure[0] = fmax(s->sure[0], x);
    s->sure[1] = fmin(s->sure[1], x);
}

/* --- poles (range-poles.c) ----------------------------------------------------------- */

/* Both after s->bounds.box has been found for the part: where it is finite there is none.
 * Whether there is a pole in a part that could not be shorter. */
void qdot_range_look_for_pole(qdot_range_scan *s, const qdot_range_part *p);

/* What the values tend to towards a short part from both sides. */
void qdot_range_look_towards(qdot_range_scan *s, const qdot_range_part *p);

/* --- by intervals (range-seek.c) ----------------------------------------------------- */

/* Meets values near the largest and the smallest of the step at hand: the part that may reach
 * farthest by its interval is halved first. */
QDOT_MUST_CHECK qdot_status qdot_range_seek(qdot_range_scan *s);

/* Of a part whose nodes s->bounds has: whether it holds nothing beyond what was met, or of a mean
 * nothing that counts, as its interval shows. What that leaves open is noted. */
bool qdot_range_is_beneath(qdot_range_scan *s, const qdot_range_part *p);

/* Of a part low ... high so short that rounding of times is seen in its values: the error of the result
 * holds what the polynomial is off by, unless an interval says less. */
void qdot_range_bound_blurred(qdot_range_scan *s, const qdot_range_part *p, double low,
                              double high);

/* Of a part that was not looked at any closer: what its values may be at most. Of the shortest ones
 * nothing where the formula has no bound: that may be a pole, or none. */
void qdot_range_leave_open(qdot_range_scan *s, const qdot_range_part *p, bool shortest);

#endif
