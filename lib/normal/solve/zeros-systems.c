/* zeros-systems.c -- writes equations as products, and in new variables (charts) that reach to infinity. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/solve/solve.h"
#include "normal/solve/zeros-parts.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS, SIZE = 4000, FACTORS = 64 };

/* --- factors of an equation ------------------------------------------------------------------------ */

/* A factor without powers and without parts that never vanish: b for b^p with p > 0; nil if it
 * never vanishes. */
static qdot_expr
factor_that_may_be_zero(const qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *x)
{
    for (;;) {
        const qdot_node *node = qdot_expr_node(pool, e);

        if (node->sign & QDOT_NE0)
            return QDOT_NIL;
        if (node->kind == QDOT_FUN && (node->op == QDOT_EXP || node->op == QDOT_COSH))
            return QDOT_NIL;
        if (node->kind == QDOT_PROD && node->n == 3) {
            const fmpq *p = qdot_expr_rational(pool, qdot_expr_arg(pool, e, 2));

            if (p != NULL && fmpq_sgn(p) > 0) {
                e = qdot_expr_arg(pool, e, 1);
                continue;
            }
        }
        break;
    }
    if (!qdot_expr_contains_any(pool, e, n, x)) {
        qdot_interval c = qdot_ball_bounds((qdot_pool *)pool, e);

        if (c.lo > 0 || c.hi < 0)
            return QDOT_NIL;
    }
    return e;
}

/* Whether f/g seems to be a constant, judged by its values at two points. */
static bool
seems_multiple(qdot_pool *pool, qdot_expr f, qdot_expr g, size_t n, const qdot_expr *x)
{
    static const double places[2][MOST] = {
        {0.3717, 0.6113, 0.4591, 0.2339, 0.1723, 0.9127},
        {0.8291, 0.2477, 0.7853, 0.5119, 0.6421, 0.3389}};
    const qdot_expr both[] = {f, g};
    qdot_enclosure *s;
    double ratio[2];
    bool same = true;

    if (qdot_enclosure_new(pool, 2, both, n, x, &s) != QDOT_OK)
        return false;
    for (int k = 0; k < 2 && same; k++) {
        qdot_interval X[MOST];
        qdot_interval a, b;

        for (size_t j = 0; j < n; j++)
            X[j] = qdot_interval_point(places[k][j]);
        qdot_enclosure_eval(s, X, false);
        a = qdot_enclosure_get(s, 0)->y;
        b = qdot_enclosure_get(s, 1)->y;
        ratio[k] = (a.lo + a.hi) / (b.lo + b.hi);
        same = isfinite(ratio[k]) && fabs(a.hi - a.lo) < 1e-9 * fabs(a.hi);
    }
    qdot_enclosure_free(s);
    return same && fabs(ratio[0] - ratio[1]) < 1e-8 * fabs(ratio[0]);
}

qdot_status
qdot_zeros_factors(qdot_pool *pool, qdot_expr f, size_t n, const qdot_expr *x,
                   qdot_expr *list)
{
    qdot_expr all, kept[FACTORS];
    uint32_t count = 0;

    *list = qdot_list(pool, 1, &f);
    if (qdot_expr_size(pool, f) > SIZE)
        return qdot_pool_check(pool);
    all = qdot_solve_factors(pool, f);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_count(pool, all) > FACTORS)
        return QDOT_OK;
    for (uint32_t i = 0; i < qdot_expr_count(pool, all); i++) {
        qdot_expr one = qdot_expr_arg(pool, all, i);

        if (one == QDOT_ZERO)
            return qdot_fail(QDOT_EDOMAIN, "the equation holds everywhere");
        one = factor_that_may_be_zero(pool, one, n, x);
        if (one != QDOT_NIL && qdot_expr_place(count, kept, one) == count)
            kept[count++] = one;
    }
    if (count == 1 && seems_multiple(pool, f, kept[0], n, x))
        kept[0] =
            f; /* keep f as it was typed: its enclosures are tighter than those of the expanded form */
    *list = qdot_list(pool, count, kept);
    return qdot_pool_check(pool);
}

/* --- charts that reach to infinity ----------------------------------------------------------------------- */

/* The size R of the inner box |x| <= R: beyond every finite bound, and not a round number. */
static double
size_of_inner_box(size_t n, const qdot_interval *bounds)
{
    double R = 1.37;

    for (size_t j = 0; j < n; j++) {
        if (isfinite(bounds[j].lo))
            R = fmax(R, 1.7 * fabs(bounds[j].lo));
        if (isfinite(bounds[j].hi))
            R = fmax(R, 1.7 * fabs(bounds[j].hi));
    }
    return R;
}

static bool
is_unbounded_interval(qdot_interval a)
{
    return isinf(a.lo) || isinf(a.hi);
}

/* A symbol for the new variables of the charts: s > 0, y_i, or y_i > 0. */
static qdot_expr
chart_symbol(qdot_pool *pool, char kind, size_t i)
{
    char name[40];
    qdot_expr e;

    snprintf(name, sizeof name, "chart#%c%zu", kind, i);
    e = qdot_symbol_get(pool, QDOT_FORMAL, name);
    if (e != QDOT_NIL && kind != 'y' && qdot_expr_symbol(pool, e)->lo == QDOT_NIL)
        qdot_symbol_domain(pool, e, QDOT_ZERO, true, QDOT_NIL, false);
    return e;
}

/* The k-th of the choices of one group: 0 none is large, then each unknown with each sign. Returns false, with k less
 * the number of choices, if there are fewer. */
static bool
choose_large_unknown(size_t n, const qdot_zeros_range *range, const qdot_interval *bounds,
                     unsigned group, size_t *k, qdot_zeros_chart *out)
{
    size_t choices = 1, at = *k;

    for (size_t j = 0; j < n; j++)
        for (int sign = 1; sign >= -1; sign -= 2) {
            if (range[j].group != group || !is_unbounded_interval(bounds[j]) ||
                !isinf(sign > 0 ? bounds[j].hi : bounds[j].lo))
                continue;
            if (choices++ == at)
                out->sign[j] = (int8_t)sign;
        }
    *k = choices;
    return at < choices;
}

void
qdot_zeros_chart_at(qdot_pool *pool, size_t n, const qdot_expr *x,
                    const qdot_zeros_range *range, const qdot_interval *bounds, size_t k,
                    qdot_zeros_chart *out)
{
    double R = size_of_inner_box(n, bounds);
    bool seen[MOST] = {false};

    memset(out, 0, sizeof *out);
    for (size_t j = 0; j < n; j++) { /* the digits of k in a mixed base give the choice in each group of unknowns */
        size_t choices = 0, mine;

        if (seen[j] || !is_unbounded_interval(bounds[j]))
            continue;
        for (size_t i = j; i < n; i++)
            seen[i] |= range[i].group == range[j].group;
        (void)choose_large_unknown(n, range, bounds, range[j].group, &choices, &(qdot_zeros_chart){0});
        mine = k % choices;
        k /= choices;
        (void)choose_large_unknown(n, range, bounds, range[j].group, &mine, out);
    }
    if (k > 0)
        return;
    out->n = n;
    for (size_t j = 0; j < n; j++) {
        qdot_interval *box = &out->box.at[j];
        bool positive = bounds[j].lo > 0 || (bounds[j].lo == 0 && range[j].lo_open);

        out->inverse[j] = -1;
        for (size_t i = 0; i < n; i++)
            if (out->sign[i] != 0 && range[i].group == range[j].group &&
                is_unbounded_interval(bounds[j]))
                out->inverse[j] = (int8_t)i;
        if (out->inverse[j] < 0) {
            *box = (qdot_interval){fmax(bounds[j].lo, -R), fmin(bounds[j].hi, R)};
            out->y[j] = x[j];
        } else if (out->inverse[j] == (int8_t)j) {
            *box = (qdot_interval){0, 1 / R};
            out->y[j] = chart_symbol(pool, 's', j);
        } else {
            *box = (qdot_interval){bounds[j].lo >= 0 ? 0 : -1, bounds[j].hi <= 0 ? 0 : 1};
            out->y[j] = chart_symbol(pool, positive ? 'p' : 'y', j);
        }
    }
}

void
qdot_zeros_chart_near(qdot_pool *pool, size_t n, const qdot_expr *centre, double reach,
                      size_t k, qdot_zeros_chart *out)
{
    size_t largest = k / 2;

    memset(out, 0, sizeof *out);
    out->n = n;
    out->near = true;
    out->sign[largest] = k % 2 == 0 ? 1 : -1;
    for (size_t j = 0; j < n; j++) {
        bool is_largest = j == largest;

        out->centre[j] = centre[j];
        out->inverse[j] = (int8_t)largest;
        out->y[j] = chart_symbol(pool, is_largest ? 's' : 'y', j);
        out->box.at[j] = (qdot_interval){is_largest ? 0 : -1, is_largest ? reach : 1};
    }
}

qdot_status
qdot_zeros_chart_put(qdot_pool *pool, const qdot_expr *x, const qdot_zeros_chart *chart,
                     const qdot_expr *f, qdot_expr *to)
{
    size_t n = chart->n;
    qdot_expr value[MOST];

    for (size_t j = 0; j < n; j++) {
        int i = chart->inverse[j];

        if (chart->near)
            value[j] = qdot_add(
                pool, chart->centre[j],
                (size_t)i == j
                    ? qdot_mul(pool, qdot_expr_int(pool, chart->sign[j]), chart->y[j])
                    : qdot_mul(pool, chart->y[i], chart->y[j]));
        else
            value[j] =
                i < 0 ? x[j]
                : (size_t)i == j
                    ? qdot_div(pool, qdot_expr_int(pool, chart->sign[j]), chart->y[j])
                    : qdot_div(pool, chart->y[j], chart->y[i]);
    }
    for (size_t k = 0; k < n; k++)
        to[k] = qdot_subs(pool, f[k], n, x, value);
    return qdot_pool_check(pool);
}

qdot_status
qdot_zeros_chart_clear(qdot_pool *pool, const qdot_zeros_chart *chart, qdot_expr *f,
                       bool *empty)
{
    *empty = false;
    for (size_t k = 0; k < chart->n && !*empty; k++) {
        qdot_expr list;

        QDOT_TRY(qdot_zeros_factors(pool, f[k], chart->n, chart->y, &list));
        *empty = qdot_expr_count(pool, list) == 0;
        f[k] = QDOT_ONE;
        for (uint32_t i = 0; i < qdot_expr_count(pool, list); i++)
            f[k] = qdot_mul(pool, f[k], qdot_expr_arg(pool, list, i));
        QDOT_TRY(qdot_pool_check(pool));
    }
    return QDOT_OK;
}

void
qdot_zeros_chart_place(const qdot_zeros_chart *chart, const double *y, double *x)
{
    for (size_t j = 0; j < chart->n; j++) {
        int i = chart->inverse[j];

        x[j] = i < 0 ? y[j] : (size_t)i == j ? chart->sign[j] / y[j] : y[j] / y[i];
    }
}

bool
qdot_zeros_is_wild(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *x,
                   const qdot_zeros_range *range)
{
    bool wild = false;
    qdot_walk w;

    if (qdot_walk_begin_n(pool, n, f, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n && !wild; i++) {
        const qdot_node *node = qdot_expr_node(pool, w.at[i]);

        if (node->kind != QDOT_FUN)
            continue;
        switch (node->op) {
        case QDOT_SIN:
        case QDOT_COS:
        case QDOT_TAN:
        case QDOT_COT:
        case QDOT_SEC:
        case QDOT_CSC:
        case QDOT_FLOOR:
        case QDOT_MOD:
            for (size_t j = 0; j < n; j++)
                wild |= !range[j].turn &&
                        (range[j].lo == QDOT_NIL || range[j].hi == QDOT_NIL) &&
                        qdot_expr_contains(pool, w.at[i], x[j]);
            break;
        default: break;
        }
    }
    qdot_walk_end(&w);
    return wild;
}
