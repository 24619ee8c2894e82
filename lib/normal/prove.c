/* prove.c -- the normal form first, then what is known beside it. */
#include "normal/prove.h"

#include "base/memory.h"
#include "normal/domain.h"
#include "normal/prepare.h"
#include "normal/rewrite.h"
#include "normal/unify.h"
#include "normal/zero.h"

#define WORK 60000000
#define ROUNDS 3 /* functions within functions, whose values are their own */

/* e: left, right, nr relations, np that are positive. */
struct problem {
    qdot_pool *pool;
    size_t nr, np;
    qdot_expr *e;
};

static size_t
count(const struct problem *p)
{
    return 2 + p->nr + p->np;
}

/* A wrong turn (a zero denominator on the way) is no failure. */
static qdot_status
only_grave(qdot_status status)
{
    return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
}

/* Whether the difference is zero in a field of all of them. `signs`: with roots and
 * constants. */
static qdot_status
in_field(struct problem *p, bool signs, bool *zero)
{
    qdot_ideal ideal = {0};
    qdot_status status = QDOT_OK;
    qdot_field f;

    *zero = false;
    qdot_field_begin(&f, p->pool, count(p), p->e, WORK);
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
                                     p->e + 2 + p->nr);
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
    return only_grave(status);
}

/* All of them prepared; QDOT_EFAILED after a wrong turn. */
static qdot_status
prepare(struct problem *p)
{
    for (size_t i = 0; i < count(p); i++)
        p->e[i] = qdot_prepare(p->pool, p->e[i]);
    if (!qdot_pool_failed(p->pool))
        return QDOT_OK;
    return only_grave(qdot_pool_check(p->pool)) == QDOT_OK ? QDOT_EFAILED
                                                           : qdot_last_error()->status;
}

static qdot_status
begin(struct problem *p, qdot_pool *pool, qdot_expr left, qdot_expr right,
      const qdot_facts *facts)
{
    *p = (struct problem){.pool = pool, .nr = facts == NULL ? 0 : facts->n_relations};
    p->e = qdot_malloc((p->nr + 2) * sizeof *p->e);
    if (p->e == NULL)
        return QDOT_ENOMEM;
    p->e[0] = left;
    p->e[1] = right;
    for (size_t i = 0; i < p->nr; i++)
        p->e[2 + i] = facts->relations[i];
    return QDOT_OK;
}

static qdot_status
finish(struct problem *p, qdot_status status)
{
    qdot_free(p->e);
    if (qdot_pool_failed(p->pool) && status == QDOT_OK)
        status = qdot_pool_check(p->pool);
    return only_grave(status);
}

qdot_status
qdot_prove_equal(qdot_pool *pool, qdot_expr left, qdot_expr right,
                 const qdot_facts *facts, bool *equal)
{
    struct problem p;
    qdot_status status;

    *equal = false;
    QDOT_TRY(begin(&p, pool, left, right, facts));
    status = prepare(&p);
    if (status == QDOT_OK)
        status = in_field(&p, true, equal);
    return finish(&p, status);
}

/* Conditions and bounds put into the symbols; what cannot be, after the relations. */
static qdot_status
unfold(struct problem *p, const qdot_facts *facts, bool *changed)
{
    qdot_exprs positive = {0};
    qdot_status status =
        qdot_domain_unfold(p->pool, facts, 2 + p->nr, p->e, p->nr, &positive, changed);
    qdot_expr *all = status == QDOT_OK
                         ? qdot_realloc(p->e, (2 + p->nr + positive.n + 1) * sizeof *all)
                         : NULL;

    if (all != NULL) {
        p->e = all;
        p->np = positive.n;
        for (size_t i = 0; i < positive.n; i++)
            p->e[2 + p->nr + i] = positive.at[i];
    }
    qdot_free(positive.at);
    return status != QDOT_OK ? status : all == NULL ? QDOT_ENOMEM : QDOT_OK;
}

qdot_status
qdot_prove_harder(qdot_pool *pool, qdot_expr left, qdot_expr right,
                  const qdot_facts *facts, bool *equal)
{
    bool changed = false, exponentials = false;
    struct problem p;
    qdot_status status;
    qdot_facts own;

    *equal = false;
    QDOT_TRY(begin(&p, pool, left, right, facts));
    status = unfold(&p, facts, &changed);
    for (size_t i = 0; i < count(&p) && status == QDOT_OK; i++)
        exponentials |= qdot_rewrite_has_exp(pool, p.e[i]);
    for (size_t i = 0; i < count(&p) && status == QDOT_OK; i++)
        p.e[i] = qdot_rewrite(pool, p.e[i], exponentials);
    if (status == QDOT_OK)
        status = prepare(&p);
    if (status == QDOT_OK)
        status = in_field(&p, true, equal);
    changed = true;
    for (int round = 0; round < ROUNDS && status == QDOT_OK && changed && !*equal;
         round++) {
        own = (qdot_facts){.n_relations = p.nr, .relations = p.e + 2};
        status = qdot_unify(pool, count(&p), p.e, &own, false, &changed);
        if (status == QDOT_OK && changed)
            status = prepare(&p);
        if (status == QDOT_OK && changed)
            status = in_field(&p, true, equal);
    }
    return finish(&p, status);
}
