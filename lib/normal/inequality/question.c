/* question.c -- replaces functions by new symbols with bounds, so that only algebraic expressions remain. */
#include "normal/inequality/question.h"

#include <stdio.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/field.h"
#include "normal/field/prepare.h"
#include "normal/prove/rewrite.h"
#include "normal/prove/zero.h"

enum { MOST_SUBSTITUTES = 24, MOST_TERMS = 300 };
#define WORK 1000000

void
qdot_question_demand(qdot_question *q, qdot_expr gap, bool weak)
{
    if (gap == QDOT_NIL || q->n == QDOT_QUESTION_CONDITIONS)
        q->too_much = true;
    else
        q->condition[q->n++] = (qdot_cells_condition){gap, weak};
}

typedef struct {
    qdot_pool *pool;
    qdot_question *q;
    qdot_expr from[MOST_SUBSTITUTES], to[MOST_SUBSTITUTES];
    size_t n;
} substitutes;

static qdot_expr
new_symbol(substitutes *s, const char *what)
{
    char name[64];
    qdot_expr y;

    snprintf(name, sizeof name, "(%s %zu)", what, s->n);
    y = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    s->q->exact = false;
    return y;
}

static void
stand_for(substitutes *s, qdot_expr from, qdot_expr to)
{
    if (s->n == MOST_SUBSTITUTES || to == QDOT_NIL) {
        s->q->too_much = true;
        return;
    }
    s->from[s->n] = from;
    s->to[s->n++] = to;
}

/* A new symbol y with the conditions lo < y < hi, or <= where lo_weak or hi_weak is true. */
static qdot_expr
bounded_symbol(substitutes *s, const char *what, qdot_expr lo, qdot_expr hi, bool lo_weak,
               bool hi_weak)
{
    qdot_expr y = new_symbol(s, what);

    qdot_question_demand(s->q, qdot_sub(s->pool, y, lo), lo_weak);
    qdot_question_demand(s->q, qdot_sub(s->pool, hi, y), hi_weak);
    return y;
}

static void
demand_sign(substitutes *s, qdot_expr y, uint8_t sign)
{
    if (sign & QDOT_GE0)
        qdot_question_demand(s->q, y, !(sign & QDOT_NE0));
    if (sign & QDOT_LE0)
        qdot_question_demand(s->q, qdot_neg(s->pool, y), !(sign & QDOT_NE0));
}

/* Replace pi by an unknown between two close rationals, so that fractions of it are bounded on both sides. */
static qdot_expr
replace_pi(substitutes *s)
{
    qdot_expr lo = qdot_expr_ratio(s->pool, 3141592653589793, 1000000000000000);
    qdot_expr hi = qdot_expr_ratio(s->pool, 3141592653589794, 1000000000000000);

    return bounded_symbol(s, "pi", lo, hi, false, false);
}

static qdot_expr
replace_plain_function(substitutes *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    uint32_t op = qdot_expr_kind(pool, e) == QDOT_FUN ? qdot_expr_node(pool, e)->op
                                                      : QDOT_FUNCTION_COUNT;
    uint8_t sign = qdot_expr_node(pool, e)->sign;
    qdot_expr half = qdot_mul(pool, QDOT_HALF, QDOT_PI), y;

    switch (op) {
    case QDOT_ATAN:
        y = bounded_symbol(s, "atan", qdot_neg(pool, half), half, false, false);
        break;
    case QDOT_ASIN: y = bounded_symbol(s, "asin", qdot_neg(pool, half), half, true, true); break;
    case QDOT_ACOS: /* pi/2 - asin */
        y = bounded_symbol(s, "acos", QDOT_ZERO, QDOT_PI, true, true);
        demand_sign(s, qdot_sub(pool, half, y), qdot_expr_sign(pool, qdot_expr_arg(pool, e, 0)));
        break;
    case QDOT_ATAN2:
        y = bounded_symbol(s, "atan2", qdot_neg(pool, QDOT_PI), QDOT_PI, false, true);
        break;
    case QDOT_SIGN: y = bounded_symbol(s, "sign", QDOT_MINUS_ONE, QDOT_ONE, true, true); break;
    default: y = new_symbol(s, "value"); break;
    }
    demand_sign(s, y, sign);
    return y;
}

/* Replace cosine and sine by (1 - t^2)/(1 + t^2), 2 t/(1 + t^2); their known signs bound t. */
static void
replace_by_half_angle(substitutes *s, const qdot_field *f, slong sine)
{
    qdot_pool *pool = s->pool;
    const qdot_gen *gs = &f->gen[sine], *gc = &f->gen[gs->pair];
    qdot_expr t = new_symbol(s, "tan"), square = qdot_pow_int(pool, t, 2);
    qdot_expr over = qdot_div(pool, QDOT_ONE, qdot_add(pool, QDOT_ONE, square));
    uint8_t of_sine = qdot_range_sign(pool, gs), of_cosine = qdot_range_sign(pool, gc);

    demand_sign(s, t, of_sine);
    if (of_cosine & QDOT_GE0) {
        qdot_question_demand(s->q, qdot_sub(pool, QDOT_ONE, t), !(of_cosine & QDOT_NE0));
        qdot_question_demand(s->q, qdot_add(pool, QDOT_ONE, t), !(of_cosine & QDOT_NE0));
    }
    stand_for(s, gs->expr,
              qdot_mul(pool, qdot_mul(pool, qdot_expr_int(pool, 2), t), over));
    stand_for(s, gc->expr, qdot_mul(pool, qdot_sub(pool, QDOT_ONE, square), over));
}

/* Replace exp(u) by an unknown E > 0, with E > 1 or E < 1 if u has a sign. */
static qdot_expr
replace_exponential(substitutes *s, qdot_expr u)
{
    qdot_pool *pool = s->pool;
    uint8_t sign = qdot_expr_node(pool, u)->sign;
    qdot_expr E = new_symbol(s, "exp");

    qdot_question_demand(s->q, E, false);
    if (sign & QDOT_GE0)
        qdot_question_demand(s->q, qdot_sub(pool, E, QDOT_ONE), !(sign & QDOT_NE0));
    if (sign & QDOT_LE0)
        qdot_question_demand(s->q, qdot_sub(pool, QDOT_ONE, E), !(sign & QDOT_NE0));
    return E;
}

static void
replace_hyperbolic(substitutes *s, const qdot_field *f, slong sine)
{
    qdot_pool *pool = s->pool;
    const qdot_gen *gs = &f->gen[sine], *gc = &f->gen[gs->pair];
    qdot_expr E = replace_exponential(s, gs->of), over = qdot_div(pool, QDOT_ONE, E);

    stand_for(s, gs->expr, qdot_mul(pool, QDOT_HALF, qdot_sub(pool, E, over)));
    stand_for(s, gc->expr, qdot_mul(pool, QDOT_HALF, qdot_add(pool, E, over)));
}

static qdot_expr
replacement_of(const substitutes *s, qdot_expr e)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->from[i] == e)
            return s->to[i];
    return e;
}

/* p with all replacements inserted, directly as a polynomial, because as an expression exp(x)^2
 * becomes exp(2*x). */
static qdot_expr
polynomial(substitutes *s, qdot_field *f, const fmpz_mpoly_t p)
{
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    qdot_expr sum = QDOT_ZERO;
    fmpq_t c;

    if (exp == NULL)
        return qdot_pool_fail(s->pool);
    fmpq_init(c);
    for (slong i = 0; i < fmpz_mpoly_length(p, f->ctx); i++) {
        qdot_expr term;

        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        fmpq_set_fmpz(c, p->coeffs + i);
        term = qdot_expr_fmpq(s->pool, c);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] > 0)
                term = qdot_mul(
                    s->pool, term,
                    qdot_pow_int(s->pool, replacement_of(s, f->gen[v].expr), (int64_t)exp[v]));
        sum = qdot_add(s->pool, sum, term);
    }
    fmpq_clear(c);
    qdot_free(exp);
    return sum;
}

/* The value of a node of the field with all replacements inserted. */
static qdot_expr
value_with_replacements(substitutes *s, qdot_field *f, qdot_expr e)
{
    const qdot_ratio *r = qdot_field_value(f, e);

    if (r == NULL || fmpz_mpoly_length(r->n, f->ctx) > MOST_TERMS ||
        fmpz_mpoly_length(r->d, f->ctx) > MOST_TERMS)
        return QDOT_NIL;
    return qdot_div(s->pool, polynomial(s, f, r->n), polynomial(s, f, r->d));
}

static void
replace_generator(substitutes *s, qdot_field *f, slong v)
{
    qdot_pool *pool = s->pool;
    const qdot_gen *g = &f->gen[v];

    switch (g->kind) {
    case QDOT_GEN_PLAIN:
        if (g->expr == QDOT_PI)
            stand_for(s, g->expr, replace_pi(s));
        else if (qdot_expr_kind(pool, g->expr) != QDOT_SYM)
            stand_for(s, g->expr, replace_plain_function(s, g->expr));
        break;
    case QDOT_GEN_SIN: replace_by_half_angle(s, f, v); break;
    case QDOT_GEN_SINH: replace_hyperbolic(s, f, v); break;
    case QDOT_GEN_EXP: stand_for(s, g->expr, replace_exponential(s, g->of)); break;
    case QDOT_GEN_ROOT:
        if (!qdot_expr_is_constant(pool, g->of))
            stand_for(s, g->expr,
                      qdot_pow(pool, value_with_replacements(s, f, g->of),
                               qdot_expr_ratio(pool, 1, (int64_t)g->order)));
        break;
    default: s->q->too_much |= g->kind == QDOT_GEN_ABS; break;
    }
}

/* Replace floor(u) by u - y and mod(u, m), m > 0, by m y, where 0 <= y < 1; also max and min. */
static qdot_expr
replace_whole_parts(qdot_pool *pool, qdot_expr e, void *user)
{
    substitutes *s = user;
    qdot_expr y, m;

    if (qdot_expr_kind(s->pool, e) != QDOT_FUN)
        return QDOT_NIL;
    switch (qdot_expr_node(s->pool, e)->op) {
    case QDOT_FLOOR:
        y = bounded_symbol(s, "part", QDOT_ZERO, QDOT_ONE, true, false);
        stand_for(s, e, y); /* replaces e by the new symbol y */
        return qdot_sub(s->pool, qdot_expr_arg(s->pool, e, 0), y);
    case QDOT_MOD:
        m = qdot_expr_arg(s->pool, e, 1);
        if ((qdot_expr_node(s->pool, m)->sign & QDOT_POS) != QDOT_POS)
            return QDOT_NIL;
        y = bounded_symbol(s, "part", QDOT_ZERO, QDOT_ONE, true, false);
        stand_for(s, e, y);
        return qdot_mul(s->pool, m, y);
    case QDOT_MAX:
    case QDOT_MIN: return qdot_rewrite_extreme(pool, e);
    default: return QDOT_NIL;
    }
}

void
qdot_question_reduce(qdot_pool *pool, qdot_question *q)
{
    substitutes s = {.pool = pool, .q = q};
    qdot_expr all[1 + QDOT_QUESTION_CONDITIONS];
    size_t n = q->n;
    qdot_field f;

    all[0] = qdot_prepare(pool, q->e);
    for (size_t i = 0; i < n; i++)
        all[1 + i] = qdot_prepare(pool, q->condition[i].gap);
    if (qdot_pool_failed(pool) || q->too_much) {
        q->too_much = true;
        return;
    }
    qdot_field_begin(&f, pool, 1 + n, all, WORK);
    /* replace inner roots, which have larger indices, before outer ones */
    for (slong v = f.n - 1; v >= 0 && qdot_field_goes(&f) && !q->too_much; v--)
        replace_generator(&s, &f, v);
    for (size_t i = 0; i < 1 + n && qdot_field_goes(&f) && !q->too_much; i++) {
        qdot_expr now = value_with_replacements(&s, &f, all[i]);

        q->too_much |= now == QDOT_NIL;
        if (i == 0)
            q->e = now;
        else
            q->condition[i - 1].gap = now;
    }
    for (size_t i = n, stands = q->n; i < stands && !q->too_much; i++) /* if conditions contain pi, bound it by rationals */
        if (qdot_expr_contains(pool, q->condition[i].gap, QDOT_PI) && replacement_of(&s, QDOT_PI) == QDOT_PI)
            stand_for(&s, QDOT_PI, replace_pi(&s));
    for (size_t i = n; i < q->n && !q->too_much; i++)
        q->condition[i].gap = qdot_subs(pool, q->condition[i].gap, s.n, s.from, s.to);
    q->too_much |= !qdot_field_goes(&f);
    qdot_field_end(&f);
}

void
qdot_question_whole_parts(qdot_pool *pool, qdot_question *q)
{
    substitutes s = {.pool = pool, .q = q};

    q->e = qdot_prepare(pool, qdot_walk_map(pool, q->e, replace_whole_parts, &s));
    q->too_much |= q->e == QDOT_NIL;
}
