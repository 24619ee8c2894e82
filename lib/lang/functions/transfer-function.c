/* transfer-function.c -- the function transfer(F, e): how an observed quantity answers an input, in Laplace's s.
 *
 *     c (s - A)^-1 b + d = (sum of s^(n-1-k) c N_k b, k = 0 ... n-1)/p(s) + d,   N_0 = 1,
 *     N_k = A N_(k-1) + p_k,   p_k = -tr(A N_(k-1))/k,   p(s) = s^n + p_1 s^(n-1) + ... + p_n
 *
 * Source  Faddeev & Faddeeva, Computational Methods of Linear Algebra (1963), section 47.
 */
#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/functions/linear.h"
#include "lang/functions/quotient.h"
#include "lang/session/measured.h"
#include "mech/scene/things.h"
#include "normal/field/normal-form.h"
#include "normal/simplify/simplify.h"

typedef struct {
    qdot_session *s;
    qdot_pool *pool;
    qdot_facts facts;
    size_t n;
    bool numbers;
    qdot_expr *A, *N, *next; /* [n x n] */
    qdot_expr *b, *c, d;     /* [n] */
} job;

static qdot_expr
product_sum(const job *j, size_t n, const qdot_expr *a, size_t step, const qdot_expr *b, size_t other)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < n; i++)
        if (a[i * step] != QDOT_ZERO && b[i * other] != QDOT_ZERO)
            sum = qdot_add(j->pool, sum, qdot_mul(j->pool, a[i * step], b[i * other]));
    return qdot_simplify(j->pool, sum, &j->facts);
}

/* c N b; what in numbers is only the rounding of its terms is 0. */
static qdot_expr
numerator_term(const job *j)
{
    qdot_expr sum = QDOT_ZERO;
    double size = 0;

    for (size_t i = 0; i < j->n; i++) {
        const qdot_expr row = product_sum(j, j->n, j->N + i * j->n, 1, j->b, 1), term = qdot_mul(j->pool, j->c[i], row);

        sum = qdot_add(j->pool, sum, term);
        for (size_t k = 0; k < j->n && j->numbers; k++)
            size += fabs(fmpq_get_d(qdot_expr_rational(j->pool, j->c[i])) *
                         fmpq_get_d(qdot_expr_rational(j->pool, j->N[i * j->n + k])) *
                         fmpq_get_d(qdot_expr_rational(j->pool, j->b[k])));
    }
    if (j->numbers && fabs(fmpq_get_d(qdot_expr_rational(j->pool, sum))) < 1e-13 * size)
        return QDOT_ZERO;
    return qdot_simplify(j->pool, sum, &j->facts);
}

/* The quotient of both polynomials in s. */
static qdot_expr
quotient_in_s(job *j, qdot_expr s)
{
    qdot_pool *pool = j->pool;
    const size_t n = j->n;
    qdot_expr p = qdot_pow_int(pool, s, (int64_t)n), top = QDOT_ZERO;

    for (size_t i = 0; i < n * n; i++)
        j->N[i] = i % (n + 1) == 0 ? QDOT_ONE : QDOT_ZERO;
    for (size_t k = 1; k <= n; k++) {
        qdot_expr trace = QDOT_ZERO;

        top = qdot_add(pool, top, qdot_mul(pool, numerator_term(j), qdot_pow_int(pool, s, (int64_t)(n - k))));
        for (size_t i = 0; i < n * n; i++)
            j->next[i] = product_sum(j, n, j->A + i / n * n, 1, j->N + i % n, n);
        for (size_t i = 0; i < n; i++)
            trace = qdot_add(pool, trace, j->next[i * (n + 1)]);
        trace = qdot_simplify(pool, qdot_div(pool, qdot_neg(pool, trace), qdot_expr_int(pool, (int64_t)k)), &j->facts);
        p = qdot_add(pool, p, qdot_mul(pool, trace, qdot_pow_int(pool, s, (int64_t)(n - k))));
        for (size_t i = 0; i < n * n; i++)
            j->N[i] = i % (n + 1) == 0 ? qdot_simplify(pool, qdot_add(pool, j->next[i], trace), &j->facts) : j->next[i];
        if (qdot_pool_failed(pool))
            return QDOT_NIL;
    }
    top = qdot_add(pool, top, qdot_mul(pool, j->d, p));
    return qdot_div(pool, top, p);
}

/* A quotient whose numerator and denominator are sums over powers of s. */
static qdot_expr
collected_quotient(qdot_pool *pool, qdot_expr e, qdot_expr s)
{
    qdot_expr top, bottom;

    if (e == QDOT_NIL || (qdot_expr_kind(pool, e) != QDOT_PROD && qdot_expr_kind(pool, e) != QDOT_SUM))
        return e;
    qdot_quotient_split(pool, e, &top, &bottom);
    return qdot_div(pool, qdot_collect(pool, top, s), qdot_collect(pool, bottom, s));
}

static qdot_status
fill_job(job *j, const qdot_linear *linear, size_t input, qdot_expr e)
{
    const size_t n = j->n, m = qdot_expr_count(j->pool, linear->inputs);
    qdot_expr *row = qdot_calloc(n + m + 1, sizeof *row);
    qdot_status status = row == NULL ? QDOT_ENOMEM : qdot_linear_row(j->s, linear, e, row);

    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        j->A[i] = qdot_measured_as_rationals(j->s, qdot_expr_arg(j->pool, linear->A, (uint32_t)i));
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        j->b[i] = qdot_measured_as_rationals(j->s, qdot_expr_arg(j->pool, linear->B, (uint32_t)(i * m + input)));
        j->c[i] = qdot_measured_as_rationals(j->s, row[i]);
    }
    if (status == QDOT_OK)
        j->d = qdot_measured_as_rationals(j->s, row[n + input]);
    for (size_t i = 0; i < n && status == QDOT_OK && j->numbers; i++)
        j->numbers = qdot_expr_rational(j->pool, j->c[i]) != NULL;
    qdot_free(row);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

qdot_status
qdot_call_transfer(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    const qdot_linear *linear;
    const qdot_expr symbol = qdot_quotient_laplace(s);
    job j = {.s = s, .pool = pool, .facts = qdot_scene_facts(s->scene)};
    size_t input = 0;
    qdot_status status;

    (void)n;
    QDOT_TRY(qdot_linear_latest(s, &linear));
    while (input < qdot_expr_count(pool, linear->inputs) && qdot_expr_arg(pool, linear->inputs, (uint32_t)input) != args[0])
        input++;
    if (input == qdot_expr_count(pool, linear->inputs) || !qdot_expr_is_scalar(pool, args[1])) {
        (void)qdot_fail(QDOT_ETYPE, "transfer(F, e) takes an input and what it moves");
        return qdot_hint("input F; linearize at equilibria[1]; transfer(F, theta)");
    }
    if (linear->B == QDOT_NIL)
        return qdot_fail(QDOT_EINVAL, "the linear motion has no state that an input could move");
    j.n = qdot_expr_count(pool, linear->states);
    j.numbers = linear->numbers != 0;
    j.A = qdot_calloc(3 * j.n * j.n + 2 * j.n + 1, sizeof *j.A);
    if (j.A == NULL)
        return QDOT_ENOMEM;
    j.N = j.A + j.n * j.n;
    j.next = j.N + j.n * j.n;
    j.b = j.next + j.n * j.n;
    j.c = j.b + j.n;
    status = fill_job(&j, linear, input, args[1]);
    if (status == QDOT_OK)
        status = qdot_value_kind_give(pool, qdot_normal(pool, quotient_in_s(&j, symbol), &j.facts), value);
    if (status == QDOT_OK)
        status = qdot_value_kind_give(pool, collected_quotient(pool, *value, symbol), value);
    qdot_free(j.A);
    return status;
}
