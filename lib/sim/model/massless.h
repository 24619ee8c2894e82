/* massless.h -- coordinates with which no mass moves, where their own equations determine them.
 *
 * If row i of M is 0, the equation of coordinate i is f_i(q, q', t) = 0. One that holds q' of such
 * coordinates determines these velocities (damping without mass, L = a(q) q' - V: index 1); one
 * without any velocity determines positions (index 2). Both are taken as constraints beside those
 * of the scene, differentiated once or twice, with the multiplier mu:
 *
 *     M q'' = f + A^T mu,   A q'' = gamma,   row i: 0 = f_i + (A^T mu)_i,
 *
 * so that mu is 0 on f_i = 0. [M A^T; A 0] is regular, if M is not, where A is regular among the
 * massless coordinates (num/saddle.h).
 *
 * A coordinate that a constraint of the scene holds is left to it.
 *
 * Tests  tests/script/massless/massless.lag, tests/bad/massless/massless-*.lag
 */
#ifndef QDOT_SIM_MASSLESS_H
#define QDOT_SIM_MASSLESS_H

#include "mech/scene/scene.h"
#include "sim/model/equations.h"
#include "sim/model/request.h"
#include "sim/model/switch.h"

/* Find them, into p->massless and p->n_massless, once M and f are there. QDOT_ESINGULAR: an equation
 * determines nothing. */
QDOT_MUST_CHECK qdot_status qdot_massless_find(const qdot_scene *scene, qdot_plan *p);

/* Whether coordinate i has no mass (its row of the mass matrix p->M is 0) and is in no constraint. */
bool qdot_massless_is(const qdot_scene *scene, const qdot_plan *p, size_t i);

/* Whether what these equations determine decides a switch, as the velocity of a slider: by which side that starts is for
 * the first piece to find (sim/course/piece-massless.c), from values as they were said. */
bool qdot_massless_switch(const qdot_plan *p, const qdot_switches *s);

/* Their equations 0 = G with the values of a request. One that holds a velocity of such coordinates determines a velocity;
 * one of positions alone determines a position, and by its rate a velocity. */
typedef struct {
    size_t n;
    qdot_expr *equations; /* [n] left sides G of G = 0 */
    bool *of_positions;   /* [n] whether the equation contains positions only; else it contains a massless velocity */
} qdot_massless;

/* Find the massless coordinates before a plan exists; derives M and f. x is cleared on failure. */
QDOT_MUST_CHECK qdot_status qdot_massless_of_scene(qdot_scene *scene, const qdot_run_request *request, qdot_massless *x);
/* The number of start values q, q' [2n] that the equations of massless coordinates determine. */
size_t qdot_massless_determines(const qdot_massless *x);
void qdot_massless_clear(qdot_massless *x);

/* The kind of constraint (on positions, velocities ...) that a massless coordinate's equation amounts to. */
qdot_constraint_kind qdot_massless_kind(const qdot_plan *p, size_t i);

#endif
