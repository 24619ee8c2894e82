/* linear.c -- solves linear systems block by block, by Bareiss' fraction-free elimination over polynomials. */
#include "normal/solve/linear.h"

#include <inttypes.h>
#include <stdlib.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/field/field.h"
#include "normal/field/normal-form.h"
#include "normal/field/prepare.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/cramer.h"

#define WORK 30000000
/* An expanded solution is not simplified if it is this many times longer than that by Cramer's rule. */
#define TOO_LONG 4

/* Write the rows of [A b] as polynomials, each multiplied by the common denominator of its entries. */
static void
fill_rows(qdot_field *f, uint32_t n, fmpz_mpoly_struct *m, const qdot_expr *e)
{
    fmpz_mpoly_t all, g, k;

    fmpz_mpoly_init(all, f->ctx);
    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_init(k, f->ctx);
    for (uint32_t i = 0; i < n && qdot_field_goes(f); i++) {
        fmpz_mpoly_one(all, f->ctx);
        for (uint32_t j = 0; j <= n && qdot_field_goes(f); j++) {
            const qdot_ratio *r = qdot_field_value(f, e[i * (n + 1) + j]);

            qdot_field_gcd(f, g, all, r->d);
            fmpz_mpoly_divides(k, r->d, g, f->ctx);
            if (qdot_field_charge(f, fmpz_mpoly_length(all, f->ctx),
                                  fmpz_mpoly_length(k, f->ctx)))
                fmpz_mpoly_mul(all, all, k, f->ctx);
        }
        for (uint32_t j = 0; j <= n && qdot_field_goes(f); j++) {
            const qdot_ratio *r = qdot_field_value(f, e[i * (n + 1) + j]);

            fmpz_mpoly_divides(k, all, r->d, f->ctx);
            if (qdot_field_charge(f, fmpz_mpoly_length(r->n, f->ctx),
                                  fmpz_mpoly_length(k, f->ctx)))
                fmpz_mpoly_mul(m + i * (n + 1) + j, r->n, k, f->ctx);
        }
    }
    fmpz_mpoly_clear(all, f->ctx);
    fmpz_mpoly_clear(g, f->ctx);
    fmpz_mpoly_clear(k, f->ctx);
}

/* Whether the polynomial p is zero modulo the rewriting rules of the field. */
static bool
is_zero_by_rules(qdot_field *f, const fmpz_mpoly_t p)
{
    fmpz_mpoly_t x;
    bool zero;

    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_set(x, p, f->ctx);
    qdot_field_reduce(f, x);
    zero = fmpz_mpoly_is_zero(x, f->ctx);
    fmpz_mpoly_clear(x, f->ctx);
    return zero;
}

/* Charge a product of polynomials to the budget; coefficients count by their numbers of words of 64 bits. */
static bool
charge_product(qdot_field *f, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    const int64_t bits = llabs(fmpz_mpoly_max_bits(a)) + llabs(fmpz_mpoly_max_bits(b));

    return qdot_field_charge(f, (int64_t)fmpz_mpoly_length(a, f->ctx) * (1 + bits / 64),
                             fmpz_mpoly_length(b, f->ctx));
}

/* x = (p a - b c)/d, exact over the polynomials (the rules are not used: they would
 * spoil it). */
static void
bareiss_step(qdot_field *f, fmpz_mpoly_t x, const fmpz_mpoly_t p, const fmpz_mpoly_t a,
             const fmpz_mpoly_t b, const fmpz_mpoly_t c, const fmpz_mpoly_t d)
{
    fmpz_mpoly_t u, v;

    fmpz_mpoly_init(u, f->ctx);
    fmpz_mpoly_init(v, f->ctx);
    if (charge_product(f, p, a) && charge_product(f, b, c)) {
        fmpz_mpoly_mul(u, p, a, f->ctx);
        fmpz_mpoly_mul(v, b, c, f->ctx);
        fmpz_mpoly_sub(u, u, v, f->ctx);
        if (charge_product(f, u, d))
            fmpz_mpoly_divides(x, u, d, f->ctx);
    }
    fmpz_mpoly_clear(u, f->ctx);
    fmpz_mpoly_clear(v, f->ctx);
}

static void
swap_rows(qdot_field *f, fmpz_mpoly_struct *m, uint32_t n, uint32_t i, uint32_t k)
{
    for (uint32_t j = 0; j <= n && i != k; j++)
        fmpz_mpoly_swap(m + i * (n + 1) + j, m + k * (n + 1) + j, f->ctx);
}

/* The row, among those from k on, with the shortest non-zero entry in column k; n if all are zero. */
static uint32_t
find_pivot_row(qdot_field *f, const fmpz_mpoly_struct *m, uint32_t n, uint32_t k)
{
    uint32_t best = n;

    for (uint32_t i = k; i < n; i++) {
        const fmpz_mpoly_struct *p = m + i * (n + 1) + k;

        if (!is_zero_by_rules(f, p) &&
            (best == n || fmpz_mpoly_length(p, f->ctx) <
                              fmpz_mpoly_length(m + best * (n + 1) + k, f->ctx)))
            best = i;
    }
    return best;
}

/* Gauss-Jordan form of Bareiss: after step k every column up to k is diagonal with the
 * same entry, the leading minor; at the end x_i = m[i][n] / m[i][i]. */
static bool
eliminate_unknowns(qdot_field *f, uint32_t n, fmpz_mpoly_struct *m, uint32_t *pivot)
{
    fmpz_mpoly_t before, x;
    bool regular = true;

    fmpz_mpoly_init(before, f->ctx);
    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_one(before, f->ctx);
    for (uint32_t k = 0; k < n && regular && qdot_field_goes(f); k++) {
        uint32_t row = find_pivot_row(f, m, n, k);
        const fmpz_mpoly_struct *p = m + k * (n + 1) + k;

        regular = row < n;
        *pivot = k;
        if (!regular)
            break;
        swap_rows(f, m, n, k, row);
        for (uint32_t i = 0; i < n; i++) {
            if (i == k)
                continue;
            for (uint32_t j = 0; j <= n; j++) {
                if (j == k || (j < k && j != i))
                    continue;
                bareiss_step(f, x, p, m + i * (n + 1) + j, m + i * (n + 1) + k,
                             m + k * (n + 1) + j, before);
                fmpz_mpoly_swap(m + i * (n + 1) + j, x, f->ctx);
            }
            fmpz_mpoly_zero(m + i * (n + 1) + k, f->ctx);
        }
        fmpz_mpoly_set(before, p, f->ctx);
    }
    fmpz_mpoly_clear(before, f->ctx);
    fmpz_mpoly_clear(x, f->ctx);
    return regular;
}

static slong
terms_of(qdot_field *f, uint32_t n, const fmpz_mpoly_struct *m)
{
    slong terms = 0;

    for (uint32_t i = 0; i < n * (n + 1); i++)
        terms += fmpz_mpoly_length(m + i, f->ctx);
    return terms;
}

static qdot_status
solve_in_field(qdot_field *f, uint32_t n, const qdot_expr *e, qdot_expr *x,
               uint32_t *pivot)
{
    fmpz_mpoly_struct *m = qdot_malloc((size_t)n * (n + 1) * sizeof *m);
    qdot_status status = QDOT_OK;
    bool regular;

    if (m == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n * (n + 1); i++)
        fmpz_mpoly_init(m + i, f->ctx);
    fill_rows(f, n, m, e);
    regular = eliminate_unknowns(f, n, m, pivot);
    if (f->state == QDOT_FIELD_OVER)
        status = qdot_fail(QDOT_ELIMIT,
                           "past the work budget: more than %" PRId64 " terms in a system of "
                           "%u equations",
                           (int64_t)terms_of(f, n, m), n);
    else if (qdot_field_goes(f) && !regular)
        status = qdot_fail(QDOT_ESINGULAR,
                           "the system has no unique solution (column %u)", *pivot + 1);
    for (uint32_t i = 0; i < n && status == QDOT_OK && qdot_field_goes(f); i++) {
        qdot_ratio r;

        qdot_ratio_init(f, &r);
        fmpz_mpoly_set(r.n, m + i * (n + 1) + n, f->ctx);
        fmpz_mpoly_set(r.d, m + i * (n + 1) + i, f->ctx);
        qdot_field_reduce(f, r.n);
        qdot_field_reduce(f, r.d);
        qdot_ratio_cancel(f, &r);
        x[i] = qdot_field_ratio_expr(f, &r);
        qdot_ratio_clear(f, &r);
    }
    for (uint32_t i = 0; i < n * (n + 1); i++)
        fmpz_mpoly_clear(m + i, f->ctx);
    qdot_free(m);
    if (status == QDOT_OK && f->state == QDOT_FIELD_OVER)
        status =
            qdot_fail(QDOT_ELIMIT, "past the work budget: a system of %u equations", n);
    return status;
}

static qdot_status
solve(qdot_pool *pool, uint32_t n, const qdot_expr *A, const qdot_expr *b, qdot_expr *x,
      uint32_t *pivot, const qdot_facts *facts)
{
    qdot_expr *e = qdot_malloc(((size_t)n * (n + 1) + 1) * sizeof *e);
    qdot_status status;
    qdot_field f;

    *pivot = 0;
    if (e == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j <= n; j++) {
            qdot_expr entry = j < n ? A[i * n + j] : b[i];

            if (facts != NULL && facts->n_relations > 0)
                entry = qdot_normal(pool, entry, facts);
            e[i * (n + 1) + j] = qdot_prepare(pool, entry);
        }
    if (qdot_pool_failed(pool)) {
        qdot_free(e);
        return qdot_pool_check(pool);
    }
    qdot_field_begin(&f, pool, (size_t)n * (n + 1), e, WORK);
    if (qdot_field_goes(&f))
        status = solve_in_field(&f, n, e, x, pivot);
    else if (f.state == QDOT_FIELD_OVER)
        status =
            qdot_fail(QDOT_ELIMIT, "past the work budget: a system of %u equations", n);
    else if (f.state == QDOT_FIELD_UNDEFINED)
        status = qdot_fail(QDOT_EDOMAIN, "division by zero");
    else
        status = QDOT_OK;
    if (f.state == QDOT_FIELD_FAILED)
        status = f.status;
    qdot_field_end(&f);
    qdot_free(e);
    if (status == QDOT_OK && qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    return status;
}

/* The number of operations in all entries e [n]. */
static uint64_t
count_operations(const qdot_pool *pool, size_t n, const qdot_expr *e)
{
    uint64_t sum = 0;

    for (size_t i = 0; i < n; i++)
        sum += qdot_expr_size(pool, e[i]);
    return sum;
}

/* Simplify all e that are not nil at once, so that common subexpressions are simplified once. */
static qdot_status
simplify_all(qdot_pool *pool, uint32_t n, qdot_expr *e, const qdot_facts *facts)
{
    qdot_expr *some = qdot_malloc(((size_t)n + 1) * sizeof *some), all;
    uint32_t count = 0;

    if (some == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++)
        if (e[i] != QDOT_NIL)
            some[count++] = e[i];
    all = count == 0 ? QDOT_NIL : qdot_simplify(pool, qdot_list(pool, count, some), facts);
    count = 0;
    for (uint32_t i = 0; i < n && all != QDOT_NIL; i++)
        if (e[i] != QDOT_NIL)
            e[i] = qdot_expr_arg(pool, all, count++);
    qdot_free(some);
    return qdot_pool_check(pool);
}

/* Each x the simpler of what elimination gave (status: or did not) and Cramer's rule, which is
 * asked where that is longer than what was given: multiplied out, long entries make a solution
 * too long to be found or to be read. */
static qdot_status
choose_simplest_solution(qdot_pool *pool, uint32_t n, const qdot_expr *A, const qdot_expr *b,
                         qdot_expr *x, const qdot_facts *facts, qdot_status status)
{
    qdot_expr y[QDOT_CRAMER_MOST];
    bool known = status == QDOT_OK, asked = false;

    if (n <= QDOT_CRAMER_MOST && (known || status == QDOT_ELIMIT))
        asked = !known || count_operations(pool, n, x) >
                              count_operations(pool, n * n, A) + count_operations(pool, n, b);
    if (asked && !known) {
        qdot_decision d;

        QDOT_TRY(qdot_decide_equal(pool, qdot_cramer_determinant(pool, n, A), QDOT_ZERO,
                                   facts, &d));
        if (d.verdict != QDOT_REFUTED)
            return qdot_fail(QDOT_ELIMIT,
                             "past the work budget: whether a system of %u equations has "
                             "one solution is not decided",
                             n);
        status = QDOT_OK;
    }
    if (asked)
        QDOT_TRY(qdot_cramer(pool, n, A, b, y));
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        if (!known || (asked && qdot_expr_size(pool, x[i]) >
                                    TOO_LONG * qdot_expr_size(pool, y[i])))
            x[i] = QDOT_NIL;
    if (status == QDOT_OK)
        status = simplify_all(pool, n, x, facts);
    for (uint32_t i = 0; i < n && asked && status == QDOT_OK; i++)
        if (x[i] != QDOT_NIL && qdot_expr_size(pool, y[i]) >= qdot_expr_size(pool, x[i]))
            y[i] = QDOT_NIL;
    if (asked && status == QDOT_OK)
        status = simplify_all(pool, n, y, facts);
    for (uint32_t i = 0; i < n && asked && status == QDOT_OK; i++)
        if (y[i] != QDOT_NIL)
            x[i] = y[i];
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

struct system {
    qdot_pool *pool;
    uint32_t n;
    const qdot_expr *A, *b;
    qdot_expr *x;
    uint32_t *pivot;
    const qdot_facts *facts;
    qdot_status status;
};

/* Solve block number k of the system: the m unknowns whose entry in `block` is k. */
static qdot_status
solve_block(struct system *s, uint32_t k, uint32_t m, const uint32_t *block)
{
    qdot_expr *A = qdot_malloc(((size_t)m * m + 2 * m) * sizeof *A), *b, *x;
    uint32_t at = 0, row = 0, pivot = 0;
    qdot_status status;

    if (A == NULL)
        return QDOT_ENOMEM;
    b = A + (size_t)m * m;
    x = b + m;
    for (uint32_t i = 0; i < s->n; i++) {
        if (block[i] != k)
            continue;
        b[row++] = s->b[i];
        for (uint32_t j = 0; j < s->n; j++)
            if (block[j] == k)
                A[at++] = s->A[i * s->n + j];
    }
    status = solve(s->pool, m, A, b, x, &pivot, s->facts);
    status = choose_simplest_solution(s->pool, m, A, b, x, s->facts, status);
    for (uint32_t i = 0, to = 0; i < s->n; i++) {
        if (block[i] != k)
            continue;
        if (to == pivot)
            *s->pivot = i;
        s->x[i] = x[to++];
    }
    qdot_free(A);
    return status;
}

/* Set block[i] to the first unknown to which unknown i is coupled, directly or through others. */
static void
find_blocks(uint32_t n, const qdot_expr *A, uint32_t *block)
{
    for (uint32_t i = 0; i < n; i++)
        block[i] = i;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t from = block[i] > block[j] ? block[i] : block[j];
            uint32_t to = block[i] > block[j] ? block[j] : block[i];

            for (uint32_t l = 0; l < n && from != to && A[i * n + j] != QDOT_ZERO; l++)
                if (block[l] == from)
                    block[l] = to;
        }
}

static void
solve_system_task(void *user)
{
    struct system *s = user;
    uint32_t *block = qdot_malloc((s->n + 1) * sizeof *block);

    s->status = block == NULL ? QDOT_ENOMEM : QDOT_OK;
    if (block == NULL)
        return;
    find_blocks(s->n, s->A, block);
    for (uint32_t k = 0; k < s->n && s->status == QDOT_OK; k++) {
        uint32_t m = 0;

        for (uint32_t i = 0; i < s->n; i++)
            m += block[i] == k;
        if (m > 0)
            s->status = solve_block(s, k, m, block);
    }
    qdot_free(block);
}

qdot_status
qdot_solve_linear(qdot_pool *pool, uint32_t n, const qdot_expr *A, const qdot_expr *b,
                  qdot_expr *x, uint32_t *pivot, const qdot_facts *facts)
{
    struct system s = {pool, n, A, b, x, pivot, facts, QDOT_OK};

    QDOT_TRY(qdot_flint_run(pool, solve_system_task, &s));
    return s.status;
}
