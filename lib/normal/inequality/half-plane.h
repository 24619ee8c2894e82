/* half-plane.h -- on which side of the imaginary axis the zeros of det(M s^2 + G s + H) lie, M, G, H
 * matrices of constants.
 *
 * Of rationals the answer is exact: p = prod f_e^e (square-free), g = gcd(f(s), f(-s)) holds all zeros
 * on the axis, and g(s) = h(s^2) or s h(s^2); zeros of f/g are enclosed until the signs of their real
 * parts are known, and so are those of h, of which the negative ones are pairs on the axis. Of other
 * constants the zeros are enclosed with growing precision; those that are not isolated by then, and
 * those on the axis, decide nothing - unless p holds even powers alone: then zeros of h, real where
 * they are alone in their ball with their conjugate, do.
 *
 * Source  Gantmacher, The Theory of Matrices II, ch. XV; Arb's acb_poly_find_roots.
 * Tests   tests/normal/inequality/test_half-plane.c
 */
#ifndef QDOT_NORMAL_HALF_PLANE_H
#define QDOT_NORMAL_HALF_PLANE_H

#include "expr/id.h"

typedef struct {
    bool grows;   /* proved: a zero has a positive real part */
    bool decays;  /* proved: all real parts are negative */
    bool bounded; /* proved: no zero has a positive real part; zeros on the imaginary axis are single and not 0 */
} qdot_half_plane;

/* M, G, H [n * n], constants (normal/refute/constant.h). even: M and H are known to be symmetric and G
 * antisymmetric, so that p holds even powers alone. All false where it cannot be told. Errors: those
 * of qdot_flint_run. */
QDOT_MUST_CHECK qdot_status qdot_half_plane_of(qdot_pool *pool, size_t n, const qdot_expr *M,
                                               const qdot_expr *G, const qdot_expr *H, bool even,
                                               qdot_half_plane *out);

#endif
