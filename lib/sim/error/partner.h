/* partner.h -- which root of a companion is the k-th one of the run.
 *
 * Tests  tests/script/events/events.lag, event-ends.sh, poincare.sh
 */
#ifndef QDOT_SIM_PARTNER_H
#define QDOT_SIM_PARTNER_H

#include <stddef.h>

/* Of times own [n] and other [m], both ascending or both descending: the index in `other` of the
 * partner of own[k]. That is the k-th too, or, where one of them has more (at the very end of the
 * run), the nearest, if it is much nearer than the next one of the run. SIZE_MAX: there is none. */
size_t qdot_partner_of(const double *own, size_t n, size_t k, const double *other, size_t m);

#endif
