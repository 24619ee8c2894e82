/* leading.h -- the first orders of the Taylor series of a motion in sums of two doubles.
 *
 * From the state, the parameters and constants as two doubles each: order k of the tape of
 * M q'' = f (series/two.h), then
 *
 *     M_0 a_k = f_k - sum_{j=1..k} M_j a_{k-j},
 *
 * solved by the factors of M_0 in doubles and as many corrections by what is left, taken in
 * two doubles, as it wants: each gains what a double holds less the digits that M_0 eats.
 * It stands beside whatever makes the other orders (direct.h, shifted.h).
 *
 * Source  Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), 12.
 * Tests   tests/script/leading.sh
 */
#ifndef QDOT_SIM_LEADING_H
#define QDOT_SIM_LEADING_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_leading qdot_leading; /* one a thread */

/* Of a smooth plan without constraints, borrowed. Errors: QDOT_ESINGULAR, those of
 * constants, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_leading_new(const qdot_plan *plan, qdot_leading **out);
void qdot_leading_free(qdot_leading *l);

/* Of a reduced plan: the momenta hi + lo [n_kept], borrowed. */
void qdot_leading_keep(qdot_leading *l, const double *hi, const double *lo);

/* For qdot_ode_series; borrowed. */
const qdot_ode_leading *qdot_leading_get(const qdot_leading *l);

#endif
