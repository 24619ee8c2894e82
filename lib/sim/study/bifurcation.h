/* bifurcation.h -- points at which curves of equilibria turn, cross, or lose their stability to an
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
 * whose rows depend on each other without beta, which is 0 there. At a crossing with null vectors v1, v2 of F_y the directions
 * alpha v1 + beta v2 of the two curves solve
 *
 *     c11 alpha^2 + 2 c12 alpha beta + c22 beta^2 = 0,   c_ij = v_i.(psi.F)_yy v_j.
 *
 * It is a pitchfork if one of them has no part along p, else transcritical.
 *
 * Source  Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), 5; Moore, Numer. Funct.
 *         Anal. Optim. 2 (1980) 441; Griewank & Reddien, IMA J. Numer. Anal. 3 (1983) 295.
 * Tests   tests/sim/test_continuation.c
 */
#ifndef QDOT_SIM_BIFURCATION_H
#define QDOT_SIM_BIFURCATION_H

#include "sim/study/newton.h"
#include "sim/study/rest-path.h"

typedef enum {
    QDOT_FOLD,
    QDOT_PITCHFORK,
    QDOT_TRANSCRITICAL,
    QDOT_HOPF,
    QDOT_COLLISION,   /* of frequencies */
    QDOT_NOT_SIMPLE   /* something else: located between two points, not followed */
} qdot_bifurcation_kind;

/* "fold", "pitchfork", "transcritical", "hopf", "hamiltonian hopf", "degenerate". */
const char *qdot_bifurcation_name(qdot_bifurcation_kind kind);

typedef struct {
    qdot_bifurcation_kind kind;
    double *y, *error;                 /* [n + 1] in one block, owned */
    double frequency, frequency_error; /* of Hopf points */
} qdot_bifurcation;

/* Systems that are made when first needed. */
typedef struct {
    qdot_rest_path *x;
    qdot_newton fold, crossing;
    qdot_tape *motion; /* K, Gamma, M from y */
    double *value, *work;
    bool apart; /* by the latest search: two curves come near each other there, and do not cross */
} qdot_bifurcations;

/* From {0}; ended in any case. Errors: QDOT_EUNSET names a parameter without a value. */
QDOT_MUST_CHECK qdot_status qdot_bifurcations_begin(qdot_bifurcations *b, qdot_rest_path *x);
void qdot_bifurcations_end(qdot_bifurcations *b);

/* Of the kind FOLD, PITCHFORK (any crossing), HOPF (also COLLISION) near out->y, where a curve goes
 * along t: out->y, out->error; the kind; of a crossing the other curve's direction to `other` [n + 1].
 * *found false: there is no regular one. */
QDOT_MUST_CHECK qdot_status qdot_bifurcation_find(qdot_bifurcations *b, const double *t,
                                                  qdot_bifurcation *out, double *other,
                                                  bool *found);

#endif
