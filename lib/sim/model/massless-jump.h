/* massless-jump.h -- the state behind an event where coordinates have no mass.
 *
 * Their equations G = 0 (massless.h) hold behind a jump as before it. What `then` does not put follows from them: positions
 * from those of positions alone, then velocities from those of velocities and from the rates of the others,
 *
 *     x = -(dG/dx)^-1 G(x = 0)   at the state behind the jump.
 *
 * What G does not see changed stays as it is, whatever G is; else G has to be linear in it.
 *
 * Tests  tests/script/massless/massless-jumps.sh
 */
#ifndef QDOT_SIM_MASSLESS_JUMP_H
#define QDOT_SIM_MASSLESS_JUMP_H

#include "mech/scene/scene.h"

typedef struct {
    size_t w;
    const qdot_expr *G;       /* [w] left sides G of the equations G = 0 of massless coordinates */
    const size_t *coordinate; /* [w] index of the massless coordinate of each unknown */
    const bool *of_positions; /* [w] whether the equation determines a position; else it determines a velocity */
} qdot_massless_rows;

/* q, q' behind an event from those before it, into after [2n]. QDOT_ENOTBUILT: an equation that is not linear in what it
 * has to determine. */
QDOT_MUST_CHECK qdot_status qdot_massless_jump(const qdot_scene *scene,
                                               const qdot_event *event,
                                               const qdot_massless_rows *rows,
                                               qdot_expr *after);

#endif
