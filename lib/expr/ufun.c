/* ufun.c -- declares undefined functions, and applies them to arguments. */
#include <string.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/pool.h"
#include "expr/printed.h"
#include "expr/walk.h"

qdot_status
qdot_ufun_declare(qdot_pool *pool, const char *name, uint32_t arity,
                  const qdot_expr *formals, uint32_t *id)
{
    qdot_ufun f = {.arity = arity, .formals = qdot_list(pool, arity, formals)};

    QDOT_TRY(qdot_pool_check(pool));
    for (*id = 0; *id < pool->ufuns.n; ++*id)
        if (strcmp(pool->ufuns.at[*id].name, name) == 0 &&
            pool->ufuns.at[*id].formals == f.formals)
            return QDOT_OK;
    if (pool->ufuns.n > UINT16_MAX)
        return qdot_fail(QDOT_ELIMIT, "more than 65536 undefined functions");
    f.name = qdot_arena_strndup(pool->arena, name, strlen(name));
    return f.name == NULL ? QDOT_ENOMEM : qdot_vec_push(&pool->ufuns, f);
}

qdot_status
qdot_ufun_redeclare(qdot_pool *pool, uint32_t id, qdot_expr formals)
{
    qdot_ufun *f = &pool->ufuns.at[id];

    if (formals == QDOT_NIL || NODE(pool, formals)->kind != QDOT_LIST ||
        NODE(pool, formals)->n != f->arity)
        return qdot_fail(QDOT_EINVAL, "%s has %u arguments", f->name, f->arity);
    f->formals = formals;
    qdot_printed_forget(pool->printed);
    return QDOT_OK;
}

const qdot_ufun *
qdot_ufun_get(const qdot_pool *pool, uint32_t id)
{
    return &pool->ufuns.at[id];
}

qdot_expr
qdot_ufun_apply(qdot_pool *pool, uint32_t id, const qdot_expr *args,
                const uint32_t *orders)
{
    uint32_t n = pool->ufuns.at[id].arity;
    qdot_expr few[16] = {0}, *all = n > 8 ? qdot_malloc(2 * n * sizeof *all) : few, e;

    if (all == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        all[i] = args[i];
        all[n + i] = orders == NULL ? QDOT_ZERO : qdot_expr_int(pool, orders[i]);
        if (all[i] != QDOT_NIL && !qdot_expr_is_scalar(pool, all[i]))
            qdot_pool_refuse(pool, QDOT_ETYPE,
                             "an argument of %s must be a number, not a vector",
                             pool->ufuns.at[id].name);
    }
    e = qdot_pool_intern(pool, QDOT_UFUN, (uint16_t)id, 2 * n, all, 0);
    if (all != few)
        qdot_free(all);
    return e;
}

qdot_expr
qdot_delayed(qdot_pool *pool, qdot_expr coordinate, qdot_expr u, uint32_t order)
{
    const qdot_symbol *x = qdot_expr_symbol(pool, coordinate);
    uint32_t id;

    if (x == NULL || qdot_ufun_declare(pool, x->name, 1, &coordinate, &id) != QDOT_OK)
        return qdot_pool_fail(pool);
    return qdot_ufun_apply(pool, id, &u, order > 0 ? &order : NULL);
}

qdot_expr
qdot_ufun_delayed(const qdot_pool *pool, uint32_t id)
{
    const qdot_ufun *f = &pool->ufuns.at[id];
    const qdot_expr x = f->arity == 1 ? qdot_expr_arg(pool, f->formals, 0) : QDOT_NIL;

    return x != QDOT_NIL && qdot_expr_is_coordinate(pool, x) && strcmp(qdot_expr_symbol(pool, x)->name, f->name) == 0
               ? x
               : QDOT_NIL;
}

bool
qdot_has_delayed(qdot_pool *pool, qdot_expr e)
{
    bool any = false, has = false;
    qdot_expr atoms;

    for (uint32_t id = 0; id < pool->ufuns.n && !any; id++)
        any = qdot_ufun_delayed(pool, id) != QDOT_NIL;
    if (!any || e == QDOT_NIL || !(NODE(pool, e)->holds & QDOT_HAS_UFUN))
        return false;
    atoms = qdot_expr_atoms(pool, e, true);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms) && !has; i++) {
        const qdot_expr atom = qdot_expr_arg(pool, atoms, i);

        has = NODE(pool, atom)->kind == QDOT_UFUN && qdot_ufun_delayed(pool, NODE(pool, atom)->op) != QDOT_NIL;
    }
    return has;
}
