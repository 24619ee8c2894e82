/* shooting.h -- a periodic orbit near a guess by multiple shooting, where single shooting is led away.
 *
 *     phi(z_k, T/K) - z_(k+1) = 0,   k = 0 .. K-1,   z_0 = z_K = start(u)
 *
 * in the unknowns u of the statement and the states z_1 .. z_(K-1) between K segments of equal length. phi is
 * the motion, its slopes those of a run of each segment (response.h), so that no run goes on for longer than
 * the motions near by take to grow a few times. The step of Newton's method (num/zero.h) counts changes of the
 * states between little against those of u: of a family, the orbit near the guess is found.
 *
 * The states begin along the run of the guess, from the start on and from the end back, as long as the motions
 * near by have not grown much; on a straight line between. Three such pieces, ever shorter, are tried,
 * and the orbit whose u is nearest to the guess is taken.
 *
 * Where nothing near the run of the guess grows, one segment does: nothing is searched here. An orbit whose run comes back
 * within its error is brought to its end by the same search, in any number of segments.
 *
 * Source  Stoer & Bulirsch, Introduction to Numerical Analysis (2002), 7.3.5; Deuflhard, Newton Methods (2004), 7.1.
 * Tests   tests/sim/study/test_shooting.c, tests/script/studies/find-orbit.sh
 */
#ifndef QDOT_SIM_SHOOTING_H
#define QDOT_SIM_SHOOTING_H

#include "sim/study/flow.h"

typedef struct {
    qdot_scene *scene;
    /* The request, whose parameter values depend on those unknowns that are parameters; t0: time of the start. */
    const qdot_run_request *request;
    size_t k; /* number of unknowns (parameters, coordinates, velocities, times); their symbols and names follow */
    const qdot_expr *unknowns;
    const char *const *names;
    const qdot_expr *start; /* [2n] start q, q' in terms of the unknowns */
    qdot_expr period;       /* the period in terms of the unknowns */
    const double *low, *high; /* [k] bounds of the unknowns, infinite if there is none */
    size_t segments;          /* number of segments; 0: as many as the guess needs */
    bool followed;            /* the guess closes within the error of its run: all segment states are taken on it */
} qdot_shooting_of;

typedef struct {
    bool found;
    double *u, *error; /* [k] u in: the guess; out: the orbit and its errors if found, else unchanged */
    size_t rank;       /* number of unknowns that the equations of a closed orbit determine */
    size_t segments;
    double *states; /* [MOST_SEGMENTS x 2n] states at the segments' starts on the orbit found; NULL: not requested */
} qdot_shooting_result;

/* r->segments: how many were taken; 1: the motions
 * near the guess do not grow, nothing was searched.
 * QDOT_ENOTBUILT: constraints, where the unknowns are not all of q, q'. Errors: those of qdot_response_new; that a run fails is none. */
QDOT_MUST_CHECK qdot_status qdot_shooting_find(const qdot_shooting_of *of, qdot_shooting_result *r);

#endif
