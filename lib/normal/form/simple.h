/* simple.h -- what is as simple as it can be, seen at a glance. */
#ifndef QDOT_NORMAL_SIMPLE_H
#define QDOT_NORMAL_SIMPLE_H

#include "expr/expr.h"

/* Whether e is seen at a glance to be as simple as it can be without relations: powers of symbols
 * times one function and one sum of parameters at most. e a scalar. */
bool qdot_simple_is_done(const qdot_pool *pool, qdot_expr e);

/* Whether e is a sum of terms in different velocities and accelerations, one in each to whatever power,
 * times parameters, one sum of them and one sine or cosine of a coordinate or of the difference of two
 * at most: nothing in two of them goes together but a common factor. */
bool qdot_simple_is_collected(const qdot_pool *pool, qdot_expr e);

/* The simplest form of e without relations where it is seen at a glance: e itself if it is done,
 * P cos(a - b) for P cos(a) cos(b) + P sin(a) sin(b) and its like, P powers of symbols and a, b
 * coordinates. Nil: it takes more than a glance. e a scalar. */
qdot_expr qdot_simple_seen(qdot_pool *pool, qdot_expr e);

#endif
