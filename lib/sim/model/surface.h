/* surface.h -- a surface u(q, q', t) = 0 at which equations switch (sim/model/switch.h).
 *
 * Tests  those of switch.h and layer.h
 */
#ifndef QDOT_SIM_SURFACE_H
#define QDOT_SIM_SURFACE_H

#include <stdint.h>

#include "expr/id.h"

/* Value of a side for a motion that slides along the surface (sim/model/sliding.h): u stays 0. */
#define QDOT_SIDE_SLIDES INT64_MAX
/* A puck that has begun to move, so slowly that its direction is that of its shares
 * (sim/model/puck.h). Other surfaces have no such mode. */
#define QDOT_SIDE_CREEPS (-1)
/* Value of a side if the switches of the surface are not frozen: its side is left open. */
#define QDOT_SIDE_OPEN INT64_MIN

/* Value of a side if the surface affects no switch of the equations in this mode (sim/model/gates.h). */
#define QDOT_SIDE_IDLE (INT64_MIN + 1)

typedef struct {
    qdot_expr u;  /* the surface's function u, as in the equations, with parameter values */
    bool steps;   /* the side is the integer floor(u); otherwise the sign of u */
    qdot_expr side; /* symbol that stands for the side in expressions */
    double power;   /* smallest non-integer exponent of a power of u (sim/model/layer.h); 0: none */
    /* A contact that may last (sim/model/contact.h): u of an event, which no equation holds.
     * Its side is 0, or QDOT_SIDE_SLIDES while it lasts. */
    bool contact;
    size_t event; /* for a contact: index of the event whose `then` is the impact */
    int reaction; /* for a contact: sign of du/dt that the reaction force can produce */
    size_t puck; /* 1 + index of the disc whose |w|^2 is u (sim/model/puck.h); 0: none */
    double layer;   /* half the width of the layer in which that power counts as 0, there of
                       side 0: a power of two; 0: there is none */
} qdot_surface;

/* A vector w of velocities whose direction enters the equations, as with dry friction in a plane
 * (sim/model/puck.h). */
enum { QDOT_PUCK_MOST = 6, QDOT_PUCK_MOST_TIED = 4 };

typedef struct {
    size_t surface; /* index of the disc's surface */
    size_t k;       /* number of components of the disc's velocity w */
    size_t velocity[QDOT_PUCK_MOST];  /* [k] coordinates j whose velocities q'_j occur in w */
    qdot_expr symbol[QDOT_PUCK_MOST]; /* [k] the symbols of the velocities q'_j */
    /* Velocities of w that constraints, with constant coefficients, tie to others: q'_j = to, which
     * changes by follow_ja with the velocity a above. */
    size_t n_tied, tied[QDOT_PUCK_MOST_TIED];
    qdot_expr tied_symbol[QDOT_PUCK_MOST_TIED], to[QDOT_PUCK_MOST_TIED];
    double follow[QDOT_PUCK_MOST_TIED][QDOT_PUCK_MOST];
    qdot_expr square;                 /* the expression |w|^2, with parameter values */
    qdot_expr rest[QDOT_PUCK_MOST];   /* [k] d_j: q'_j minus its value at w = 0 */
    qdot_expr metric[QDOT_PUCK_MOST * QDOT_PUCK_MOST]; /* [k x k] the matrix G of |w|^2 in terms of d */
    qdot_expr share[QDOT_PUCK_MOST];  /* [k] symbols of the components s_j of the direction of friction */
    qdot_expr inverse;                /* symbol for 1/|w|; 0 at rest */
    qdot_expr length;                 /* symbol for the speed |w| while it goes to 0 */
    size_t first; /* index of the disc's first symbol; the discs' symbols follow the sides of all surfaces */
    double radius; /* the disc counts as at rest if |w| is at most this; 0: not tested */
} qdot_puck;

#endif
