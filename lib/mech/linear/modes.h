/* modes.h -- finds normal modes of small oscillations about an equilibrium. */
#ifndef QDOT_MECH_MODES_H
#define QDOT_MECH_MODES_H

#include "mech/scene/things.h"
#include "mech/linear/rest.h"

/* (H - w^2 M) a = 0 about `equations`: frequencies w [n]
 * ascending (unordered: the order of some pairs is not proved; they are ordered as at one set of
 * parameter values), amplitudes a [n * coordinates], a row each, scaled so that the first
 * component that is not 0 is 1. Exact if the characteristic polynomial factors into linear and
 * quadratic ones in w^2, else (or at once, if `numbers`) numbers, which need every parameter's
 * value. QDOT_ETYPE with damping or gyroscopic terms, QDOT_EDOMAIN where H is not positive
 * semidefinite. */
typedef struct {
    size_t n;
    qdot_expr *frequency, *amplitude;
    bool numeric, unordered;
} qdot_modes;
QDOT_MUST_CHECK qdot_status qdot_modes_about(qdot_scene *s, qdot_expr equations,
                                             bool numbers, qdot_binder bind, void *user,
                                             qdot_modes *out);
void qdot_modes_clear(qdot_modes *m);

#endif
