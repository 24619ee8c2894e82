/* mass-columns.h -- the mass matrix in numbers, column by column, from the functions of a residual (residual-adjoint.h).
 *
 *     M e_j = J^T W J e_j,   J = dx/dq
 *
 * J e_j by the tape `along` and sums up from the roots, J^T of the forces by sums from the leaves and the tape `adjoint`:
 * each column takes the work of the functions. 32 columns are evaluated at once (tape/rows.h).
 *
 * Tests  tests/sim/form/test_residual-adjoint.c
 */
#ifndef QDOT_SIM_MASS_COLUMNS_H
#define QDOT_SIM_MASS_COLUMNS_H

#include "sim/form/residual.h"

typedef struct qdot_mass_columns qdot_mass_columns;

/* For n coordinates and a residual with `adjoint`, borrowed. `shaken` as for qdot_bind_new. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_mass_columns_new(const qdot_residual *residual, size_t n, bool shaken,
                                                  qdot_mass_columns **columns);
void qdot_mass_columns_free(qdot_mass_columns *columns);

/* The lower triangle of M [n x n] at the state y and time t; the rest of M may be written, too. */
void qdot_mass_columns_evaluate(qdot_mass_columns *columns, double t, const double *y, double *M);

#endif
