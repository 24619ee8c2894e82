/* steady.c -- steady motions of a scene, as the equilibria of a scene whose cyclic coordinates turn along. */
#include "mech/study/steady.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/saved.h"

typedef struct {
    qdot_pool *pool;
    size_t n;
    qdot_expr *q, *rate, *w; /* [n] cyclic coordinates, q' and the parameters that stand for them */
} turning;

/* The cyclic coordinates whose momentum is conserved. */
static qdot_status
find_turning(qdot_scene *s, turning *x)
{
    qdot_cyclic *list = NULL;
    size_t n = 0;

    QDOT_TRY(qdot_mech_cyclic(s, &list, &n));
    x->pool = s->pool;
    x->q = qdot_calloc(3 * n + 1, sizeof *x->q);
    if (x->q == NULL) {
        qdot_free(list);
        return QDOT_ENOMEM;
    }
    x->rate = x->q + n;
    x->w = x->rate + n;
    for (size_t i = 0; i < n; i++) {
        if (list[i].rate != QDOT_NIL)
            continue;
        x->q[x->n] = list[i].coordinate;
        x->rate[x->n] = qdot_symbol_jet(s->pool, list[i].coordinate, 1);
        x->w[x->n] = qdot_symbol_get(s->pool, QDOT_PARAM, qdot_expr_symbol(s->pool, x->rate[x->n])->name);
        x->n++;
    }
    qdot_free(list);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (x->n > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "no coordinate is cyclic with a conserved momentum: steady motions are the equilibria");
    return qdot_hint("equilibria");
}

static qdot_status
turn_along(qdot_scene *s, const turning *x)
{
    for (size_t i = 0; i < x->n; i++) {
        QDOT_TRY(qdot_scene_replace(s, x->rate[i], qdot_add(s->pool, x->rate[i], x->w[i])));
        QDOT_TRY(qdot_scene_replace(s, x->q[i], qdot_add(s->pool, x->q[i], qdot_mul(s->pool, x->w[i], QDOT_T))));
    }
    return QDOT_OK;
}

/* Write the rates as q'. */
static qdot_expr
with_rates(const turning *x, qdot_expr e)
{
    return e == QDOT_NIL ? QDOT_NIL : qdot_subs(x->pool, e, x->n, x->w, x->rate);
}

static qdot_status
write_rates(const turning *x, qdot_equilibria *all)
{
    for (size_t i = 0; i < all->n; i++) {
        qdot_equilibrium *one = &all->at[i];

        one->equations = with_rates(x, one->equations);
        one->exists = with_rates(x, one->exists);
        one->range = with_rates(x, one->range);
        one->stable_when = with_rates(x, one->stable_when);
        for (size_t k = 0; k < x->n; k++) {
            const qdot_expr constant = qdot_rel(x->pool, QDOT_EQ, x->rate[k], x->rate[k]);

            one->equations = qdot_list_appended(x->pool, one->equations, 1, &constant);
        }
    }
    all->special = with_rates(x, all->special);
    all->undefined = with_rates(x, all->undefined);
    all->meeting = with_rates(x, all->meeting);
    all->jump = with_rates(x, all->jump);
    return qdot_pool_check(x->pool);
}

qdot_status
qdot_steady_find(qdot_scene *s, qdot_binder bind, void *user, qdot_equilibria *out)
{
    qdot_scene_saved saved = {0};
    turning x = {0};
    qdot_status status = find_turning(s, &x);

    *out = (qdot_equilibria){0};
    if (status == QDOT_OK)
        status = qdot_scene_save(s, &saved);
    if (status == QDOT_OK)
        status = turn_along(s, &x);
    if (status == QDOT_OK)
        status = qdot_equilibrium_find(s, bind, user, out);
    qdot_scene_restore(s, &saved);
    if (status == QDOT_OK)
        status = write_rates(&x, out);
    qdot_free(x.q);
    return status;
}
