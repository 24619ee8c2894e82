/* members.h -- M q'' = f over power series in lanes: the system of an ensemble.
 *
 *     M_0 a_k = f_k - sum_{j=1..k} M_j a_{k-j},   q'' = sum a_k s^k / unit^2
 *
 * as in sim/form/direct.h, with parameters that differ from member to member as further inputs
 * of the tape. Where momenta of cyclic coordinates are kept (sim/plan/routh.h) they are components
 * of a state in place of those velocities, series of nothing but order 0, and
 *
 *     q_c,k+1 = unit r_c,k / (k + 1),   q_c' = r_c(q, q', t, p)
 *
 * Tests  tests/sim/test_ensemble.c
 */
#ifndef QDOT_SIM_MEMBERS_H
#define QDOT_SIM_MEMBERS_H

#include "num/structure.h"
#include "ode/batch.h"
#include "tape/tape.h"

/* What all members share. The tape reads q [n], q' [n], t, parameters [varied], momenta
 * [n_kept], and gives block by block: one coordinate, q''; else f and the lower triangle of M by
 * rows; then the rates of the coordinates whose momenta are kept, which are in no block. */
typedef struct {
    size_t n, varied, n_kept;
    const size_t *kept; /* [n_kept] borrowed */
    qdot_structure structure;
    qdot_tape *tape;
} qdot_members_model;

/* With its series: one a thread. */
typedef struct qdot_members qdot_members;

/* For series to order `most`; tape: the model's or a shaken one. Both borrowed. Errors:
 * QDOT_ENOTBUILT (equations that switch), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_members_new(const qdot_members_model *model,
                                             const qdot_tape *tape, int most,
                                             qdot_members **members);
void qdot_members_free(qdot_members *members);

/* Parameters [members x varied] of a run, borrowed. */
void qdot_members_set(qdot_members *members, const double *parameters);

/* Its callbacks; `members` is their user. */
qdot_ode_batch qdot_members_system(qdot_members *members);

/* The order for a run under tol, by what an expansion of the lanes costs. */
QDOT_MUST_CHECK qdot_status qdot_members_order(const qdot_members_model *model, double tol,
                                               int *order);

#endif
