/* direct.h -- Taylor coefficients of the motion, from those of the equations.
 *
 * With s = (t' - t)/unit, q = sum q_k s^k and q'' = sum a_k s^k:
 *
 *     v_k+1 = unit a_k / (k + 1),   q_k+1 = unit v_k / (k + 1)
 *
 *     a block of one     a_k is an output of the tape
 *     a constant block   M a_k = f_k
 *     any other          M_0 a_k = f_k - sum_{j=1..k} M_j a_{k-j}: one factorisation an
 *                        expansion, one back-substitution an order, by the machine code
 *                        itself where there is some and blocks are small
 *
 * Tests  tests/sim/test_taylor.c
 */
#ifndef QDOT_SIM_DIRECT_H
#define QDOT_SIM_DIRECT_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_direct qdot_direct;

/* Of the plan, borrowed. `shaken` as for qdot_bind_new. Errors: QDOT_ENOTBUILT for
 * equations that switch; QDOT_ESINGULAR; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_direct_new(const qdot_plan *plan, bool shaken,
                                            qdot_direct **direct);
void qdot_direct_free(qdot_direct *direct);

/* Of a reduced plan (sim/plan/routh.h): the momenta hi + lo [n_kept], borrowed and read wherever
 * an expansion begins. */
void qdot_direct_keep(qdot_direct *direct, const double *hi, const double *lo);

/* Coefficients of output i of the plan's tape. */
const double *qdot_direct_output(const qdot_direct *direct, size_t i);

/* Its callbacks; borrowed. */
const qdot_ode_series *qdot_direct_series(const qdot_direct *direct);

/* Convolutions and instructions an order; how often M was factored. */
double qdot_direct_convolutions(const qdot_direct *direct);
size_t qdot_direct_factored(const qdot_direct *direct);

/* How long the machine code is that an expansion to the order prepared last runs as, in
 * bytes; 0: kernels run, *why says for what reason. */
size_t qdot_direct_code(const qdot_direct *direct, const char **why);

#endif
