/* direction.h -- friction written along the direction of a scalar velocity is sign(u):
 *
 *     u/|u|, u/sqrt(u^2), u^3/|u|^3     also in terms: x'/|x' - v| - v/|x' - v|
 *
 * At u = 0 a quotient divides by zero, where sign(u) may stick. The coefficient C of 1/|u|, with |u| and
 * functions of u kept as they are, is B u: C/|u| becomes B sign(u). What is not of that form stays.
 *
 * Tests  tests/script/contacts/friction-spellings.lag
 */
#ifndef QDOT_MECH_DIRECTION_H
#define QDOT_MECH_DIRECTION_H

#include "expr/id.h"

/* Replace such directions in e [n] by signs. On failure an entry is nil or unchanged, and the pool keeps the
 * failure. */
void qdot_directions_as_signs(qdot_pool *pool, size_t n, qdot_expr *e);

/* Whether the k-th argument of a product, a base, is |u| for some u, with an odd negative exponent, *power. */
bool qdot_is_inverse_magnitude(const qdot_pool *pool, qdot_expr product, uint32_t k, int64_t *power);

#endif
