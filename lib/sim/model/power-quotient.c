/* power-quotient.c -- writes (c + k b^p)/b^p as c b^-p + k, so that only powers of b of one sign remain. */
#include "sim/model/power-quotient.h"

#include "expr/build.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"

/* Whether a sum has the form c + k b^p; then parts: k, c, and the power b^-p. */
static bool
is_constant_plus_power(qdot_pool *pool, qdot_expr sum, qdot_expr parts[3])
{
    if (qdot_expr_kind(pool, sum) != QDOT_SUM || qdot_expr_count(pool, sum) != 3 ||
        qdot_expr_arg(pool, sum, 0) == QDOT_ZERO)
        return false;
    parts[0] = qdot_expr_arg(pool, sum, 2);
    parts[1] = qdot_expr_arg(pool, sum, 0);
    parts[2] = qdot_div(pool, QDOT_ONE, qdot_expr_arg(pool, sum, 1));
    return true;
}

/* Whether the power b^p is one of the factors of a product. */
static bool
has_factor(const qdot_pool *pool, qdot_expr product, qdot_expr power)
{
    qdot_expr b = power, p = QDOT_ONE;

    if (qdot_expr_kind(pool, power) == QDOT_PROD) {
        if (qdot_expr_count(pool, power) != 3 || qdot_expr_arg(pool, power, 0) != QDOT_ONE)
            return false;
        b = qdot_expr_arg(pool, power, 1);
        p = qdot_expr_arg(pool, power, 2);
    }
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, product); i += 2)
        if (qdot_expr_arg(pool, product, i) == b && qdot_expr_arg(pool, product, i + 1) == p)
            return true;
    return false;
}

static qdot_expr
divide_sum_by_power(qdot_pool *pool, qdot_expr product, void *user)
{
    qdot_expr e = product, parts[3];

    (void)user;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, product); i += 2) {
        const qdot_expr sum = qdot_expr_arg(pool, product, i);

        if (qdot_expr_arg(pool, product, i + 1) != QDOT_ONE ||
            !is_constant_plus_power(pool, sum, parts) || qdot_pool_failed(pool) ||
            !has_factor(pool, product, parts[2]))
            continue;
        e = qdot_div(pool, qdot_div(pool, e, sum), parts[2]);
        return qdot_mul(pool, e,
                        qdot_hold(pool, qdot_add(pool, parts[0],
                                                 qdot_mul(pool, parts[1], parts[2]))));
    }
    return e;
}

qdot_expr
qdot_power_quotient(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_PROD, divide_sum_by_power, NULL);
}
