/* series.h -- Taylor series in several symbols at once, also where a quotient is 0/0 at the point.
 *
 *     e = sum_k 1/k! d^k/dray^k e(a + ray u) at ray = 0,   u = x - a,   up to a degree
 *
 * Tests  tests/script/solve/series-removable.lag, tests/bad/definitions/series-none.sh
 */
#ifndef QDOT_NORMAL_SERIES_H
#define QDOT_NORMAL_SERIES_H

#include "normal/field/facts.h"

/* *value: the terms of e of degree 0 ... most in symbols - at, both [n]; e may be a vector or matrix. An error tells
 * the part of e that has no such series (QDOT_EDOMAIN); else the pool's, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_series(qdot_pool *pool, const qdot_facts *facts, qdot_expr e,
                                        size_t n, const qdot_expr *symbols, const qdot_expr *at,
                                        int64_t most, qdot_expr *value);

#endif
