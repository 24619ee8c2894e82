/* simplify.h -- the form a person would write: the shortest (form/shortest.h), after absolute
 * values and signs known from the conditions of `facts` are replaced.
 */
#ifndef QDOT_NORMAL_SIMPLIFY_H
#define QDOT_NORMAL_SIMPLIFY_H

#include "normal/field/facts.h"

qdot_expr qdot_simplify(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* The sign of v/u as far as its simplified form shows it: bits QDOT_GE0, QDOT_LE0, QDOT_NE0; 0:
 * nothing is known. */
uint8_t qdot_ratio_sign(qdot_pool *pool, qdot_expr v, qdot_expr u);

#endif
