/* simplify.c -- known signs, then the shortest form. */
#include "normal/simplify/simplify.h"

#include "normal/form/shortest.h"
#include "normal/inequality/less.h"

qdot_expr
qdot_simplify(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    return qdot_shortest(pool, qdot_known_signs(pool, e, facts), facts);
}
