/* generic.c -- expressions in double at a point: for ranks at generic configurations
 * only. */
#include "mech/dynamics/generic.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/elliptic.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/jacobi.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "num/samples.h"

static double
least(const double *x, uint32_t n)
{
    double y = x[0];

    for (uint32_t i = 1; i < n; i++)
        y = fmin(y, x[i]);
    return y;
}

static double
greatest(const double *x, uint32_t n)
{
    double y = x[0];

    for (uint32_t i = 1; i < n; i++)
        y = fmax(y, x[i]);
    return y;
}

/* The value f(x[0] ... x[n-1]) of an elementary function. */
static double
function_value(qdot_fun_id id, const double *x, uint32_t n)
{
    switch (id) {
#define X(ID, name, few, most, traits, lo, hi, inverse, operation, value, ...) case QDOT_##ID: return value;
#include "expr/function.def"
#undef X
    case QDOT_HOLD: return x[0];
    case QDOT_LOOKUP: return n == 2 ? qdot_samples_lookup(x[1], x[0]) : NAN;
    default: return NAN;
    }
}

static double
rational_as_double(const fmpq *x)
{
    slong p, q;
    double a = fmpz_get_d_2exp(&p, fmpq_numref(x));
    double b = fmpz_get_d_2exp(&q, fmpq_denref(x));
    slong shift = p - q;

    return ldexp(a / b, shift > 5000 ? 5000 : shift < -5000 ? -5000 : (int)shift);
}

/* A pseudo-random number in (0, 1) that depends only on a name and a seed. */
static double
pseudo_random(const char *name, uint64_t seed)
{
    uint64_t h = seed * 0x9e3779b97f4a7c15u + 0x1234567;

    for (; *name; name++)
        h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    h ^= h >> 31;
    return ((double)(h >> 11) + 0.5) / 9007199254740992.0;
}

static bool
bound_as_double(const qdot_pool *pool, qdot_expr e, double *value)
{
    const fmpq *x = e == QDOT_NIL ? NULL : qdot_expr_rational(pool, e);

    if (e == QDOT_PI)
        *value = M_PI;
    else if (x)
        *value = rational_as_double(x);
    return x || e == QDOT_PI;
}

double
qdot_generic_value(const qdot_pool *pool, qdot_expr e, uint64_t seed)
{
    const qdot_symbol *x = qdot_expr_symbol(pool, e);
    double u = pseudo_random(x->name, seed), lo = 0, hi = 0;
    bool above = bound_as_double(pool, x->lo, &lo), below = bound_as_double(pool, x->hi, &hi);

    if (e == QDOT_PI)
        return M_PI;
    if (above && below)
        return lo + (hi - lo) * (0.1 + 0.8 * u);
    if (above)
        return lo + 0.5 + u;
    if (below)
        return hi - 0.5 - u;
    if ((x->sign & QDOT_NEG) == QDOT_NEG)
        return -0.5 - u;
    return x->class == QDOT_PARAM || x->sign & QDOT_GE0 ? 0.5 + u : 3 * u - 1.5;
}

static double
power_of_doubles(double b, double e)
{
    return e == 1 ? b : e == -1 ? 1 / b : pow(b, e);
}

/* The value of an expression from the values x [n] of its arguments. */
static double
evaluate_node(const qdot_node *node, const double *x)
{
    double v;

    switch (node->kind) {
    case QDOT_SUM:
        v = x[0];
        for (uint32_t i = 1; i + 1 < node->n; i += 2)
            v += x[i] * x[i + 1];
        return v;
    case QDOT_PROD:
        v = x[0];
        for (uint32_t i = 1; i + 1 < node->n; i += 2)
            v *= power_of_doubles(x[i], x[i + 1]);
        return v;
    case QDOT_FUN:
        return function_value((qdot_fun_id)node->op, x, node->n);
    case QDOT_REL:
        return node->op == QDOT_LT ? x[0] < x[1] : node->op == QDOT_LE ? x[0] <= x[1]
                                                                       : x[0] == x[1];
    case QDOT_LOGIC:
        v = node->op == QDOT_AND;
        if (node->op == QDOT_NOT)
            return x[0] == 0;
        for (uint32_t i = 0; i < node->n; i++)
            v = node->op == QDOT_AND ? v != 0 && x[i] != 0 : v != 0 || x[i] != 0;
        return v;
    default:
        return NAN;
    }
}

static double
get_double(const qdot_walk *w, qdot_expr e)
{
    uint64_t bits = qdot_walk_get(w, e);
    double v;

    memcpy(&v, &bits, sizeof v);
    return v;
}

static void
set_double(qdot_walk *w, qdot_expr e, double v)
{
    uint64_t bits;

    memcpy(&bits, &v, sizeof bits);
    qdot_walk_set(w, e, bits);
}

qdot_status
qdot_generic_evaluate(const qdot_pool *pool, size_t n, const qdot_expr *e,
                      const qdot_generic_point *at, double *out)
{
    static const qdot_generic_point nothing = {.seed = 1};
    qdot_walk w;
    qdot_vec(double) x = {0};
    qdot_status status = QDOT_OK;

    if (at == NULL)
        at = &nothing;
    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        const qdot_node *node = qdot_expr_node(pool, w.at[i]);
        char name[24];

        if (node->kind == QDOT_NUM) {
            set_double(&w, w.at[i], rational_as_double(qdot_expr_rational(pool, w.at[i])));
            continue;
        }
        if (node->kind == QDOT_SYM) {
            double v = qdot_generic_value(pool, w.at[i], at->seed);

            for (size_t k = 0; k < at->m; k++)
                if (at->symbols[k] == w.at[i])
                    v = at->values[k];
            set_double(&w, w.at[i], v);
            continue;
        }
        if (node->kind == QDOT_UFUN) {
            name[0] = 'u';
            for (int k = 0; k < 8; k++)
                name[k + 1] = (char)('a' + (w.at[i] >> 4 * k & 15));
            name[9] = '\0';
            set_double(&w, w.at[i], 0.5 + pseudo_random(name, at->seed));
            continue;
        }
        status = qdot_grow(&x.at, &x.capacity, node->n + 1u, sizeof *x.at);
        if (status != QDOT_OK)
            break;
        for (uint32_t k = 0; k < node->n; k++)
            x.at[k] = get_double(&w, qdot_expr_args(pool, w.at[i])[k]);
        set_double(&w, w.at[i], evaluate_node(node, x.at));
    }
    qdot_free(x.at);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        out[i] = get_double(&w, e[i]);
    qdot_walk_end(&w);
    return status;
}

qdot_expr
qdot_generic_decimal(qdot_pool *pool, double x)
{
    qdot_text text = {0};
    qdot_expr e;

    qdot_text_double(&text, x, 15);
    e = qdot_text_status(&text) != QDOT_OK ? qdot_pool_fail(pool)
        : text.at[0] == '-'
            ? qdot_neg(pool, qdot_expr_decimal(pool, text.at + 1, text.n - 1))
            : qdot_expr_decimal(pool, text.at, text.n);
    qdot_text_clear(&text);
    return e;
}
