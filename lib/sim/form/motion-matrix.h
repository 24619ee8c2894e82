/* motion-matrix.h -- the matrix K of what a motion solves for, K d = -E, while a series is expanded.
 *
 *     explicit equations   entries are rows of the program; block by block, Cholesky or LDL^T
 *     d'Alembert's         K is M, from a tape of its own or column by column (mass-columns.h); likewise
 *     of constraints       [M A^T; A 0], of rows of the program, of any rank (saddle-solver.h)
 *
 * It is factored where a series begins. Orders up to QDOT_BLOCKS_SOLVED are solved for by that
 * factor, those beyond by the inverse; with constraints all by the inverse (num/bordered.h).
 *
 * Tests  tests/sim/form/test_taylor.c, test_motion.c, test_bordered.c
 */
#ifndef QDOT_SIM_MOTION_MATRIX_H
#define QDOT_SIM_MOTION_MATRIX_H

#include "series/lanes-motion.h"
#include "series/taylor-motion.h"
#include "sim/form/blocks.h"
#include "sim/form/mass-columns.h"
#include "sim/form/saddle-solver.h"

/* An entry of the matrix K: the address of its value, and where it is copied. */
typedef struct {
    double *to;
    const double *from;
} qdot_motion_matrix_entry;

typedef struct {
    const qdot_plan *plan;
    const qdot_motion *motion;
    qdot_saddle_solver *saddle; /* solver that eliminates multipliers by the constraints' own coefficients; NULL: not used */
    int refined;                /* with `saddle`: orders up to this one are refined by iteration */
    qdot_blocks solvers;
    size_t blocks; /* number of blocks of the motion */
    size_t *block; /* [blocks] index in `solvers` of each block */
    qdot_motion_matrix_entry *entries; /* [n_entries] entries of K that vary; none if the tape `masses` gives K */
    size_t n_entries;
    qdot_mass_columns *columns; /* gives K as one block; NULL: not used */
    const qdot_tape *masses; /* tape that gives K; NULL: K comes from `entries` */
    qdot_tape *shaken;       /* copy of `masses` with slightly perturbed constants; NULL: none */
    double *in, *out, *work; /* inputs, outputs and scratch of `masses` */
    double *by;              /* [solved] the Taylor coefficients of order k of the unknowns */
} qdot_motion_matrix;

/* For a series of the motion; all is borrowed. masses: M as lower triangles of the blocks that are
 * not constant, from q, q', t; NULL: K is of rows. Errors: QDOT_ESINGULAR, QDOT_ENOMEM. Clear it in
 * any case. */
QDOT_MUST_CHECK qdot_status qdot_motion_matrix_init(qdot_motion_matrix *K, const qdot_plan *plan,
                                                    const qdot_motion *motion,
                                                    const qdot_tape *masses,
                                                    qdot_taylor *taylor, bool shaken);
void qdot_motion_matrix_clear(qdot_motion_matrix *K);

/* Whether K is the mass matrix beside the program, not of its rows. */
static inline bool
qdot_motion_matrix_is_mass(const qdot_motion_matrix *K)
{
    return K->masses || K->columns;
}

/* Call _begin before order 0 is computed at y: reads entries that are no rows; then _take_rows for
 * those that are. */
QDOT_MUST_CHECK qdot_status qdot_motion_matrix_begin(qdot_motion_matrix *K, double t,
                                                     const double *y);
QDOT_MUST_CHECK qdot_status qdot_motion_matrix_take_rows(qdot_motion_matrix *K);

/* Prepare to solve at the orders 1 ... p - 1, p as for other steps of the run: invert the blocks of K that are not constant. */
void qdot_motion_matrix_prepare(qdot_motion_matrix *K, int p);

/* Solve K d = -E at order k (E: the residual); K->by becomes the unknowns' coefficients. */
void qdot_motion_matrix_solve(qdot_motion_matrix *K, int k);

/* Call after qdot_motion_matrix_prepare: pass the factors and inverses of K to machine code. */
void qdot_motion_matrix_hand_over(const qdot_motion_matrix *K, qdot_taylor *taylor);
void qdot_motion_matrix_hand_to_lanes(const qdot_motion_matrix *K, qdot_lanes_motion *code);

/* The number of times that the matrix K was factored. */
size_t qdot_motion_matrix_factored(const qdot_motion_matrix *K);

#endif
