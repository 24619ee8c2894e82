/* positive.c -- simplifies the condition e > 0 or e != 0: drops factors of known sign, or known not
 * to vanish. */
#include "normal/simplify/positive.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "normal/form/shortest.h"
#include "normal/inequality/less.h"
#include "normal/refute/sample.h"

enum { WORK = 1000000, PRODUCT_WORK = 100000, POINTS = 24 };

/* The condition on e: positive where no even power vanishes; positive, with sign and zeros
 * preserved; or not 0. */
typedef enum { POSITIVE_GENERIC, POSITIVE_EXACT, POSITIVE_NONZERO } question;

typedef struct {
    qdot_pool *pool;
    question asked;
    qdot_field *f;
    const qdot_facts *facts;
    size_t n_known;
    const qdot_expr *known; /* [n_known] expressions in the field that are known to be positive */
    int sign;               /* sign of the product of the factors left out */
    qdot_vec(qdot_expr) rest;
} job;

/* Numerators of the known ones: 1 if p is one of them times a square or so, -1 if it is its
 * negative, 0 otherwise. */
static int
sign_by_known_factor(job *j, const fmpz_mpoly_t p)
{
    qdot_field *f = j->f;
    fmpz_mpoly_t q;
    int sign = 0;

    fmpz_mpoly_init(q, f->ctx);
    for (size_t i = 0; i < j->n_known && sign == 0; i++) {
        const qdot_ratio *r = qdot_field_value(f, j->known[i]);
        fmpz_t c;

        fmpz_init(c);
        if (r != NULL && fmpz_mpoly_is_one(r->d, f->ctx) &&
            fmpz_mpoly_length(r->n, f->ctx) > 0) {
            qdot_field_primitive(f, c, q, r->n, false);
            if (fmpz_mpoly_equal(q, p, f->ctx))
                sign = 1;
            fmpz_mpoly_neg(q, q, f->ctx);
            if (fmpz_mpoly_equal(q, p, f->ctx))
                sign = -1;
        }
        fmpz_clear(c);
    }
    fmpz_mpoly_clear(q, f->ctx);
    return sign;
}

/* The sign of an expression without symbols, by an enclosure of its value. */
static int
sign_of_constant(job *j, qdot_expr e)
{
    int sign = 0;
    qdot_sample sample;

    if (qdot_sample_begin(&sample, j->pool, 1, &e, NULL) != QDOT_OK)
        return 0;
    qdot_sample_point(&sample, 0);
    for (slong prec = 128; prec <= 1024 && sign == 0; prec *= 2) {
        arb_srcptr v;

        if (!qdot_sample_eval(&sample, prec) ||
            (v = qdot_ball_get(&sample.ball, e)) == NULL)
            continue;
        sign = arb_is_positive(v) ? 1 : arb_is_negative(v) ? -1 : 0;
    }
    qdot_sample_end(&sample);
    return sign;
}

/* Find whether e is positive at some sample points and negative at others, so that no sign can be proved. */
static void
sample_signs(job *j, qdot_expr e, bool *above, bool *below)
{
    qdot_sample sample;

    *above = *below = false;
    if (qdot_sample_begin(&sample, j->pool, 1, &e, j->facts) != QDOT_OK)
        return;
    for (int k = 0; k < POINTS && sample.possible && !(*above && *below); k++) {
        arb_srcptr v;

        qdot_sample_point(&sample, k);
        if (!qdot_sample_eval(&sample, 64) || (v = qdot_ball_get(&sample.ball, e)) == NULL)
            continue;
        *above |= arb_is_positive(v);
        *below |= arb_is_negative(v);
    }
    qdot_sample_end(&sample);
}

static bool
is_known_positive(const job *j, qdot_expr b)
{
    if ((qdot_expr_node(j->pool, b)->sign & QDOT_POS) == QDOT_POS)
        return true;
    for (size_t i = 0; i < j->n_known; i++)
        if (j->known[i] == b)
            return true;
    return false;
}

/* Whether e is a product of powers of factors that are known to be positive. */
static bool
is_product_of_positive(const job *j, qdot_expr e)
{
    qdot_pool *pool = j->pool;

    if (qdot_expr_kind(pool, e) != QDOT_PROD || qdot_expr_is_negative(pool, e))
        return false;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i);

        if (is_known_positive(j, b))
            continue;
        if (qdot_expr_kind(pool, b) != QDOT_PROD || qdot_expr_is_negative(pool, b))
            return false;
        for (uint32_t k = 1; k < qdot_expr_count(pool, b); k += 2)
            if (!is_known_positive(j, qdot_expr_arg(pool, b, k)))
                return false;
    }
    return true;
}

/* The sign of e if it is proved, 1 or -1; 0 if not known. */
static int
proved_sign(job *j, qdot_expr e)
{
    uint8_t sign = qdot_expr_node(j->pool, e)->sign;
    bool above, below;
    qdot_decision d;

    if ((sign & QDOT_POS) == QDOT_POS)
        return 1;
    if ((sign & QDOT_NEG) == QDOT_NEG)
        return -1;
    /* e >= 0 everywhere, being an even power: it is positive except where e = 0 */
    if (j->asked == POSITIVE_GENERIC && (sign & QDOT_GE0) != 0)
        return 1;
    if (j->asked == POSITIVE_GENERIC && (sign & QDOT_LE0) != 0)
        return -1;
    if (j->n_known > 0 && is_product_of_positive(j, e))
        return 1;
    if ((qdot_expr_node(j->pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) == 0)
        return sign_of_constant(j, e);
    sample_signs(j, e, &above, &below);
    if (!below &&
        qdot_decide_less(j->pool, QDOT_ZERO, e, true, j->facts, &d) == QDOT_OK &&
        d.verdict == QDOT_PROVED)
        return 1;
    if (!above &&
        qdot_decide_less(j->pool, e, QDOT_ZERO, true, j->facts, &d) == QDOT_OK &&
        d.verdict == QDOT_PROVED)
        return -1;
    return 0;
}

/* Keep those factors of p, a numerator or (`below`) a denominator, on which the condition asked for depends. */
static qdot_status
keep_relevant_factors(job *j, const fmpz_mpoly_t p, bool below)
{
    qdot_field *f = j->f;
    qdot_factors factors;
    qdot_status status = qdot_factor(f, &factors, p);

    if (status == QDOT_OK && fmpz_sgn(factors.content) < 0)
        j->sign = -j->sign;
    for (slong i = 0; i < factors.n && status == QDOT_OK; i++) {
        qdot_expr e = qdot_field_expr(f, factors.poly + i);
        bool even = factors.exp[i] % 2 == 0, vanishes = j->asked != POSITIVE_GENERIC && !below;
        int sign = sign_by_known_factor(j, factors.poly + i);

        if ((even && !vanishes) || (below && j->asked == POSITIVE_NONZERO))
            continue;
        if (e == QDOT_NIL)
            status = qdot_pool_check(j->pool);
        else if (sign == 0)
            sign = proved_sign(j, e);
        if (sign < 0 && !even)
            j->sign = -j->sign;
        if (sign == 0 && status == QDOT_OK)
            status = qdot_vec_push(&j->rest, even && j->asked == POSITIVE_EXACT
                                                 ? qdot_pow_int(j->pool, e, 2)
                                                 : e);
    }
    qdot_factor_clear(f, &factors);
    return status;
}

qdot_expr
qdot_positive_without_minus(qdot_pool *pool, qdot_expr e)
{
    qdot_expr left = QDOT_ZERO, right = QDOT_ZERO;
    uint32_t n = qdot_expr_count(pool, e);

    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return qdot_expr_is_negative(pool, e)
                   ? qdot_rel(pool, QDOT_LT, qdot_neg(pool, e), QDOT_ZERO)
                   : qdot_rel(pool, QDOT_LT, QDOT_ZERO, e);
    for (uint32_t i = 0; i < n; i += i == 0 ? 1 : 2) { /* the entries c0, c1, t1, c2, t2, ...: look at coefficients */
        qdot_expr term = qdot_expr_arg(pool, e, i);

        if (i > 0)
            term = qdot_mul(pool, term, qdot_expr_arg(pool, e, i + 1));
        if (qdot_expr_is_negative(pool, term))
            left = qdot_sub(pool, left, term);
        else
            right = qdot_add(pool, right, term);
    }
    return qdot_rel(pool, QDOT_LT, left, right);
}

/* Drop a factor |v| if v is a factor, too: |v| is never negative, and 0 only where v is. */
static void
drop_absolute_values(job *j)
{
    qdot_pool *pool = j->pool;

    for (size_t i = 0; i < j->rest.n;) {
        qdot_expr e = j->rest.at[i], v = QDOT_NIL;

        if (qdot_expr_is_function(pool, e, QDOT_ABS))
            v = qdot_expr_arg(pool, e, 0);
        if (v != QDOT_NIL && (qdot_expr_place(j->rest.n, j->rest.at, v) < j->rest.n ||
                              qdot_expr_place(j->rest.n, j->rest.at, qdot_neg(pool, v)) < j->rest.n))
            j->rest.at[i] = j->rest.at[--j->rest.n];
        else
            i++;
    }
}

static qdot_expr
write_condition(job *j)
{
    qdot_pool *pool = j->pool;
    qdot_expr rest;
    bool spent;

    drop_absolute_values(j);
    if (j->rest.n == 0)
        return j->sign > 0 || j->asked == POSITIVE_NONZERO ? QDOT_TRUE : QDOT_FALSE;
    if (j->asked == POSITIVE_NONZERO)
        return qdot_rel(pool, QDOT_LT, QDOT_ZERO,
                        qdot_fun1(pool, QDOT_ABS, qdot_product(pool, j->rest.n, j->rest.at)));
    if (j->rest.n == 1) {
        rest = j->rest.at[0];
        return qdot_positive_without_minus(pool, j->sign > 0 ? rest : qdot_neg(pool, rest));
    }
    rest = qdot_shortest_within(pool, qdot_product(pool, j->rest.n, j->rest.at), j->facts,
                                PRODUCT_WORK, &spent);
    return qdot_positive_without_minus(pool, j->sign > 0 ? rest : qdot_neg(pool, rest));
}

struct asking {
    job j;
    qdot_expr e, result; /* expression; its simplified form, nil if the budget is used up */
    qdot_status status;
};

static void
simplify_condition_task(void *user)
{
    struct asking *x = user;
    job *j = &x->j;
    qdot_expr *all = qdot_malloc((j->n_known + 1) * sizeof *all);
    qdot_field f;

    if (all == NULL) {
        x->status = QDOT_ENOMEM;
        return;
    }
    all[0] = qdot_prepare(j->pool, x->e);
    for (size_t i = 0; i < j->n_known; i++)
        all[1 + i] = qdot_prepare(j->pool, j->known[i]);
    j->known = all + 1;
    if (qdot_pool_failed(j->pool)) {
        x->status = qdot_pool_check(j->pool);
        qdot_free(all);
        return;
    }
    qdot_field_begin(&f, j->pool, j->n_known + 1, all, WORK);
    j->f = &f;
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, all[0]);
        if (fmpz_mpoly_is_zero(r.n, f.ctx)) {
            x->result = QDOT_FALSE;
        } else {
            x->status = keep_relevant_factors(j, r.n, false);
            if (x->status == QDOT_OK)
                x->status = keep_relevant_factors(j, r.d, true);
            if (x->status == QDOT_OK && qdot_field_goes(&f))
                x->result = write_condition(j);
        }
        qdot_ratio_clear(&f, &r);
    }
    if (x->status == QDOT_OK && f.state == QDOT_FIELD_FAILED)
        x->status = f.status;
    qdot_field_end(&f);
    qdot_free(all);
    qdot_free(j->rest.at);
}

static qdot_expr
decide_sign_or_unknown(struct asking *x, qdot_expr unknown)
{
    qdot_pool *pool = x->j.pool;
    qdot_status status;

    if (qdot_pool_failed(pool))
        return QDOT_NIL;
    status = qdot_flint_run(pool, simplify_condition_task, x);
    if (status == QDOT_ELIMIT)
        return unknown;
    if (status != QDOT_OK || x->status != QDOT_OK)
        return qdot_pool_fail(pool);
    return x->result != QDOT_NIL ? x->result : unknown;
}

qdot_expr
qdot_positive(qdot_pool *pool, qdot_expr e, const qdot_facts *facts, size_t n,
              const qdot_expr *known)
{
    struct asking x = {
        .j = {.pool = pool, .facts = facts, .n_known = n, .known = known, .sign = 1},
        .e = e,
    };

    return decide_sign_or_unknown(&x, qdot_positive_without_minus(pool, e));
}

qdot_expr
qdot_positive_exact(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    struct asking x = {
        .j = {.pool = pool, .asked = POSITIVE_EXACT, .facts = facts, .sign = 1}, .e = e};

    return decide_sign_or_unknown(&x, qdot_positive_without_minus(pool, e));
}

qdot_expr
qdot_nonzero(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    struct asking x = {
        .j = {.pool = pool, .asked = POSITIVE_NONZERO, .facts = facts, .sign = 1}, .e = e};

    return decide_sign_or_unknown(&x, qdot_rel(pool, QDOT_LT, QDOT_ZERO, qdot_fun1(pool, QDOT_ABS, e)));
}

qdot_expr
qdot_positive_of(qdot_pool *pool, qdot_expr relation)
{
    return qdot_sub(pool, qdot_expr_arg(pool, relation, 1),
                    qdot_expr_arg(pool, relation, 0));
}
