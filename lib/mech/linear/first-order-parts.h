/* first-order-parts.h -- what the files of the linear motion about a state share. */
#ifndef QDOT_MECH_FIRST_ORDER_PARTS_H
#define QDOT_MECH_FIRST_ORDER_PARTS_H

#include "mech/dynamics/speeds.h"
#include "mech/linear/state-values.h"

/* Changes of n symbols are linear in columns: state and inputs, and a last one for what does not change. */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_state_values v;
    size_t n, c, inputs;   /* numbers of coordinates that are no first-order unknowns, of constraints, of inputs, which
                            * here are those of the scene and the first-order unknowns */
    size_t *own;           /* [n] index of each such coordinate in the scene */
    size_t *order;         /* [c] the constraints, holonomic ones first, then those of velocities, of accelerations */
    qdot_echelon level[3]; /* rows over jets of that order: (n of the order itself, n each of the orders below, 1) */
    bool *kept;            /* [c] not a repetition of earlier ones on the level of accelerations */
    size_t y, z;           /* numbers of independent coordinates and velocities */
    bool accelerated;      /* q'' at the state is known: the slopes of the constraints on its level have values */
    size_t width;          /* columns: y + z of the state, inputs; some that are 0; last what does not change */
    qdot_expr *change[3];  /* [n x width] of q, q', q'' */
    qdot_expr *lambda;     /* [c x width] of the multipliers */
    qdot_expr *M;          /* [n x n] */
    const qdot_speeds *speeds; /* they are states in place of independent velocities; NULL: there are none */
    qdot_expr *rates;      /* [z x width] changes of their rates */
} qdot_first_order_job;

/* The jet of coordinate i. */
qdot_expr qdot_first_order_jet(const qdot_first_order_job *j, size_t i, uint32_t order);
/* n expressions, all 0, which the caller frees; NULL: there is none. */
qdot_expr *qdot_first_order_new(size_t n);
/* The slopes of e along q, q' and the inputs, slope [2 n + inputs]. */
void qdot_first_order_slopes(const qdot_first_order_job *j, qdot_expr e, qdot_expr *slope);
/* How an expression with these slopes changes with what column a stands for, one of the state or an input. */
qdot_expr qdot_first_order_change(qdot_first_order_job *j, const qdot_expr *slope, size_t a);
/* The part of that change that comes from the changes of one order of the jets, by X [n]. */
qdot_expr qdot_first_order_along(const qdot_first_order_job *j, const qdot_expr *X, const qdot_expr *change, size_t a);
/* Solve A x = b for several right sides; A is [n x n], X has a row of `columns` right sides for each unknown and is
 * replaced by the solutions. QDOT_ESINGULAR without a message. */
QDOT_MUST_CHECK qdot_status qdot_first_order_solve(qdot_first_order_job *j, size_t n, const qdot_expr *A, size_t columns,
                                                   qdot_expr *X);
/* If the state names a speed, put the velocities that speeds and constraints give; speeds that are not named are 0. */
QDOT_MUST_CHECK qdot_status qdot_first_order_put_velocities(qdot_first_order_job *j);
/* Write all changes in terms of the speeds, with those of their rates. */
QDOT_MUST_CHECK qdot_status qdot_first_order_turn_to_speeds(qdot_first_order_job *j);
/* Hand out the results. */
struct qdot_first_order;
QDOT_MUST_CHECK qdot_status qdot_first_order_write(qdot_first_order_job *j, struct qdot_first_order *out);

#endif
