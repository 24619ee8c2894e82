/* split.c -- splits b = c prod f^m into positive factors, squares, and a rest that is kept as one base. */
#include "normal/field/split.h"

#include <flint/fmpz.h>
#include <flint/fmpz_factor.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "normal/field/factor.h"

#define WORK 400000

/* A product c * prod base^m * rest with c > 0, where b >= 0 implies that every base and the rest are >= 0. */
struct parts {
    fmpq_t c;
    struct {
        qdot_expr base;
        int64_t m;
    } * at;
    size_t n, capacity;
    qdot_expr rest; /* product of factors whose signs are not known one by one; 1: none */
    bool negative;  /* the value is minus the product; for parts of any sign */
};

static void
parts_init(struct parts *p)
{
    *p = (struct parts){.rest = QDOT_ONE};
    fmpq_init(p->c);
    fmpq_one(p->c);
}

static void
parts_clear(struct parts *p)
{
    fmpq_clear(p->c);
    qdot_free(p->at);
}

static qdot_status
parts_add(struct parts *p, qdot_expr base, int64_t m)
{
    QDOT_TRY(qdot_grow(&p->at, &p->capacity, p->n + 1, sizeof *p->at));
    p->at[p->n].base = base;
    p->at[p->n++].m = m;
    return QDOT_OK;
}

/* Choose the form of p with the fewest terms: as it is, with 1 - c^2 for s^2, or with 1 - s^2 for c^2. */
static qdot_status
polynomial_shorten(qdot_field *f, fmpz_mpoly_t p)
{
    fmpz_mpoly_t other;
    qdot_status status = QDOT_OK;

    fmpz_mpoly_init(other, f->ctx);
    for (slong v = 0; v < f->n && status == QDOT_OK; v++)
        if ((f->gen[v].kind == QDOT_GEN_COS || f->gen[v].kind == QDOT_GEN_COSH) &&
            fmpz_mpoly_degree_si(p, v, f->ctx) >= 2) {
            status = qdot_factor_flip(f, other, p, v);
            if (status == QDOT_OK && qdot_field_goes(f) &&
                fmpz_mpoly_length(other, f->ctx) < fmpz_mpoly_length(p, f->ctx))
                fmpz_mpoly_swap(p, other, f->ctx);
        }
    fmpz_mpoly_clear(other, f->ctx);
    return status;
}

struct unknown {
    qdot_expr base[32];
    int64_t m[32];
    size_t n;
};

static qdot_status
take_factors(qdot_field *f, struct parts *p, struct unknown *u, fmpz_mpoly_t poly,
             int side)
{
    qdot_pool *pool = f->pool;
    qdot_factors factors;
    qdot_status status = polynomial_shorten(f, poly);

    QDOT_TRY(status);
    status = qdot_factor(f, &factors, poly);
    if (fmpz_sgn(factors.content) < 0)
        p->negative = !p->negative;
    fmpz_abs(factors.content, factors.content);
    if (side > 0)
        fmpq_mul_fmpz(p->c, p->c, factors.content);
    else
        fmpq_div_fmpz(p->c, p->c, factors.content);
    for (slong i = 0; i < factors.n && status == QDOT_OK; i++) {
        qdot_expr base = qdot_field_expr(f, factors.poly + i);
        int64_t m = side * factors.exp[i];
        uint8_t sign;

        if (base == QDOT_NIL) {
            status = QDOT_EFAILED;
            break;
        }
        sign = qdot_expr_node(pool, base)->sign;
        if (!(sign & QDOT_GE0) && (sign & QDOT_LE0)) {
            base = qdot_neg(pool, base);
            sign |= QDOT_GE0;
            if (m % 2 != 0)
                p->negative = !p->negative;
        }
        if (sign & QDOT_GE0) {
            status = parts_add(p, base, m);
        } else if (m % 2 == 0) {
            status = parts_add(p, qdot_fun1(pool, QDOT_ABS, base), m);
        } else if (u->n < sizeof u->base / sizeof *u->base) {
            u->base[u->n] = base;
            u->m[u->n++] = m;
        } else {
            status = QDOT_ELIMIT;
        }
    }
    qdot_factor_clear(f, &factors);
    return status;
}

/* Split b. `whole`: b is known not to be negative (it stands under a root or in a
 * logarithm). QDOT_EFAILED where it cannot be split. */
static qdot_status
split_base(qdot_pool *pool, qdot_expr b, bool whole, struct parts *p)
{
    struct unknown u = {.n = 0};
    qdot_status status = QDOT_EFAILED;
    qdot_field f;

    qdot_field_begin(&f, pool, 1, &b, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, b);
        if (qdot_field_goes(&f) && !fmpz_mpoly_is_zero(r.n, f.ctx)) {
            status = take_factors(&f, p, &u, r.n, 1);
            if (status == QDOT_OK)
                status = take_factors(&f, p, &u, r.d, -1);
            if (!qdot_field_goes(&f) || qdot_pool_failed(pool))
                status = QDOT_EFAILED;
        }
        qdot_ratio_clear(&f, &r);
    }
    qdot_field_end(&f);
    QDOT_TRY(status);
    if (!whole) {
        for (size_t i = 0; i < u.n && status == QDOT_OK; i++)
            status = parts_add(p, qdot_fun1(pool, QDOT_ABS, u.base[i]), u.m[i]);
        return status;
    }
    if (u.n == 0)
        return p->negative ? QDOT_EFAILED : QDOT_OK;
    if (p->negative)
        u.base[0] = qdot_neg(pool, u.base[0]);
    if (u.n == 1)
        return parts_add(p, u.base[0], u.m[0]);
    /* use f^m = |f|^(m - 1) f for odd m */
    for (size_t i = 0; i < u.n && status == QDOT_OK; i++) {
        if (u.m[i] != 1)
            status = parts_add(p, qdot_fun1(pool, QDOT_ABS, u.base[i]), u.m[i] - 1);
        p->rest = qdot_mul(pool, p->rest, u.base[i]);
    }
    return status;
}

qdot_expr
qdot_split_power(qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    struct parts p;
    qdot_expr e;

    if (qdot_expr_kind(pool, b) == QDOT_NUM || qdot_expr_kind(pool, b) == QDOT_SYM)
        return qdot_pow(pool, b, x);
    parts_init(&p);
    if (split_base(pool, b, true, &p) != QDOT_OK) {
        e = qdot_pow(pool, b, x);
    } else {
        e = qdot_mul(pool, qdot_pow(pool, qdot_expr_fmpq(pool, p.c), x),
                     qdot_pow(pool, p.rest, x));
        for (size_t i = 0; i < p.n; i++)
            e = qdot_mul(pool, e,
                         qdot_pow(pool, p.at[i].base,
                                  qdot_mul(pool, qdot_expr_int(pool, p.at[i].m), x)));
    }
    parts_clear(&p);
    return e;
}

qdot_expr
qdot_split_abs(qdot_pool *pool, qdot_expr b)
{
    struct parts p;
    qdot_expr e;

    if (qdot_expr_kind(pool, b) == QDOT_NUM || qdot_expr_kind(pool, b) == QDOT_SYM)
        return qdot_fun1(pool, QDOT_ABS, b);
    parts_init(&p);
    if (split_base(pool, b, false, &p) != QDOT_OK) {
        e = qdot_fun1(pool, QDOT_ABS, b);
    } else {
        e = qdot_expr_fmpq(pool, p.c);
        for (size_t i = 0; i < p.n; i++)
            e = qdot_mul(pool, e, qdot_pow_int(pool, p.at[i].base, p.at[i].m));
    }
    parts_clear(&p);
    return e;
}

/* The logarithm of an integer as a sum over its prime factors. */
static qdot_expr
log_of_integer(qdot_pool *pool, const fmpz_t n)
{
    qdot_expr e = QDOT_ZERO;
    fmpz_factor_t f;

    if (fmpz_is_one(n))
        return e;
    if (fmpz_bits(n) > 62)
        return qdot_fun1(pool, QDOT_LOG, qdot_expr_fmpz(pool, n));
    fmpz_factor_init(f);
    fmpz_factor(f, n);
    for (slong i = 0; i < f->num; i++)
        e = qdot_add(pool, e,
                     qdot_mul(pool, qdot_expr_int(pool, (int64_t)f->exp[i]),
                              qdot_fun1(pool, QDOT_LOG,
                                        qdot_expr_fmpz(pool, f->p + i))));
    fmpz_factor_clear(f);
    return e;
}

/* log b^x = x log b for a root or a base that is not negative: b > 0 where it is
 * defined. */
static qdot_expr
log_of_factor(qdot_pool *pool, qdot_expr e)
{
    qdot_expr b, x;

    if (qdot_expr_kind(pool, e) == QDOT_PROD && qdot_expr_count(pool, e) == 3 &&
        qdot_expr_arg(pool, e, 0) == QDOT_ONE) {
        int64_t k;

        b = qdot_expr_arg(pool, e, 1);
        x = qdot_expr_arg(pool, e, 2);
        if (qdot_expr_kind(pool, x) == QDOT_NUM &&
            (!qdot_expr_to_int(pool, x, &k) ||
             (qdot_expr_node(pool, b)->sign & QDOT_GE0)))
            return qdot_mul(pool, x, qdot_fun1(pool, QDOT_LOG, b));
    }
    return qdot_fun1(pool, QDOT_LOG, e);
}

qdot_expr
qdot_split_log(qdot_pool *pool, qdot_expr b)
{
    struct parts p;
    qdot_expr e;

    if (qdot_expr_kind(pool, b) == QDOT_SYM)
        return qdot_fun1(pool, QDOT_LOG, b);
    parts_init(&p);
    if (split_base(pool, b, true, &p) != QDOT_OK) {
        e = qdot_fun1(pool, QDOT_LOG, b);
    } else {
        e = qdot_sub(pool, log_of_integer(pool, fmpq_numref(p.c)),
                     log_of_integer(pool, fmpq_denref(p.c)));
        if (p.rest != QDOT_ONE)
            e = qdot_add(pool, e, log_of_factor(pool, p.rest));
        for (size_t i = 0; i < p.n; i++)
            e = qdot_add(pool, e,
                         qdot_mul(pool, qdot_expr_int(pool, p.at[i].m),
                                  log_of_factor(pool, p.at[i].base)));
    }
    parts_clear(&p);
    return e;
}
