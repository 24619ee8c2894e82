/* leading.h -- the first orders of the Taylor series of a motion in sums of two doubles.
 *
 * The equations are the plan's, as the program of a motion: M q'' = f, or d'Alembert's residual
 * along its tree, where they are taken so in doubles too (motion-series.h, tree-series.h).
 * Accelerations of an order begin as what doubles made of them; the equations' residual E, in
 * two doubles, is then as small as the rounding of doubles, and M_0^-1 E, in doubles, is what is
 * missing. Each correction gains what a double holds less the digits that M_0 eats.
 *
 * Source  Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), 12.
 * Tests   tests/script/methods/leading.sh
 */
#ifndef QDOT_SIM_LEADING_H
#define QDOT_SIM_LEADING_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_leading qdot_leading; /* must not be shared between threads */

/* Of a smooth plan without constraints, and its series in doubles, which is there when an order is
 * asked for; both borrowed. Errors: QDOT_ESINGULAR, those of constants, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_leading_new(const qdot_plan *plan,
                                             const qdot_ode_series *series,
                                             qdot_leading **out);
void qdot_leading_free(qdot_leading *l);

/* Set the conserved momenta of a reduced plan to hi + lo [n_kept]; borrowed. */
void qdot_leading_keep(qdot_leading *l, const double *hi, const double *lo);

/* The callbacks for the member `leading` of qdot_ode_system; borrowed. */
const qdot_ode_leading *qdot_leading_get(const qdot_leading *l);

#endif
