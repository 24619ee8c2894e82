/* momentum-rows.h -- momenta that are kept, in the series of a reduced plan (sim/plan/routh.h).
 *
 * Momenta are inputs of its program, numbers behind t; the velocities that follow from them are the
 * last of its outputs.
 *
 * Tests  tests/sim/plan/test_routh.c
 */
#ifndef QDOT_SIM_MOMENTUM_ROWS_H
#define QDOT_SIM_MOMENTUM_ROWS_H

#include "sim/form/expansion.h"
#include "sim/model/equations.h"

typedef struct qdot_momentum qdot_momentum;

typedef struct {
    const qdot_plan *plan;
    qdot_expansion at;
    const double *hi, *lo; /* [n_kept] conserved momenta hi + lo, borrowed; NULL: 0 */
    qdot_momentum *drawn;  /* [n_kept] the conserved momenta, rounded at random as in the latest step */
    const double **rates; /* [n_kept] Taylor coefficients of the velocities that follow from the momenta */
    bool shaken;           /* use only the high part hi of the momenta */
} qdot_momentum_rows;

/* Make the rows of conserved momenta for a plan (borrowed) that has a series program. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_momentum_rows_init(qdot_momentum_rows *m,
                                                    const qdot_plan *plan,
                                                    qdot_expansion at, bool shaken);
void qdot_momentum_rows_clear(qdot_momentum_rows *m);

/* Set the conserved momenta from time t on: hi + lo rounded at random to one of the neighbouring doubles. */
void qdot_momentum_rows_draw(qdot_momentum_rows *m, double t);

/* Copy coefficients of orders below p of velocities that follow from momenta to the rows where
 * others read them. */
void qdot_momentum_rows_show(const qdot_momentum_rows *m, int p);

/* Check that the velocities are finite; QDOT_EDOMAIN: the message names one that is not. */
QDOT_MUST_CHECK qdot_status qdot_momentum_rows_check(const qdot_momentum_rows *m);

#endif
