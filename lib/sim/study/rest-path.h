/* rest-path.h -- points on curves of equilibria F(y) = 0, y = (u, p): tangents and corrections.
 *
 * With the weights w of an inner product, t the unit tangent,
 *
 *     [ F'(y)   ]       [ 0 ]         F(y1) = 0,
 *     [ (w t0)^T ] t  =  [ 1 ],        (w t)^T (y1 - y) = s      (pseudo-arclength)
 *
 * F' is the exact derivative of F's tape. The determinant of the first matrix, t in place of t0,
 * changes its sign where two curves cross, and nowhere else on a curve.
 *
 * Source  H. B. Keller, in Applications of Bifurcation Theory (1977), 359; Allgower & Georg,
 *         Introduction to Numerical Continuation Methods (2003), 2 and 8.
 * Tests   tests/sim/test_continuation.c
 */
#ifndef QDOT_SIM_REST_PATH_H
#define QDOT_SIM_REST_PATH_H

#include "mech/study/equilibrium-curve.h"
#include "num/lu.h"
#include "tape/tape.h"

typedef struct {
    qdot_equilibrium_curve *c; /* borrowed */
    size_t n;                  /* unknowns; y has n + 1 */
    double least, most;        /* of p */
    double *weight;            /* [n + 1] */
    qdot_tape *tape;           /* F */
    double *F, *J;             /* [n], [n * (n + 1)] at the place of the last evaluation */
    double *A, *b, *work;      /* [(n + 1)^2], [n + 1] */
    qdot_lu_row *rows;
} qdot_rest_path;

/* A point of a curve, with the direction in which it is followed. */
typedef struct {
    double *y, *t;  /* [n + 1] in one block, owned */
    int sign;       /* of the determinant */
    long growing;   /* roots of the linear motion with positive real parts; -1: unknown */
    qdot_stability stability;
} qdot_rest_point;

/* From {0}; ended in any case. Weights: 1 / range of p, 1 / size [n] of the unknowns; multipliers
 * weigh little. QDOT_EUNSET names a parameter without a value. */
QDOT_MUST_CHECK qdot_status qdot_rest_path_begin(qdot_rest_path *x, qdot_equilibrium_curve *c,
                                                 double least, double most);
void qdot_rest_path_scale(qdot_rest_path *x, const double *size);
void qdot_rest_path_end(qdot_rest_path *x);

QDOT_MUST_CHECK qdot_status qdot_rest_point_begin(const qdot_rest_path *x, qdot_rest_point *a);
void qdot_rest_point_end(qdot_rest_point *a);
void qdot_rest_point_copy(const qdot_rest_path *x, const qdot_rest_point *from,
                          qdot_rest_point *to);

/* The inner product. The distance of two places, angles modulo full turns. */
double qdot_rest_path_product(const qdot_rest_path *x, const double *a, const double *b);
double qdot_rest_path_distance(const qdot_rest_path *x, const double *a, const double *b);

/* Solve F(y) = 0, g.(y - y as it was) = 0 from the guess y; *steps; false: no zero near. */
bool qdot_rest_path_solve(qdot_rest_path *x, const double *g, double *y, int *steps);
/* The same with y_i held. */
bool qdot_rest_path_hold(qdot_rest_path *x, size_t i, double *y);
/* a->t, a->sign at a->y, in the direction of `along`; false where there is no tangent. */
bool qdot_rest_path_tangent(qdot_rest_path *x, const double *along, qdot_rest_point *a);
/* The point at s from a, along a->t, with its tangent; false: none. */
bool qdot_rest_path_go(qdot_rest_path *x, const qdot_rest_point *a, double s, qdot_rest_point *to,
                       int *steps);
/* a->stability, a->growing. */
QDOT_MUST_CHECK qdot_status qdot_rest_path_judge(qdot_rest_path *x, qdot_rest_point *a);

/* F and J at y. */
void qdot_rest_path_evaluate(qdot_rest_path *x, const double *y);

#endif
