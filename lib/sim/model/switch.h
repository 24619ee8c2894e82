/* switch.h -- surfaces at which equations switch: abs, sign, min, max, mod, floor, if.
 *
 * Each of these functions is smooth except on surfaces in the space of (q, q', t):
 *
 *     abs(u), sign(u)     u = 0           +-u, +-1
 *     min(a, b, ...)      a - b = 0 ...   the least of them
 *     if(a < b, A, B)     a - b = 0       A or B; a == b: where a - b stays 0
 *     floor(u)            u = k, k + 1    k
 *     mod(a, b)           of floor(a/b)   a - k b
 *
 * A jump of T - V itself is a surface too, even if the equations on both sides are the same.
 *
 * A mode is one side of every surface: a sign, 0 if u stays 0 or in a layer about it
 * (sim/model/layer.h), the integer of a floor,
 * QDOT_SIDE_SLIDES, or QDOT_SIDE_IDLE if only branches that are not taken switch on it
 * (sim/model/gates.h). An expression frozen to a mode does not switch.
 *
 * On a surface along which the motion slides an expression is the mean of its values e+, e- on both
 * sides, with a share s of -1 ... 1 (Filippov):
 *
 *     (1 + s)/2 e+ + (1 - s)/2 e-        so sign(u) is s, abs(u) is 0
 *
 * Surfaces may be nested: u of if(mod(t, 1) < 0.3, A, B) is mod(t, 1) - 0.3, which is t - k - 0.3
 * on the side k of its inner surface. A surface comes after those inside it, so that sides can be
 * decided one after another; as expressions in q, q', t and the sides, as symbols, all u are
 * smooth. What stands in a branch that is not taken need not be defined.
 *
 * Tests  tests/script/contacts/switching.lag, switch-nested.lag, switch-branches.lag, tests/sim/model/test_switch.c, test_taylor.c
 */
#ifndef QDOT_SIM_SWITCH_H
#define QDOT_SIM_SWITCH_H

#include "sim/model/gates.h"
#include "sim/model/request.h"
#include "sim/model/surface.h"

typedef struct qdot_switches {
    qdot_pool *pool; /* pool of the expressions; borrowed */
    qdot_vec(qdot_surface) surfaces; /* surfaces: nested ones first, then those of contacts, then those of discs */
    size_t contacts;
    qdot_vec(qdot_puck) pucks; /* sliding discs; their surfaces come after those of contacts */
    size_t n_puck_symbols;     /* number of symbols of all discs, k + 1 for each */
    qdot_vec(qdot_expr) atoms; /* the functions that switch (abs, sign ...), nested ones first */
    qdot_vec(qdot_expr) roots; /* the expressions that contain switching functions */
    qdot_gates gates; /* gates (switching functions) of `roots` and of the functions u of the surfaces */
    qdot_expr mass, forcing; /* M and f of M q'' = f, with their switching functions, parameter values inserted */
    qdot_expr level; /* the terms of T - V that switch: a jump of them is an infinite force;
                        NIL: none */
} qdot_switches;

/* From so many coordinates on M and f are not derived if nothing reads them
 * (sim/plan/tree-alone.h), and switches are looked for in their ingredients. Fewer are derived in
 * milliseconds. */
enum { QDOT_MANY_COORDINATES = 32 };

/* So many where bodies turn in space: entries of M along an arm of N links are sums over links of products of N angles. */
enum { QDOT_MANY_TURNING = 12 };

/* Whether a scene has that many coordinates; whether so many with bodies that turn in space, and neither constraints nor
 * first-order unknowns: forces with a potential are not derived, either (sim/form/residual-adjoint.h). */
bool qdot_switches_are_many(const qdot_scene *scene);
bool qdot_switches_are_spatial(const qdot_scene *scene);

/* The number of surfaces at which the equations themselves switch, not counting contacts and discs. */
static inline size_t
qdot_switches_own(const qdot_switches *s)
{
    return s->surfaces.n - s->contacts - s->pucks.n;
}

/* Find the surfaces of the equations of motion and of the constraints; start from {0}. Errors: as
 * qdot_plan_new. */
QDOT_MUST_CHECK qdot_status qdot_switches_find(qdot_scene *scene,
                                               const qdot_run_request *request,
                                               qdot_switches *switches);
void qdot_switches_clear(qdot_switches *switches);

/* frozen [n]: e [n] in the mode side [surfaces]; NULL: with the symbols of the sides.
 *   share  [surfaces] the share of each surface along which the motion slides; NULL: none does
 */
QDOT_MUST_CHECK qdot_status qdot_switches_freeze(const qdot_switches *switches,
                                                 const int64_t *side, const qdot_expr *share,
                                                 size_t n, const qdot_expr *e,
                                                 qdot_expr *frozen);

#endif
