/* nth-part.c -- relations between terms c f(u) with inverse functions f whose coefficients c have
 * odd denominators. */
#include "normal/prove/nth-part.h"

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"

enum { MOST_PARTS = 15, MOST = 4 };

static bool
is_inverse_function(const qdot_pool *pool, qdot_expr e, bool circular)
{
    return qdot_expr_is_function_that(pool, e, circular ? QDOT_FUN_ARC : QDOT_FUN_AREA);
}

/* Add the relations for h = f/n, where f is an inverse function, once for each h. */
static qdot_status
add_nth_part_relations(qdot_pool *pool, qdot_expr f, int64_t n, bool circular, qdot_nth_parts *relations)
{
    qdot_expr h = qdot_mul(pool, qdot_expr_ratio(pool, 1, n), f);
    qdot_expr c = qdot_fun1(pool, circular ? QDOT_COS : QDOT_COSH, h);
    qdot_expr s = qdot_fun1(pool, circular ? QDOT_SIN : QDOT_SINH, h);
    qdot_expr two = qdot_mul(pool, qdot_expr_int(pool, 2), c), T = QDOT_ONE, U = QDOT_ZERO;
    qdot_expr T1 = c, U1 = QDOT_ONE, row[2];

    for (int64_t k = 0; k < n; k++) {
        qdot_expr more = qdot_sub(pool, qdot_mul(pool, two, T1), T);

        T = T1, T1 = more;
        more = qdot_sub(pool, qdot_mul(pool, two, U1), U);
        U = U1, U1 = more;
    }
    row[0] = qdot_sub(pool, T, qdot_fun1(pool, circular ? QDOT_COS : QDOT_COSH, f));
    row[1] = qdot_sub(pool, qdot_mul(pool, s, U),
                      qdot_fun1(pool, circular ? QDOT_SIN : QDOT_SINH, f));
    for (int i = 0; i < 2; i++) {
        for (size_t k = 0; k < relations->n; k++)
            if (relations->at[k] == row[i])
                return QDOT_OK;
        QDOT_TRY(qdot_vec_push(relations, row[i]));
    }
    return QDOT_OK;
}

static qdot_status
add_relations_of_argument(qdot_pool *pool, qdot_expr arg, bool circular, qdot_nth_parts *relations)
{
    bool sum = qdot_expr_kind(pool, arg) == QDOT_SUM;
    uint32_t n = sum ? qdot_expr_count(pool, arg) : 3;

    for (uint32_t i = 1; i < n && relations->n < MOST; i += 2) {
        qdot_expr f = QDOT_NIL, c = QDOT_ONE;
        int64_t parts;

        if (sum) {
            f = qdot_expr_arg(pool, arg, i);
            c = qdot_expr_arg(pool, arg, i + 1);
        } else if (qdot_expr_kind(pool, arg) == QDOT_PROD &&
                   qdot_expr_count(pool, arg) == 3 &&
                   qdot_expr_arg(pool, arg, 2) == QDOT_ONE) {
            f = qdot_expr_arg(pool, arg, 1);
            c = qdot_expr_arg(pool, arg, 0);
        }
        if (f == QDOT_NIL || !is_inverse_function(pool, f, circular) ||
            fmpz_cmp_ui(fmpq_denref(qdot_expr_rational(pool, c)), MOST_PARTS) > 0)
            continue;
        parts = fmpz_get_si(fmpq_denref(qdot_expr_rational(pool, c)));
        if ((parts & (parts - 1)) != 0)
            QDOT_TRY(add_nth_part_relations(pool, f, parts, circular, relations));
    }
    return QDOT_OK;
}

qdot_status
qdot_nth_part_relations(qdot_pool *pool, size_t n, const qdot_expr *e, qdot_nth_parts *relations)
{
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        unsigned op = qdot_expr_kind(pool, w.at[i]) == QDOT_FUN
                          ? qdot_expr_node(pool, w.at[i])->op
                          : QDOT_FUNCTION_COUNT;

        if (op <= QDOT_COT || (op >= QDOT_SINH && op <= QDOT_TANH))
            status = add_relations_of_argument(pool, qdot_expr_arg(pool, w.at[i], 0), op <= QDOT_COT, relations);
    }
    qdot_walk_end(&w);
    return status;
}
