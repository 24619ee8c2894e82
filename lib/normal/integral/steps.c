/* steps.c -- antiderivatives of what holds floor and mod, for all steps at once. */
#include "normal/integral/piecewise.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/integral/ends.h"
#include "normal/simplify/simplify.h"

enum { MOST_DEGREE = 12 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x, u, modulo; /* steps at integers u; a node mod(u m, m), or nil */
    qdot_expr N, V;         /* symbols for floor(u) and u - floor(u) */
} steps;

bool
qdot_piecewise_steps(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    static const qdot_fun_id ids[] = {QDOT_FLOOR, QDOT_MOD};

    return qdot_expr_find_function(pool, e, 2, ids, x) != QDOT_NIL;
}

/* The u at whose integers the node floor(u) or mod(u m, m) has its steps. */
static qdot_expr
place_of_steps(qdot_pool *pool, qdot_expr node)
{
    const qdot_expr u = qdot_expr_arg(pool, node, 0);

    return qdot_expr_is_function(pool, node, QDOT_MOD) ? qdot_div(pool, u, qdot_expr_arg(pool, node, 1)) : u;
}

static qdot_expr
node_on_step(qdot_pool *pool, qdot_expr node, void *user)
{
    const steps *s = user;
    const bool mod = qdot_expr_is_function(pool, node, QDOT_MOD);

    if ((!mod && !qdot_expr_is_function(pool, node, QDOT_FLOOR)) || !qdot_expr_contains(pool, node, s->x) ||
        qdot_normal(pool, qdot_sub(pool, place_of_steps(pool, node), s->u), NULL) != QDOT_ZERO)
        return node;
    return mod ? qdot_mul(pool, qdot_expr_arg(pool, node, 1), s->V) : s->N;
}

/* A symbol about which nothing else is known, 0 < it < 1 if `fraction`. */
static qdot_expr
new_step_symbol(qdot_pool *pool, const char *name, bool fraction)
{
    const qdot_expr w = qdot_symbol_get(pool, QDOT_FORMAL, name);

    qdot_symbol_hide(pool, w);
    if (fraction && w != QDOT_NIL)
        qdot_symbol_domain(pool, w, QDOT_ZERO, true, QDOT_ONE, true);
    return w;
}

/* The sum of j^k for j = 0 ... N - 1 by Faulhaber's recursion, k = 0 ... most. */
static void
write_power_sums(qdot_pool *pool, qdot_expr N, int64_t most, qdot_expr *sum)
{
    for (int64_t k = 0; k <= most; k++) {
        qdot_expr s = qdot_pow_int(pool, N, k + 1);
        int64_t binomial = 1; /* of k + 1 over i */

        for (int64_t i = 0; i < k; i++) {
            s = qdot_sub(pool, s, qdot_mul(pool, qdot_expr_int(pool, binomial), sum[i]));
            binomial = binomial * (k + 1 - i) / (i + 1);
        }
        sum[k] = qdot_div(pool, s, qdot_expr_int(pool, k + 1));
    }
}

/* S with S(N + 1) - S(N) = d(N), S(0) = 0, for a polynomial d; nil: it is none. */
static qdot_expr
sum_steps(const steps *s, qdot_expr d)
{
    qdot_pool *pool = s->pool;
    qdot_expr sums[MOST_DEGREE + 1], S = QDOT_ZERO, rest = d;

    if (!qdot_expr_contains(pool, d, s->N))
        return qdot_mul(pool, d, s->N);
    write_power_sums(pool, s->N, MOST_DEGREE, sums);
    for (int64_t k = 0; k <= MOST_DEGREE && rest != QDOT_ZERO; k++) {
        const qdot_expr c = qdot_coefficient(pool, d, s->N, k);

        if (c == QDOT_NIL) { /* no polynomial */
            (void)!qdot_pool_check(pool);
            return QDOT_NIL;
        }
        S = qdot_add(pool, S, qdot_mul(pool, c, sums[k]));
        rest = qdot_normal(pool, qdot_sub(pool, rest, qdot_mul(pool, c, qdot_pow_int(pool, s->N, k))), NULL);
    }
    return rest == QDOT_ZERO ? S : QDOT_NIL;
}

/* H at an end of the step; nil: it has no value there. */
static qdot_expr
value_at_end(const steps *s, qdot_expr H, qdot_expr at)
{
    qdot_end end;

    if (qdot_end_value(s->pool, H, s->V, at, at == QDOT_ZERO ? 1 : -1, s->facts, &end) != QDOT_OK)
        return qdot_pool_fail(s->pool);
    return end.kind == QDOT_END_VALUE ? end.value : QDOT_NIL;
}

/* The antiderivative for u = slope x + shift. */
static qdot_expr
integrate_linear(const steps *s, qdot_expr e, qdot_expr slope, qdot_piece_find *find)
{
    qdot_pool *pool = s->pool;
    const qdot_expr zero = QDOT_ZERO, shift = qdot_subs(pool, s->u, 1, &s->x, &zero), whole = qdot_fun1(pool, QDOT_FLOOR, s->u);
    const qdot_expr X = qdot_div(pool, qdot_sub(pool, qdot_add(pool, s->V, s->N), shift), slope);
    qdot_expr H, S, lo, hi, F, fraction;

    e = qdot_subs(pool, e, 1, &s->x, &X);
    if (e == QDOT_NIL || qdot_expr_contains(pool, e, s->x) || qdot_piecewise_steps(pool, e, s->N) ||
        qdot_piecewise_steps(pool, e, s->V))
        return QDOT_NIL;
    H = find(pool, qdot_simplify(pool, e, s->facts), s->V, s->facts);
    if (H == QDOT_NIL)
        return H;
    lo = value_at_end(s, H, QDOT_ZERO);
    hi = value_at_end(s, H, QDOT_ONE);
    if (lo == QDOT_NIL || hi == QDOT_NIL)
        return QDOT_NIL;
    S = sum_steps(s, qdot_simplify(pool, qdot_sub(pool, hi, lo), s->facts));
    if (S == QDOT_NIL)
        return S;
    F = qdot_add(pool, S, qdot_sub(pool, H, lo));
    F = qdot_simplify(pool, qdot_div(pool, F, slope), s->facts);
    fraction = s->modulo == QDOT_NIL ? qdot_sub(pool, s->u, whole) : qdot_div(pool, s->modulo, qdot_expr_arg(pool, s->modulo, 1));
    return qdot_subs(pool, F, 2, (qdot_expr[]){s->N, s->V}, (qdot_expr[]){whole, fraction});
}

/* int f(u) u' dx over u. */
static qdot_expr
integrate_over_place(const steps *s, qdot_expr e, qdot_expr slope, const qdot_facts *facts, qdot_piece_find *find)
{
    qdot_pool *pool = s->pool;
    const qdot_expr w = new_step_symbol(pool, "place#", false), back = qdot_fun1(pool, QDOT_FLOOR, w);
    qdot_expr f = qdot_simplify(pool, qdot_div(pool, e, slope), facts), F;

    f = qdot_subs(pool, f, 3, (qdot_expr[]){s->N, s->V, s->u}, (qdot_expr[]){back, qdot_sub(pool, w, back), w});
    if (f == QDOT_NIL || qdot_expr_contains(pool, f, s->x))
        return QDOT_NIL;
    F = find(pool, f, w, facts);
    return F == QDOT_NIL ? F : qdot_subs(pool, F, 1, &w, &s->u);
}

/* The terms of the sum e without steps; *rest: the others. */
static qdot_expr
split_smooth_terms(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr *rest)
{
    const qdot_expr sum = qdot_expand(pool, e);
    qdot_expr smooth = QDOT_ZERO;

    *rest = e;
    if (sum == QDOT_NIL || qdot_expr_kind(pool, sum) != QDOT_SUM)
        return smooth;
    *rest = QDOT_ZERO;
    smooth = qdot_expr_arg(pool, sum, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2) {
        const qdot_expr t = qdot_expr_arg(pool, sum, i);
        qdot_expr *to = qdot_piecewise_steps(pool, t, x) ? rest : &smooth;

        *to = qdot_add(pool, *to, qdot_mul(pool, qdot_expr_arg(pool, sum, i + 1), t));
    }
    return smooth;
}

static qdot_expr
integrate_steps(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, qdot_piece_find *find)
{
    static const qdot_fun_id ids[] = {QDOT_FLOOR, QDOT_MOD};
    const qdot_expr node = qdot_expr_find_function(pool, e, 2, ids, x);
    steps s = {.pool = pool, .facts = facts, .x = x};
    qdot_expr slope;

    if (node == QDOT_NIL || (qdot_expr_is_function(pool, node, QDOT_MOD) && qdot_expr_contains(pool, qdot_expr_arg(pool, node, 1), x)))
        return QDOT_NIL;
    s.u = place_of_steps(pool, node);
    s.N = new_step_symbol(pool, "whole#", false);
    s.V = new_step_symbol(pool, "fraction#", true);
    s.modulo = qdot_expr_find_function(pool, e, 1, (qdot_fun_id[]){QDOT_MOD}, x);
    if (s.modulo != QDOT_NIL && qdot_normal(pool, qdot_sub(pool, place_of_steps(pool, s.modulo), s.u), NULL) != QDOT_ZERO)
        return QDOT_NIL;
    slope = qdot_diff(pool, s.u, x);
    if (slope == QDOT_NIL || slope == QDOT_ZERO)
        return QDOT_NIL;
    e = qdot_walk_replace(pool, e, QDOT_FUN, node_on_step, &s);
    if (e == QDOT_NIL)
        return e;
    return qdot_expr_contains(pool, slope, x) ? integrate_over_place(&s, e, slope, facts, find) : integrate_linear(&s, e, slope, find);
}

qdot_expr
qdot_steps_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, qdot_piece_find *find)
{
    qdot_expr rest, F, G = QDOT_ZERO;
    const qdot_expr smooth = split_smooth_terms(pool, e, x, &rest);

    F = integrate_steps(pool, rest, x, facts, find);
    if (smooth != QDOT_ZERO && F != QDOT_NIL)
        G = find(pool, smooth, x, facts);
    return G == QDOT_NIL ? G : qdot_add(pool, F, G);
}
