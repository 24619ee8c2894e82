/* taylor.h -- integration by Taylor series of high order.
 *
 * A step expands the solution to order p and evaluates the polynomial. It aims at an
 * error of eps = tol^(5/4), not below 1e-17: thousands of steps may share the tolerance.
 * The order is chosen once, from eps and from what an expansion costs (series.cost): a
 * step of order p is about rho e^(-L/p) long, L = -ln eps, rho the radius of convergence,
 * so p makes
 *
 *     (cost_0 + cost_1 p + cost_2 p^2) e^(L/p)
 *
 * least. Where cost_2 dominates that is L/2 (Jorba & Zou); short tapes take more. Where
 * recurrences are machine code it is cost.code, with cost.wider for each vector of orders beyond
 * the first, and L at least cost.digits.
 *
 * The length of a step is
 *
 *     h = rho eps^(1/p),   rho = min over k = p/2 ... p, i of (max(s_i, |y_i|)/|x_ik|)^(1/k):
 *
 * from the whole upper half of the series, since a symmetric start makes most of the
 * coefficients vanish. So a term at k may be eps^(k/p), a steady fall from the size of the state;
 * where eps is so large that this is less than by 2^(2/3) an order, it may be eps 4^((p-k)/3):
 * terms of a solution without singularities, an oscillation that is hardly there, fall ever
 * faster. And no term of orders 2 ... p/2 may be so large that its rounding
 * counts beside eps (where it does anyway, above half the size of the state): solutions
 * without singularities would take steps whose terms cancel. A step is confirmed by the
 * defect at its end: the slope of the polynomial there against y' as the equations have it
 * (the next step's first coefficient),
 *
 *     |P_i'(h) - f_i| h <= 10 (p + 1) tol max(s_i, |y_i|) + rounding,
 *
 * else it is taken back and a quarter of it tried. Where the upper half holds nothing at
 * all (free fall, an equilibrium, few terms of a high power) the polynomial may be the
 * solution: then h is what is left, and the defect is looked at inside the step too.
 *
 * Where the coefficients are worth less than a double (series.noise) no step is held to a
 * tighter tolerance; one that would end just before the place that causes it goes over it,
 * summed up to its least term, or stays well before (series.ahead).
 *
 * Times are doubles exactly: h is the difference of two. The state is a sum of two
 * doubles, advanced by the series, whose first product and sum are exact; the powers of
 * the step are made once for all components.
 *
 * Between steps the state is the series again, expanded from the stored point: as
 * accurate as the run.
 *
 * Source  Jorba & Zou, Experimental Math. 14 (2005) 99; Nedialkov & Pryce, BIT 45 (2005)
 *         561.
 * Tests   tests/ode/test_taylor.c
 */
#ifndef QDOT_ODE_TAYLOR_H
#define QDOT_ODE_TAYLOR_H

#include "ode/run.h"

/* The length *h that a step by series from y [n] at t towards t1 would be tried with; 0: none can be;
 * INFINITY: the series ends. Nothing is changed. QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_first_step(const qdot_ode_system *system,
                                                       const qdot_ode_options *options, double t,
                                                       double t1, const double *y, double *h);

/* What steps take under tol by the best order up to about `most`, as machine code where there is to be some: nanoseconds
 * for a way as long as the radius of convergence. */
double qdot_ode_taylor_cost(const qdot_ode_cost *cost, int most, double tol);

/* The order of a run under tol, its first orders in two doubles or not; `more` orders on
 * top. */
int qdot_ode_taylor_order(const qdot_ode_series *series, double tol, bool leading,
                          int more);

/* The highest order among a run under tol and its companions (ode/companion.h), of which this is the
 * run (more = 0) or one with so many orders on top. Machine code is written for all of them at once. */
int qdot_ode_taylor_highest(const qdot_ode_system *system, double tol, bool leading, int more);

/* How long, in radians, steps of order p may be that let no oscillation grow: z to a tenth,
 * up to which |sum_{k=0..p} (iz)^k/k!| <= 1 + 1e-6. From p to p + 1 that may halve. Where an
 * order is for an oscillation that is hardly there (cost.digits) what it costs may be weighed by
 * that too (cost.by_stability). */
double qdot_ode_taylor_stable(int p);

/* The least of the terms of order 5 ... p at s, two in a row, relative by scale [n], and the
 * second of their orders. */
double qdot_ode_taylor_least_term(const qdot_ode_series *series, size_t n, int p, double s,
                                  const double *scale, int *cut);

/* Expand about (t0, y0 [n]) for a step of about h to order p; then the state at t, from
 * that expansion. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_expand(const qdot_ode_system *system, int p,
                                                   double t0, double h,
                                                   const double *y0);
/* The highest order, at most p, at which some coefficient of the series is not 0; at least 2. */
int qdot_ode_taylor_last_order(const qdot_ode_system *system, int p);
/* The state y [n] at t + t_low of a step, by the series that is there, its coefficients taken as exact:
 * the first orders in two doubles. Not for systems with `following`. */
void qdot_ode_taylor_evaluate_two(const qdot_ode_system *system, const qdot_ode_expanded *step, double t,
                                  double t_low, qdot_two *y);
/* Find the rounding error of the series' value caused by terms that are not in two doubles: rounding [n]. */
void qdot_ode_taylor_rounding_two(const qdot_ode_system *system, const qdot_ode_expanded *step, double t,
                                  double *rounding);
void qdot_ode_taylor_evaluate(const qdot_ode_system *system, int p, double t0, double h,
                              double t, const double *y0, double *y);

#endif
