/* simplify.c -- inserts known signs, then finds the shortest form. */
#include "normal/simplify/simplify.h"

#include "expr/build.h"
#include "expr/node.h"
#include "normal/form/shortest.h"
#include "normal/inequality/less.h"

qdot_expr
qdot_simplify(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    return qdot_shortest(pool, qdot_known_signs(pool, e, facts), facts);
}

uint8_t
qdot_ratio_sign(qdot_pool *pool, qdot_expr v, qdot_expr u)
{
    qdot_expr ratio;

    if (v == QDOT_NIL || u == QDOT_NIL || (u == QDOT_ZERO && v != u))
        return 0;
    ratio = v == u ? QDOT_ONE : qdot_simplify(pool, qdot_div(pool, v, u), NULL);
    return qdot_expr_sign(pool, ratio);
}
