/* isolate.h -- proof that n equations in n unknowns have exactly one solution near a point.
 *
 * Krawczyk's test: for f(x) = 0, a box X = x0 +- r and any matrix C, here the inverse of f'(x0) in
 * double,
 *
 *     K = x0 - C f(x0) + (1 - C f'(X)) (X - x0)
 *
 * inside the interior of X proves that f has one zero in X and no more. f(x0) and f'(X) are
 * enclosed in balls, so rounding is part of the proof. Boxes of several sizes are tried. A zero at
 * which f' is singular is never proved; nor is one at a place where f jumps or has a kink.
 *
 * Source  Krawczyk, Computing 4 (1969) 187; Neumaier, Interval Methods for Systems of Equations, 5.1.
 * Tests   tests/mech/study/test_equilibrium.c
 */
#ifndef QDOT_NORMAL_ISOLATE_H
#define QDOT_NORMAL_ISOLATE_H

#include "normal/refute/ball.h"

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *x; /* [n] the unknowns; borrowed */
    qdot_expr *f;       /* [n + n * n] functions f, then the Jacobian df_i/dx_j by rows */
    qdot_ball ball;
    arb_ptr at;         /* [n] present values of x as balls */
    arb_ptr y, z;       /* [n] working memory */
    double *C, *work;   /* [n x n] approximate inverse of the Jacobian; working memory */
    double *unique;     /* [n] after a proof: |x_i - x0_i| within which the zero is unique */
} qdot_isolate;

/* For f [n] that contain only the symbols x [n] and pi. Errors:
 * QDOT_ENOMEM, QDOT_EINTR, the pool's; then there is nothing to end. */
QDOT_MUST_CHECK qdot_status qdot_isolate_begin(qdot_isolate *s, qdot_pool *pool, size_t n,
                                               const qdot_expr *f, const qdot_expr *x);
void qdot_isolate_end(qdot_isolate *s);

/* Whether there is exactly one zero near x0 [n]; then x0 is its best approximation in double and
 * radius [n] bounds how far each component is from it. */
bool qdot_isolate_prove(qdot_isolate *s, double *x0, double *radius);

#endif
