/* equal.c -- proves a difference to be zero in one field, or part by part if it contains many roots. */
#include "normal/prove/equal.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/field/prepare.h"
#include "normal/field/root-parts.h"
#include "normal/prove/zero.h"

#define WORK 60000000
#define MOST_POSITIVE 8

qdot_status
qdot_problem_in_field(qdot_problem *p, bool signs, bool *zero)
{
    qdot_ideal ideal = {0};
    qdot_status status = QDOT_OK;
    qdot_field f;

    *zero = false;
    qdot_field_begin(&f, p->pool, qdot_problem_count(p), p->e, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio d;

        qdot_ratio_init(&f, &d);
        qdot_ratio_sub(&f, &d, qdot_field_value(&f, p->e[0]),
                       qdot_field_value(&f, p->e[1]));
        qdot_field_reduce(&f, d.n);
        *zero = qdot_field_goes(&f) && fmpz_mpoly_is_zero(d.n, f.ctx);
        if (p->nr > 0 && !*zero && qdot_field_goes(&f)) {
            fmpz_t scale;

            fmpz_init(scale);
            status = qdot_ideal_make(&ideal, &f, p->nr, p->e + 2);
            if (status == QDOT_OK)
                qdot_ideal_reduce(&ideal, &f, scale, d.n);
            fmpz_clear(scale);
            *zero = status == QDOT_OK && qdot_field_goes(&f) &&
                    fmpz_mpoly_is_zero(d.n, f.ctx);
        }
        if (!*zero && signs && status == QDOT_OK && qdot_field_goes(&f)) {
            qdot_zero z;

            status = qdot_zero_begin(&z, &f, p->nr > 0 ? &ideal : NULL, p->np,
                                     p->e + 2 + p->nr, !p->conditional);
            z.prove = qdot_prove_given;
            if (status == QDOT_OK) {
                status = qdot_zero_prove(&z, d.n, zero);
                qdot_zero_end(&z);
            }
        }
        qdot_ideal_clear(&ideal, &f);
        qdot_ratio_clear(&f, &d);
    }
    if (f.state == QDOT_FIELD_FAILED && status == QDOT_OK)
        status = f.status;
    qdot_field_end(&f);
    return qdot_grave(status);
}

/* The same of what stands with each product of roots, where these are many: over one
 * denominator with all of them it may be past the budget. */
static qdot_status
prove_by_roots(qdot_problem *p, bool *zero)
{
    const qdot_expr left = p->e[0], right = p->e[1];
    qdot_root_parts parts = {.n = 1};
    qdot_expr d = QDOT_NIL;
    qdot_status status = QDOT_OK;

    *zero = false;
    if (qdot_expr_is_scalar(p->pool, left) && qdot_expr_is_scalar(p->pool, right))
        d = qdot_sub(p->pool, left, right);
    if (d != QDOT_NIL && qdot_root_parts_many(p->pool, d)) {
        status = qdot_grave(qdot_root_parts_add(p->pool, &parts, &d));
        *zero = status == QDOT_OK;
        p->e[1] = QDOT_ZERO;
        for (size_t k = 0; k < parts.entries.n && status == QDOT_OK && *zero; k++) {
            p->e[0] = qdot_div(p->pool, parts.entries.at[k], parts.roots.at[k]);
            status = qdot_grave(qdot_pool_check(p->pool));
            *zero = p->e[0] != QDOT_NIL;
            if (status == QDOT_OK && *zero)
                status = qdot_problem_in_field(p, false, zero);
        }
        p->e[0] = left;
        p->e[1] = right;
    }
    qdot_root_parts_clear(&parts);
    return status;
}

qdot_status
qdot_problem_note_positive(qdot_problem *p)
{
    qdot_pool *pool = p->pool;
    qdot_expr found[MOST_POSITIVE], *all;
    size_t n = 0;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(pool, 2, p->e, &w));
    for (size_t i = 0; i < w.n; i++) {
        if (qdot_expr_kind(pool, w.at[i]) != QDOT_PROD)
            continue;
        for (uint32_t k = 1; k < qdot_expr_count(pool, w.at[i]) && n < MOST_POSITIVE;
             k += 2) {
            qdot_expr b = qdot_expr_arg(pool, w.at[i], k);
            const fmpq *x =
                qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k + 1));

            if (x != NULL && !fmpz_is_one(fmpq_denref(x)) &&
                qdot_expr_kind(pool, b) == QDOT_SUM &&
                qdot_expr_node(pool, b)->sign == QDOT_POS)
                found[n++] = b;
        }
    }
    qdot_walk_end(&w);
    if (n == 0)
        return QDOT_OK;
    all = qdot_realloc(p->e, (qdot_problem_count(p) + n) * sizeof *all);
    if (all == NULL)
        return QDOT_ENOMEM;
    p->e = all;
    for (size_t i = 0; i < n; i++)
        p->e[2 + p->nr + p->np++] = found[i];
    return QDOT_OK;
}

qdot_status
qdot_problem_prepare(qdot_problem *p)
{
    for (size_t i = 0; i < qdot_problem_count(p); i++)
        p->e[i] = qdot_prepare(p->pool, p->e[i]);
    if (!qdot_pool_failed(p->pool))
        return QDOT_OK;
    return qdot_grave(qdot_pool_check(p->pool)) == QDOT_OK ? QDOT_EFAILED
                                                           : qdot_last_error()->status;
}

qdot_status
qdot_problem_begin(qdot_problem *p, qdot_pool *pool, qdot_expr left, qdot_expr right,
      const qdot_facts *facts)
{
    *p = (qdot_problem){.pool = pool, .nr = facts == NULL ? 0 : facts->n_relations};
    p->e = qdot_malloc((p->nr + 2) * sizeof *p->e);
    if (p->e == NULL)
        return QDOT_ENOMEM;
    p->e[0] = left;
    p->e[1] = right;
    for (size_t i = 0; i < p->nr; i++)
        p->e[2 + i] = facts->relations[i];
    return QDOT_OK;
}

qdot_status
qdot_problem_finish(qdot_problem *p, qdot_status status)
{
    qdot_free(p->e);
    if (qdot_pool_failed(p->pool) && status == QDOT_OK)
        status = qdot_pool_check(p->pool);
    return qdot_grave(status);
}

qdot_status
qdot_prove_equal(qdot_pool *pool, qdot_expr left, qdot_expr right,
                 const qdot_facts *facts, bool *equal)
{
    qdot_problem p;
    qdot_status status;

    *equal = false;
    QDOT_TRY(qdot_problem_begin(&p, pool, left, right, facts));
    status = qdot_problem_note_positive(&p);
    if (status == QDOT_OK)
        status = qdot_problem_prepare(&p);
    if (status == QDOT_OK)
        status = prove_by_roots(&p, equal);
    if (status == QDOT_OK && !*equal)
        status = qdot_problem_in_field(&p, true, equal);
    return qdot_problem_finish(&p, status);
}

qdot_status
qdot_prove_given(qdot_pool *pool, qdot_expr left, qdot_expr right, size_t n_positive,
                 const qdot_expr *positive, bool sure, bool *equal)
{
    qdot_problem p;
    qdot_status status;
    qdot_expr *all;

    *equal = false;
    QDOT_TRY(qdot_problem_begin(&p, pool, left, right, NULL));
    all = qdot_realloc(p.e, (2 + n_positive) * sizeof *all);
    if (all == NULL)
        return qdot_problem_finish(&p, QDOT_ENOMEM);
    p.e = all;
    for (size_t i = 0; i < n_positive; i++)
        p.e[2 + p.np++] = positive[i];
    p.conditional = !sure;
    status = qdot_problem_prepare(&p);
    if (status == QDOT_OK)
        status = qdot_problem_in_field(&p, true, equal);
    return qdot_problem_finish(&p, status);
}
