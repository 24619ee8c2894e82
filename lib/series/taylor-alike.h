/* taylor-alike.h -- a motion of like parts in doubles: a step of sixteen parts at once, by vectors.
 *
 * Orders are begun four at a time, K to K + 3: what products of orders below K are of each of them is summed up when K
 * is begun, so that orders are read once for four, and terms with the newest orders are added as these come to be
 * known.
 *
 * The coefficients of sixteen parts of one kind (alike.h) lie together, by order, then row, then part, so
 * that all orders of them stay in the first cache while an order of their steps is carried out: an order goes
 * once over all parts, then over the sums, then over the integrals.
 *
 * Source  van der Hoeven, J. Symbolic Comput. 34 (2002) 479, 4.1, for sums that are begun before their last terms
 *         are known.
 * Tests   tests/series/test_taylor-alike.c
 */
#ifndef QDOT_SERIES_TAYLOR_ALIKE_H
#define QDOT_SERIES_TAYLOR_ALIKE_H

#include "series/alike.h"
#include "series/motion.h"
#include "series/taylor.h"

typedef struct qdot_taylor_alike qdot_taylor_alike;

/* Of a motion with its parts and the series of its rows (taylor-motion.h), all borrowed; inputs, numbers and
 * outputs are read and written there. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_alike_new(const qdot_motion *motion, qdot_taylor *taylor,
                                                  qdot_taylor_alike **alike);
void qdot_taylor_alike_free(qdot_taylor_alike *alike);

/* As qdot_taylor_begin and qdot_taylor_extend, of inputs and outputs; as qdot_taylor_near. */
void qdot_taylor_alike_begin(qdot_taylor_alike *alike, double unit);
void qdot_taylor_alike_extend(qdot_taylor_alike *alike, int from, int to);
double qdot_taylor_alike_near(const qdot_taylor_alike *alike, int p, double s, double least);

#endif
