/* guarded.h -- a fast series where its equations are well conditioned, another one elsewhere.
 *
 * Under constraints the fast forms (bordered.h, eliminated.h) solve without pivots or corrections.
 * Their `begin` fails with QDOT_EDOMAIN at a state that is not for them: the other series is begun
 * there instead.
 *
 * Tests  tests/sim/test_bordered.c, tests/sim/test_constraints.c
 */
#ifndef QDOT_SIM_GUARDED_H
#define QDOT_SIM_GUARDED_H

#include "ode/system.h"

typedef struct {
    const qdot_ode_series *own, *other, *now; /* `now`: the one begun last */
    bool as_code; /* `own` is worth its time as machine code only: */
    int p;        /* before there is some, of order p, the other is taken */
    bool looked;  /* at the first state, by `own` */
    bool (*fits)(const void *form); /* whether what `own` began will do; NULL: it does */
    const void *form;               /* borrowed */
    qdot_ode_series series;
} qdot_guarded;

/* Both borrowed. Costs and `fits` are the caller's to fill in. */
void qdot_guarded_init(qdot_guarded *guarded, const qdot_ode_series *own,
                       const qdot_ode_series *other, bool as_code);

#endif
