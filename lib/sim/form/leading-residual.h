/* leading-residual.h -- the first orders of the series of a motion in sums of two doubles, from
 * d'Alembert's residual (residual.h): work N along a chain where M q'' = f takes N^2.
 *
 * Order m of q begins as what doubles made of it; the residual that this leaves, in two
 * doubles, is as small as their rounding, and M_0^-1 of it, in doubles, is what is missing.
 * All of order m is corrected by that (series/two.h).
 *
 * Tests  tests/script/leading.sh
 */
#ifndef QDOT_SIM_LEADING_RESIDUAL_H
#define QDOT_SIM_LEADING_RESIDUAL_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_leading_residual qdot_leading_residual; /* one a thread */

/* Of a plan with a residual, and the series of it in doubles, which is there when an order is
 * asked for; both borrowed. Errors: QDOT_ESINGULAR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_leading_residual_new(const qdot_plan *plan,
                                                      const qdot_ode_series *series,
                                                      qdot_leading_residual **out);
void qdot_leading_residual_free(qdot_leading_residual *l);

/* For qdot_ode_system; borrowed. */
const qdot_ode_leading *qdot_leading_residual_get(const qdot_leading_residual *l);

#endif
