/* growth.c -- limits at infinity of functions of exponentials and logarithms, by Gruntz's algorithm. */
#include "normal/calculus/growth.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/calculus/expansion.h"
#include "normal/prove/decide.h"

enum { MOST_FASTEST = 12, DEEPEST = 24, MOST_NESTING = 60, MOST_SHIFTS = 6 };

/* Expressions of one comparability class: x itself or exponentials. */
typedef struct {
    qdot_expr at[MOST_FASTEST];
    size_t n;
} class;

static qdot_status find_fastest(qdot_growth *g, qdot_expr e, int nesting, class *found);

static bool
is_exponential(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function(pool, e, QDOT_EXP);
}

/* --- comparing growth ------------------------------------------------------------------------------- */

static qdot_expr
logarithm_of(const qdot_growth *g, qdot_expr f)
{
    return f == g->x ? qdot_fun1(g->pool, QDOT_LOG, g->x) : qdot_expr_arg(g->pool, f, 0);
}

/* 1 if f grows or decays faster than h, -1 if slower, 0 if both are of one class. */
static qdot_status
compare_growth(qdot_growth *g, qdot_expr f, qdot_expr h, int *faster)
{
    qdot_expr limit;

    *faster = 0;
    if (f == h)
        return QDOT_OK;
    QDOT_TRY(qdot_growth_limit(g, qdot_div(g->pool, logarithm_of(g, f), logarithm_of(g, h)), &limit));
    *faster = limit == QDOT_ZERO ? -1 : qdot_infinite(g->pool, limit) != 0 ? 1 : 0;
    return QDOT_OK;
}

static qdot_status
join(class *a, const class *b)
{
    for (size_t i = 0; i < b->n; i++) {
        if (qdot_expr_place(a->n, a->at, b->at[i]) < a->n)
            continue;
        if (a->n == MOST_FASTEST)
            return QDOT_EFAILED;
        a->at[a->n++] = b->at[i];
    }
    return QDOT_OK;
}

/* a = the faster of a and b; both where they are of one class. */
static qdot_status
keep_faster(qdot_growth *g, class *a, const class *b)
{
    int faster;

    if (b->n == 0)
        return QDOT_OK;
    if (a->n == 0) {
        *a = *b;
        return QDOT_OK;
    }
    QDOT_TRY(compare_growth(g, a->at[0], b->at[0], &faster));
    if (faster < 0)
        *a = *b;
    return faster == 0 ? join(a, b) : QDOT_OK;
}

/* The fastest of exp(u), which is one itself where u is unbounded. */
static qdot_status
find_fastest_of_exponential(qdot_growth *g, qdot_expr e, int nesting, class *found)
{
    const qdot_expr u = qdot_expr_arg(g->pool, e, 0);
    const class itself = {.at = {e}, .n = 1};
    qdot_expr limit;

    QDOT_TRY(find_fastest(g, u, nesting, found));
    QDOT_TRY(qdot_growth_limit(g, u, &limit));
    return qdot_infinite(g->pool, limit) != 0 ? keep_faster(g, found, &itself) : QDOT_OK;
}

/* The most rapidly varying subexpressions of e. */
static qdot_status
find_fastest(qdot_growth *g, qdot_expr e, int nesting, class *found)
{
    qdot_pool *pool = g->pool;
    const uint32_t n = qdot_expr_count(pool, e);

    *found = (class){.n = 0};
    if (!qdot_expr_contains(pool, e, g->x))
        return QDOT_OK;
    if (e == g->x) {
        *found = (class){.at = {e}, .n = 1};
        return QDOT_OK;
    }
    if (nesting > MOST_NESTING)
        return QDOT_EFAILED;
    if (is_exponential(pool, e))
        return find_fastest_of_exponential(g, e, nesting + 1, found);
    if (qdot_expr_kind(pool, e) != QDOT_SUM && qdot_expr_kind(pool, e) != QDOT_PROD &&
        qdot_expr_kind(pool, e) != QDOT_FUN)
        return QDOT_EFAILED;
    for (uint32_t i = 0; i < n; i++) {
        class part;

        QDOT_TRY(find_fastest(g, qdot_expr_arg(pool, e, i), nesting + 1, &part));
        QDOT_TRY(keep_faster(g, found, &part));
    }
    return QDOT_OK;
}

/* b^p with x in p as exp(p log b), throughout e. */
static qdot_expr
power_as_exponential(qdot_pool *pool, qdot_expr e, void *user)
{
    const qdot_growth *g = user;
    qdot_expr product;

    product = qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);

        product = qdot_mul(pool, product,
                           qdot_expr_rational(pool, p) != NULL ||
                                   (!qdot_expr_contains(pool, p, g->x) && !qdot_expr_contains(pool, b, g->x))
                               ? qdot_pow(pool, b, p)
                               : qdot_fun1(pool, QDOT_EXP, qdot_mul(pool, p, qdot_fun1(pool, QDOT_LOG, b))));
    }
    return product;
}

/* --- the first term ----------------------------------------------------------------------------------- */

/* The member of the smallest expression; it holds no other one. */
static qdot_expr
simplest_of(const qdot_pool *pool, const class *fastest)
{
    qdot_expr best = fastest->at[0];

    for (size_t i = 1; i < fastest->n; i++)
        if (qdot_expr_size(pool, fastest->at[i]) < qdot_expr_size(pool, best) ||
            (qdot_expr_size(pool, fastest->at[i]) == qdot_expr_size(pool, best) &&
             qdot_expr_compare(pool, fastest->at[i], best) < 0))
            best = fastest->at[i];
    return best;
}

/* The largest member not yet done. */
static size_t
largest_of(const qdot_pool *pool, const class *fastest)
{
    size_t best = 0;

    for (size_t i = 1; i < fastest->n; i++)
        if (qdot_expr_size(pool, fastest->at[i]) > qdot_expr_size(pool, fastest->at[best]) ||
            (qdot_expr_size(pool, fastest->at[i]) == qdot_expr_size(pool, fastest->at[best]) &&
             fastest->at[i] > fastest->at[best]))
            best = i;
    return best;
}

/* Write all of the class in e as powers of w = exp(-|h|), times slower factors; *log_w = -|h|. */
static qdot_status
write_in_small(qdot_growth *g, class fastest, qdot_expr *e, qdot_expr *log_w)
{
    qdot_pool *pool = g->pool;
    const qdot_expr h = qdot_expr_arg(pool, simplest_of(pool, &fastest), 0);
    qdot_expr limit;
    int sign;

    QDOT_TRY(qdot_growth_limit(g, h, &limit));
    sign = qdot_infinite(pool, limit);
    if (sign == 0)
        return QDOT_EFAILED;
    *log_w = sign > 0 ? qdot_neg(pool, h) : h;
    while (fastest.n > 0) {
        const size_t k = largest_of(pool, &fastest);
        const qdot_expr f = fastest.at[k], s = qdot_expr_arg(pool, f, 0);
        qdot_expr c, slower, power;

        fastest.at[k] = fastest.at[--fastest.n];
        QDOT_TRY(qdot_growth_limit(g, qdot_div(pool, s, h), &c));
        if (qdot_expr_rational(pool, c) == NULL || c == QDOT_ZERO)
            return QDOT_EFAILED;
        slower = qdot_expand(pool, qdot_sub(pool, s, qdot_mul(pool, c, h)));
        power = qdot_pow(pool, g->w, sign > 0 ? qdot_neg(pool, c) : c);
        power = qdot_mul(pool, power, qdot_fun1(pool, QDOT_EXP, slower));
        *e = qdot_subs(pool, *e, 1, &f, &power);
        QDOT_TRY(qdot_pool_check(pool));
    }
    return QDOT_OK;
}

/* e = coefficient w^(n/d) + ..., where the coefficient varies more slowly. */
static qdot_status
find_first_term(qdot_growth *g, qdot_expr e, qdot_expr *coefficient, int64_t *n, int64_t *d)
{
    qdot_pool *pool = g->pool;
    qdot_expansion expansion = {.pool = pool, .facts = g->facts, .w = g->w};
    class fastest;
    qdot_status status;

    *coefficient = e;
    *n = 0;
    *d = 1;
    if (!qdot_expr_contains(pool, e, g->x))
        return QDOT_OK;
    e = qdot_walk_replace(pool, e, QDOT_PROD, power_as_exponential, g);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(find_fastest(g, e, 0, &fastest));
    if (fastest.n == 0)
        return QDOT_OK;
    for (int k = 0; qdot_expr_place(fastest.n, fastest.at, g->x) < fastest.n; k++) { /* x = exp(X), once more x */
        const qdot_expr up = qdot_fun1(pool, QDOT_EXP, g->x);

        if (k == MOST_SHIFTS)
            return QDOT_EFAILED;
        e = qdot_subs(pool, e, 1, &g->x, &up);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(find_fastest(g, e, 0, &fastest));
    }
    QDOT_TRY(write_in_small(g, fastest, &e, &expansion.log_w));
    status = qdot_expansion_lead(&expansion, e, coefficient, n, d);
    g->undefined = g->undefined || expansion.undefined;
    return status;
}

/* --- questions ------------------------------------------------------------------------------------------- */

static qdot_status
begin_question(qdot_growth *g)
{
    QDOT_TRY(qdot_pool_check(g->pool));
    if (g->depth >= DEEPEST || g->work <= 0)
        return QDOT_EFAILED;
    g->depth++;
    g->work--;
    return QDOT_OK;
}

static qdot_status
end_question(qdot_growth *g, qdot_status status)
{
    g->depth--;
    return status == QDOT_EDOMAIN || status == QDOT_ETYPE || status == QDOT_ELIMIT ? QDOT_EFAILED : status;
}

static qdot_status
answer_sign(qdot_growth *g, qdot_expr e, int *sign)
{
    qdot_expr c;
    int64_t n, d;

    QDOT_TRY(find_first_term(g, e, &c, &n, &d));
    if (qdot_expr_contains(g->pool, c, g->x))
        return qdot_growth_sign(g, c, sign);
    *sign = qdot_proved_sign(g->pool, c, g->facts);
    if (*sign == 2 && g->undecided == QDOT_NIL)
        g->undecided = c;
    return *sign == 2 ? QDOT_EFAILED : QDOT_OK;
}

qdot_status
qdot_growth_sign(qdot_growth *g, qdot_expr e, int *sign)
{
    if (e == QDOT_NIL)
        return QDOT_EFAILED;
    QDOT_TRY(begin_question(g));
    return end_question(g, answer_sign(g, e, sign));
}

/* Whether e = c x^p log(x)^q with a c free of x; *order: 1 where it grows, -1 where it vanishes, 0 where it is c. */
static bool
is_power_with_logarithm(const qdot_growth *g, qdot_expr e, qdot_expr *c, int *order)
{
    qdot_pool *pool = g->pool;
    const qdot_expr log_x = qdot_fun1(pool, QDOT_LOG, g->x);
    int by_x = 0, by_log = 0;

    *c = QDOT_ONE;
    if (e == g->x || e == log_x) {
        *order = 1;
        return true;
    }
    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return false;
    *c = qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        const fmpq *number = qdot_expr_rational(pool, p);

        if ((b == g->x || b == log_x) && number != NULL)
            *(b == g->x ? &by_x : &by_log) = fmpq_sgn(number);
        else if (!qdot_expr_contains(pool, b, g->x) && !qdot_expr_contains(pool, p, g->x))
            *c = qdot_mul(pool, *c, qdot_pow(pool, b, p));
        else
            return false;
    }
    *order = by_x != 0 ? by_x : by_log;
    return *c != QDOT_NIL;
}

/* e = front exp(log), front free of x: e is an exponential or a product with one; nil in *log: it is neither. */
static qdot_status
read_logarithm(qdot_growth *g, qdot_expr e, qdot_expr *front, qdot_expr *log)
{
    qdot_pool *pool = g->pool;
    bool is_one = false;

    *front = QDOT_ONE;
    *log = is_exponential(pool, e) ? qdot_expr_arg(pool, e, 0) : QDOT_NIL;
    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return QDOT_OK;
    *front = qdot_expr_arg(pool, e, 0);
    *log = QDOT_ZERO;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        const bool odd = qdot_expr_to_int(pool, p, &(int64_t){0}) && !qdot_expr_to_int(pool, qdot_mul(pool, QDOT_HALF, p), &(int64_t){0});
        int sign = 1;

        if (!qdot_expr_contains(pool, b, g->x)) {
            *front = qdot_mul(pool, *front, qdot_pow(pool, b, p));
        } else if (is_exponential(pool, b)) {
            *log = qdot_add(pool, *log, qdot_mul(pool, p, qdot_expr_arg(pool, b, 0)));
            is_one = true;
        } else {
            QDOT_TRY(qdot_growth_sign(g, b, &sign));
            if (sign == 0 || (sign < 0 && !qdot_expr_to_int(pool, p, &(int64_t){0})))
                return QDOT_EFAILED;
            *log = qdot_add(pool, *log, qdot_mul(pool, p, qdot_fun1(pool, QDOT_LOG, sign < 0 ? qdot_neg(pool, b) : b)));
        }
        *front = sign < 0 && odd ? qdot_neg(pool, *front) : *front;
    }
    *log = is_one ? qdot_expand(pool, *log) : QDOT_NIL;
    return QDOT_OK;
}

/* The limit by that of the logarithm, for exponents whose ratio is no rational number; QDOT_EFAILED: not found. */
static qdot_status
answer_by_logarithm(qdot_growth *g, qdot_expr e, qdot_expr *limit)
{
    qdot_pool *pool = g->pool;
    qdot_expr front, log;
    int sign;

    e = qdot_walk_replace(pool, e, QDOT_PROD, power_as_exponential, g);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(read_logarithm(g, e, &front, &log));
    if (log == QDOT_NIL)
        return QDOT_EFAILED;
    QDOT_TRY(qdot_growth_limit(g, log, limit));
    if (qdot_infinite(pool, *limit) == 0) {
        *limit = qdot_mul(pool, front, qdot_fun1(pool, QDOT_EXP, *limit));
        return QDOT_OK;
    }
    if (qdot_infinite(pool, *limit) < 0) {
        *limit = QDOT_ZERO;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_growth_sign(g, front, &sign));
    *limit = sign > 0 ? QDOT_INFINITY : qdot_neg(pool, QDOT_INFINITY);
    return sign == 0 ? QDOT_EFAILED : QDOT_OK;
}

static qdot_status
answer_limit(qdot_growth *g, qdot_expr e, qdot_expr *limit)
{
    qdot_status status;
    qdot_expr c;
    int64_t n, d;
    int sign;

    if (is_power_with_logarithm(g, e, &c, &sign)) {
        n = -sign;
        d = 1;
    } else {
        status = find_first_term(g, e, &c, &n, &d);
        if (status == QDOT_EFAILED && !g->undefined)
            return answer_by_logarithm(g, e, limit);
        QDOT_TRY(status);
    }
    if (n > 0 || c == QDOT_ZERO) {
        *limit = QDOT_ZERO;
        return QDOT_OK;
    }
    if (n == 0) {
        *limit = c;
        return qdot_expr_contains(g->pool, c, g->x) ? qdot_growth_limit(g, c, limit) : QDOT_OK;
    }
    QDOT_TRY(qdot_growth_sign(g, c, &sign));
    *limit = sign > 0 ? QDOT_INFINITY : qdot_neg(g->pool, QDOT_INFINITY);
    return sign == 0 ? QDOT_EFAILED : QDOT_OK;
}

qdot_status
qdot_growth_limit(qdot_growth *g, qdot_expr e, qdot_expr *limit)
{
    if (e == QDOT_NIL)
        return QDOT_EFAILED;
    if (!qdot_expr_contains(g->pool, e, g->x)) {
        *limit = e;
        return QDOT_OK;
    }
    if (e == g->x) {
        *limit = QDOT_INFINITY;
        return QDOT_OK;
    }
    QDOT_TRY(begin_question(g));
    return end_question(g, answer_limit(g, e, limit));
}
