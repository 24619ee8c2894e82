/* rationalize.c -- multiplies numerator and denominator by conjugates, root by root, to remove roots. */
#include "normal/simplify/rationalize.h"

#include "base/memory.h"
#include "expr/polynomial/flint.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "normal/simplify/simplify.h"

enum { WORK = 500000 };

/* Set out to A - B r for p = A + B r, where v is the variable of the root r. */
static void
conjugate(qdot_field *f, fmpz_mpoly_t out, const fmpz_mpoly_t p, slong v)
{
    fmpz_mpoly_t term;
    ulong power;

    fmpz_mpoly_init(term, f->ctx);
    fmpz_mpoly_zero(out, f->ctx);
    for (slong i = 0; i < fmpz_mpoly_length(p, f->ctx); i++) {
        fmpz_mpoly_get_term(term, p, i, f->ctx);
        power = (ulong)fmpz_mpoly_degree_si(term, v, f->ctx);
        if (power % 2 != 0)
            fmpz_mpoly_sub(out, out, term, f->ctx);
        else
            fmpz_mpoly_add(out, out, term, f->ctx);
    }
    fmpz_mpoly_clear(term, f->ctx);
}

static void
remove_roots_from_denominator(qdot_field *f, qdot_ratio *r)
{
    qdot_ratio by;

    qdot_ratio_init(f, &by);
    for (slong v = 0; v < f->n && qdot_field_goes(f); v++) {
        if (f->gen[v].kind != QDOT_GEN_ROOT || f->gen[v].order != 2 ||
            fmpz_mpoly_degree_si(r->d, v, f->ctx) == 0)
            continue;
        conjugate(f, by.n, r->d, v);
        qdot_field_mul(f, r->n, r->n, by.n);
        qdot_field_mul(f, r->d, r->d, by.n);
        qdot_ratio_cancel(f, r);
    }
    qdot_ratio_clear(f, &by);
}

struct rationalizing {
    qdot_pool *pool;
    qdot_expr e, result; /* expression; its form without roots in denominators, nil if the budget is used up */
};

static void
rationalize_task(void *user)
{
    struct rationalizing *x = user;
    qdot_expr prepared = qdot_prepare(x->pool, x->e);
    qdot_field f;

    if (prepared == QDOT_NIL)
        return;
    qdot_field_begin(&f, x->pool, 1, &prepared, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, prepared);
        remove_roots_from_denominator(&f, &r);
        if (qdot_field_goes(&f) && !fmpz_mpoly_is_zero(r.d, f.ctx))
            x->result = qdot_field_ratio_expr(&f, &r);
        qdot_ratio_clear(&f, &r);
    }
    if (f.state == QDOT_FIELD_FAILED &&
        qdot_grave(f.status) != QDOT_OK)
        x->result = qdot_pool_fail(x->pool);
    qdot_field_end(&f);
}

qdot_expr
qdot_rationalize(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    qdot_expr best = qdot_simplify(pool, e, facts), other = QDOT_NIL;
    struct rationalizing x = {pool, best, QDOT_NIL};
    qdot_status status =
        best == QDOT_NIL ? QDOT_OK : qdot_flint_run(pool, rationalize_task, &x);

    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (status == QDOT_OK && x.result != QDOT_NIL)
        other = qdot_simplify(pool, x.result, facts);
    if (qdot_pool_failed(pool))
        return QDOT_NIL;
    return other != QDOT_NIL && qdot_expr_size(pool, other) <= qdot_expr_size(pool, best)
               ? other
               : best;
}
