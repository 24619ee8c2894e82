/* multiply.c -- reads expanded expressions as polynomials over Z, multiplies these, and writes the result as an expression. */
#include "expr/polynomial/multiply.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include <flint/fmpq.h>
#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_vec.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/polynomial/flint.h"
#include "expr/polynomial/terms.h"
#include "expr/pool.h"

/* FLINT hears Ctrl-C when it allocates. Of two long polynomials so many products of terms, some 0.1 s, are computed at a time. */
#define PRODUCTS_AT_ONCE 5e6
#define MOST_PRODUCTS 1e10 /* of one multiplication; some minutes */

/* The value of an item: c p. */
typedef struct {
    fmpz_mpoly_t p;
    fmpq_t c;
    bool made;
} polynomial;

typedef struct {
    qdot_pool *pool;
    const qdot_multiply_list *list;
    uint32_t item;
    qdot_variables v;
    polynomial *value; /* [item + 1] */
    qdot_expr result;
} multiplication;

double
qdot_multiply_terms_of_power(double t, uint64_t n)
{
    double terms = 1;

    if (t <= 1)
        return t;
    for (double k = 1; k < t && terms < 1e30; k++)
        terms *= ((double)n + k) / k;
    return terms;
}

/* --- bounds of the number of terms -------------------------------------------------------- */

/* Degrees of a polynomial: in each variable, and the least and greatest total degree of its terms. */
typedef struct {
    double least, most;
    double *degree; /* [n] */
} degrees;

static bool
find_degrees(const multiplication *m, const fmpz_mpoly_t p, degrees *d)
{
    const slong n = m->v.n;
    ulong *exp = qdot_malloc(((size_t)n + 1) * sizeof *exp);

    d->degree = qdot_calloc((size_t)n + 1, sizeof *d->degree);
    d->least = INFINITY;
    d->most = 0;
    if (exp == NULL || d->degree == NULL) {
        qdot_free(exp);
        qdot_pool_fail(m->pool);
        return false;
    }
    for (slong i = 0; i < fmpz_mpoly_length(p, m->v.ctx); i++) {
        double total = 0;

        fmpz_mpoly_get_term_exp_ui(exp, p, i, m->v.ctx);
        for (slong k = 0; k < n; k++) {
            total += (double)exp[k];
            d->degree[k] = fmax(d->degree[k], (double)exp[k]);
        }
        d->least = fmin(d->least, total);
        d->most = fmax(d->most, total);
    }
    qdot_free(exp);
    return true;
}

/* The number of monomials within the degrees: those of a box, or of the total degrees least ... most. */
static double
count_monomials(const multiplication *m, const degrees *d)
{
    double box = 1, all = 1, below = d->least > 0 ? 1 : 0, used = 0;

    for (slong k = 0; k < m->v.n; k++)
        if (d->degree[k] > 0) {
            used++;
            box *= d->degree[k] + 1;
            all *= (d->most + used) / used;
            below *= (d->least - 1 + used) / used;
        }
    return fmin(box, all - below);
}

/* The least of `terms`, which bounds the number of terms of p^n q, and the number of monomials within its degrees; q NULL: of p^n.
 * Degrees are asked for only where `terms` is too many. */
static double
bound_by_degrees(const multiplication *m, double terms, const fmpz_mpoly_struct *p, uint64_t n, const fmpz_mpoly_struct *q)
{
    degrees d = {0}, more = {0};

    if (terms <= QDOT_MULTIPLY_MOST_TERMS)
        return terms;
    if (find_degrees(m, p, &d) && (q == NULL || find_degrees(m, q, &more))) {
        for (slong k = 0; k < m->v.n; k++)
            d.degree[k] = (double)n * d.degree[k] + (q != NULL ? more.degree[k] : 0);
        d.least = (double)n * d.least + more.least;
        d.most = (double)n * d.most + more.most;
        terms = fmin(terms, count_monomials(m, &d));
    }
    qdot_free(d.degree);
    qdot_free(more.degree);
    return terms;
}

/* Whether to go on to a polynomial of at most `terms` terms by `products` products of terms; counts these as work of the pool. */
static bool
may_multiply(const multiplication *m, double terms, double products)
{
    qdot_pool *pool = m->pool;
    uint64_t left;

    if (FAILED(pool) || qdot_pool_interrupted(pool))
        return false;
    if (terms > QDOT_MULTIPLY_MOST_TERMS) {
        qdot_pool_refuse(pool, QDOT_ELIMIT, terms < 1e15 ? "multiplied out it has up to %.0f terms, and %d are the most"
                                                         : "multiplied out it has up to %.1e terms, and %d are the most",
                         floor(terms + 0.5), QDOT_MULTIPLY_MOST_TERMS);
        return false;
    }
    if (products > MOST_PRODUCTS) {
        qdot_pool_refuse(pool, QDOT_ELIMIT, "multiplying it out takes %.1e products of terms", products);
        return false;
    }
    left = qdot_pool_budget(pool, UINT64_MAX);
    if (left != UINT64_MAX && (double)left < products / 16) {
        qdot_pool_refuse(pool, QDOT_ELIMIT, "the work budget is spent");
        left = 0;
    } else if (left != UINT64_MAX) {
        left -= (uint64_t)(products / 16);
    }
    (void)qdot_pool_budget(pool, left);
    return !FAILED(pool);
}

/* --- arithmetic --------------------------------------------------------------------------- */

/* Add a b to the sum, a in parts of not more than PRODUCTS_AT_ONCE products with the terms of b. */
static void
multiply_in_parts(const multiplication *m, fmpz_mpoly_geobucket_t sum, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    const fmpz_mpoly_ctx_struct *ctx = m->v.ctx;
    const slong n = fmpz_mpoly_length(a, ctx);
    const slong step = 1 + (slong)(PRODUCTS_AT_ONCE / (double)fmpz_mpoly_length(b, ctx));
    ulong *exp = qdot_malloc(((size_t)m->v.n + 1) * sizeof *exp);
    fmpz_mpoly_t part, product;

    if (exp == NULL) {
        qdot_pool_fail(m->pool);
        return;
    }
    fmpz_mpoly_init(part, ctx);
    fmpz_mpoly_init(product, ctx);
    for (slong from = 0; from < n && !qdot_pool_interrupted(m->pool); from += step) {
        fmpz_mpoly_zero(part, ctx);
        for (slong i = from; i < n && i < from + step; i++) {
            fmpz_mpoly_get_term_exp_ui(exp, a, i, ctx);
            fmpz_mpoly_push_term_fmpz_ui(part, a->coeffs + i, exp, ctx);
        }
        fmpz_mpoly_mul(product, part, b, ctx);
        fmpz_mpoly_geobucket_add(sum, product, ctx);
    }
    fmpz_mpoly_clear(part, ctx);
    fmpz_mpoly_clear(product, ctx);
    qdot_free(exp);
}

/* r = r a, within the limits. */
static void
multiply_polynomials(const multiplication *m, fmpz_mpoly_t r, const fmpz_mpoly_t a)
{
    const fmpz_mpoly_ctx_struct *ctx = m->v.ctx;
    const double nr = (double)fmpz_mpoly_length(r, ctx), na = (double)fmpz_mpoly_length(a, ctx);
    fmpz_mpoly_geobucket_t sum;

    if (!may_multiply(m, bound_by_degrees(m, nr * na, r, 1, a), nr * na))
        return;
    if (nr * na <= PRODUCTS_AT_ONCE) {
        fmpz_mpoly_mul(r, r, a, ctx);
        return;
    }
    fmpz_mpoly_geobucket_init(sum, ctx);
    multiply_in_parts(m, sum, nr < na ? a : r, nr < na ? r : a);
    fmpz_mpoly_geobucket_empty(r, sum, ctx);
    fmpz_mpoly_geobucket_clear(sum, ctx);
}

/* p = p^n, within the limits. */
static void
raise_polynomial(const multiplication *m, fmpz_mpoly_t p, uint64_t n)
{
    const double t = (double)fmpz_mpoly_length(p, m->v.ctx);
    double terms;

    if (n == 1)
        return;
    terms = bound_by_degrees(m, qdot_multiply_terms_of_power(t, n), p, n, NULL);
    if (!may_multiply(m, terms, terms * t))
        return;
    if ((double)n * fabs((double)_fmpz_vec_max_bits(p->coeffs, p->length)) > 2.0 * QDOT_MAX_BITS)
        qdot_pool_refuse(m->pool, QDOT_ELIMIT, "an exact number of more than 10^6 digits");
    else if (n > UWORD_MAX || !fmpz_mpoly_pow_ui(p, p, (ulong)n, m->v.ctx))
        qdot_pool_refuse(m->pool, QDOT_ELIMIT, "the power %" PRIu64 " is too high", n);
}

/* --- items -------------------------------------------------------------------------------- */

/* The value of a part: of its item, or of its expression, which is read into `own`. */
static const polynomial *
part_value(multiplication *m, const qdot_multiply_part *part, polynomial *own)
{
    if (part->e == QDOT_NIL)
        return &m->value[part->item];
    qdot_terms_read(&m->v, own->p, own->c, part->e);
    return own;
}

static void
begin_polynomial(const multiplication *m, polynomial *x)
{
    fmpz_mpoly_init(x->p, m->v.ctx);
    fmpq_init(x->c);
    fmpq_one(x->c);
    x->made = true;
}

static void
end_polynomial(const multiplication *m, polynomial *x)
{
    if (!x->made)
        return;
    fmpz_mpoly_clear(x->p, m->v.ctx);
    fmpq_clear(x->c);
    x->made = false;
}

/* y = c + sum of c_k x_k, over the denominator that all have in common. */
static void
add_parts(multiplication *m, const qdot_multiply_item *item, polynomial *y)
{
    const fmpz_mpoly_ctx_struct *ctx = m->v.ctx;
    const qdot_multiply_part *part = m->list->parts.at + item->from;
    fmpz_mpoly_geobucket_t sum;
    fmpz_mpoly_t p;
    fmpq_t c, all;

    fmpz_mpoly_geobucket_init(sum, ctx);
    fmpz_mpoly_init(p, ctx);
    fmpq_init(c);
    fmpq_init(all); /* of y: numerators have a common divisor, denominators a common multiple */
    fmpq_set(all, RATIONAL(m->pool, item->c));
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < item->n && !FAILED(m->pool); i++) {
            polynomial own = {.made = false};
            const polynomial *x;

            begin_polynomial(m, &own);
            x = part_value(m, &part[i], &own);
            fmpq_mul(c, x->c, RATIONAL(m->pool, part[i].c));
            if (pass == 0) {
                fmpq_gcd(all, all, c);
            } else {
                fmpq_div(c, c, all);
                fmpz_mpoly_scalar_mul_fmpz(p, x->p, fmpq_numref(c), ctx);
                fmpz_mpoly_geobucket_add(sum, p, ctx);
            }
            end_polynomial(m, &own);
        }
    if (!fmpq_is_zero(all)) {
        fmpq_div(c, RATIONAL(m->pool, item->c), all);
        fmpz_mpoly_set_fmpz(p, fmpq_numref(c), ctx);
        fmpz_mpoly_geobucket_add(sum, p, ctx);
        fmpq_set(y->c, all);
    }
    fmpz_mpoly_geobucket_empty(y->p, sum, ctx);
    fmpz_mpoly_geobucket_clear(sum, ctx);
    fmpz_mpoly_clear(p, ctx);
    fmpq_clear(c);
    fmpq_clear(all);
}

static int
compare_lengths(const void *a, const void *b)
{
    const polynomial *x = a, *y = b;

    return x->p->length < y->p->length ? -1 : x->p->length > y->p->length;
}

/* y = c x1^n1 x2^n2 ..., short factors first. */
static void
multiply_parts(multiplication *m, const qdot_multiply_item *item, polynomial *y)
{
    const qdot_multiply_part *part = m->list->parts.at + item->from;
    polynomial *factor = qdot_calloc(item->n + 1, sizeof *factor);
    fmpq_t c, power;

    if (factor == NULL) {
        qdot_pool_fail(m->pool);
        return;
    }
    fmpq_init(c);
    fmpq_init(power);
    fmpz_mpoly_one(y->p, m->v.ctx);
    fmpq_set(c, RATIONAL(m->pool, item->c));
    for (size_t i = 0; i < item->n && !FAILED(m->pool); i++) {
        const polynomial *x;

        begin_polynomial(m, &factor[i]);
        x = part_value(m, &part[i], &factor[i]);
        if (x != &factor[i])
            fmpz_mpoly_set(factor[i].p, x->p, m->v.ctx);
        raise_polynomial(m, factor[i].p, part[i].power);
        if (FAILED(m->pool))
            break;
        if (fmpq_is_one(x->c))
            continue;
        fmpq_pow_si(power, x->c, (slong)part[i].power);
        fmpq_mul(c, c, power);
        if (qdot_number_too_large(m->pool, c))
            break;
    }
    qsort(factor, item->n, sizeof *factor, compare_lengths);
    for (size_t i = 0; i < item->n; i++) {
        if (!FAILED(m->pool))
            multiply_polynomials(m, y->p, factor[i].p);
        end_polynomial(m, &factor[i]);
    }
    fmpq_swap(y->c, c);
    fmpq_clear(c);
    fmpq_clear(power);
    qdot_free(factor);
}

/* Mark the items on which the wanted one depends: these are read and computed. */
static void
mark_items(const multiplication *m, bool *wanted)
{
    wanted[m->item] = true;
    for (uint32_t i = m->item + 1; i-- > 0;) {
        const qdot_multiply_item *item = &m->list->items.at[i];

        for (size_t k = 0; wanted[i] && k < item->n; k++)
            if (m->list->parts.at[item->from + k].e == QDOT_NIL)
                wanted[m->list->parts.at[item->from + k].item] = true;
    }
}

static void
compute_items(multiplication *m, const bool *wanted)
{
    for (uint32_t i = 0; i <= m->item; i++)
        for (size_t k = 0; wanted[i] && k < m->list->items.at[i].n; k++)
            qdot_variables_find(&m->v, m->list->parts.at[m->list->items.at[i].from + k].e);
    qdot_variables_settle(&m->v);
    for (uint32_t i = 0; i <= m->item && !FAILED(m->pool); i++) {
        const qdot_multiply_item *item = &m->list->items.at[i];

        if (!wanted[i])
            continue;
        begin_polynomial(m, &m->value[i]);
        if (item->is_sum)
            add_parts(m, item, &m->value[i]);
        else
            multiply_parts(m, item, &m->value[i]);
    }
    if (!FAILED(m->pool))
        m->result = qdot_terms_write(&m->v, m->value[m->item].p, m->value[m->item].c);
    for (uint32_t i = 0; i <= m->item; i++)
        end_polynomial(m, &m->value[i]);
    qdot_variables_end(&m->v);
}

static void
multiply_guarded(void *user)
{
    multiplication *m = user;
    bool *wanted = qdot_calloc((size_t)m->item + 1, sizeof *wanted);

    m->v = (qdot_variables){.pool = m->pool};
    m->value = qdot_calloc((size_t)m->item + 1, sizeof *m->value);
    if (wanted == NULL || m->value == NULL) {
        qdot_pool_fail(m->pool);
    } else {
        mark_items(m, wanted);
        compute_items(m, wanted);
    }
    qdot_free(wanted);
    qdot_free(m->value);
}

qdot_expr
qdot_multiply_out(qdot_pool *pool, const qdot_multiply_list *list, uint32_t item)
{
    multiplication m = {.pool = pool, .list = list, .item = item};

    if (FAILED(pool))
        return QDOT_NIL;
    if (qdot_flint_run(pool, multiply_guarded, &m) != QDOT_OK)
        return qdot_pool_fail(pool);
    return FAILED(pool) ? QDOT_NIL : m.result;
}
