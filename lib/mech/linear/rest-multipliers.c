/* rest-multipliers.c -- the multipliers at a place of rest that names coordinates alone. */
#include "mech/linear/modes.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/node.h"
#include "mech/dynamics/quantity.h"
#include "mech/linear/elimination.h"
#include "mech/linear/linear-motion.h"
#include "mech/scene/scene.h"

qdot_status
qdot_rest_multipliers(qdot_scene *s, qdot_expr *place)
{
    qdot_pool *pool = s->pool;
    const qdot_facts facts = qdot_scene_facts(s);
    const size_t c = s->constraints.n, n = s->coordinates.n;
    qdot_expr *row = qdot_calloc(2 * c + 1, sizeof *row), *wanted = row + c + 1;
    qdot_elimination x = {.pool = pool, .facts = &facts};
    qdot_echelon e = {0};
    size_t m = 0;
    qdot_status status = row == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < c && status == QDOT_OK; k++) {
        bool given = false;

        for (uint32_t i = 0; i < qdot_expr_count(pool, *place); i++)
            given |= qdot_expr_arg(pool, qdot_expr_arg(pool, *place, i), 0) == s->constraints.at[k].multiplier;
        if (!given)
            wanted[m++] = s->constraints.at[k].multiplier;
    }
    if (m > 0 && status == QDOT_OK)
        status = qdot_echelon_begin(&e, n, m, m + 1);
    for (size_t i = 0; i < n && m > 0 && status == QDOT_OK; i++) {
        const qdot_expr gap = qdot_motion_residual(s, i);
        qdot_expr rest = qdot_rest_value(s, *place, gap);
        bool independent;

        for (size_t k = 0; k < m; k++) {
            const qdot_expr slope = qdot_diff(pool, gap, wanted[k]);

            row[k] = qdot_elimination_short(&x, qdot_rest_value(s, *place, slope));
            rest = rest == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, rest, 1, &wanted[k], (qdot_expr[]){QDOT_ZERO});
        }
        row[m] = qdot_elimination_short(&x, rest);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            status = qdot_echelon_add(&x, &e, row, &independent);
    }
    for (size_t r = 0; r < e.rank && status == QDOT_OK; r++) {
        qdot_expr value = qdot_neg(pool, e.row[r * e.width + m]), one;

        for (size_t k = 0; k < m; k++)
            if (k != e.pivot[r])
                value = qdot_sub(pool, value, qdot_mul(pool, e.row[r * e.width + k], wanted[k]));
        one = qdot_rel(pool, QDOT_EQ, wanted[e.pivot[r]], value);
        *place = qdot_list_appended(pool, *place, 1, &one);
        status = qdot_pool_check(pool);
    }
    qdot_echelon_end(&e);
    qdot_free(row);
    return status;
}
