/* solve.c -- factors an equation, then inverts the functions of x from the outermost inwards. */
#include "normal/solve/solve.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/flint.h"
#include "normal/field/prepare.h"
#include "normal/prove/decide.h"
#include "normal/refute/sample.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"

enum { WORK = 2000000, MOST_DEPTH = 8, MOST_TURNS = 24, POINTS = 120, WANTED = 6 };

typedef qdot_vec(qdot_root) root_list;

typedef struct {
    qdot_pool *pool;
    qdot_expr f, x;
    const qdot_facts *facts;
    root_list roots;
    bool complete, angle;
    int depth;
    qdot_status status;
} solver;

static qdot_status solve_all(solver *s, qdot_expr f, qdot_expr condition);

static qdot_expr
tidy(const solver *s, qdot_expr e)
{
    return qdot_simplify(s->pool, e, s->facts);
}

/* --- conditions -------------------------------------------------------------------- */

qdot_expr
qdot_solve_both(qdot_pool *pool, qdot_expr a, qdot_expr relation)
{
    uint32_t n = a == QDOT_NIL ? 0 : qdot_expr_count(pool, a);
    qdot_expr *all, result;

    if (a == QDOT_FALSE || relation == QDOT_FALSE)
        return QDOT_FALSE;
    if (relation == QDOT_TRUE)
        return a;
    all = qdot_malloc((n + 1) * sizeof *all);
    if (all == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        all[i] = qdot_expr_arg(pool, a, i);
        if (all[i] == relation) {
            qdot_free(all);
            return a;
        }
    }
    all[n] = relation;
    result = qdot_list(pool, n + 1, all);
    qdot_free(all);
    return result;
}

static qdot_expr
positive(solver *s, qdot_expr e)
{
    return qdot_positive(s->pool, e, s->facts, 0, NULL);
}

/* --- is it one? -------------------------------------------------------------------- */

/* Where x may be: its declared domain, -pi < x <= pi for an angle without one. */
static bool
within(const solver *s, double v)
{
    const qdot_symbol *x = qdot_expr_symbol(s->pool, s->x);
    const double close = 1e-12;
    double lo = s->angle ? -M_PI + close : -INFINITY,
           hi = s->angle ? M_PI + close : INFINITY;
    const qdot_expr bound[2] = {x == NULL ? QDOT_NIL : x->lo,
                                x == NULL ? QDOT_NIL : x->hi};

    for (int i = 0; i < 2; i++) {
        const fmpq *q =
            bound[i] == QDOT_NIL ? NULL : qdot_expr_rational(s->pool, bound[i]);
        bool open = i == 0 ? x->lo_open : x->hi_open;
        double b;
        arf_t a;

        if (q == NULL && bound[i] != QDOT_PI)
            continue;
        arf_init(a);
        if (q != NULL)
            arf_set_fmpq(a, q, 53, ARF_RND_NEAR);
        b = q != NULL ? arf_get_d(a, ARF_RND_NEAR) : M_PI;
        arf_clear(a);
        if (i == 0)
            lo = open ? b + close : b - close;
        else
            hi = open ? b - close : b + close;
    }
    return v > lo && v < hi;
}

/* Whether `value` can lie where x may be, judged at points of the parameters' domains.
 * A value that is real at none of them is kept if it holds parameters. */
static qdot_status
belongs(const solver *s, qdot_expr value, bool *yes)
{
    int seen = 0, inside = 0;
    qdot_sample sample;

    *yes = true;
    QDOT_TRY(qdot_sample_begin(&sample, s->pool, 1, &value, s->facts));
    for (int k = 0; sample.possible && k < POINTS && seen < WANTED; k++) {
        arb_srcptr v;

        qdot_sample_point(&sample, k);
        if (!qdot_sample_eval(&sample, 96))
            continue;
        v = qdot_ball_get(&sample.ball, value);
        if (v == NULL)
            continue;
        seen++;
        inside += within(s, arf_get_d(arb_midref(v), ARF_RND_NEAR));
    }
    qdot_sample_end(&sample);
    if (seen > 0)
        *yes = inside > 0;
    else if (qdot_expr_node(s->pool, value)->holds == 0)
        *yes = false;
    return qdot_pool_check(s->pool);
}

/* Whether e is 0 at some points of the parameters' domains, as far as can be seen. */
static qdot_status
vanishes_somewhere(const solver *s, qdot_expr e, bool *yes)
{
    qdot_sample sample;

    *yes = false;
    QDOT_TRY(qdot_sample_begin(&sample, s->pool, 1, &e, s->facts));
    for (int k = 0; sample.possible && k < POINTS / 4 && !*yes; k++) {
        arb_srcptr v;

        qdot_sample_point(&sample, k);
        *yes = qdot_sample_eval(&sample, 96) &&
               (v = qdot_ball_get(&sample.ball, e)) != NULL && arb_contains_zero(v);
    }
    qdot_sample_end(&sample);
    return qdot_pool_check(s->pool);
}

/* Whether f is 0 and defined at x = value: refuted ones are not. Where it is 0 for some
 * parameters only, no condition says for which: then these are not all. */
static qdot_status
holds(solver *s, qdot_expr value, bool *yes)
{
    qdot_expr at = qdot_subs(s->pool, s->f, 1, &s->x, &value);
    qdot_decision d;
    bool sometimes;

    *yes = false;
    if (at == QDOT_NIL) { /* not defined there */
        qdot_status status = qdot_pool_check(s->pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    QDOT_TRY(qdot_decide_equal(s->pool, at, QDOT_ZERO, s->facts, &d));
    *yes = d.verdict != QDOT_REFUTED;
    if (*yes)
        return QDOT_OK;
    QDOT_TRY(vanishes_somewhere(s, at, &sometimes));
    s->complete = s->complete && !sometimes;
    return QDOT_OK;
}

static qdot_status
add_root(solver *s, qdot_expr value, qdot_expr condition)
{
    qdot_root root = {tidy(s, value), condition};
    bool yes;

    QDOT_TRY(qdot_pool_check(s->pool));
    if (condition == QDOT_FALSE)
        return QDOT_OK;
    for (size_t i = 0; i < s->roots.n; i++)
        if (s->roots.at[i].value == root.value ||
            qdot_is_zero(s->pool, qdot_sub(s->pool, s->roots.at[i].value, root.value),
                         s->facts))
            return QDOT_OK;
    QDOT_TRY(belongs(s, root.value, &yes));
    if (yes)
        QDOT_TRY(holds(s, root.value, &yes));
    return yes ? qdot_vec_push(&s->roots, root) : QDOT_OK;
}

/* --- polynomials in one thing ------------------------------------------------------ */

/* y with y^k = v: v^(1/k), its negative where k is even. */
static qdot_status
extract(solver *s, qdot_expr v, long k, qdot_expr condition, root_list *out)
{
    qdot_expr y, kind = QDOT_TRUE;

    if (v == QDOT_ZERO || k == 1) {
        qdot_root root = {v, condition};

        return qdot_vec_push(out, root);
    }
    if (k % 2 == 0)
        kind = positive(s, v);
    condition = qdot_solve_both(s->pool, condition, kind);
    if (condition == QDOT_FALSE)
        return QDOT_OK;
    if (k % 2 != 0 && (qdot_expr_node(s->pool, v)->sign & QDOT_NEG) == QDOT_NEG)
        y = qdot_neg(s->pool, qdot_pow(s->pool, qdot_neg(s->pool, v),
                                       qdot_expr_ratio(s->pool, 1, k)));
    else
        y = qdot_pow(s->pool, v, qdot_expr_ratio(s->pool, 1, k));
    QDOT_TRY(qdot_pool_check(s->pool));
    if (k % 2 == 0)
        QDOT_TRY(qdot_vec_push(out, ((qdot_root){qdot_neg(s->pool, y), condition})));
    return qdot_vec_push(out, ((qdot_root){y, condition}));
}

/* Real y with sum c_k y^k = 0, c [degree + 1]. */
static qdot_status
polynomial(solver *s, const qdot_expr *c, long degree, qdot_expr condition,
           root_list *out)
{
    qdot_pool *pool = s->pool;
    long step = 0;
    qdot_expr a, b, discriminant, root, two_a, kind;

    for (long k = 1; k <= degree; k++) /* a polynomial in y^step */
        for (long rest = k; c[k] != QDOT_ZERO && rest > 0;) {
            long swap = step % rest;

            if (step == 0) {
                step = rest;
                break;
            }
            step = rest;
            rest = swap;
        }
    if (step == 0)
        return QDOT_OK;
    if (degree / step > 2) {
        s->complete = false;
        return QDOT_OK;
    }
    a = c[degree];
    if (degree == step)
        return extract(s, tidy(s, qdot_neg(pool, qdot_div(pool, c[0], a))), step,
                       condition, out);
    b = c[step];
    discriminant = tidy(
        s,
        qdot_sub(pool, qdot_mul(pool, b, b),
                 qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 4), a, c[0]})));
    QDOT_TRY(qdot_pool_check(pool));
    kind = discriminant == QDOT_ZERO ? QDOT_TRUE : positive(s, discriminant);
    condition = qdot_solve_both(s->pool, condition, kind);
    if (condition == QDOT_FALSE)
        return QDOT_OK;
    root = qdot_sqrt(pool, discriminant);
    two_a = qdot_mul(pool, qdot_expr_int(pool, 2), a);
    for (int sign = -1; sign <= 1; sign += 2) {
        qdot_expr y = sign < 0 ? qdot_add(pool, b, root) : qdot_sub(pool, b, root);

        y = tidy(s, qdot_neg(pool, qdot_div(pool, y, two_a)));
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(extract(s, y, step, condition, out));
        if (discriminant == QDOT_ZERO)
            break;
    }
    return QDOT_OK;
}

/* --- inverses ---------------------------------------------------------------------- */

/* x with u(x) = w + 2 pi k, u linear in x. */
static qdot_status
turns(solver *s, qdot_expr u, qdot_expr w, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    qdot_expr c = tidy(s, qdot_diff(pool, u, s->x)), zero = QDOT_ZERO, base;
    bool rational = qdot_expr_kind(pool, c) == QDOT_NUM, was = s->angle;
    long most = rational ? MOST_TURNS / 2 : 0;
    qdot_status status = QDOT_OK;

    if (qdot_expr_contains(pool, c, s->x)) {
        s->complete = false;
        return QDOT_OK;
    }
    base = qdot_sub(pool, w, qdot_subs(pool, u, 1, &s->x, &zero));
    QDOT_TRY(qdot_pool_check(pool));
    s->angle = rational && c != QDOT_ZERO;
    for (long k = 0; k <= 2 * most && status == QDOT_OK; k++) {
        long turn = k % 2 == 0 ? k / 2 : -(k / 2) - 1; /* 0, -1, 1, -2 ... */
        qdot_expr value =
            qdot_add(pool, base, qdot_mul(pool, qdot_expr_int(pool, 2 * turn), QDOT_PI));

        status = add_root(s, qdot_div(pool, value, c), condition);
    }
    s->angle = was;
    return status;
}

/* |v| < 1 as a condition, from the sides of v^2 < 1. */
static qdot_expr
below_one(solver *s, qdot_expr v)
{
    qdot_expr below = positive(s, qdot_sub(s->pool, QDOT_ONE, v));
    qdot_expr above = positive(s, qdot_add(s->pool, QDOT_ONE, v));

    return below == QDOT_FALSE || above == QDOT_FALSE
               ? QDOT_FALSE
               : qdot_solve_both(s->pool, qdot_solve_both(s->pool, QDOT_NIL, below),
                                 above);
}

static qdot_status
all_turns(solver *s, qdot_expr u, qdot_expr condition, size_t n, const qdot_expr *w)
{
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(turns(s, u, w[i], condition));
    return QDOT_OK;
}

static qdot_expr
all_of(solver *s, qdot_expr a, qdot_expr b)
{
    for (uint32_t i = 0;
         b != QDOT_NIL && b != QDOT_FALSE && i < qdot_expr_count(s->pool, b); i++)
        a = qdot_solve_both(s->pool, a, qdot_expr_arg(s->pool, b, i));
    return b == QDOT_FALSE ? QDOT_FALSE : a;
}

/* sin u = v or cos u = v. */
static qdot_status
circular(solver *s, bool sine, qdot_expr u, qdot_expr v, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    qdot_expr angle = qdot_fun1(pool, sine ? QDOT_ASIN : QDOT_ACOS, v), inside;

    if (angle == QDOT_NIL) { /* a number beyond 1 */
        qdot_status status = qdot_pool_check(pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    if (v == QDOT_ONE || v == QDOT_MINUS_ONE)
        return turns(s, u, angle, condition);
    inside = below_one(s, v);
    condition = all_of(s, condition, inside);
    if (condition == QDOT_FALSE)
        return QDOT_OK;
    if (sine)
        return all_turns(s, u, condition, 2,
                         (qdot_expr[]){angle, qdot_sub(pool, QDOT_PI, angle)});
    return all_turns(s, u, condition, 2, (qdot_expr[]){angle, qdot_neg(pool, angle)});
}

/* h(u) = v by the inverse function: u = g(v). */
static qdot_status
invert(solver *s, qdot_expr g, qdot_expr v, qdot_expr condition)
{
    static const struct {
        qdot_fun_id h, g;
    } pairs[] = {{QDOT_EXP, QDOT_LOG},    {QDOT_LOG, QDOT_EXP},
                 {QDOT_SINH, QDOT_ASINH}, {QDOT_TANH, QDOT_ATANH},
                 {QDOT_ASIN, QDOT_SIN},   {QDOT_ACOS, QDOT_COS},
                 {QDOT_ATAN, QDOT_TAN},   {QDOT_ASINH, QDOT_SINH},
                 {QDOT_ACOSH, QDOT_COSH}, {QDOT_ATANH, QDOT_TANH}};
    qdot_pool *pool = s->pool;
    qdot_fun_id h = qdot_expr_node(pool, g)->op;
    qdot_expr u = qdot_expr_arg(pool, g, 0), w;

    if (h == QDOT_SIN || h == QDOT_COS)
        return circular(s, h == QDOT_SIN, u, v, condition);
    if (h == QDOT_COSH || h == QDOT_ABS) {
        qdot_expr least = h == QDOT_COSH ? QDOT_ONE : QDOT_ZERO;

        if (v != least)
            condition = qdot_solve_both(s->pool, condition,
                                        positive(s, qdot_sub(pool, v, least)));
        if (condition == QDOT_FALSE)
            return QDOT_OK;
        w = h == QDOT_COSH ? qdot_fun1(pool, QDOT_ACOSH, v) : v;
        QDOT_TRY(solve_all(s, qdot_sub(pool, u, w), condition));
        return solve_all(s, qdot_add(pool, u, w), condition);
    }
    if (h == QDOT_EXP)
        condition = qdot_solve_both(s->pool, condition, positive(s, v));
    if (condition == QDOT_FALSE)
        return QDOT_OK;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (pairs[i].h == h)
            return solve_all(s, qdot_sub(pool, u, qdot_fun1(pool, pairs[i].g, v)),
                             condition);
    s->complete = false;
    return QDOT_OK;
}

/* --- one factor -------------------------------------------------------------------- */

/* a sin u + b cos u + d = 0: sin(u + atan2(b, a)) = -d/R, R = sqrt(a^2 + b^2). */
static qdot_status
mixed(solver *s, qdot_expr u, qdot_expr a, qdot_expr b, qdot_expr d, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    qdot_expr R, shift, v, kind;

    if (d == QDOT_ZERO) {
        qdot_expr w =
            qdot_fun1(pool, QDOT_ATAN, tidy(s, qdot_neg(pool, qdot_div(pool, b, a))));

        return all_turns(s, u, condition, 2,
                         (qdot_expr[]){w, qdot_add(pool, w, QDOT_PI)});
    }
    R = qdot_add(pool, qdot_mul(pool, a, a), qdot_mul(pool, b, b));
    kind = positive(s, tidy(s, qdot_sub(pool, R, qdot_mul(pool, d, d))));
    condition = qdot_solve_both(s->pool, condition, kind);
    if (condition == QDOT_FALSE)
        return QDOT_OK;
    v = tidy(s, qdot_div(pool, qdot_neg(pool, d), qdot_sqrt(pool, R)));
    shift = qdot_fun(pool, QDOT_ATAN2, 2, (qdot_expr[]){a, b});
    v = qdot_fun1(pool, QDOT_ACOS, v); /* R cos(u - atan2(a, b)) = -d */
    QDOT_TRY(qdot_pool_check(pool));
    return all_turns(s, u, condition, 2,
                     (qdot_expr[]){qdot_add(pool, shift, v), qdot_sub(pool, shift, v)});
}

/* The generators of x in one factor, and the factor by their powers. */
typedef struct {
    slong var[3];
    size_t n;
    long degree[3];
    qdot_groups groups;
} shape;

static qdot_status
take_shape(solver *s, qdot_field *f, const fmpz_mpoly_t p, shape *out)
{
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by);
    qdot_status status;

    *out = (shape){0};
    if (by == NULL)
        return QDOT_ENOMEM;
    for (slong v = 0; v < f->n; v++) {
        if (fmpz_mpoly_degree_si(p, v, f->ctx) == 0 ||
            !qdot_expr_contains(s->pool, f->gen[v].expr, s->x))
            continue;
        by[v] = true;
        if (out->n < 3) {
            out->var[out->n] = v;
            out->degree[out->n] = fmpz_mpoly_degree_si(p, v, f->ctx);
        }
        out->n++;
    }
    status = qdot_factor_group(f, &out->groups, p, by);
    qdot_free(by);
    return status;
}

/* Coefficient of var0^i (and var1^j). */
static qdot_expr
coefficient(qdot_field *f, const shape *sh, ulong i, ulong j)
{
    for (slong k = 0; k < sh->groups.n; k++) {
        const ulong *key = sh->groups.key + k * f->n;

        if (key[sh->var[0]] == i && (sh->n < 2 || key[sh->var[1]] == j))
            return qdot_field_expr(f, sh->groups.poly + k);
    }
    return QDOT_ZERO;
}

/* The sum over powers of var0 at var1^j, as an expression. */
static qdot_expr
slice(qdot_field *f, const shape *sh, ulong j)
{
    qdot_pool *pool = f->pool;
    qdot_expr sum = QDOT_ZERO;

    for (long i = 0; i <= sh->degree[0]; i++)
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, coefficient(f, sh, (ulong)i, j),
                                qdot_pow_int(pool, f->gen[sh->var[0]].expr, i)));
    return sum;
}

static void
exchange(shape *sh)
{
    slong var = sh->var[0];
    long degree = sh->degree[0];

    sh->var[0] = sh->var[1];
    sh->degree[0] = sh->degree[1];
    sh->var[1] = var;
    sh->degree[1] = degree;
}

/* sin u and cos u of one angle. */
static qdot_status
sine_and_cosine(solver *s, qdot_field *f, shape *sh, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    qdot_expr u = f->gen[sh->var[0]].of, A, B, c;

    if (f->gen[sh->var[0]].kind == QDOT_GEN_SIN) /* var0 the cosine */
        exchange(sh);
    if (sh->degree[0] == 1 && sh->degree[1] == 1 && coefficient(f, sh, 1, 1) == QDOT_ZERO)
        return mixed(s, u, coefficient(f, sh, 0, 1), coefficient(f, sh, 1, 0),
                     coefficient(f, sh, 0, 0), condition);
    if (sh->degree[1] != 1) {
        s->complete = false;
        return QDOT_OK;
    }
    A = slice(f, sh, 0);
    B = slice(f, sh, 1);
    c = f->gen[sh->var[0]].expr;
    A = qdot_sub(pool, qdot_mul(pool, A, A),
                 qdot_mul(pool, qdot_mul(pool, B, B),
                          qdot_sub(pool, QDOT_ONE, qdot_mul(pool, c, c))));
    return solve_all(s, A, condition);
}

/* A + B r = 0 with r^q = b: A^q = (-B)^q b, each solution tried at the end. */
static qdot_status
root_and_rest(solver *s, qdot_field *f, shape *sh, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    size_t at = f->gen[sh->var[0]].kind == QDOT_GEN_ROOT ? 1 : 0;
    const qdot_gen *root;
    qdot_expr A, B;

    if (at == 1) /* var1 the root */
        exchange(sh);
    root = &f->gen[sh->var[1]];
    if (root->kind != QDOT_GEN_ROOT || sh->degree[1] != 1) {
        s->complete = false;
        return QDOT_OK;
    }
    A = slice(f, sh, 0);
    B = qdot_neg(pool, slice(f, sh, 1));
    A = qdot_sub(pool, qdot_pow_int(pool, A, root->order),
                 qdot_mul(pool, qdot_pow_int(pool, B, root->order), root->of));
    return solve_all(s, A, condition);
}

/* One generator g: values of g, then g(x) = value. */
static qdot_status
one_generator(solver *s, qdot_field *f, const shape *sh, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    const qdot_gen gen = f->gen[sh->var[0]];
    qdot_expr *c = qdot_calloc((size_t)sh->degree[0] + 1, sizeof *c);
    root_list values = {0};
    qdot_status status = c == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (long k = 0; k <= sh->degree[0] && status == QDOT_OK; k++)
        c[k] = coefficient(f, sh, (ulong)k, 0);
    if (status == QDOT_OK)
        status = polynomial(s, c, sh->degree[0], condition, &values);
    for (size_t i = 0; i < values.n && status == QDOT_OK; i++) {
        qdot_expr v = values.at[i].value, when = values.at[i].condition;

        if (gen.expr == s->x)
            status = add_root(s, v, when);
        else if (gen.kind == QDOT_GEN_ROOT) /* tried at the end */
            status = solve_all(
                s, qdot_sub(pool, gen.of, qdot_pow_int(pool, v, gen.order)), when);
        else if (qdot_expr_kind(pool, gen.expr) == QDOT_FUN &&
                 qdot_expr_count(pool, gen.expr) == 1)
            status = invert(s, gen.expr, v, when);
        else
            s->complete = false;
    }
    qdot_free(c);
    qdot_free(values.at);
    return status;
}

static qdot_status
one_factor(solver *s, qdot_field *f, const fmpz_mpoly_t p, qdot_expr condition)
{
    qdot_status status;
    shape sh;

    QDOT_TRY(qdot_interrupt_check());
    status = take_shape(s, f, p, &sh);
    if (status == QDOT_OK && sh.n == 1)
        status = one_generator(s, f, &sh, condition);
    else if (status == QDOT_OK && sh.n == 2 && f->gen[sh.var[0]].kind != QDOT_GEN_ROOT &&
             f->gen[sh.var[1]].kind != QDOT_GEN_ROOT &&
             f->gen[sh.var[0]].pair == (uint32_t)sh.var[1] &&
             (f->gen[sh.var[0]].kind == QDOT_GEN_SIN ||
              f->gen[sh.var[0]].kind == QDOT_GEN_COS))
        status = sine_and_cosine(s, f, &sh, condition);
    else if (status == QDOT_OK && sh.n == 2)
        status = root_and_rest(s, f, &sh, condition);
    else if (status == QDOT_OK && sh.n > 2)
        s->complete = false;
    qdot_factor_ungroup(f, &sh.groups);
    return status;
}

/* Every factor of e's numerator. */
static qdot_status
solve_all(solver *s, qdot_expr e, qdot_expr condition)
{
    qdot_expr prepared = qdot_prepare(s->pool, e);
    qdot_factors factors;
    qdot_status status = qdot_pool_check(s->pool);
    qdot_field f;

    QDOT_TRY(status);
    if (s->depth >= MOST_DEPTH) {
        s->complete = false;
        return QDOT_OK;
    }
    s->depth++;
    qdot_field_begin(&f, s->pool, 1, &prepared, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, prepared);
        if (qdot_field_goes(&f) && !fmpz_mpoly_is_zero(r.n, f.ctx)) {
            status = qdot_factor(&f, &factors, r.n);
            for (slong i = 0; i < factors.n && status == QDOT_OK; i++)
                status = one_factor(s, &f, factors.poly + i, condition);
            qdot_factor_clear(&f, &factors);
        }
        qdot_ratio_clear(&f, &r);
    }
    if (f.state == QDOT_FIELD_FAILED && status == QDOT_OK)
        status = f.status;
    if (!qdot_field_goes(&f))
        s->complete = false;
    qdot_field_end(&f);
    s->depth--;
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

static void
solve_guarded(void *user)
{
    solver *s = user;

    s->status = solve_all(s, s->f, QDOT_NIL);
    if (s->status == QDOT_OK)
        s->status = qdot_solve_sort(s->pool, s->roots.n, s->roots.at);
}

qdot_status
qdot_solve(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts,
           qdot_root **roots, size_t *n, bool *complete)
{
    solver s = {.pool = pool, .f = f, .x = x, .facts = facts, .complete = true};
    qdot_status status;

    *roots = NULL;
    *n = 0;
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_is_zero(pool, f, facts))
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    if (qdot_solve_sign(pool, f, x) != QDOT_NIL)
        return qdot_solve_by_sign(pool, f, x, facts, roots, n, complete);
    status = qdot_flint_run(pool, solve_guarded, &s);
    if (status != QDOT_OK) { /* nothing is there any more */
        *complete = false;
        return status == QDOT_ELIMIT ? QDOT_OK : status;
    }
    if (s.status != QDOT_OK) {
        qdot_free(s.roots.at);
        return s.status;
    }
    *roots = s.roots.at;
    *n = s.roots.n;
    *complete = s.complete;
    return QDOT_OK;
}
