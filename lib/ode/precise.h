/* precise.h -- integration by Taylor series in numbers of any precision (MPFR).
 *
 * The method is that of taylor.h with numbers of `bits` bits. The upper half of the series gives
 * the radius of convergence, and the step is the part of it that makes the last term as large as
 * the tolerance,
 *
 *     h = tol^(1/p) min over k = p/2 ... p, i of (max(1, |y_i|) / |x_ik|)^(1/k),
 *
 * confirmed by the defect of the polynomial at its end, |P_i'(h) - f_i| h <= 10 (p + 1)
 * tol max(1, |y_i|), and inside the step if the upper half of the series is 0. The order p
 * makes (cost_0 + cost_1 p + cost_2 p^2) e^(L/p) least, L = -ln tol. The tolerance is given
 * as its log2, as it may be below any double. The start of every step is stored; a state within a
 * step is found by expanding the series again.
 *
 * Source  as taylor.h
 * Tests   tests/ode/test_precise.c
 */
#ifndef QDOT_ODE_PRECISE_H
#define QDOT_ODE_PRECISE_H

#include "num/real.h"
#include "ode/run.h"

/* y' = f(t, y) by its Taylor coefficients: y_i(t + h) = sum_k x_ik h^k. Failures are those
 * of qdot_ode_system. */
typedef struct {
    size_t n;
    size_t checked;     /* dy_i/dt with i below this is itself a component of y, and needs no check */
    mpfr_prec_t bits;   /* precision of all numbers in bits */
    int most;           /* highest order that the callbacks can compute */
    const mpfr_t *x;    /* x_ik = x[i stride + k], written by the callbacks */
    size_t stride;
    /* begin: compute orders 0 and 1 of the solution through y [n] at t; extend: compute orders 2 ... p */
    qdot_status (*begin)(mpfr_srcptr t, const mpfr_t *y, void *user);
    qdot_status (*extend)(int p, void *user);
    /* Limit a step like `near` of qdot_ode_series, for log2 of the step; NULL: any step is allowed */
    double (*near)(int p, double log2_h, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_precise_system;

typedef struct {
    double log2_tol;
    int order;          /* order of the Taylor expansions, at most system->most */
    uint64_t max_steps; /* largest number of steps; 0: 50 million */
    double max_bytes;   /* largest memory for stored points, in bytes; 0: 2e9 */
    /* Called after every accepted step, when the point is stored: as in qdot_ode_options; a
     * failure ends the run and keeps the step. */
    qdot_status (*accepted)(mpfr_srcptr t, const mpfr_t *y, bool *stop, void *user);
    void *user;
} qdot_precise_options;

/* The stored points of a run: t, then y [n]. Initialise with {0}. */
typedef struct {
    size_t n, count;
    int order;
    mpfr_prec_t bits;
    qdot_reals *chunks; /* blocks of QDOT_PRECISE_CHUNK points each */
    size_t n_chunks, capacity;
    /* For figures: QDOT_PRECISE_INSIDE rows of t, y [n] between points k and k + 1, rounded to
     * doubles. */
    double *inside;
    size_t inside_capacity;
    qdot_ode_result result;
} qdot_precise_run;

enum { QDOT_PRECISE_CHUNK = 64, QDOT_PRECISE_INSIDE = 3 };

void qdot_precise_run_clear(qdot_precise_run *run);

/* The stored point k: its t at [0], y at [1 ... n]. */
mpfr_t *qdot_precise_point(const qdot_precise_run *run, size_t k);

/* The rows (t, y) in doubles stored between points k and k + 1. */
const double *qdot_precise_inside(const qdot_precise_run *run, size_t k);

/* The order of expansions for a tolerance, given the cost of an expansion as a polynomial in its order p. */
int qdot_precise_order_for(double log2_tol, const double cost[3]);

/* Integrate from t0, y0 [n] to t1, all of the system's precision. Errors as
 * qdot_ode_integrate, the run so far kept and run->result filled; QDOT_ELIMIT beyond
 * max_bytes. */
QDOT_MUST_CHECK qdot_status qdot_precise_integrate(const qdot_precise_system *system,
                                                   const qdot_precise_options *options,
                                                   mpfr_srcptr t0, mpfr_srcptr t1,
                                                   const mpfr_t *y0,
                                                   qdot_precise_run *run);

/* The state y [n] at t; *near: the point that was expanded last, SIZE_MAX for none, kept
 * by the caller while the system is used for nothing else. QDOT_EDOMAIN outside. */
QDOT_MUST_CHECK qdot_status qdot_precise_at(const qdot_precise_run *run,
                                            const qdot_precise_system *system,
                                            mpfr_srcptr t, size_t *near, mpfr_t *y);

/* Replace the last point by the time t within the last step, with state y [n]. */
void qdot_precise_cut(qdot_precise_run *run, mpfr_srcptr t, const mpfr_t *y);

#endif
