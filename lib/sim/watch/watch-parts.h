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
#include "tape/knots.h"

enum { QDOT_WATCH_NODES = QDOT_CHEBYSHEV_MOST, QDOT_WATCH_LEAST_NODES = 16 };

/* How often a part of a step may be halved. */
enum { QDOT_WATCH_DEEPEST = 100 };

/* The largest |g|, also at a pole: it can be added up, multiplied by the square of a number of nodes, divided
 * by the distance of nodes. */
#define QDOT_WATCH_MOST 0x1p900

/* Near a located root, |g| below this fraction of g's size counts as 0, because the root's time is rounded. */
#define QDOT_WATCH_NEGLIGIBLE 0x1p-10

/* A watched function counts as 0 if it is at most this many times its rounding error. */
#define QDOT_WATCH_ROUNDINGS 16

/* The value of n_extrema until the extrema of the polynomial have been computed. */
#define QDOT_WATCH_UNKNOWN (-2)

/* The signs of the watched functions at the time up to which the step has been searched. */
struct qdot_watch_state {
    int *sign;  /* [m] the last sign that was not 0; 0: none yet, or none since a root from which on
                   g stays 0 */
    bool *on;   /* [m] whether g_i is 0 at the start of the step */
    bool *blurred; /* [m] which is an extremum within rounding of 0, or a jump to it: two doubles tell no more
                      of it */
    double *g0; /* [m] the value computed for g at its zero, or at the start of the present interval */
    bool *sharp; /* [m] g0 has been computed in double-double precision */
    double *offset; /* [m] value of g at its zero due to rounding, subtracted from double-double values */
    bool *joined; /* [m] bodies of g touch and have moved alike since the piece began (watch-hidden.c) */
    double *apart; /* [m] the largest distance between them since then, beyond that at its begin */
};

typedef struct qdot_watch qdot_watch;
struct qdot_watch {
    const qdot_plan *plan;
    const qdot_series_kernels *kernels;
    qdot_watch_reader reader; /* reads states within the step */
    qdot_tape *tape, *sizes; /* outputs: the functions g; sums of the magnitudes of their terms */
    qdot_tape *plain; /* outputs: g with unperturbed constants; NULL: those in `tape` are unperturbed */
    /* Fields for values in double-double precision (watch-two.c): */
    qdot_tape_two *two;   /* evaluates g in double-double precision; NULL: not needed yet */
    qdot_two *state_two;  /* [2n] scratch state in double-double precision */
    struct qdot_precise *many; /* evaluates g in multiple precision (watch-flat.c); NULL: not needed yet */
    double *settled; /* [m] the time of the flat root of g at which a piece began; NaN: none */
    bool *deep; /* [m] evaluate g in multiple precision: first step of a piece that starts on a zero of g */
    bool any_deep;
    double *hidden; /* [m] for functions that are `deep`: how much rounding of operations may hide; 0: not computed */
    bool *may_be_flat; /* [m] g may have flat roots, to be located in multiple precision */
    int *leaves;     /* [m] sign of g just after the start of the step */
    struct qdot_watch_turn *turns; /* [m] directions of the user's functions (watch-turns.c); NULL: the same as those of g */
    qdot_knots jumps; /* tables of steps that the functions read at a + b t */
    bool *smooth;         /* [m] g contains no switching function, and is not a bound of a coordinate */
    bool *clock;          /* [m] g depends on t only */
    bool *reads_tables;   /* [m] g reads tables of data */
    bool expanded;        /* the step has a Taylor series */
    bool *wants;          /* [m] the sign of g_i in this interval must be determined in double-double precision */
    bool fine;            /* values of the functions in `wants` are double-double at present */
    /* all switches inside the functions keep their sides in the present interval, as far as was tested */
    bool steady;
    bool coarse;          /* do not use double-double values, because a jump or kink is near */
    size_t m, n;             /* number of functions; number of coordinates */
    bool accelerations;
    double tol;
    size_t *coordinate; /* [m] index of the coordinate that g bounds; SIZE_MAX: g is no bound of a domain */
    double *bound;      /* [m] value of the bound, if g is one */
    double *in;         /* inputs of the tape */
    double *work, *g;   /* scratch; [m] values of g */
    double *moved, *raw; /* [m] scratch for rounding errors and for values */
    double *z;          /* [2n] scratch state */
    double *end;        /* [2n + 1] state and time at the end of the step that was searched last */
    double *noise;      /* [m] rounding error of g in the present interval; NaN: not computed */
    double *first_noise; /* [m] rounding error of g at the start of the step; NaN: not computed */
    double *size;       /* [m] size (largest coefficient) of the polynomial fitted last to g */
    double *clear;      /* [m] proved distance of g from 0 in the present interval, if positive */
    qdot_polynomial_bounds bounds; /* bounds of g between the nodes, or on the whole step */
    bool bound_at_step;  /* the bounds of g on the whole step have been computed */
    bool boxed_at_step;  /* the intervals bounds.box for the whole step have been computed */
    bool all_bounds;     /* every g is a coordinate minus its bound */
    double *final;      /* [m] g at the end of the step */
    double length;      /* length of the step */
    double shortest;    /* an interval of this length is not divided further */
    double cut;         /* for QDOT_PART_START_FAR: fraction of the interval to be cut off at its start */
    double reached;     /* time in the step at which the search ended */
    size_t looked_at;   /* number of intervals searched in all steps */
    double reach;       /* time from the start of the step to the root that ended it; 0: none */
    double part_before; /* start of the previous interval of this step */
    double direction;   /* direction of time in the step: 1 or -1 */

    /* The start of the step, and the state of the search. */
    double t, *y; /* time and state [2n] at the start of the step */
    double begun;          /* time at which the piece began */
    const double *largest; /* [2n] largest |y| so far, as in qdot_watch_known; borrowed */
    double least; /* if the start was shifted by rounding: size of this shift; else 0 */
    struct qdot_watch_state start, now;
    int *first;      /* [m] first sign of g after the start of the step */
    bool *slow; /* [m] g leaves its zero at the start so slowly that rounding hides its slope */
    bool *fresh;     /* [m] `first` is not known yet */
    bool *grazed;    /* [m] g touches 0 at the end of the step */
    bool *live;      /* [m] g may have a root in this step */
    /* Fields for functions that decay until rounding hides their signs (watch-fade.c): */
    bool *may_fade;  /* [m] g need not be searched after it has decayed */
    bool *fading;    /* [m] |g| is within its rounding error during the whole step */
    int *faded;      /* [m] number of consecutive earlier steps in which |g| was within its rounding error */
    double *faded_since; /* [m] time at which the first of these steps starts */
    double *most;    /* [m] largest |g| at the ends of steps so far */
    /* Fields for functions that rounding makes (watch-hidden.c). */
    bool *may_hide;  /* [m] crossings of g that rounding makes are passed over */
    int *meets;      /* [m] sign of g behind a crossing that counts */
    bool *beside;    /* [m] other contacts last */
    double *gap;     /* [m] how far the bodies were apart when the piece began, which is rounding if they touch; at least 0 */
    int *hides;      /* [m] whether rounding is all of g in this step; QDOT_WATCH_UNKNOWN: not found out yet */
    int nodes;       /* number of Chebyshev nodes that sufficed last time */
    double *samples; /* [m x QDOT_WATCH_NODES] values of g at the Chebyshev nodes */
    double *fitted;  /* [m x QDOT_WATCH_NODES] Chebyshev coefficients of the polynomials fitted */
    int *n_fitted;   /* [m] number of nodes used for the fit; 0: not fitted */
    double *extrema; /* [m x QDOT_WATCH_NODES] places x in [-1, 1] of the polynomial's extrema */
    int *n_extrema; /* [m] number of extrema; or QDOT_WATCH_UNKNOWN, or -1 as from qdot_chebyshev_crossings */
    double *fine_end; /* [m] g at the end of the interval, in double-double precision */
    double *ends;    /* [(QDOT_WATCH_DEEPEST + 2) x m] g at the ends of parts still to be searched */
    qdot_vec(qdot_root) roots;
};

/* An interval of a step, and the Chebyshev polynomial of one function on it. */
typedef struct {
    double a, b; /* start and end time */
    int n;
    double c[QDOT_WATCH_NODES];
    bool from_zero; /* the polynomial represents (g - g(a)) (b - a)/(t - a) */
    double at_end;  /* value g(b) */
    bool sharp;     /* at_end is a double-double value, though values within the interval are not */
} qdot_watch_part;

/* What to do next with an interval of a step; the most expensive actions come last. */
typedef enum {
    QDOT_PART_GOOD,
    QDOT_PART_MORE_NODES,
    QDOT_PART_HALVED,
    QDOT_PART_PARTED, /* divide beside the middle, where g may be singular */
    QDOT_PART_START_CUT, /* cut off a short interval at the start */
    QDOT_PART_START_FAR  /* cut off an interval at the start, of the length that w->cut gives */
} qdot_watch_verdict;

/* Whether two doubles tell more of function i than one. What jumps or has a kink there is a matter of its values as
 * doubles are; and the run ends at the last state that is within a bound as a double. */
static inline bool
qdot_watch_has_two(const qdot_watch *w, size_t i)
{
    return w->coordinate[i] == SIZE_MAX && (w->smooth[i] || w->steady);
}

/* Whether values of function i are computed in double-double precision at present. */
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

/* Record a root of the step, with the direction in which the user's function passes 0. */
QDOT_MUST_CHECK qdot_status qdot_watch_push(qdot_watch *w, qdot_root root);
void qdot_watch_clear_turns(qdot_watch *w);

/* --- values of the functions (watch-values.c) ---------------------------------------- */

/* Compile the functions g [m] with the parameter values of the plan; `shaken` and errors as in qdot_watch_new. */
QDOT_MUST_CHECK qdot_status qdot_watch_lower(qdot_watch *w, const qdot_expr *g,
                                             bool shaken);

/* g [m] at the state in w->in, at most 2^900 in size and, but for an exact 0, at least DBL_MIN. QDOT_EDOMAIN if
 * one is not a number. */
QDOT_MUST_CHECK qdot_status qdot_watch_value(qdot_watch *w, double t, double *g);

/* Evaluate the functions g [m] at time t within the step; w->in becomes the state there. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_at(qdot_watch *w, double t, double *g);

/* --- values in two doubles (watch-two.c) --------------------------------------------- */

/* Whether function i can be evaluated double-double within the step: the state can be read so, or is not needed. */
bool qdot_watch_can_two(const qdot_watch *w, size_t i);

/* Make the double-double tape of g, and w->state_two, unless they exist; read the state at t in the step into the latter. */
QDOT_MUST_CHECK qdot_status qdot_watch_make_two(qdot_watch *w);
QDOT_MUST_CHECK qdot_status qdot_watch_read_two(qdot_watch *w, double t);

/* Evaluate g [m] at time t within the step, double-double where w->wants is set; w->in becomes the state. */
QDOT_MUST_CHECK qdot_status qdot_watch_value_two(qdot_watch *w, double t, double *g);

/* Evaluate g [m] at the state y + low [2n] (low NULL: 0), all in double-double precision. */
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
 * the start of the step from where on g is more than rounding, and has the sign behind a crossing; `several`: the bodies
 * may have been apart before, and then they bounce. _doubt_missed: add a touch where g has crossed 0, so near to where the
 * step starts that no root was told from rounding. */
QDOT_MUST_CHECK qdot_status qdot_watch_is_hidden(qdot_watch *w, size_t i, bool *hidden);
QDOT_MUST_CHECK qdot_status qdot_watch_drop_hidden(qdot_watch *w, bool *any);
QDOT_MUST_CHECK qdot_status qdot_watch_claim_hidden(qdot_watch *w);
QDOT_MUST_CHECK qdot_status qdot_watch_doubt_missed(qdot_watch *w);

/* --- rounding of the functions (watch-noise.c) -------------------------------------- */

/* The sum of the changes of g_i if t and each component of the state y [2n] in turn is changed by
 * the fraction `by` of max(|component|, least). Undefined values count as 0. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise(qdot_watch *w, double t, const double *y,
                                             double by, double least, size_t i,
                                             double *noise);

/* Find the change of g_i by rounding of its operations (double-double if `exact`) at the state w->in. */
QDOT_MUST_CHECK qdot_status qdot_watch_operations(qdot_watch *w, double t, bool exact, size_t i, double *noise);

/* The same within the part: at two places beside its middle, the larger. (Some functions have none at a single place, and
 * at an end there may be a pole, where they have no bound.) */
QDOT_MUST_CHECK qdot_status qdot_watch_operations_within(qdot_watch *w, const qdot_watch_part *p, bool exact, size_t i,
                                                         double *noise);

/* Find the change of g_i caused by rounding of the state y [2n], of t, of its terms and of its operations. */
QDOT_MUST_CHECK qdot_status qdot_watch_rounding(qdot_watch *w, double t, const double *y, size_t i,
                                                double *noise);

/* Find the change of g_i caused by rounding of the state's change, y [2n] minus that at the step's start. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise_two(qdot_watch *w, double t, const double *y, size_t i,
                                                 double *noise);

/* Fill w->noise [m] of the part, after values at its nodes, if that is not done yet: where 64 nodes are not
 * enough rounding may be all there is. */
QDOT_MUST_CHECK qdot_status qdot_watch_find_noise(qdot_watch *w, const qdot_watch_part *p);

/* --- no roots between the nodes (watch-exclusion.c) ---------------------------------- */

/* Whether polynomials that fit all values at `nodes` nodes cannot have missed a root between the nodes. */
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

/* The time that corresponds to x, -1 to 1, on an interval. */
double qdot_watch_time(const qdot_watch_part *p, double x);

/* Fit function i on the interval by a polynomial p->c, from w->samples at `nodes` nodes. */
qdot_watch_verdict qdot_watch_fit(qdot_watch *w, qdot_watch_part *p, size_t i, int nodes);

/* After a fit: whether function i is nothing but rounding errors on the interval. */
bool qdot_watch_vanishes(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* After a fit: the magnitude below which function i cannot be told from its rounding errors. */
double qdot_watch_least(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* Whether a fit is accurate only to within rounding errors, which may hide a kink. */
bool qdot_watch_is_noisy(const qdot_watch *w, const qdot_watch_part *p, size_t i);

/* Append the roots of function i on the interval to w->roots; w->now advances to the interval's end. */
QDOT_MUST_CHECK qdot_status qdot_watch_roots(qdot_watch *w, qdot_watch_part *p, size_t i);

/* The value of the function g at a time t just before a root, or at or after the root. */
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

/* Set root->rounding if the function depends on t only; its slope at the root is given. */
QDOT_MUST_CHECK qdot_status qdot_watch_clock_rounding(qdot_watch *w, qdot_root *root, double slope);

/* root->rounding if that is negligible compared to `step`, the distance of doubles of t; else 0. */
double qdot_watch_negligible_rounding(const qdot_root *root, double step);

/* Move the root to the double before root->t if rounding does not distinguish the two times. */
void qdot_watch_put_on_double(const qdot_watch *w, const qdot_watch_part *p, qdot_root *root);

/* Among the roots in order of time, those of functions of t alone that rounding moves by a few doubles of
 * t, and that are no farther apart than that, are given the same t; whether there are any, so that the order is another one. */
bool qdot_watch_join_instants(qdot_watch *w);

/* --- flat roots (watch-flat.c) -------------------------------------------------------- */

/* Where function i has hardly any slope at a crossing that was found, |g'| <= `slope`: locate it in many digits. *is false:
 * it is none, but made by rounding. It may become a touch. Where many digits are not used, root->blur becomes as wide as the
 * time within which rounding of the operations of g, in the precision in which the crossing was found, hides its sign. */
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
/* Find how much rounding of the state changes function i at the ends of the interval, evaluated in multiple precision. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise_deep(qdot_watch *w, const qdot_watch_part *p, size_t i, double *noise);
void qdot_watch_clear_flat(qdot_watch *w);

/* --- touches (watch-touches.c) ------------------------------------------------------- */

/* Whether an extremum of value v at x, of the polynomial of function i, touches 0; *within: as in qdot_root. */
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

/* At the end t of a run: record zeros of functions that are 0 there. */
QDOT_MUST_CHECK qdot_status qdot_watch_end_on_zero(qdot_watch *w, double t);

/* Remove a zero found only because the start was shifted by a rounding error: there the function was 0. */
QDOT_MUST_CHECK qdot_status qdot_watch_forget_start(qdot_watch *w);

/* --- jumps of tables of data (watch-jumps.c) ----------------------------------------- */

/* Fill w->jumps: the tables that watched functions read at a function of time, and that jump at their knots. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_watch_find_jumps(qdot_watch *w);

/* Whether one of w->jumps has a knot between two times. Steps end just before and just behind such a knot: a step across it is
 * as short as times can be, and nothing else happens in it. */
bool qdot_watch_is_over_jump(const qdot_watch *w, double from, double to);
/* The time t + by, if no knot of w->jumps is between; else t - by, if none is there; else t. */
double qdot_watch_time_beside(const qdot_watch *w, double t, double by);

/* Append roots for the functions whose signs, or being 0, that step changes. A function that jumps over 0 has a pole there. */
QDOT_MUST_CHECK qdot_status qdot_watch_pass_jump(qdot_watch *w, double t);
/* Mark roots at which such a function goes over to being 0 for some time: equations that switch by it read the value at 0. */
void qdot_watch_mark_pieces(qdot_watch *w);

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
