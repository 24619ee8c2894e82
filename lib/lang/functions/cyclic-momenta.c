/* cyclic-momenta.c -- the cyclic coordinates, each with its momentum. */
#include "lang/functions/cyclic-momenta.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/entry.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/scene.h"

/* The equations of all [count] cyclic coordinates, and these coordinates, as LISTs. */
static qdot_status
list_cyclic(qdot_session *s, const qdot_cyclic *all, size_t count, qdot_expr *equations, qdot_expr *coordinates)
{
    qdot_expr *both = qdot_malloc((2 * count + 1) * sizeof *both);

    if (both == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < count; i++) {
        both[i] = qdot_rel(s->pool, QDOT_EQ, qdot_symbol_of(s->pool, QDOT_MOMENTUM, all[i].coordinate), all[i].momentum);
        both[count + i] = all[i].coordinate;
    }
    *equations = qdot_list(s->pool, (uint32_t)count, both);
    *coordinates = qdot_list(s->pool, (uint32_t)count, both + count);
    qdot_free(both);
    return qdot_value_kind_check(s->pool, *equations);
}

qdot_status
qdot_session_cyclic(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    qdot_cyclic *all = NULL;
    qdot_expr coordinates;
    size_t count = 0;
    qdot_status status;

    QDOT_TRY(qdot_mech_cyclic(s->scene, &all, &count));
    status = list_cyclic(s, all, count, value, &coordinates);
    qdot_free(all);
    QDOT_TRY(status);
    if (n == 0)
        return QDOT_OK;
    if (qdot_expr_is_coordinate(s->pool, index[0])) {
        for (uint32_t k = 0; k < count; k++)
            if (qdot_expr_arg(s->pool, coordinates, k) == index[0])
                return qdot_value_kind_give(s->pool, qdot_expr_arg(s->pool, *value, k), value);
        return qdot_fail(QDOT_EINVAL, "`%.200s` is not cyclic", qdot_expr_symbol(s->pool, index[0])->name);
    }
    return qdot_entry_of(s, *value, QDOT_NIL, 1, index, value);
}
