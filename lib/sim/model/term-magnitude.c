/* term-magnitude.c -- makes the sum of the absolute values of a sum's terms. */
#include "sim/model/term-magnitude.h"

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/node.h"

qdot_expr
qdot_term_magnitude(qdot_pool *pool, qdot_expr e)
{
    qdot_expr size;

    if (qdot_expr_is_function(pool, e, QDOT_SIN)) {
        const qdot_expr sizes[] = {QDOT_ONE, qdot_term_magnitude(pool, qdot_expr_arg(pool, e, 0))};

        return qdot_fun(pool, QDOT_MIN, 2, sizes);
    }
    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return qdot_fun1(pool, QDOT_ABS, e);
    size = qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, e, 0));
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, e); k += 2)
        size = qdot_add(pool, size,
                        qdot_fun1(pool, QDOT_ABS,
                                  qdot_mul(pool, qdot_expr_arg(pool, e, k),
                                           qdot_expr_arg(pool, e, k + 1))));
    return size;
}
