/* simple.h -- quick tests for expressions that are already in simplest form. */
#ifndef QDOT_NORMAL_SIMPLE_H
#define QDOT_NORMAL_SIMPLE_H

#include "expr/id.h"

/* Whether e is obviously as simple as possible without relations: powers of symbols times at most
 * one function and one sum of parameters, or a distance sqrt((a - b)^2 + (c - d)^2 + ...) of different symbols. e a scalar. */
bool qdot_simple_is_done(const qdot_pool *pool, qdot_expr e);

/* Whether e is a sum of terms in different velocities and accelerations, one to any power in
 * each, times parameters, at most one sum of them and one sine or cosine of a coordinate or of
 * the difference of two: then terms can only share a common factor. */
bool qdot_simple_is_collected(const qdot_pool *pool, qdot_expr e);

/* The simplest form of e without relations if it is obvious: e itself if qdot_simple_is_done,
 * P cos(a - b) for P cos(a) cos(b) + P sin(a) sin(b) and the like, P powers of symbols and a, b
 * coordinates. Nil: not obvious. e a scalar. */
qdot_expr qdot_simple_seen(qdot_pool *pool, qdot_expr e);

#endif
