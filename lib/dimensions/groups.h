/* groups.h -- products of powers without dimension (Buckingham's theorem). Inside of this room.
 *
 *     prod of x_j^p_j has no dimension   if   sum over j of a_ij p_j = 0 for every base quantity i
 */
#ifndef QDOT_DIMENSIONS_GROUPS_H
#define QDOT_DIMENSIONS_GROUPS_H

#include <stddef.h>

#include "base/status.h"
#include "units/dimension.h"

/* A basis of the solutions p, integers without a common factor, the shortest first: power [count x n], to be freed.
 * a [rows x n]: the exponents of the x, overwritten. QDOT_ELIMIT: an exponent is too large. */
QDOT_MUST_CHECK qdot_status qdot_groups_find(size_t rows, size_t n, qdot_exponent *a, size_t *count, int32_t **power);

#endif
