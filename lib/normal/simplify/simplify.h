/* simplify.h -- the form a person would write: the shortest (form/shortest.h), after absolute
 * values and signs known from the conditions of `facts` are replaced.
 */
#ifndef QDOT_NORMAL_SIMPLIFY_H
#define QDOT_NORMAL_SIMPLIFY_H

#include "normal/field/facts.h"

qdot_expr qdot_simplify(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
