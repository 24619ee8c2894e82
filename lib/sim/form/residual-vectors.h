/* residual-vectors.h -- d'Alembert's residual by vectors of eight coordinates.
 *
 * The slopes of a coordinate are spread over vectors, one lane a coordinate, so that
 *
 *     sum_f dd_f/dq_i F_f,   F = W d'',
 *
 * is vectors of slopes times vectors of forces, orders by orders, and each vector of forces
 * eight rows of W times the second derivatives of the differences, which are lanes of the
 * program (series/taylor-wide.h).
 *
 * Tests  tests/sim/test_taylor.c
 */
#ifndef QDOT_SIM_RESIDUAL_VECTORS_H
#define QDOT_SIM_RESIDUAL_VECTORS_H

#include "sim/form/residual.h"
#include "series/taylor.h"

typedef struct qdot_residual_vectors qdot_residual_vectors;

/* Of a residual, for n coordinates, and its program, both borrowed; W [rows x functions] by
 * columns is read, not kept. *wide NULL: its program has no vectors. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_residual_vectors_new(const qdot_residual *r, size_t n,
                                                      const qdot_taylor *places,
                                                      const double *W, size_t rows,
                                                      qdot_residual_vectors **wide);
void qdot_residual_vectors_free(qdot_residual_vectors *wide);

/* Orders 0 and 1 of the program, whose order 0 is there; first [n]: q of order 1. */
void qdot_residual_vectors_begin(qdot_residual_vectors *wide, const qdot_taylor *places,
                                 const double *first);

/* R [n, with room for full vectors]: order m - 2 of what is applied by the program, times
 * `scale`, less the sums, coefficients m of q taken as 0. Then those become newest [n]. */
void qdot_residual_vectors_residual(qdot_residual_vectors *wide, int m, double scale,
                                    double *R);
void qdot_residual_vectors_correct(qdot_residual_vectors *wide, int m,
                                   const double *newest);

/* Vectors of a convolution an order, other vectors' multiplications, and what is begun
 * anew an order: groups, sums. */
void qdot_residual_vectors_count(const qdot_residual_vectors *wide, double *convolutions,
                                 double *products, double *begun);

#endif
