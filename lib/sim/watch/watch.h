/* watch.h -- finds all roots of functions of the motion within a step.
 *
 *     g_i(q, q', t, q'') = 0,   i = 0 ... m - 1,   t_k <= t < t_k+1
 *
 * On a part of a step every g_i is interpolated by a Chebyshev polynomial (num/chebyshev.h) of 16
 * to 64 terms whose last coefficients are below rounding, and discs (polynomial-bounds.h) bound
 * its error between the nodes; if either fails the part is halved. If a step has a series and
 * discs keep g_i away from 0, it is not sampled. Between
 * its extrema, which are isolated by the bound of the derivative, a polynomial changes its
 * sign at most once: no root is missed, however near two are. A root is then located by the
 * states themselves: the first double of t at which g has changed its sign.
 *
 * A step is half open, and the next step begins with the sign at its end, that of the stored
 * state: a root at the end is found once. If g(t_k) is 0 the roots of (g - g(t_k))/(t - t_k) are
 * looked for, so that rounding of g just after t_k makes no root. Whether the zero at t_k itself
 * counts depends on the sign before it: a motion that starts on it has none.
 *
 * A part is also halved where rounding of its polynomial hides a sign that the values show
 * (watch-resolution.c): a step of any length is searched as far as t resolves it. Values beyond 2^900 count as
 * that, those that underflow as the least normal number of their sign.
 *
 * An extremum within rounding of 0, or within the tolerance of the run, is a root without
 * change of sign.
 *
 * Where g has hardly any slope at a root, rounding of its operations hides the root, or makes several of it: it is
 * evaluated in many digits there (watch-flat.c).
 *
 * Of functions of t alone two crossings that only rounding of their operations sets apart have the same time
 * (watch-instants.c).
 *
 * A function may stay 0: its root is then where it becomes 0. Beside a jump or a kink no polynomial
 * represents it: there, in a part of a few thousand doubles of t, its values alone are looked at
 * (watch-rough.c).
 *
 * Tests  tests/script/events/event-spans.lag, events.lag, event-roots.lag, event-stays.lag, narrow-events.lag,
 *        flat-events.lag
 */
#ifndef QDOT_SIM_WATCH_H
#define QDOT_SIM_WATCH_H

#include "ode/system.h"
#include "sim/watch/root.h"
#include "sim/model/equations.h"

typedef struct qdot_watch qdot_watch;

/* Make a watch of g [m], with the parameter values of the plan. `shaken` as for qdot_bind_new.
 * Errors: as qdot_tape_new. */
QDOT_MUST_CHECK qdot_status qdot_watch_new(const qdot_plan *plan, size_t m,
                                           const qdot_expr *g, bool shaken, double tol,
                                           qdot_watch **watch);
void qdot_watch_free(qdot_watch *w);

/* The tape of g: inputs q, q', t. Borrowed. */
const qdot_tape *qdot_watch_tape(const qdot_watch *w);

/* Declare that g_i is coordinate - bound: steps that stay far from the bound need not be searched. */
void qdot_watch_is_bound(qdot_watch *w, size_t i, size_t coordinate, double bound);

/* Let roots of g_i at which it is flat be located in many digits: of an event, whose time counts. Not of a switch, which
 * the motion may meet again at once. */
void qdot_watch_may_be_flat(qdot_watch *w, size_t i);

/* Declare that g_i stands for another function f, which at a zero of g_i changes its sign as g_i * turn does
 * (sim/model/repeated-zeros.h). `half`: f is not 0 where turn < 0; such a root of g_i is given as a pole. Errors: as
 * qdot_tape_new. */
QDOT_MUST_CHECK qdot_status qdot_watch_turns(qdot_watch *w, size_t i, qdot_expr turn, bool half);
/* Whether the factor turn < 0 at a state: then f falls where g_i rises. Never true with `half`. */
bool qdot_watch_is_turned(qdot_watch *w, double t, const double *y, size_t i);

/* Let g_i fade: where it has decayed and stays within the rounding of the state its zeros are not sought. That is for
 * functions whose zeros are only recorded; until this is called none fades. _faded_since: the time since which g_i has
 * faded; NaN: it has not. */
void qdot_watch_may_fade(qdot_watch *w, size_t i, bool may);
double qdot_watch_faded_since(const qdot_watch *w, size_t i);

/* Let crossings of g_i be passed over that rounding of the state makes (watch-hidden.c): of bodies that touch, and that
 * meet where g changes its sign to `way`, in the direction of the run; `beside`: other contacts last. Until this is called
 * none are. */
void qdot_watch_may_hide(qdot_watch *w, size_t i, bool may, int way, bool beside);

/* Values and signs of the watched functions g at the start of a piece of the run. */
typedef struct {
    double least;           /* lower bound for |components| in estimates of rounding: 0, or 1 if
                               the start was moved by a rounding of 1 */
    bool exact; /* y + low is exact and not the result of an integration: no rounding error */
    const int *before;      /* [m] signs of g just before the start; 0: unknown, as at the start of a run */
    const double *residual; /* [m] |g| up to which it counts as 0, if a root was located here;
                               or NULL */
    const double *low;      /* [2n] exact state minus y; NULL: 0 */
    const double *largest; /* [2n] largest |y| so far in the run, borrowed, may still grow; NULL: unknown */
    size_t left;            /* functions below this have left their root with the state: they are 0
                               only where that is lost in the rounding of two doubles */
} qdot_watch_known;

/* Begin a piece of the run at (t, y); `reader`, copied, reads its states. on [m] out: whether g
 * is 0 here. */
QDOT_MUST_CHECK qdot_status qdot_watch_begin(qdot_watch *w,
                                             const qdot_watch_reader *reader, double t,
                                             const double *y, const qdot_watch_known *known,
                                             bool *on);

/* Evaluate the watched functions [m] at a state; call before qdot_watch_begin. */
QDOT_MUST_CHECK qdot_status qdot_watch_measure(qdot_watch *w, const qdot_watch_reader *reader,
                                               double t, const double *y, const double **g);

/* All roots of the step to (t, y), as far as the first that ends it (qdot_watch_reader), ascending in the direction of the run; borrowed until
 * the next call. `last`: the step ends the run, and a root at its end counts. A repeated call
 * tries another step from the same start; _take accepts the step.
 *   step  NULL, or that of the system's series, to t */
QDOT_MUST_CHECK qdot_status qdot_watch_step(qdot_watch *w, double t, const double *y,
                                            bool last, const qdot_ode_expanded *step,
                                            const qdot_root **roots, size_t *n);
void qdot_watch_take(qdot_watch *w);

/* How far the step was searched: to its end, or no further because a step of a series holds too many
 * roots. Such a step is to be tried shorter. */
double qdot_watch_reached(const qdot_watch *w);

/* The number of intervals of steps that have been searched so far. */
size_t qdot_watch_looked_at(const qdot_watch *w);

/* Whether only bounds are watched and the step, by its series, stays far from all of them: then
 * it need not be searched, and _pass accepts it. */
bool qdot_watch_is_far(const qdot_watch *w, const qdot_ode_expanded *step);
void qdot_watch_pass(qdot_watch *w, double t, const double *y);

/* For the step last searched: [m] the sign of g just after its start, 0 if g vanishes throughout;
 * and whether g leaves a zero there so slowly that its slope cannot be told from 0. */
const int *qdot_watch_first(const qdot_watch *w);
const bool *qdot_watch_slow(const qdot_watch *w);

/* dg_i/dt at the state y + low [2n] near a zero of g_i, where that has the rates [2n]; *noise: what the
 * rounding of rates as large as fast [2n] makes of it. */
QDOT_MUST_CHECK qdot_status qdot_watch_rate(qdot_watch *w, double t, const double *y, const double *low,
                                            const double *rates, const double *fast, size_t i,
                                            double *rate, double *noise);

/* The change of g_i if each component of the state y [2n] changes by 4 rounding errors of the sizes
 * `by` [2n]. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise_of(qdot_watch *w, double t, const double *y,
                                                const double *by, size_t i, double *noise);

/* Find the change of g_i by 4 rounding errors of t, if g_i depends on t. */
QDOT_MUST_CHECK qdot_status qdot_watch_noise_of_time(qdot_watch *w, double t, const double *y, size_t i,
                                                     double *noise);

/* All g [m] at a state, and their signs [m]; on [m], unless NULL: whether they are 0 but for rounding of the
 * time and of a state whose components have been as large as `largest` [2n]. */
QDOT_MUST_CHECK qdot_status qdot_watch_look(qdot_watch *w, double t, const double *y,
                                            const double *largest, int *signs, double *g, bool *on);

#endif
