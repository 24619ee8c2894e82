/* watch-parts.h -- the members of a watch.
 *
 * For watch.c only, which goes over a step part by part: values of the functions
 * (watch-values.c; in two doubles: watch-two.c) and their rounding (watch-noise.c), proofs that a part holds no further roots (watch-exclusion.c), the
 * polynomial of one function on one part with its roots (watch-roots.c), whether its rounding hides
 * some (watch-resolution.c), which way the function asked for goes (watch-turns.c), and roots on a part of a few
 * thousand doubles in which no polynomial represents the function (watch-rough.c).
 *
 * Tests  as watch.h
 */
#ifndef QDOT_SIM_WATCH_PARTS_H
#define QDOT_SIM_WATCH_PARTS_H

#include "num/chebyshev.h"
#include "num/series.h"
#include "series/two.h"
#include "sim/bind/polynomial-bounds.h"
#include "sim/watch/root.h"
#include "sim/model/equations.h"

enum { QDOT_WATCH_NODES = QDOT_CHEBYSHEV_MOST, QDOT_WATCH_LEAST_NODES = 16 };

/* How often a part of a step may be halved. */
enum { QDOT_WATCH_DEEPEST = 100 };

/* The largest |g|, also at a pole: it can be added up, multiplied by the square of a number of nodes, divided
 * by the distance of nodes. */
#define QDOT_WATCH_MOST 0x1p900

/* Near a located root |g| below this part of its size counts as 0, as the time of the root is rounded. */
#define QDOT_WATCH_NEGLIGIBLE 0x1p-10

/* A function of at most this many times its noise counts as 0. */
#define QDOT_WATCH_ROUNDINGS 16

/* The value of n_extrema as long as the extrema have not been computed. */
#define QDOT_WATCH_UNKNOWN (-2)

/* The signs of the functions at the time up to which the step has been searched. */
struct qdot_watch_state {
    int *sign;  /* [m] the last sign that was not 0; 0: none yet, or none since a root from which on
                   g stays 0 */
    bool *on;   /* [m] g_i is 0 at the start of the step */
    bool *blurred; /* [m] which is an extremum within rounding of 0, or a jump to it: two doubles tell no more
                      of it */
    double *g0; /* [m] g at that zero, or at the start of the present part */
    bool *sharp; /* [m] g0 has been computed in two doubles */
    double *offset; /* [m] value of g at its zero due to rounding, subtracted from values in two doubles */
};

typedef struct qdot_watch qdot_watch;
struct qdot_watch {
    const qdot_plan *plan;
    const qdot_series_kernels *kernels;
    qdot_watch_reader reader; /* reads states within the step */
    qdot_tape *tape, *sizes; /* outputs: g; sums of the magnitudes of their terms */
    qdot_tape *plain; /* outputs: g without shaken constants; NULL: `tape` is not shaken */
    /* Fields for values in sums of two doubles (watch-two.c). */
    qdot_tape_two *two;   /* evaluates g in two doubles; NULL: not needed yet */
    qdot_two *state_two;  /* [2n] scratch state in two doubles */
    struct qdot_precise *many; /* evaluates g in many digits (watch-flat.c); NULL: not needed yet */
    double *settled; /* [m] the time of the flat root at which a piece began; NaN: none */
    bool *deep; /* [m] evaluate g in many digits: first step of a piece that starts on its zero */
    bool any_deep;
    double *hidden; /* [m] of these: what rounding of their operations hides of the bounds on the part; 0: not computed */
    bool *may_be_flat; /* [m] flat roots of g may be located in many digits */
    int *leaves;     /* [m] sign of g just after the start */
    struct qdot_watch_turn *turns; /* [m] directions of the original functions (watch-turns.c); NULL: as g */
    bool *smooth;         /* [m] g contains no switching function and is not a bound */
    bool *clock;          /* [m] g is a function of t only */
    bool expanded;        /* the step has a Taylor series */
    bool *wants;          /* [m] the sign of g_i in this part must be determined in two doubles */
    bool fine;            /* such values are in two doubles at present */
    /* all switches in the functions keep their sides in the present interval, as far as was tested */
    bool steady;
    bool coarse;          /* do not use two doubles, because a jump or kink is near */
    size_t m, n;             /* number of functions; of coordinates */
    bool accelerations;
    double tol;
    size_t *coordinate; /* [m] coordinate of a domain bound; SIZE_MAX: g is no bound */
    double *bound;      /* [m] value of the bound */
    double *in;         /* inputs of the tape */
    double *work, *g;   /* scratch; [m] values of g */
    double *moved, *raw; /* [m] scratch for rounding errors and for values */
    double *z;          /* [2n] scratch state */
    double *end;        /* [2n + 1] state and time at the end of the step searched last */
    double *noise;      /* [m] rounding error of g in this part; NaN: not computed */
    double *first_noise; /* [m] rounding error of g at the start of the step; NaN: not computed */
    double *size;       /* [m] size of the polynomial fitted last */
    double *clear;      /* [m] guaranteed distance of g from 0 in this part, if positive */
    qdot_polynomial_bounds bounds; /* bounds of g between nodes, or on the whole step */
    bool bound_at_step;  /* bounds on the whole step are known */
    bool boxed_at_step;  /* intervals bounds.box for the whole step are known */
    bool all_bounds;     /* every g is a coordinate minus its bound */
    double *final;      /* [m] g at the end of the step */
    double length;      /* length of the step */
    double shortest;    /* a part of this length is not divided further */
    double cut;         /* QDOT_PART_START_FAR: fraction of the part to be cut off at its start */
    double reached;     /* time in the step at which the search ended */
    size_t looked_at;   /* number of parts searched in all steps */
    double reach;       /* time from the start of the step to the root that ended it; 0: none */
    double part_before; /* start of the previous part of this step */
    double direction;   /* direction of time in the step: 1 or -1 */

    /* The start of the step, and the state of the search. */
    double t, *y; /* time and state [2n] at the start of the step */
    double begun;          /* time at which the piece began */
    const double *largest; /* [2n] largest |y| so far, as in qdot_watch_known */
    double least; /* at a start that was shifted by rounding: size of this shift; else 0 */
    struct qdot_watch_state start, now;
    int *first;      /* [m] first sign of g after the start */
    bool *slow; /* [m] g leaves its zero at the start so slowly that rounding hides the slope */
    bool *fresh;     /* [m] `first` is not known yet */
    bool *grazed;    /* [m] g touches 0 at the end of the step */
    bool *live;      /* [m] g may have a root in this step */
    /* Fields for functions that have decayed until rounding hides their signs (watch-fade.c). */
    bool *may_fade;  /* [m] g may be left unsearched after it has decayed */
    bool *fading;    /* [m] |g| is within its rounding error during the whole step */
    int *faded;      /* [m] number of consecutive steps before this one with the same property */
    double *faded_since; /* [m] start of the first of these steps */
    double *most;    /* [m] largest |g| at the ends of steps so far */
    /* Fields for functions that rounding makes (watch-hidden.c). */
    bool *may_hide;  /* [m] crossings of g that rounding makes are passed over */
    int *meets;      /* [m] sign of g behind a crossing that counts */
    int *hides;      /* [m] whether rounding is all of g in this step; QDOT_WATCH_UNKNOWN: not found out yet */
    int nodes;       /* number of nodes that sufficed last time */
    double *samples; /* [m x QDOT_WATCH_NODES] values of g at the nodes */
    double *fitted;  /* [m x QDOT_WATCH_NODES] Chebyshev coefficients of the polynomials fitted */
    int *n_fitted;   /* [m] number of nodes used for the fit; 0: not fitted */
    double *extrema; /* [m x QDOT_WATCH_NODES] extrema of the polynomial, x in [-1, 1] */
    int *n_extrema; /* [m] their number; QDOT_WATCH_UNKNOWN, or -1 as from qdot_chebyshev_crossings */
    double *fine_end; /* [m] g at the end of the part, in two doubles */
    double *ends;    /* [(QDOT_WATCH_DEEPEST + 2) x m] g at the ends of parts still to be searched */
    qdot_vec(qdot_root) roots;
};

/* An interval of a step, and the polynomial of one function on it. */
typedef struct {
    double a, b; /* start and end time */
    int n;
    double c[QDOT_WATCH_NODES];
    bool from_zero; /* the polynomial represents (g - g(a)) (b - a)/(t - a) */
    double at_end;  /* value g(b) */
    bool sharp;     /* at_end is in two doubles, though values within the part are not */
} qdot_watch_part;

/* The next action for an interval; the most expensive last. */
typedef enum {
    QDOT_PART_GOOD,
    QDOT_PART_MORE_NODES,
    QDOT_PART_HALVED,
    QDOT_PART_PARTED, /* cut beside the middle, where g may be singular */
    QDOT_PART_START_CUT, /* cut off a short part at the start */
    QDOT_PART_START_FAR  /* cut off a part at the start as long as w->cut says */
} qdot_watch_verdict;

/* Whether two doubles tell more of function i than one. What jumps or has a kink there is a matter of its values as
 * doubles are; and the run ends at the last state that is within a bound as a double. */
static inline bool
qdot_watch_has_two(const qdot_watch *w, size_t i)
{
    return w->coordinate[i] == SIZE_MAX && (w->smooth[i] || w->steady);
}

/* Whether values of function i are in two doubles at present. */
static inline bool
qdot_watch_is_fine(const qdot_watch *w, size_t i)
{
    return w->fine && w->wants[i] && qdot_watch_has_two(w, i) && !w->now.blurred[i];
}

/* The value of a function that is 0 at the start of the interval: exactly 0, or rounded as its
 * other values are. */
static inline double
qdot_watch_zero(const qdot_watch *w, size_t i)
{
    return qdot_watch_is_fine(w, i) ? 0 : w->now.g0[i];
}

static inline int
qdot_watch_sign(double x)
{
    return (x > 0) - (x < 0);
}

/* --- recording roots (watch-turns.c) ------------------------------------------------- */

/* Add a root of the step, with the direction of the function that the user asked for. */
QDOT_MUST_CHECK qdot_status qdot_watch_push(qdot_watch *w, qdot_root root);
void qdot_watch_clear_turns(qdot_watch *w);

/* --- values of the functions (watch-values.c) ---------------------------------------- */

/* Lower the functions g [m] with the parameter values of the plan; shaken and errors as qdot_watch_new. */
QDOT_MUST_CHECK qdot_status qdot_watch_lower(qdot_watch *w, const qdot_expr *g,
                                             bool shaken);

/* g [m] at the state in w->in, at most 2^900 in size and, but for an exact 0, at least DBL_MIN. QDOT_EDOMAIN if
 * one is not a number. */
QDOT_MUST_CHECK qdot_status qdot_watch_value(qdot_watch *w, double t, double *g);

/* Evaluate g [m] at t within the step; w->in becomes the state there. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_at(qdot_watch *w, double t, double *g);

/* --- values in two doubles (watch-two.c) --------------------------------------------- */

/* Whether function i can be evaluated in two doubles within the step: the state can be read so, or is not needed. */
bool qdot_watch_can_two(const qdot_watch *w, size_t i);

/* Make the tape of g in two doubles, and w->state_two, unless they exist; the state at t within the step: w->state_two. */
QDOT_MUST_CHECK qdot_status qdot_watch_make_two(qdot_watch *w);
QDOT_MUST_CHECK qdot_status qdot_watch_read_two(qdot_watch *w, double t);

/* g [m] at t within the step, in two doubles where w->wants says so; w->in is the state there. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_two(qdot_watch *w, double t, double *g);

/* Evaluate g [m] at the state y + low [2n] (low NULL: 0), all in two doubles. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_at_start(qdot_watch *w, double t, const double *y,
                                                      const double *low, double *g);

/* w->start.g0 where a piece begins, in two doubles where w->start.sharp: all if its states are read so, else those of t
 * alone. low as for _value_at_start. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_at_begin(qdot_watch *w, const double *low);

/* Set w->wants [m] of functions that, sampled on the part, are so small, or start on a zero, that doubles do not
 * tell their signs; *any: whether there is one. */
QDOT_MUST_CHECK qdot_status qdot_watch_wants_two(qdot_watch *w, const qdot_watch_part *p, int nodes, bool *any);

/* Where function i, whose polynomial is p->c, is so small at the end of the part that a double may not tell its sign, take
 * its value there in two doubles, by which its roots are located: p->at_end, p->sharp. */
QDOT_MUST_CHECK qdot_status qdot_watch_sharpen_end(qdot_watch *w, qdot_watch_part *p, size_t i);

/* --- functions that have decayed (watch-fade.c) ---------------------------------------- */

/* Set w->fading for the step to (t, y), at whose end the functions are w->final. _has_faded: function i is not to be
 * searched in that step. _take_fading: the step is taken; count it. */
QDOT_MUST_CHECK qdot_status qdot_watch_find_fading(qdot_watch *w, double t, const double *y);
bool qdot_watch_has_faded(const qdot_watch *w, size_t i);
void qdot_watch_take_fading(qdot_watch *w);

/* --- crossings that rounding makes (watch-hidden.c) ------------------------------------ */

/* Whether rounding of the state is all of g_i and of dg_i/dt in the step to w->end: its roots there are no crossings.
 * _drop_hidden: such functions are not searched any further in this step; *any: others are. _claim_hidden: add a root at
 * the start of the step from where on g is more than rounding, and has the sign behind a crossing. */
QDOT_MUST_CHECK qdot_status qdot_watch_is_hidden(qdot_watch *w, size_t i, bool *hidden);
QDOT_MUST_CHECK qdot_status qdot_watch_drop_hidden(qdot_watch *w, bool *any);
QDOT_MUST_CHECK qdot_status qdot_watch_claim_hidden(qdot_watch *w);

/* --- rounding of the functions (watch-noise.c) -------------------------------------- */

/* The sum of the changes of g_i if t and each component of the state y [2n] in turn is changed by
 * the fraction `by` of max(|component|, least). Undefined values count as 0. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise(qdot_watch *w, double t, const double *y,
                                             double by, double least, size_t i,
                                             double *noise);

/* Find the change of g_i by rounding of its operations, in two doubles if `exact`, at the state in w->in. */
QDOT_MUST_CHECK qdot_status qdot_watch_operations(qdot_watch *w, double t, bool exact, size_t i, double *noise);

/* The same within the part: at two places beside its middle, the larger. (Some functions have none at a single place, and
 * at an end there may be a pole, where they have no bound.) */
QDOT_MUST_CHECK qdot_status qdot_watch_operations_within(qdot_watch *w, const qdot_watch_part *p, bool exact, size_t i,
                                                         double *noise);

/* Find the change of g_i by rounding of the state y [2n], of t, of its terms and of its operations. */
QDOT_MUST_CHECK qdot_status qdot_watch_rounding(qdot_watch *w, double t, const double *y, size_t i,
                                                double *noise);

/* Find the change of g_i by rounding of the change of the state y [2n] since the start of the step. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise_two(qdot_watch *w, double t, const double *y, size_t i,
                                                 double *noise);

/* Fill w->noise [m] of the part, after values at its nodes, if that is not done yet: where 64 nodes are not
 * enough rounding may be all there is. */
QDOT_MUST_CHECK qdot_status qdot_watch_find_noise(qdot_watch *w, const qdot_watch_part *p);

/* --- no roots between the nodes (watch-exclusion.c) ---------------------------------- */

/* Whether polynomials that fit all values at `nodes` nodes cannot miss a root between them. */
qdot_watch_verdict qdot_watch_judge(qdot_watch *w, const qdot_watch_part *p, int nodes);

/* Bound the functions on the step by its series (NULL: none); g_i keeps its sign on the step if
 * _excludes then returns true. */
void qdot_watch_bound(qdot_watch *w, const qdot_ode_expanded *step);
bool qdot_watch_excludes(const qdot_watch *w, size_t i);

/* --- what rounding of the polynomial hides (watch-resolution.c) ----------------------- */

/* After the fit of function i at `nodes`, which is good: whether rounding of the polynomial hides a sign of the
 * function, whose values tell it. */
QDOT_MUST_CHECK qdot_status qdot_watch_resolve(qdot_watch *w, const qdot_watch_part *p, size_t i,
                                               int nodes, qdot_watch_verdict *v);

/* After a fit of function i: the x of the extrema of its polynomial, borrowed; their number. None where it
 * has no root. */
int qdot_watch_extrema(qdot_watch *w, const qdot_watch_part *p, size_t i, const double **x);

/* --- finding roots (watch-roots.c) --------------------------------------------------- */

/* The time that corresponds to x in -1 ... 1 on an interval. */
double qdot_watch_time(const qdot_watch_part *p, double x);

/* Fit function i on the interval by a polynomial p->c, from w->samples at `nodes` nodes. */
qdot_watch_verdict qdot_watch_fit(qdot_watch *w, qdot_watch_part *p, size_t i, int nodes);

/* After a fit: whether function i is only rounding noise on the interval. */
bool qdot_watch_vanishes(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* After a fit: the size below which function i cannot be distinguished from noise. */
double qdot_watch_least(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* Whether a fit is accurate only within rounding noise, which may hide a kink. */
bool qdot_watch_is_noisy(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* Append the roots of function i on the interval to w->roots; w->now advances to the interval's end. */
QDOT_MUST_CHECK qdot_status qdot_watch_roots(qdot_watch *w, qdot_watch_part *p, size_t i);

/* The value g at a time t just before a root, or at or after it. */
typedef struct {
    double t, g;
} qdot_watch_end;

/* Where between ends [2], near guess, function i changes its sign to `way`, or becomes 0: *root, and
 * the doubles beside it, ends out. *found false if the signs are equal, since a polynomial overshoots
 * beside a jump and a pole: ends[1] has g if it is that after a root. */
QDOT_MUST_CHECK qdot_status qdot_watch_cross(qdot_watch *w, const qdot_watch_part *p, size_t i,
                                             int way, double guess, qdot_watch_end *ends,
                                             qdot_root *root, bool *found);

/* --- roots of one instant (watch-instants.c) ------------------------------------------ */

/* Set root->rounding if the function depends on t only and has the given slope at the root. */
QDOT_MUST_CHECK qdot_status qdot_watch_clock_rounding(qdot_watch *w, qdot_root *root, double slope);

/* The value of root->rounding if it is negligible compared to `step`, the distance of doubles of t; else 0. */
double qdot_watch_negligible_rounding(const qdot_root *root, double step);

/* Move the root to the double before root->t if rounding cannot tell the two apart. */
void qdot_watch_put_on_double(const qdot_watch *w, const qdot_watch_part *p, qdot_root *root);

/* Among the roots in order of time, those of functions of t alone that rounding moves by a few doubles of
 * t, and that are no farther apart than that, are given the same t; whether there are any, so that the order is another one. */
bool qdot_watch_join_instants(qdot_watch *w);

/* --- flat roots (watch-flat.c) -------------------------------------------------------- */

/* Where function i has hardly any slope at a crossing that was found, |g'| <= `slope`: locate it in many digits. *is false:
 * it is none, but made by rounding. It may become a touch. */
QDOT_MUST_CHECK qdot_status qdot_watch_settle_flat(qdot_watch *w, const qdot_watch_part *p, double slope, qdot_root *root,
                                                   bool *is);
/* Likewise a touch, at which g'' is `bend`; `hidden`: rounding of the operations is all that is seen there, however large
 * that is. */
QDOT_MUST_CHECK qdot_status qdot_watch_settle_touch(qdot_watch *w, const qdot_watch_part *p, double bend, bool hidden,
                                                    qdot_root *root, bool *is);
/* Where a piece starts: set w->deep [m], and w->start.g0 of these. Then, for a step to t, w->leaves and w->final of these;
 * then values at t within the step, into g [m]. */
QDOT_MUST_CHECK qdot_status qdot_watch_begin_deep(qdot_watch *w, const double *low);
QDOT_MUST_CHECK qdot_status qdot_watch_leave_deep(qdot_watch *w, double t);
QDOT_MUST_CHECK qdot_status qdot_watch_value_deep(qdot_watch *w, double t, double *g);
void qdot_watch_end_deep(qdot_watch *w);
/* What rounding of the state makes of a deep function at the ends of the part. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise_deep(qdot_watch *w, const qdot_watch_part *p, size_t i, double *noise);
void qdot_watch_clear_flat(qdot_watch *w);

/* --- touches (watch-touches.c) ------------------------------------------------------- */

/* Whether an extremum of value v at x of the polynomial of function i is a root; *within: as in qdot_root. */
QDOT_MUST_CHECK qdot_status qdot_watch_is_touch(qdot_watch *w, const qdot_watch_part *p, size_t i, double x,
                                                double v, bool *touch, double *within);

/* Make a root for a touch (*is false: in many digits it is none); its time is uncertain by the distance of the two
 * crossings that rounding could have merged. */
QDOT_MUST_CHECK qdot_status qdot_watch_touch(qdot_watch *w, const qdot_watch_part *p, size_t i, double x, double v,
                                             double within, qdot_root *root, bool *is);

/* Append the root from which on g_i is 0, |g_i| <= least: it is at `to`, not at `from`. Its sign before is
 * w->now.sign, which becomes 0. */
QDOT_MUST_CHECK qdot_status qdot_watch_stay(qdot_watch *w, size_t i, double from, double to,
                                            double least);

/* --- where a run ends and starts (watch-ends.c) -------------------------------------- */

/* At the end t of a run: append zeros of functions that are 0 there. */
QDOT_MUST_CHECK qdot_status qdot_watch_end_on_zero(qdot_watch *w, double t);

/* Remove a zero found because the start was shifted by one rounding: the function was 0 at the start. */
QDOT_MUST_CHECK qdot_status qdot_watch_forget_start(qdot_watch *w);

/* --- roots where a function jumps or has a kink (watch-rough.c) ---------------------- */

/* As qdot_watch_roots, by the values themselves, for a part of a few thousand doubles of t in which no
 * polynomial represents the function: it jumps there, or has a kink. */
QDOT_MUST_CHECK qdot_status qdot_watch_rough_roots(qdot_watch *w, const qdot_watch_part *p,
                                                   size_t i, int nodes);

/* Append what qdot_watch_roots may miss where the fit is noisy, a function that keeps its sign at the
 * nodes: a touch, or two roots beside a kink. */
QDOT_MUST_CHECK qdot_status qdot_watch_seek_least(qdot_watch *w, const qdot_watch_part *p, size_t i,
                                                  int nodes);

#endif
