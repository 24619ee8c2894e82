/* surface.h -- a surface u(q, q', t) = 0 at which equations switch (sim/model/switch.h).
 *
 * Tests  those of switch.h and layer.h
 */
#ifndef QDOT_SIM_SURFACE_H
#define QDOT_SIM_SURFACE_H

#include "expr/expr.h"

typedef struct {
    qdot_expr u;  /* as in the equations, with parameter values */
    bool steps;   /* the side is floor(u); else the sign of u */
    qdot_expr side; /* a symbol for the side */
    double power;   /* the least broken exponent of a power of u (sim/model/layer.h); 0: none */
    /* A contact that may last (sim/model/contact.h): u of an event, which no equation holds.
     * Its side is 0, or QDOT_SIDE_SLIDES while it lasts. */
    bool contact;
    size_t event; /* whose `then` is the impact */
    int reaction; /* the sign of du/dt that the contact can push to */
    double layer;   /* half the width of the layer in which that power counts as 0, there of
                       side 0: a power of two; 0: there is none */
} qdot_surface;

#endif
