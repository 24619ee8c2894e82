/* rest-bifurcation.h -- points at which curves of equilibria turn, cross, or lose their stability to an
 * oscillation: located to the last bits as regular zeros of larger systems.
 *
 *     fold       F = 0,  F_u phi = 0,  phi.phi = 1
 *     crossing   F + beta psi = 0,  psi.F_y = 0,  psi.psi = 1                       (Moore)
 *     Hopf       F = 0,  (K + i w Gamma - w^2 M) z = 0,  z_k = 1                    z = a + i b
 *     collision  F = 0,  (K - W M) a = 0,  (K - W M) b = M a,  a_k = 1, b_k = 0     W = w^2
 *
 * The last is where two frequencies of a motion without damping meet and leave the imaginary axis
 * (flutter; a Hamiltonian Hopf point); with gyroscopic forces, K symmetric and Gamma antisymmetric, it is
 *
 *     F = 0,  (K + i w Gamma - w^2 M + i beta) z = 0,  z* (i Gamma - 2 w M) z = 0,  z_k = 1
 *
 * whose rows depend on each other without beta, which is 0 there.
 *
 * Source  Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), 5; Moore, Numer. Funct.
 *         Anal. Optim. 2 (1980) 441; Griewank & Reddien, IMA J. Numer. Anal. 3 (1983) 295.
 * Tests   tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_REST_BIFURCATION_H
#define QDOT_SIM_REST_BIFURCATION_H

#include "sim/branches/bifurcation.h"
#include "sim/branches/newton.h"
#include "sim/branches/rest-path.h"

/* The extended systems for bifurcations of equilibria; each is made when first needed. */
typedef struct {
    qdot_rest_path *x;
    qdot_newton fold, crossing;
    qdot_tape *motion; /* outputs: stiffness K, damping and gyroscopic matrix Gamma, mass M of the linearised motion at y */
    double *value, *work;
} qdot_rest_bifurcations;

/* Begin to find bifurcations, in a struct {0}; must be ended in any case. QDOT_EUNSET: a parameter
 * has no value. */
QDOT_MUST_CHECK qdot_status qdot_rest_bifurcations_begin(qdot_rest_bifurcations *b, qdot_rest_path *x);
void qdot_rest_bifurcations_end(qdot_rest_bifurcations *b);

/* Locates a bifurcation of equilibria; a qdot_bifurcation_finder with user pointer b. COLLISION is
 * found as HOPF. */
QDOT_MUST_CHECK qdot_status qdot_rest_bifurcation_find(void *b, const qdot_bifurcation_bracket *in,
                                                       qdot_bifurcation *out, double *other,
                                                       qdot_bifurcation_answer *answer);

#endif
