/* nearest.h -- the point nearest to a given one at which equations hold.
 *
 *     F_k(x) = 0, k = 1 ... m:   min (x - a)^T W (x - a)   over those x_i that are free
 *
 * From several points about a: Newton steps of least length onto F = 0, then along it
 * towards a (projected gradient, each step brought back), and Newton's method on
 *
 *     W (x - a) + A^T lambda = 0,  F = 0,    A = dF/dx
 *
 * to the end. The nearest of what was found counts; another one as near is told. What was
 * found is refined with F in ball arithmetic, into two doubles for each unknown.
 *
 * Tests  tests/sim/test_start.c
 */
#ifndef QDOT_SIM_NEAREST_H
#define QDOT_SIM_NEAREST_H

#include "num/row-space.h"
#include "sim/model/domain.h"

typedef struct {
    qdot_pool *pool;         /* borrowed, as all below */
    size_t inputs;           /* symbols that F holds: unknowns and what is given */
    const qdot_expr *symbol; /* [inputs] */
    size_t first, n;         /* the unknowns are symbol[first ... first + n) */
    size_t m;
    const qdot_expr *F; /* [m] */
    const qdot_domains *domains; /* of the unknowns; NULL: none */

    /* made by _begin */
    qdot_tape *tape, *curved; /* F and A; second derivatives where there are any */
    qdot_expr *A;             /* [m * n] */
    uint32_t *place;          /* [3 * curves] k, i, j of each second derivative */
    size_t curves;
    bool curves_known;
    bool bent; /* A depends on the unknowns */
    double *value; /* [m + m*n] F and A, of the latest point */
    double *work;
} qdot_nearest;

typedef enum {
    QDOT_NEAREST_FOUND,
    QDOT_NEAREST_NONE,   /* no point was found where F = 0 */
    QDOT_NEAREST_SEVERAL /* two, equally near */
} qdot_nearest_outcome;

/* Derive and lower. QDOT_EUNSET names what has no value. */
QDOT_MUST_CHECK qdot_status qdot_nearest_begin(qdot_nearest *p);
void qdot_nearest_end(qdot_nearest *p);

/* F in balls at at + low [inputs], in units of the unknowns: |F_k| / |A_k|, the distance
 * to F_k = 0; 0 where F_k may be exactly 0. residual [m] = F_k (NULL: not wanted). */
QDOT_MUST_CHECK qdot_status qdot_nearest_distance(qdot_nearest *p, const double *at,
                                                  const double *low, double *distance,
                                                  double *residual);

/* Move the free unknowns of `at`. free [n]; W [n * n] NULL: 1; size: a length of the
 * scene; other [n]: the second answer, of SEVERAL. The centre a is `at` on entry. */
QDOT_MUST_CHECK qdot_status qdot_nearest_find(qdot_nearest *p, const bool *free,
                                              const double *W, double *at, double *other,
                                              qdot_nearest_outcome *outcome);

/* Make F = 0 at at + low as far as two doubles go, moving the free unknowns least. */
QDOT_MUST_CHECK qdot_status qdot_nearest_refine(qdot_nearest *p, const bool *free,
                                                double *at, double *low);

/* sqrt(x . x) of x [n], without overflow: for nearest-search.c too. */
double qdot_nearest_length(const double *x, size_t n);

#endif
