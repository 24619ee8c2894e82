/* reading.c -- writes an integrand as a quotient of polynomials in x and the functions of x in it. */
#include "normal/integral/reading.h"

#include <stdio.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/field.h"
#include "normal/field/prepare.h"

#define WORK 400000

struct reader {
    qdot_integral_task *t;
    qdot_expr e, x;
    qdot_reading *out;
    bool read;
};

/* Give every generator that holds x a symbol, in the order of the variables; stands [f->n] is what is written for each. */
static bool
name_generators(struct reader *r, qdot_field *f, const bool *used, qdot_expr *stands)
{
    qdot_reading *out = r->out;
    char name[16];

    for (slong v = 0; v < f->n; v++) {
        const qdot_gen *g = &f->gen[v];

        stands[v] = g->expr;
        if (!used[v] || !qdot_expr_contains(f->pool, g->expr, r->x))
            continue;
        if (g->expr == r->x) {
            out->bare = true;
            continue;
        }
        if (out->n == QDOT_READING_GENERATORS)
            return false;
        snprintf(name, sizeof name, "k#%d", out->n);
        stands[v] = qdot_symbol_get(f->pool, QDOT_FORMAL, name);
        out->generator[out->n].kind = g->kind;
        out->generator[out->n].expr = g->expr;
        out->generator[out->n].of = g->of;
        out->generator[out->n].order = g->order;
        out->generator[out->n++].symbol = stands[v];
    }
    return true;
}

static qdot_expr
write_polynomial(qdot_field *f, const fmpz_mpoly_t p, const qdot_expr *stands)
{
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    qdot_expr sum = QDOT_ZERO;
    fmpq_t c;

    if (exp == NULL)
        return qdot_pool_fail(f->pool);
    fmpq_init(c);
    for (slong i = 0; i < fmpz_mpoly_length(p, f->ctx); i++) {
        qdot_expr term;

        fmpz_mpoly_get_term_coeff_fmpz(fmpq_numref(c), p, i, f->ctx);
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        term = qdot_expr_fmpq(f->pool, c);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] > 0)
                term = qdot_mul(f->pool, term, qdot_pow_int(f->pool, stands[v], (int64_t)exp[v]));
        sum = qdot_add(f->pool, sum, term);
    }
    fmpq_clear(c);
    qdot_free(exp);
    return sum;
}

static bool
holds_moving(qdot_pool *pool, const struct reader *r, qdot_expr e)
{
    if (qdot_expr_contains(pool, e, r->x))
        return true;
    for (int i = 0; i < r->out->n; i++)
        if (qdot_expr_contains(pool, e, r->out->generator[i].symbol))
            return true;
    return false;
}

static bool
write_factors(struct reader *r, qdot_field *f, const qdot_factors *factors, const qdot_expr *stands)
{
    qdot_pool *pool = f->pool;
    qdot_reading *out = r->out;
    fmpq_t c;

    fmpq_init(c);
    fmpz_set(fmpq_denref(c), factors->content);
    fmpz_one(fmpq_numref(c));
    fmpq_canonicalise(c);
    out->rest = qdot_expr_fmpq(pool, c);
    fmpq_clear(c);
    for (slong i = 0; i < factors->n; i++) {
        qdot_expr base = write_polynomial(f, factors->poly + i, stands);

        if (!holds_moving(pool, r, base)) {
            out->rest = qdot_div(pool, out->rest, qdot_pow_int(pool, base, (int64_t)factors->exp[i]));
            continue;
        }
        if (out->factors == QDOT_READING_FACTORS)
            return false;
        out->factor[out->factors].base = base;
        out->factor[out->factors++].power = (int64_t)factors->exp[i];
    }
    return true;
}

static void
read_value(struct reader *r, qdot_field *f, const qdot_ratio *value)
{
    qdot_expr *stands = qdot_malloc(((size_t)f->n + 1) * sizeof *stands);
    bool *used = qdot_calloc((size_t)f->n + 1, sizeof *used);
    slong *degree = qdot_malloc(((size_t)f->n + 1) * sizeof *degree);
    qdot_factors factors = {0};

    if (stands != NULL && used != NULL && degree != NULL) {
        for (int half = 0; half < 2; half++) {
            fmpz_mpoly_degrees_si(degree, half == 0 ? value->n : value->d, f->ctx);
            for (slong v = 0; v < f->n; v++)
                used[v] |= degree[v] > 0;
        }
        if (fmpz_mpoly_length(value->n, f->ctx) <= 400 && fmpz_mpoly_length(value->d, f->ctx) <= 400 &&
            name_generators(r, f, used, stands) && qdot_factor(f, &factors, value->d) == QDOT_OK) {
            r->out->numerator = write_polynomial(f, value->n, stands);
            r->read = write_factors(r, f, &factors, stands) && qdot_field_goes(f);
            qdot_factor_clear(f, &factors);
        }
    }
    qdot_free(degree);
    qdot_free(used);
    qdot_free(stands);
}

static void
read_in_field(void *user)
{
    struct reader *r = user;
    qdot_pool *pool = r->t->pool;
    qdot_expr e = qdot_prepare(pool, r->e);
    qdot_field f;
    qdot_ratio value;

    qdot_field_begin(&f, pool, 1, &e, WORK);
    if (qdot_field_goes(&f)) {
        qdot_field_cancelled(&f, &value, e);
        if (qdot_field_goes(&f))
            read_value(r, &f, &value);
        qdot_ratio_clear(&f, &value);
    }
    qdot_field_end(&f);
}

bool
qdot_reading_make(qdot_integral_task *t, qdot_expr e, qdot_expr x, qdot_reading *reading)
{
    struct reader r = {t, e, x, reading, false};

    *reading = (qdot_reading){0};
    if (e == QDOT_NIL || !qdot_integral_goes(t))
        return false;
    if (qdot_flint_run(t->pool, read_in_field, &r) != QDOT_OK)
        return false;
    return r.read && !qdot_pool_failed(t->pool);
}

qdot_expr
qdot_reading_denominator(qdot_integral_task *t, const qdot_reading *reading)
{
    qdot_expr d = QDOT_ONE;

    for (int i = 0; i < reading->factors; i++)
        d = qdot_mul(t->pool, d, qdot_pow_int(t->pool, reading->factor[i].base, reading->factor[i].power));
    return d;
}
