/* blocks.h -- solvers for the blocks of the mass matrix M, or for the matrix of M and constraints. */
#ifndef QDOT_SIM_BLOCKS_H
#define QDOT_SIM_BLOCKS_H

#include "num/ldlt.h"
#include "sim/model/equations.h"

typedef struct {
    size_t n; /* number of unknowns: q'' of one block; with constraints all q'', then multipliers */
    bool constant;   /* M is constant here and factored only once */
    double *a;       /* [n x n] M, then its factors; with constraints [M A^T; A 0] */
    double *x;       /* [n] right-hand side and then solution, for the caller; scratch of qdot_blocks_invert */
    qdot_ldlt ldlt;  /* LDL^T factors, if M is not positive definite */
    size_t m;        /* n rounded up to full vectors */
    double *inverse; /* [m x n] inverse of M, if requested; else NULL */
    double *lower;   /* [m x n] scratch for the inverse; [m] for products */
} qdot_solver;

typedef struct {
    const qdot_plan *plan;
    qdot_solver *at; /* [n] a solver for each block */
    size_t n;        /* number of blocks, plan->structure.blocks; with constraints 1 */
    bool diagonal;   /* with constraints: M is a diagonal matrix */
    size_t factored; /* number of factorisations so far */
} qdot_blocks;

/* For this plan, borrowed; constant blocks factored. With constraints, up to QDOT_BORDERED_MOST
 * unknowns. `shaken` as for qdot_bind_new. Errors: QDOT_ESINGULAR, QDOT_ENOMEM; clear it in any
 * case. */
QDOT_MUST_CHECK qdot_status qdot_blocks_init(qdot_blocks *b, const qdot_plan *plan,
                                             bool shaken);
void qdot_blocks_clear(qdot_blocks *b);

/* Factor block k, whose lower triangle stands in its `a`. Errors: QDOT_ESINGULAR names the
 * coordinate; QDOT_EDOMAIN: a row of A has less than a third of its length left beyond the
 * others. */
QDOT_MUST_CHECK qdot_status qdot_blocks_factor(qdot_blocks *b, size_t k);

/* Solve with block k, factored: x [n] is the right-hand side, then the solution. */
void qdot_blocks_solve(const qdot_blocks *b, size_t k, double *x);

/* Orders of a series up to this one are solved for: an error of the inverse is the same at all
 * orders of a step, and would make the energy drift as t. */
enum { QDOT_BLOCKS_SOLVED = 3 };

/* For many right-hand sides: the inverse of block k, factored, as L^-T L^-1, and its
 * product with x [n]. Its error is of the size of _solve's, not as reliably: for the
 * orders of a series beyond that. An indefinite block is solved; of a bordered one there is no more
 * than the inverse. _invert overwrites the block's x. */
QDOT_MUST_CHECK qdot_status qdot_blocks_prepare(qdot_blocks *b, size_t k);
void qdot_blocks_invert(qdot_blocks *b, size_t k);
void qdot_blocks_apply(const qdot_blocks *b, size_t k, double *x);

/* Copy a lower triangle, stored by rows, into block k of M. Returns the address after the numbers read. */
const double *qdot_blocks_unpack(const qdot_blocks *b, size_t k, const double *from);

/* Report that M is singular because the coordinate of the given row has no mass. */
qdot_status qdot_blocks_singular(const qdot_plan *plan, const qdot_plan_block *block,
                                 size_t row);

#endif
