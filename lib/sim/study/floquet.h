/* floquet.h -- the multipliers of a periodic orbit, by the slopes of its flow (flow.h).
 *
 *     dz(T) = B dz(0),   z = (q, q') on the constraints;   multipliers: the eigenvalues of B
 *
 * Where motions near by grow, B is the product of the slopes over segments, between states that are found with the start
 * and the period (shooting.h), so that all closes also where no run in doubles comes back. Errors are how far B is by a
 * tolerance 100 times as large, and what rounding leaves beside the largest slopes in units of the states: a slope that is 0
 * by cancellation may be the same in both, and a pair with one vector, as behind impacts, is known to its root alone.
 *
 * Where the equations hold no time and the orbit is no rest, one multiplier is 1, that of a shift in time; where
 * they come from a Lagrangian, a second, that of the energy. These are stated as 1. Without friction multipliers
 * come as lambda, 1/lambda: one that is apart from all others and within its error of the unit circle is on it.
 *
 * Source  Hale, Ordinary Differential Equations, III.7; Arnold, Mathematical Methods, 42.
 * Tests   tests/script/studies/floquet.sh
 */
#ifndef QDOT_SIM_FLOQUET_H
#define QDOT_SIM_FLOQUET_H

#include "sim/run/run.h"

/* A run is closed if its end is this close to its start, relative to max(scale, |value|). */
#define QDOT_FLOQUET_CLOSED 1e-7

typedef enum {
    QDOT_FLOQUET_STABLE,
    QDOT_FLOQUET_UNSTABLE,
    QDOT_FLOQUET_UNDECIDED
} qdot_floquet_verdict;

typedef struct {
    size_t n; /* number of multipliers: 2 (n - m) */
    double *re, *im,
        *error; /* [n] multipliers re + i im, sorted by qdot_eigenvalues_arrange; error 0: exact */
    size_t trivial; /* number of multipliers that are 1 for every orbit (time shift, conserved energy) */
    bool
        asymptotic; /* there is damping or driving: stable means that all multipliers are inside the unit circle */
    qdot_floquet_verdict verdict;
} qdot_floquet;

/* Find *reach, the largest change of q and q' that their initial rates would make over the whole run. */
QDOT_MUST_CHECK qdot_status qdot_floquet_reach(qdot_scene *scene, qdot_run *run, double *reach);
/* Whether the run began at rest: no coordinate or velocity changes, relative to max(scale, |value|). */
QDOT_MUST_CHECK qdot_status qdot_floquet_rests(qdot_scene *scene, qdot_run *run, bool *rests);
/* Whether the run ends where it began: *off, the largest difference of a q or q', relative to max(scale, |value|);
 * *where, that jet. */
QDOT_MUST_CHECK qdot_status qdot_floquet_return(qdot_scene *scene, qdot_run *run,
                                                double *off, qdot_expr *where);
/* The multipliers of the run, which ends where it began; its request. Clear *x in any case. QDOT_EINVAL: the
 * equations do not have the period of the orbit; QDOT_EFAILED: no orbit is near the run; errors of qdot_response_new and
 * of its runs. */
QDOT_MUST_CHECK qdot_status qdot_floquet_find(qdot_scene *scene, qdot_run *run,
                                              const qdot_run_request *request,
                                              qdot_floquet *x);
/* The multipliers of the product of B [K x k x k] with errors E, of which so many are 1 whatever the orbit; asymptotic:
 * as above. Clear *x in any case. */
QDOT_MUST_CHECK qdot_status qdot_floquet_of(size_t K, size_t k, const double *B, const double *E,
                                            size_t trivial, bool asymptotic, qdot_floquet *x);
/* Whether the scene is Lagrangian: moved only by a Lagrangian and constraints that are holonomic,
 * perhaps in integrated form. */
QDOT_MUST_CHECK qdot_status qdot_floquet_is_lagrangian(qdot_scene *scene, bool *yes);
void qdot_floquet_clear(qdot_floquet *x);

#endif
