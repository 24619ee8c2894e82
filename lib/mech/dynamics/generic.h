/* generic.h -- evaluates expressions at a random point, to find ranks of matrices. Internal to mech/. */
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

/* Evaluate e [n] in doubles at a point (NULL: random values with seed 1). NaN where undefined. */
QDOT_MUST_CHECK qdot_status qdot_generic_evaluate(const qdot_pool *pool, size_t n,
                                                  const qdot_expr *e,
                                                  const qdot_generic_point *at,
                                                  double *out);
/* The number x rounded to 15 decimal digits, as an exact rational; nil: the pool failed. */
qdot_expr qdot_generic_decimal(qdot_pool *pool, double x);
/* A random value for a symbol, within its domain and of a size about 1. */
double qdot_generic_value(const qdot_pool *pool, qdot_expr symbol, uint64_t seed);

#endif
