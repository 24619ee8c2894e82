/* prove.c -- the normal form first, then what is known beside it. */
#include "normal/prove/prove.h"

#include "base/memory.h"
#include "expr/walk.h"
#include "normal/field/prepare.h"
#include "normal/field/root-parts.h"
#include "normal/field/together.h"
#include "normal/prove/angle-basis.h"
#include "normal/prove/domain.h"
#include "normal/prove/rewrite.h"
#include "normal/prove/unify.h"
#include "normal/prove/zero.h"

#define WORK 60000000
#define MOST_POSITIVE 8
#define ROUNDS 3 /* functions within functions, whose values are their own */

/* e: left, right, nr relations, np that are positive; `conditional`: some of these by conditions. */
struct problem {
    qdot_pool *pool;
    size_t nr, np;
    bool conditional;
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
                                     p->e + 2 + p->nr, !p->conditional);
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

/* The same of what stands with each product of roots, where these are many: over one
 * denominator with all of them it may be past the budget. */
static qdot_status
by_roots(struct problem *p, bool *zero)
{
    const qdot_expr left = p->e[0], right = p->e[1];
    qdot_root_parts parts = {.n = 1};
    qdot_expr d = QDOT_NIL;
    qdot_status status = QDOT_OK;

    *zero = false;
    if (qdot_expr_is_scalar(p->pool, left) && qdot_expr_is_scalar(p->pool, right))
        d = qdot_sub(p->pool, left, right);
    if (d != QDOT_NIL && qdot_root_parts_many(p->pool, d)) {
        status = only_grave(qdot_root_parts_add(p->pool, &parts, &d));
        *zero = status == QDOT_OK;
        p->e[1] = QDOT_ZERO;
        for (size_t k = 0; k < parts.entries.n && status == QDOT_OK && *zero; k++) {
            p->e[0] = qdot_div(p->pool, parts.entries.at[k], parts.roots.at[k]);
            status = only_grave(qdot_pool_check(p->pool));
            *zero = p->e[0] != QDOT_NIL;
            if (status == QDOT_OK && *zero)
                status = in_field(p, false, zero);
        }
        p->e[0] = left;
        p->e[1] = right;
    }
    qdot_root_parts_clear(&parts);
    return status;
}

/* Bases of roots that are positive as they stand; once multiplied out that is hard to see. */
static qdot_status
note_positive(struct problem *p)
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
    all = qdot_realloc(p->e, (count(p) + n) * sizeof *all);
    if (all == NULL)
        return QDOT_ENOMEM;
    p->e = all;
    for (size_t i = 0; i < n; i++)
        p->e[2 + p->nr + p->np++] = found[i];
    return QDOT_OK;
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
    status = note_positive(&p);
    if (status == QDOT_OK)
        status = prepare(&p);
    if (status == QDOT_OK)
        status = by_roots(&p, equal);
    if (status == QDOT_OK && !*equal)
        status = in_field(&p, true, equal);
    return finish(&p, status);
}

qdot_status
qdot_prove_given(qdot_pool *pool, qdot_expr left, qdot_expr right, size_t n_positive,
                 const qdot_expr *positive, bool sure, bool *equal)
{
    struct problem p;
    qdot_status status;
    qdot_expr *all;

    *equal = false;
    QDOT_TRY(begin(&p, pool, left, right, NULL));
    all = qdot_realloc(p.e, (2 + n_positive) * sizeof *all);
    if (all == NULL)
        return finish(&p, QDOT_ENOMEM);
    p.e = all;
    for (size_t i = 0; i < n_positive; i++)
        p.e[2 + p.np++] = positive[i];
    p.conditional = !sure;
    status = prepare(&p);
    if (status == QDOT_OK)
        status = in_field(&p, true, equal);
    return finish(&p, status);
}

/* Conditions and bounds put into the symbols; what cannot be, after the relations. */
static qdot_status
unfold(struct problem *p, const qdot_facts *facts, bool implied, bool *empty)
{
    qdot_exprs positive = {0};
    bool changed;
    qdot_status status = qdot_domain_unfold(p->pool, facts, 2 + p->nr, p->e, p->nr,
                                            implied, &positive, &changed, empty);
    qdot_expr *all = status == QDOT_OK
                         ? qdot_realloc(p->e, (2 + p->nr + positive.n + 1) * sizeof *all)
                         : NULL;

    if (all != NULL) {
        p->e = all;
        p->np = positive.n;
        p->conditional = positive.n > 0;
        for (size_t i = 0; i < positive.n; i++)
            p->e[2 + p->nr + i] = positive.at[i];
    }
    qdot_free(positive.at);
    return status != QDOT_OK ? status : all == NULL ? QDOT_ENOMEM : QDOT_OK;
}

static qdot_status
harder(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts,
       bool implied, bool *equal, bool *empty)
{
    bool changed = true, exponentials = false;
    struct problem p;
    qdot_status status;
    qdot_facts own;

    *equal = false;
    QDOT_TRY(begin(&p, pool, left, right, facts));
    status = unfold(&p, facts, implied, empty);
    if (status == QDOT_OK && implied && *empty) {
        *equal = true;
        return finish(&p, status);
    }
    for (size_t i = 0; i < count(&p) && status == QDOT_OK; i++)
        exponentials |= qdot_rewrite_has_exp(pool, p.e[i]);
    for (size_t i = 0; i < count(&p) && status == QDOT_OK; i++)
        p.e[i] = qdot_rewrite(pool, p.e[i], exponentials);
    if (status == QDOT_OK && !qdot_pool_failed(pool))
        status = note_positive(&p);
    if (status == QDOT_OK)
        status = prepare(&p);
    if (status == QDOT_OK)
        status = in_field(&p, true, equal);
    for (int round = 0; round < ROUNDS && status == QDOT_OK && changed && !*equal;
         round++) {
        own = (qdot_facts){.n_relations = p.nr, .relations = p.e + 2};
        status = qdot_unify(pool, count(&p), p.e, &own, false, &changed);
        if (status == QDOT_OK && changed)
            status = prepare(&p);
        if (status == QDOT_OK && changed)
            status = in_field(&p, true, equal);
    }
    if (status == QDOT_OK && !*equal && !qdot_pool_failed(pool))
        status = qdot_together(pool, count(&p), p.e, &changed);
    if (status == QDOT_OK && !*equal && changed && !qdot_pool_failed(pool)) {
        status = prepare(&p);
        if (status == QDOT_OK)
            status = in_field(&p, true, equal);
    }
    if (status == QDOT_OK && !*equal && !qdot_pool_failed(pool)) {
        own = (qdot_facts){.n_relations = p.nr, .relations = p.e + 2};
        status = qdot_angle_basis(pool, count(&p), p.e, &own, &changed);
        if (status == QDOT_OK && changed)
            status = prepare(&p);
        if (status == QDOT_OK && changed)
            status = in_field(&p, true, equal);
    }
    return finish(&p, status);
}

qdot_status
qdot_prove_harder(qdot_pool *pool, qdot_expr left, qdot_expr right,
                  const qdot_facts *facts, bool *equal)
{
    bool empty;

    return harder(pool, left, right, facts, false, equal, &empty);
}

qdot_status
qdot_prove_defined(qdot_pool *pool, qdot_expr left, qdot_expr right,
                   const qdot_facts *facts, bool *equal, bool *empty)
{
    bool none = false;
    qdot_status status = harder(pool, left, right, facts, true, equal, &none);

    if (empty != NULL)
        *empty = none;
    else
        *equal &= !none; /* nothing is claimed of no points */
    return status;
}
