/* gates.h -- which switches the equations hold in a mode.
 *
 * A switch may stand in a branch that is not taken:
 *
 *     if(y < 0, max((-y)^1.5, 0), 0)          max(u, v, w) where u is the largest: v - w
 *
 * It has no side then: what decides it may be undefined, and need not be watched. The gates are the
 * nodes of the equations between their roots and their switches, the switches among them. From the sides
 * follows which branches are taken, and from these, beginning at the roots, which gates are open. What a surface
 * decides by, u, is looked at where one of its switches is open.
 *
 * Tests  tests/script/contacts/switch-branches.lag, tests/sim/model/test_gates.c
 */
#ifndef QDOT_SIM_GATES_H
#define QDOT_SIM_GATES_H

#include "base/memory.h"
#include "sim/model/surface.h"

/* A comparison whose sign follows from the side of a switching surface u = 0: the sign of u, or of -u. */
typedef struct {
    size_t surface; /* index of the surface; SIZE_MAX: the comparison never changes during a run */
    int turned;     /* -1 if the comparison is of -u instead of the surface's function u; else 1 */
    uint8_t sign;   /* if the comparison never changes: bits QDOT_GE0 ... of its known sign */
    qdot_expr u;    /* left minus right side of the comparison, before its sign was normalised */
} qdot_gate_pair;

typedef enum {
    QDOT_GATE_PASSES,  /* contains switching functions, or is a product with a power that needs a layer */
    QDOT_GATE_IF,
    QDOT_GATE_LOGIC,
    QDOT_GATE_RELATION,
    QDOT_GATE_EXTREME, /* min or max: compares the pairs of arguments (0, 1), (0, 2), ... (1, 2), ... */
    QDOT_GATE_VALUE    /* abs, sign, floor or mod: its value is given by the side of one surface */
} qdot_gate_kind;

typedef struct {
    qdot_expr node;
    qdot_gate_kind kind;
    uint16_t op; /* operation of the node of the expression */
    uint32_t n;  /* number of arguments of the node */
    size_t first; /* index in `arguments` of the node's first; each entry is a gate, or SIZE_MAX for none */
    size_t pair;  /* index in `pairs` of the node's first comparison */
} qdot_gate;

/* The switching functions (gates) in the equations, such as abs, sign, max. Start from {0}. */
typedef struct {
    size_t surfaces;
    qdot_vec(qdot_gate) gates; /* the switching functions (gates), arguments before the functions of them */
    qdot_vec(size_t) arguments;
    qdot_vec(qdot_gate_pair) pairs;
    qdot_vec(size_t) roots; /* gates that are the outermost switching functions in the expressions searched */
    size_t *decides; /* [surfaces] the gate that the surface's own function u is, as it contains switches; SIZE_MAX: none */
    bool branches;   /* there is a mode in which some gate is not evaluated */
} qdot_gates;

/* Whether a node of an expression is a switching function whose argument changes along a run. */
bool qdot_gates_is_switch(const qdot_pool *pool, qdot_expr e);
/* Whether an expression contains anything that changes along a run. */
bool qdot_gates_moves(const qdot_pool *pool, qdot_expr e);
/* Write u or -u, whichever prints without a leading minus; *turned: -u was chosen. */
qdot_expr qdot_gates_upright(qdot_pool *pool, qdot_expr u, bool *turned);

/* Find the gates of e [n], whose surfaces are at [m]. `deciding`: also of what these decide by, which is
 * open where one of their switches is. */
QDOT_MUST_CHECK qdot_status qdot_gates_find(qdot_pool *pool, size_t m, const qdot_surface *at, size_t n,
                                            const qdot_expr *e, bool deciding, qdot_gates *gates);
void qdot_gates_clear(qdot_gates *gates);

/* State of a gate, as bits: its condition may be false, may be true; its value is needed. */
enum { QDOT_GATE_FALSE = 1, QDOT_GATE_TRUE = 2, QDOT_GATE_OPEN = 4 };

/* The sign of a pair by the sides; *known: there is one. Where the motion slides it is that of corner
 * [surfaces], or unknown without. */
int qdot_gates_sign(const qdot_gate_pair *pair, const int64_t *side,
                    const int64_t *corner, bool *known);

/* Mark what is open with these sides (NULL: all) into open [gates.n + surfaces], gates and then surfaces.
 * Allocates nothing, and makes no node. */
void qdot_gates_open(const qdot_gates *gates, const int64_t *side, const int64_t *corner, uint8_t *open);

#endif
