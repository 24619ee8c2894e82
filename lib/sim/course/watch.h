/* watch.h -- functions of the motion along a step, and all their roots in it.
 *
 *     g_i(q, q', t, q'') = 0,   i = 0 ... m - 1,   t_k <= t < t_k+1
 *
 * On a part of a step every g_i becomes a Chebyshev polynomial (num/chebyshev.h) of 16 to
 * 64 terms whose last are below rounding, and discs (polynomial-bounds.h) say that nothing hides between
 * its nodes; where that is not so the part is halved. A step by a series is left alone where
 * discs keep g_i from 0. Between
 * its extrema, which are isolated by the bound of the derivative, a polynomial changes its
 * sign at most once: none is missed, however near two lie. A root is then located in
 * doubles of t by the states themselves: the first double at which g has gone over.
 *
 * A step is half open, and the sign at its end is that of the stored state, which the next
 * step begins with: what lies at an end is found once. Where g(t_k) is 0 the roots of
 * (g - g(t_k))/(t - t_k) are looked for, so that g itself may be as near to 0 as it likes
 * just behind t_k; whether that zero counts depends on the sign before it: a motion that
 * starts on it has none.
 *
 * An extremum within rounding of 0, or within the tolerance of the run, is a root without
 * change of sign.
 *
 * Tests  tests/script/events.lag, event-roots.lag, narrow-events.lag
 */
#ifndef QDOT_SIM_WATCH_H
#define QDOT_SIM_WATCH_H

#include "ode/system.h"
#include "sim/course/root.h"
#include "sim/model/equations.h"

typedef struct qdot_watch qdot_watch;

/* Of g [m], with the values of the plan in place. `shaken` as for qdot_bind_new. Errors:
 * as qdot_tape_new. */
QDOT_MUST_CHECK qdot_status qdot_watch_new(const qdot_plan *plan, size_t m,
                                           const qdot_expr *g, bool shaken, double tol,
                                           qdot_watch **watch);
void qdot_watch_free(qdot_watch *w);

/* g_i is coordinate - bound: then a step far from it needs no look. */
void qdot_watch_is_bound(qdot_watch *w, size_t i, size_t coordinate, double bound);

/* What is known where a piece begins. */
typedef struct {
    double least;           /* what |numbers| count as at least where rounding is judged: 0, or 1
                               for a start that has been moved by a rounding of 1 */
    const int *before;      /* [m] the signs just before, 0: none, as at the start of a run */
    const double *residual; /* [m] NULL, or |g| up to which it is 0: where it has been located
                               there */
} qdot_watch_known;

/* A piece of the run begins at (t, y), whose states `reader` has from now on, copied. on [m]
 * out: whether g is 0 here. */
QDOT_MUST_CHECK qdot_status qdot_watch_begin(qdot_watch *w,
                                             const qdot_watch_reader *reader, double t,
                                             const double *y, const qdot_watch_known *known,
                                             bool *on);

/* All roots of the step to (t, y), ascending in the direction of the run; borrowed until
 * the next call. `last`: the step ends the run, whose end counts. Repeating it tries
 * another step from the same start. The step is taken by _take.
 *   step  NULL, or that of the system's series, to t */
QDOT_MUST_CHECK qdot_status qdot_watch_step(qdot_watch *w, double t, const double *y,
                                            bool last, const qdot_ode_expanded *step,
                                            const qdot_root **roots, size_t *n);
void qdot_watch_take(qdot_watch *w);

/* Whether the step, by its series, stays far from everything that is watched, which are
 * bounds: then no look is needed, and it is taken by _pass. */
bool qdot_watch_is_far(const qdot_watch *w, const qdot_ode_expanded *step);
void qdot_watch_pass(qdot_watch *w, double t, const double *y);

/* Of the step last looked at: [m] the sign right behind its start, 0 where g vanishes
 * throughout; and whether it leaves a zero there so slowly that its slope cannot be told
 * from 0. */
const int *qdot_watch_first(const qdot_watch *w);
const bool *qdot_watch_slow(const qdot_watch *w);

/* The signs of all g at a state. */
QDOT_MUST_CHECK qdot_status qdot_watch_look(qdot_watch *w, double t, const double *y,
                                            int *signs);

#endif
