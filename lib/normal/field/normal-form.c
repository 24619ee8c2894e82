/* normal-form.c -- writes an expression as a cancelled quotient of polynomials in the generators of
 * its field. */
#include "normal/field/normal-form.h"

#include "base/memory.h"
#include "expr/polynomial/flint.h"
#include "expr/tensor.h"
#include "normal/field/ideal.h"
#include "normal/field/prepare.h"

enum { WORK = 4000000 };

static qdot_expr
normal_form_of_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    const qdot_facts *facts = user;
    size_t nr = facts == NULL ? 0 : facts->n_relations;
    qdot_expr *all = qdot_malloc((nr + 1) * sizeof *all), result = e;
    qdot_field f;

    if (all == NULL)
        return qdot_pool_fail(pool);
    all[0] = qdot_prepare(pool, e);
    for (size_t i = 0; i < nr; i++)
        all[1 + i] = qdot_prepare(pool, facts->relations[i]);
    qdot_field_begin(&f, pool, nr + 1, all, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, all[0]);
        if (nr > 0)
            qdot_ideal_reduce_ratio(&f, &r, nr, all + 1);
        if (qdot_field_goes(&f))
            result = qdot_field_ratio_expr(&f, &r);
        qdot_ratio_clear(&f, &r);
    }
    if (f.state == QDOT_FIELD_FAILED && qdot_grave(f.status) != QDOT_OK)
        qdot_pool_fail(pool);
    qdot_field_end(&f);
    qdot_free(all);
    if (qdot_grave(qdot_pool_check(pool)) != QDOT_OK)
        qdot_pool_fail(pool);
    return qdot_pool_failed(pool) ? QDOT_NIL : result == QDOT_NIL ? e : result;
}

struct normalizing {
    qdot_pool *pool;
    qdot_expr e, result;
    const qdot_facts *facts;
};

static void
compute_normal_form(void *user)
{
    struct normalizing *x = user;

    x->result = qdot_value_map(x->pool, x->e, normal_form_of_scalar, (void *)(uintptr_t)x->facts);
}

qdot_expr
qdot_normal(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    struct normalizing x = {pool, e, e, facts};
    qdot_status status;

    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    status = qdot_flint_run(pool, compute_normal_form, &x);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    return status == QDOT_OK ? x.result : e;
}
