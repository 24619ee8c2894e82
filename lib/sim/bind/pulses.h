/* pulses.h -- forces that act for less than a step.
 *
 * The length of a step depends on the equations where a method looks at them. A force like
 * exp(-10^6 (t - 3)^2), or that of a thin wall, is negligible there with all its derivatives: the
 * step passes over it, and so may those of a companion. If there are functions that do so
 * (tape/disc.h), and their argument, or the logarithm of a divisor, may change by 10 or more in the
 * step, the outputs of the plan's tape are sampled at 16 or 64 points of it, and discs
 * (polynomial-bounds.h) bound them between; if the bound is too large the step is halved. The
 * difference between the parts and the polynomial of the whole step, summed up, is what the step
 * missed. One function that grows with its argument, where that goes one way and forces are a multiple
 * of it, need not be sampled if it is nearly the same at both ends of the step: dry friction.
 *
 * Steps of a run are looked at before they are accepted (`look` of ode/system.h): one that misses
 * something ends where that begins, and the next one is no longer than what is found there.
 *
 * Tests  tests/sim/bind/test_pulses.c, tests/script/contacts/hidden-forces.lag, narrow-forces.lag
 */
#ifndef QDOT_SIM_PULSES_H
#define QDOT_SIM_PULSES_H

#include <stdint.h>

#include "sim/bind/polynomial-bounds.h"
#include "sim/model/equations.h"
#include "tape/disc.h"

/* Data recorded to find pulses: forces that act for a shorter time than a step. Initialise with {0}. */
typedef struct {
    const qdot_tape *tape; /* outputs: M and f; NULL: not made yet */
    size_t n, m;           /* number of coordinates; of outputs that are examined */
    qdot_disc_hiding hiding;
    int nodes; /* number of Chebyshev nodes on a whole step: 16, or 64 for methods that evaluate within steps */
    qdot_polynomial_bounds bounds;
    double *in;      /* [2n + 1] inputs of the tape: q, q', t */
    double *out;     /* [outputs] outputs of the tape */
    double *work;    /* scratch of the tape */
    double *largest; /* [m] largest magnitude of each output so far */
    double *values;  /* [m x QDOT_CHEBYSHEV_MOST] outputs at the Chebyshev nodes of the step or of a part of it */
    double *whole;   /* [m x QDOT_CHEBYSHEV_MOST] Chebyshev coefficients of the outputs over the step */
    double *beyond;  /* [m] integral of |output - its interpolating polynomial over the step|, from samples */
    double *all;     /* [m] integral of |output| over the step */
    double *allowed; /* [m] largest allowed value of `beyond` in this step */
    double *left;    /* [m] what of `allowed` is left for parts not examined yet */
    double *ends;    /* [4n] the states at both ends of a part of the step */
    double *
        parts; /* [n_parts x (1 + m)] start time of each part of the step; change of the outputs over its length */
    size_t n_parts;
    int most; /* largest number of parts of a step; reduced after steps for which it did not suffice */
} qdot_pulses;

/* A step of the integration, and the result of searching it for short forces. */
typedef struct {
    double a, b, tol;
    const double *from, *to; /* [2n] states at the times a and b */
    /* Read the state at t into y [2n]; NULL: by a cubic through positions and velocities of both ends. */
    qdot_status (*read)(double t, double *y, void *user);
    void *user;
    bool missed;
    double t;            /* time near which most of the force is missed */
    double begins, part; /* start of the missed pulse; longest step that resolves the force */
    uint64_t evaluations;
} qdot_pulses_step;

/* For the tape of a plan, or a shaken copy, borrowed, which may hide something (qdot_disc_may_hide);
 * with constraints their rows are not looked at: they act through multipliers, and where they have
 * no direction the run ends. QDOT_ENOMEM; clear it in any case. */
QDOT_MUST_CHECK qdot_status qdot_pulses_init(qdot_pulses *p, const qdot_plan *plan,
                                             const qdot_tape *tape,
                                             qdot_disc_hiding hiding, int nodes);
void qdot_pulses_clear(qdot_pulses *p);

/* Whether the step misses a force, by more than ten tolerances of the integral of its size over the
 * step, and more than a hundredth of the tolerance. Errors: QDOT_EINTR, those of `read`. */
QDOT_MUST_CHECK qdot_status qdot_pulses_look(qdot_pulses *p, qdot_pulses_step *step);

#endif
