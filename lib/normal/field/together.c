/* together.c -- writes the arguments of all functions in one field, inner functions first. */
#include "normal/field/together.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/field.h"

enum { MOST = 40, WORK = 4000000 };

struct arguments {
    qdot_expr at[MOST], flat[MOST];
    size_t n;
};

static bool
contains_functions(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_scalar(pool, e) && qdot_expr_kind(pool, e) != QDOT_FUN &&
           (qdot_expr_node(pool, e)->holds & QDOT_HAS_FUN);
}

static void
arguments_add(struct arguments *a, qdot_expr e)
{
    for (size_t i = 0; i < a->n; i++)
        if (a->at[i] == e)
            return;
    if (a->n < MOST)
        a->at[a->n++] = e;
}

static qdot_status
arguments_gather(struct arguments *a, qdot_pool *pool, size_t n, const qdot_expr *e)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &w));
    for (size_t i = 0; i < w.n; i++) {
        qdot_kind kind = qdot_expr_kind(pool, w.at[i]);

        for (uint32_t k = 0; kind == QDOT_FUN && k < qdot_expr_count(pool, w.at[i]); k++)
            if (contains_functions(pool, qdot_expr_arg(pool, w.at[i], k)))
                arguments_add(a, qdot_expr_arg(pool, w.at[i], k));
    }
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* Compute all arguments as values of one field; false if the budget was exhausted. */
static bool
compute_arguments(struct arguments *a, qdot_pool *pool)
{
    bool good;
    qdot_field f;

    qdot_field_begin(&f, pool, a->n, a->at, WORK);
    for (size_t i = 0; i < a->n && qdot_field_goes(&f); i++) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, a->at[i]);
        a->flat[i] = qdot_field_ratio_expr(&f, &r);
        if (a->flat[i] != QDOT_NIL && qdot_field_goes(&f))
            a->flat[i] = qdot_expand(pool, a->flat[i]);
        qdot_ratio_clear(&f, &r);
    }
    good = qdot_field_goes(&f) && !qdot_pool_failed(pool);
    qdot_field_end(&f);
    return good;
}

qdot_status
qdot_together(qdot_pool *pool, size_t n, qdot_expr *e, bool *changed)
{
    struct arguments a = {.n = 0};

    *changed = false;
    QDOT_TRY(arguments_gather(&a, pool, n, e));
    if (a.n < 2 || !compute_arguments(&a, pool))
        return QDOT_OK;
    for (size_t i = 0; i < n; i++) {
        qdot_expr to = qdot_subs(pool, e[i], a.n, a.at, a.flat);

        *changed |= to != e[i];
        e[i] = to;
    }
    return QDOT_OK;
}
