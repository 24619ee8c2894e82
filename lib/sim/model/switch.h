/* switch.h -- where equations switch: abs, sign, min, max, mod, floor, if.
 *
 * Each of them is smooth but for surfaces in the space of (q, q', t):
 *
 *     abs(u), sign(u)     u = 0           +-u, +-1
 *     min(a, b, ...)      a - b = 0 ...   the least of them
 *     if(a < b, A, B)     a - b = 0       A or B; a == b: where a - b stays 0
 *     floor(u)            u = k, k + 1    k
 *     mod(a, b)           of floor(a/b)   a - k b
 *
 * Where T - V itself jumps there is a surface too, though the equations on its sides may be
 * the same.
 *
 * A mode is one side of every surface: a sign, 0 where u stays 0, and an integer where it is
 * a floor. Frozen to a mode an expression switches no more.
 *
 * Surfaces may stand inside one another: u of if(mod(t, 1) < 0.3, A, B) is mod(t, 1) - 0.3,
 * which is t - k - 0.3 by the side k of its inner surface. A surface stands behind those
 * inside it, so that sides can be decided one after another; as expressions in q, q', t and
 * the sides, which are symbols then, all u are smooth.
 *
 * Tests  tests/script/switching.lag, switch-nested.lag, tests/sim/test_switch.c, test_taylor.c
 */
#ifndef QDOT_SIM_SWITCH_H
#define QDOT_SIM_SWITCH_H

#include "sim/model/request.h"

typedef struct {
    qdot_expr u;  /* as it stands in the equations, the values put in */
    bool steps;   /* the mode is floor(u); else the sign of u */
    qdot_expr side; /* a symbol for it */
} qdot_surface;

typedef struct qdot_switches {
    qdot_pool *pool; /* borrowed */
    qdot_vec(qdot_surface) surfaces; /* inner ones first */
    qdot_vec(qdot_expr) atoms; /* what switches, inner ones first */
    qdot_expr level; /* the terms of T - V that switch: where they jump the force is infinite;
                        NIL: none */
} qdot_switches;

/* Fewer coordinates are derived in milliseconds. Of so many M and f are left underived where
 * nothing reads them (sim/plan/tree-alone.h), and switches are looked for in what they would be
 * made of. */
enum { QDOT_MANY_COORDINATES = 32 };

/* Those of the equations of motion and of the constraints; start from {0}. Errors: as qdot_plan_new has them. */
QDOT_MUST_CHECK qdot_status qdot_switches_find(qdot_scene *scene,
                                               const qdot_run_request *request,
                                               qdot_switches *switches);
void qdot_switches_clear(qdot_switches *switches);

/* e [n] in a mode: side [surfaces]; NULL: the symbols of the sides in their place. */
QDOT_MUST_CHECK qdot_status qdot_switches_freeze(const qdot_switches *switches,
                                                 const long *side, size_t n,
                                                 const qdot_expr *e, qdot_expr *frozen);

#endif
