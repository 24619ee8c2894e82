/* stages.h -- implicit methods in (q, p) at s places c_i of a step: their coefficients, their
 * polynomials, their iteration.
 *
 *     X_i = q + h sum_j a_ij W_j,   W_i = v(t_i, X_i, P_i),   F_i = F(t_i, X_i, W_i),   t_i = t + c_i h
 *
 * Coefficients are pairs of doubles, the second ones after all the first. The low parts count: where
 * they were added to the sums of the high ones, and so lost, the energy drifted as t.
 *
 * Source  Hairer, Lubich & Wanner, Geometric Numerical Integration, VIII.5, VIII.6.
 * Tests   tests/ode/geometric/test_geometric.c
 */
#ifndef QDOT_ODE_GEOMETRIC_STAGES_H
#define QDOT_ODE_GEOMETRIC_STAGES_H

#include "num/collocation.h"
#include "num/sum.h"
#include "ode/geometric/geometric.h"

/* Work space of the stages of a collocation method, with which the work space of the method begins. */
typedef struct {
    size_t s, n;
    double *a, *b, *c, *ahead; /* [2 x s x s], [2 x s], [s] the method's a_ij, b_i, c_i; [s x s] L_j(1 + c_i) */
    double *F, *W, *X;         /* [s x n] forces F_i, velocities W_i, positions X_i of the stages */
    double *p;                 /* [n] momenta of one stage */
    double *rest;              /* the work space after these arrays */
} qdot_stages;

/* The size of the work space of s stages: rows of n doubles, and further doubles. */
#define QDOT_STAGES_ROWS(s) (3 * (s) + 1)
#define QDOT_STAGES_MORE(s) (3 * (s) * (s) + 3 * (s))

qdot_stages qdot_stages_of(const qdot_geometric *g);

/* Fill in the coefficients a, b, c, ahead of the method. */
void qdot_stages_begin(const qdot_stages *w, const qdot_collocation *m);

/* F and W to begin with, and X of these: from the polynomials of the step before, where it had the
 * same length, or those of the start. */
QDOT_MUST_CHECK qdot_status qdot_stages_guess(qdot_geometric *g, const qdot_stages *w,
                                              double t, double h);

/* x [s x n] taken as the polynomial of a step is that of the next; the first `s` of its nodes, ahead
 * [s x s] for these. */
void qdot_stages_go_on(size_t s, size_t n, const double *ahead, double *x);

/* Repeat `once` until it changes X by nothing, or `patience` times in a row by no less than before:
 * what is left is rounding, without a direction of its own. QDOT_EDOMAIN if that does not come
 * about. */
typedef qdot_status qdot_stages_once(qdot_geometric *g, const qdot_stages *w, double t,
                                     double h, double *change);
QDOT_MUST_CHECK qdot_status qdot_stages_iterate(qdot_geometric *g, const qdot_stages *w,
                                                double t, double h, int patience,
                                                qdot_stages_once *once);

/* Compute the positions X of the stages from their velocities W; returns the largest relative change of a position. */
double qdot_stages_move(const qdot_geometric *g, const qdot_stages *w, double h);

/* sum_j a_j x_jk over the rows of x [s x n]; *rest the same of the low parts, which may not be added to
 * it here: rounding would drop them every time, in one direction. */
static inline double
qdot_stages_combine(size_t s, size_t n, const double *a, const double *low,
                    const double *x, size_t k, double *rest)
{
    double sum = 0;

    *rest = 0;
    for (size_t j = 0; j < s; j++) {
        sum += a[j] * x[j * n + k];
        *rest += low[j] * x[j * n + k];
    }
    return sum;
}

/* Component k of stage i, (y + low) + h sum_j a_ij x_jk, rounded once; the array a is arranged as w->a. */
static inline double
qdot_stages_at(const qdot_stages *w, const double *a, size_t i, double y, double low,
               double h, const double *x, size_t k)
{
    const size_t s = w->s;
    double rest, e;
    const double sum =
        qdot_stages_combine(s, w->n, a + i * s, a + s * s + i * s, x, k, &rest);
    const double at = qdot_two_sum(y, h * sum, &e);

    return at + (e + (low + h * rest));
}

/* Advance the sum of two doubles y + low by h sum_j b_j x_jk. */
static inline void
qdot_stages_advance(const qdot_stages *w, double *y, double *low, double h,
                    const double *x, size_t k)
{
    double rest;
    const double sum = qdot_stages_combine(w->s, w->n, w->b, w->b + w->s, x, k, &rest);

    qdot_sum_advance_by(y, low, h * sum, h * rest);
}

#endif
