/* generic.h -- values of expressions at a random point, for ranks. Internal to mech/. */
#ifndef QDOT_MECH_GENERIC_H
#define QDOT_MECH_GENERIC_H

#include "expr/id.h"

/* A point: symbols [m] have values; any other symbol or undefined function gets a random one from
 * `seed`. */
typedef struct {
    size_t m;
    const qdot_expr *symbols;
    const double *values;
    uint64_t seed;
} qdot_generic_point;

/* Evaluate e [n] in double at a point (NULL: random values with seed 1). NaN where undefined. */
QDOT_MUST_CHECK qdot_status qdot_generic_evaluate(const qdot_pool *pool, size_t n,
                                                  const qdot_expr *e,
                                                  const qdot_generic_point *at,
                                                  double *out);
/* The number x rounded to 15 decimal digits, as an exact rational; nil: the pool failed. */
qdot_expr qdot_generic_decimal(qdot_pool *pool, double x);
/* The random value of a symbol, inside its domain and about of size 1. */
double qdot_generic_value(const qdot_pool *pool, qdot_expr symbol, uint64_t seed);

#endif
