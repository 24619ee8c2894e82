/* nearest.h -- the point nearest to a given one at which equations hold.
 *
 *     F_k(x) = 0, k = 1 ... m:   min (x - a)^T W (x - a)   over those x_i that are free
 *
 * From several points about a: Newton steps of least length lead onto F = 0, a projected gradient
 * along it towards a (each step corrected back), and Newton's method on
 *
 *     W (x - a) + A^T lambda = 0,  F = 0,    A = dF/dx
 *
 * finishes. The nearest solution found is taken; another one as near is reported. The solution is
 * refined with F in ball arithmetic, into two doubles for each unknown.
 *
 * A row is `linear` if its slopes depend on given values only: then these slopes, and what F is at 0,
 * are found in balls, so that a slope that is 0 is none (cos(theta) at theta = pi/2 is 6e-17 in doubles).
 * Of other rows slopes far below their largest so far count as rounding.
 *
 * Tests  tests/sim/start/test_start.c
 */
#ifndef QDOT_SIM_NEAREST_H
#define QDOT_SIM_NEAREST_H

#include "num/row-space.h"
#include "sim/model/domain.h"
#include "sim/start/given.h"

typedef struct {
    qdot_pool *pool;         /* pool of the expressions; borrowed, as the fields below */
    size_t inputs;           /* number of symbols in F: unknowns and given values */
    const qdot_expr *symbol; /* [inputs] the symbols that occur in F */
    size_t first, n;         /* the unknowns are symbol[first] ... symbol[first + n - 1] */
    size_t m;
    const qdot_expr *F; /* [m] equations F = 0 */
    const qdot_domains *domains; /* domains of the unknowns; NULL: none */
    const qdot_given *given;     /* [inputs] the given values: the requested start */

    /* Fields set by qdot_nearest_begin: */
    qdot_tape *tape, *curved; /* outputs: F and A = dF/dx; second derivatives of F, if there are any */
    qdot_expr *A;             /* [m x n] Jacobian A = dF/dx */
    uint32_t *place;          /* [3 x curves] k, i, j of each second derivative d2F_k/dx_i dx_j */
    size_t curves;
    bool curves_known; /* the tape `curved` has been made */
    bool bent; /* F is nonlinear: A depends on the unknowns */
    bool *linear;  /* [m] whether F_k is linear in the unknowns */
    double *constant; /* [m + m*n] for linear equations: F_k at x = 0, and A */
    double *value; /* [m + m*n] F and A at the latest point */
    double *work;
} qdot_nearest;

typedef enum {
    QDOT_NEAREST_FOUND,
    QDOT_NEAREST_NONE,   /* no point with F = 0 was found */
    QDOT_NEAREST_SEVERAL /* two different points are equally near */
} qdot_nearest_outcome;

/* Derive A and compile F and A. Error QDOT_EUNSET names a symbol without a value. */
QDOT_MUST_CHECK qdot_status qdot_nearest_begin(qdot_nearest *p);
void qdot_nearest_end(qdot_nearest *p);

/* Evaluate F and A at a given point, into p->value. */
void qdot_nearest_evaluate(qdot_nearest *p, const double *at);

/* distance [m] to F_k = 0 at the start that is given, whose doubles are at [inputs], by balls:
 * |F_k| / |A_k|, in units of the unknowns; 0 if F_k may be exactly 0. residual [m] = F_k (NULL: not
 * wanted). */
QDOT_MUST_CHECK qdot_status qdot_nearest_distance(qdot_nearest *p, const double *at,
                                                  double *distance, double *residual);

/* Move the free unknowns of `at` to the nearest solution; a is `at` on entry. free [n]; W [n *
 * n], NULL: 1; other [n]: the second solution, if SEVERAL. */
QDOT_MUST_CHECK qdot_status qdot_nearest_find(qdot_nearest *p, const bool *free,
                                              const double *W, double *at, double *other,
                                              qdot_nearest_outcome *outcome);

/* Solve F = 0 at at + low in double-double precision, moving the free unknowns as little as possible. */
QDOT_MUST_CHECK qdot_status qdot_nearest_refine(qdot_nearest *p, const bool *free,
                                                double *at, double *low);

/* The length sqrt(x . x) of the vector x [n], without overflow; also for nearest-search.c. */
double qdot_nearest_length(const double *x, size_t n);

#endif
