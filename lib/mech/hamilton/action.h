/* action.h -- the action variable of one degree of freedom, or of a coordinate that separates.
 *
 *     J(x) = loop integral of p dx over one period,   p = shift +- sqrt(f)        (separation.h)
 *
 *     between turning points a < b, f > 0 inside:  J = 2 int_a^b sqrt(f) dx
 *     no turning point, f > 0, x an angle:          J = int_-pi^pi (shift + sqrt(f)) dx, the motion with the larger p
 *     x cyclic, an angle:                           J = 2 pi p[x]
 *
 * No factor 1/(2 pi). Turning points are the zeros of f and the ends of the declared domain, where the particle is
 * reflected. The regimes of the constants - libration, rotation - are those of the conditions under which the zeros exist.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 10.6-10.8; Landau & Lifshitz, Mechanics, 49-50.
 * Tests   tests/script/studies/action.lag
 */
#ifndef QDOT_MECH_ACTION_H
#define QDOT_MECH_ACTION_H

#include "mech/hamilton/separation.h"

typedef enum {
    QDOT_ACTION_FOUND,
    QDOT_ACTION_UNBOUND,   /* the motion is bounded in no regime */
    QDOT_ACTION_SEVERAL,   /* there are wells with different values */
    QDOT_ACTION_NO_POINTS, /* the turning points were not found, or their order not proved */
    QDOT_ACTION_FALLS      /* p dx is not integrable at an end: the particle falls in */
} qdot_action_verdict;

typedef struct {
    qdot_expr condition; /* a LIST: the regime; nil: always */
    qdot_expr value;     /* holds an integral where the exact one was not found */
    bool rotation;
    bool wall;           /* reflected at an end of the domain */
} qdot_action_regime;

typedef struct {
    qdot_action_verdict verdict; /* FOUND: of at least one regime */
    qdot_vec(qdot_action_regime) regime;
} qdot_action;

/* The action of a coordinate that was separated (not cyclic, solved for p). *out is cleared by the caller. */
QDOT_MUST_CHECK qdot_status qdot_action_find(qdot_scene *s, const qdot_separation *all, size_t which, qdot_action *out);
void qdot_action_clear(qdot_action *a);

#endif
