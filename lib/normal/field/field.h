/* field.h -- expressions as quotients of multivariate polynomials over Z.
 *
 * A field is made for a few expressions at hand and holds only the generators that
 * occur in them: symbols, applications of undefined functions, s = sin b and c = cos b
 * of base angles b (lattice.h), the same for sinh and cosh, exp b, roots r = b^(1/q),
 * absolute values, and any other function as a generator of its own. Rules, one for
 * each dependent generator,
 *
 *     s^2 = 1 - c^2,   S^2 = C^2 - 1,   r^q = b,   |b|^2 = b^2,
 *
 * lead in separate variables and are monic, so the remainder is a normal form. The
 * order is lexicographic: roots (outer before inner), sines, then the rest.
 *
 * Budget. Each call of FLINT is charged beforehand by terms x terms; past the budget
 * the field stops and every further operation does nothing. Ctrl-C stops it too.
 */
#ifndef QDOT_NORMAL_FIELD_H
#define QDOT_NORMAL_FIELD_H

#include "normal/field/ratio.h"

/* Set up for e[n], prepared (prepare.h), with a budget. Always to be ended; look at
 * `state`. */
void qdot_field_begin(qdot_field *f, qdot_pool *pool, size_t n, const qdot_expr *e,
                      int64_t work);
void qdot_field_end(qdot_field *f);

/* The value of one of the e of qdot_field_begin; owned by the field. NULL if it
 * stopped. */
const qdot_ratio *qdot_field_value(qdot_field *f, qdot_expr e);
/* Set r to the value of the expression e with common factors cancelled; the caller clears r. */
void qdot_field_cancelled(qdot_field *f, qdot_ratio *r, qdot_expr e);

#endif
