/* motion.h -- the series program of a motion: recurrences, and unknowns that are solved for order
 * by order.
 *
 * Unknowns are rows u, a multiplier or the highest derivative of a coordinate, with its integrals
 *
 *     once' = unit u,   twice' = unit once,
 *
 * velocities and coordinates mostly. A row says how far it is ahead of u, its lead: when order k
 * of u is found, orders k + 1 and k + 2 of its integrals are. An unknown is given by a row
 * (u = value), or by equations,
 *
 *     E_i = 0 at every order,
 *
 * affine in the newest coefficients of the unknowns that are solved for. Stage k of an
 * expansion, whoever carries it out:
 *
 *     newest coefficients: 0, or what is guessed
 *     every step at order k + its lead
 *     u_k of what is given by a row; K d = -E_k for the others, u_k += d, integrals too
 *     the steps that are `newest` take on what that changes (linear.def)
 *
 * K = dE_k/du_k is the same at every order. Equations are explicit if they are
 *
 *     E_i = sum_j K_ij u_j - right_i
 *
 * with all orders of these rows: whoever wishes may sum that without the steps that write it. So may
 * the first of them be alone. A form of the equations of motion is what fills this:
 * where accelerations stand in E themselves no step is `newest`; where they are rates of
 * rates of places (d'Alembert), or of constraints, these lead by 2.
 *
 * Tests  tests/series/test_motion.c
 */
#ifndef QDOT_SERIES_MOTION_H
#define QDOT_SERIES_MOTION_H

#include "series/program.h"

typedef struct {
    qdot_program_row value;       /* the row that gives the unknown; QDOT_NO_ROW: the unknown is solved for */
    qdot_program_row row;         /* the row of the unknown u itself; QDOT_NO_ROW: no step reads it */
    qdot_program_row once, twice; /* rows of the first and second integral of u by t; QDOT_NO_ROW: there is no such input */
} qdot_motion_unknown;

/* An entry of the matrix K of the equations: K_ij and K_ji are the coefficient of order 0 of a row. */
typedef struct {
    uint32_t i, j;
    qdot_program_row at;
} qdot_motion_entry;

typedef struct {
    qdot_program program;
    qdot_vec(qdot_motion_unknown) unknowns;
    qdot_vec(uint32_t) solved; /* indices in `unknowns` of those unknowns that equations determine */
    qdot_vec(qdot_program_row) equations; /* [solved.n] rows of the residuals E; K couples unknowns of one block only */
    qdot_vec(uint32_t) blocks; /* first index in `solved` of each block, and the end of the last block */
    qdot_vec(qdot_motion_entry) entries;  /* K, its other entries 0; none: it follows from steps
                                             that are `newest` (_column of an executor) */
    qdot_vec(qdot_program_row) right; /* right-hand sides of the explicit equations, which are the first right.n equations */
    struct qdot_alike *alike; /* its parts that are alike (alike.h); NULL: few are */
    size_t written; /* number of steps at the end of the program that compute only the rows of explicit equations */
} qdot_motion;

/* Once the program has ended: the leads of steps and rows, which steps are `newest`, and which of
 * those later orders read, beside the equations. Errors: QDOT_ENOTBUILT (a coefficient is read before
 * it is known). */
QDOT_MUST_CHECK qdot_status qdot_motion_arrange(qdot_motion *motion);
/* End the program and arrange the motion: of a motion that was filled by `b`, with `status` so far. If
 * that, or one of the two, is a failure, it is returned and the motion is empty. */
QDOT_MUST_CHECK qdot_status qdot_motion_complete(qdot_motion *motion, qdot_program_builder *b,
                                            qdot_status status);
void qdot_motion_clear(qdot_motion *motion);

/* While it is filled. One whose value is a row, then one that is solved for by E = 0, in the block
 * at hand; that block ends. */
QDOT_MUST_CHECK qdot_status qdot_motion_give(qdot_motion *motion, qdot_program_row value,
                                             qdot_program_row once, qdot_program_row twice);
QDOT_MUST_CHECK qdot_status qdot_motion_solve(qdot_motion *motion, qdot_motion_unknown u,
                                              qdot_program_row equation);
QDOT_MUST_CHECK qdot_status qdot_motion_end_block(qdot_motion *motion);

/* An unknown that is solved for: rows of u, of its equation's right side (QDOT_NO_ROW: none), of the residual E. */
typedef struct {
    qdot_program_row u, right, E;
} qdot_motion_line;

/* Write E_i = sum_j K_ij u_j - right_i of unknowns `first` to `end` - 1 with the entries from number
 * `from` on; lines by number of the unknown. */
void qdot_motion_write(const qdot_motion *motion, qdot_program_builder *b, size_t from,
                       qdot_motion_line *lines, size_t first, size_t end);

/* Whether all equations of a motion are explicit; true also if there are none. */
static inline bool
qdot_motion_is_explicit(const qdot_motion *m)
{
    return m->right.n == m->solved.n;
}

/* The first stage of an expansion, at which the rows with the largest lead have order 0. */
static inline int
qdot_motion_first(const qdot_motion *m)
{
    return -m->program.lead;
}

#endif
