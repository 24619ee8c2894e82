/* proportion.c -- decides whether two equations are the same up to a factor. */
#include "normal/solve/proportion.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/normal-form.h"
#include "normal/field/prepare.h"
#include "normal/refute/ball.h"
#include "normal/simplify/simplify.h"

#define WORK 40000000

/* Mark the variables that must not occur in the factor between the two equations. */
static bool *
moving_variables(const qdot_field *f, uint32_t moving)
{
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by);

    for (slong v = 0; by != NULL && v < f->n; v++)
        by[v] = f->gen[v].kind == QDOT_GEN_PLAIN &&
                (qdot_expr_node(f->pool, f->gen[v].expr)->holds & moving);
    return by;
}

/* Whether such a variable occurs inside another function or root of the field, as in sin(q'). */
static bool
has_velocity_inside_function(const qdot_field *f, const bool *by, uint32_t moving)
{
    for (slong v = 0; v < f->n; v++)
        if (!by[v] && (qdot_expr_node(f->pool, f->gen[v].expr)->holds & moving))
            return true;
    return false;
}

static const fmpz_mpoly_struct *
find_group_by_key(const qdot_field *f, const qdot_groups *groups, const ulong *key)
{
    for (slong i = 0; i < groups->n; i++) {
        bool same = true;

        for (slong v = 0; v < f->n && same; v++)
            same = groups->key[i * f->n + v] == key[v];
        if (same)
            return groups->poly + i;
    }
    return NULL;
}

/* a = factor * b with numerators and denominators free of what holds bits of `fixed`; *moving: there
 * are such variables. */
static qdot_status
find_constant_ratio(qdot_field *f, const qdot_ratio *a, const qdot_ratio *b, uint32_t fixed,
                    qdot_ratio *factor, bool *proved, bool *moving)
{
    bool *by = moving_variables(f, fixed);
    qdot_groups ga = {0}, gb = {0};
    qdot_status status;
    qdot_ratio x, y;

    *proved = *moving = false;
    if (by == NULL)
        return QDOT_ENOMEM;
    if (has_velocity_inside_function(f, by, fixed)) {
        qdot_free(by);
        return QDOT_OK;
    }
    /* a numerator over another's, times the denominators: both free of velocities or
     * not */
    status = qdot_factor_group(f, &ga, a->n, by);
    if (status == QDOT_OK)
        status = qdot_factor_group(f, &gb, b->n, by);
    for (slong v = 0; v < f->n; v++)
        if (by[v] && (fmpz_mpoly_degree_si(a->d, v, f->ctx) > 0 ||
                      fmpz_mpoly_degree_si(b->d, v, f->ctx) > 0))
            status = status == QDOT_OK ? QDOT_EFAILED : status;
    qdot_ratio_init(f, &x);
    qdot_ratio_init(f, &y);
    if (status == QDOT_OK && gb.n > 0) {
        /* the group with the shortest coefficient determines what the factor must be */
        slong at = 0;
        const fmpz_mpoly_struct *match;

        for (slong i = 0; i < gb.n; i++) {
            *moving |= gb.n > 1;
            for (slong v = 0; v < f->n; v++)
                *moving |= gb.key[i * f->n + v] > 0;
            if (fmpz_mpoly_length(gb.poly + i, f->ctx) <
                fmpz_mpoly_length(gb.poly + at, f->ctx))
                at = i;
        }
        match = find_group_by_key(f, &ga, gb.key + at * f->n);
        if (match != NULL) {
            qdot_field_mul(f, factor->n, match, b->d);
            qdot_field_mul(f, factor->d, gb.poly + at, a->d);
            if (!fmpz_mpoly_is_zero(factor->d, f->ctx)) {
                qdot_ratio_cancel(f, factor);
                qdot_ratio_mul(f, &x, factor, b);
                qdot_ratio_sub(f, &y, a, &x);
                qdot_field_reduce(f, y.n);
                *proved = qdot_field_goes(f) && fmpz_mpoly_is_zero(y.n, f->ctx);
            }
        }
    }
    qdot_ratio_clear(f, &x);
    qdot_ratio_clear(f, &y);
    qdot_factor_ungroup(f, &ga);
    qdot_factor_ungroup(f, &gb);
    qdot_free(by);
    return status == QDOT_EFAILED ? QDOT_OK : status;
}

static bool
factors_are_nonzero(qdot_field *f, const fmpz_mpoly_t p)
{
    qdot_factors factors;
    bool nonzero = qdot_factor(f, &factors, p) == QDOT_OK;

    for (slong i = 0; i < factors.n && nonzero; i++) {
        qdot_expr e = qdot_field_expr(f, factors.poly + i);

        nonzero = e != QDOT_NIL && (qdot_expr_node(f->pool, e)->sign & QDOT_NE0);
    }
    qdot_factor_clear(f, &factors);
    return nonzero;
}

/* The value of a symbol from a LIST of equations symbol = number, as a callback. */
static bool
value_from_list(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const qdot_ball *b = ((void **)user)[0];
    qdot_expr at = *(qdot_expr *)((void **)user)[1];

    for (uint32_t i = 0; i < qdot_expr_count(b->pool, at); i++) {
        qdot_expr row = qdot_expr_arg(b->pool, at, i);

        if (qdot_expr_arg(b->pool, row, 0) == atom) {
            arb_set_fmpq(
                value, qdot_expr_rational(b->pool, qdot_expr_arg(b->pool, row, 1)), prec);
            return true;
        }
    }
    return false;
}

/* Report the point with only one set of velocities, and the values of a and b there. */
static qdot_status
report_point(qdot_pool *pool, qdot_expr a, qdot_expr b, qdot_expr atoms, qdot_decision *d)
{
    uint32_t n = qdot_expr_count(pool, d->at), kept = 0;
    qdot_expr *rows = qdot_malloc((n + 1) * sizeof *rows), both[2] = {a, b};
    qdot_ball ball;
    void *user[2] = {&ball, &d->at};
    arb_srcptr x;

    if (rows == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr row = qdot_expr_arg(pool, d->at, i);

        if (qdot_expr_contains(pool, atoms, qdot_expr_arg(pool, row, 0)))
            rows[kept++] = row;
    }
    d->at = qdot_list(pool, kept, rows);
    qdot_free(rows);
    if (d->at == QDOT_NIL)
        return qdot_pool_check(pool);
    QDOT_TRY(qdot_ball_begin(&ball, pool, 2, both));
    qdot_ball_eval(&ball, 64, value_from_list, user);
    x = qdot_ball_get(&ball, a);
    d->left = x == NULL ? 0 : arf_get_d(arb_midref(x), ARF_RND_NEAR);
    x = qdot_ball_get(&ball, b);
    d->right = x == NULL ? 0 : arf_get_d(arb_midref(x), ARF_RND_NEAR);
    qdot_ball_end(&ball);
    return QDOT_OK;
}

/* a(q, v) b(q, w) - a(q, w) b(q, v) is zero for all v, w if a is a multiple of b; the
 * point at which it is not refutes. */
static qdot_status
refute(qdot_pool *pool, qdot_expr a, qdot_expr b, uint32_t fixed, const qdot_facts *facts,
       qdot_decision *d)
{
    qdot_expr both[2] = {a, b}, atoms, left, right;
    qdot_expr *from, *to;
    qdot_decision inner;
    qdot_status status = QDOT_OK;
    uint32_t n, moving = 0;

    atoms = qdot_expr_atoms(pool, qdot_list(pool, 2, both), true);
    if (atoms == QDOT_NIL)
        return qdot_pool_check(pool);
    n = qdot_expr_count(pool, atoms);
    from = qdot_malloc((2 * (size_t)n + 1) * sizeof *from);
    if (from == NULL)
        return QDOT_ENOMEM;
    to = from + n;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);
        char name[32];

        if (qdot_expr_kind(pool, x) != QDOT_SYM ||
            !(qdot_expr_node(pool, x)->holds & fixed))
            continue;
        snprintf(name, sizeof name, "(other %u)", moving);
        from[moving] = x;
        to[moving++] = qdot_symbol_get(pool, QDOT_FORMAL, name);
    }
    left = qdot_mul(pool, a, qdot_subs(pool, b, moving, from, to));
    right = qdot_mul(pool, qdot_subs(pool, a, moving, from, to), b);
    qdot_free(from);
    if (left == QDOT_NIL || right == QDOT_NIL)
        return qdot_pool_check(pool);
    /* do not try with relations among the facts: relations of velocities would have to hold for both sets of velocities */
    if (facts == NULL || facts->n_relations == 0)
        status = qdot_decide_equal(pool, left, right, facts, &inner);
    else
        inner.verdict = QDOT_UNDECIDED;
    if (status == QDOT_OK && inner.verdict == QDOT_REFUTED) {
        *d = inner;
        status = report_point(pool, a, b, atoms, d);
    }
    return status;
}

/* Refute that a and b are proportional, if one vanishes at a point where the other does not. */
static qdot_status
refute_by_zeros_of_one(qdot_pool *pool, qdot_expr a, qdot_expr b, qdot_decision *d)
{
    for (int side = 0; side < 2 && d->verdict == QDOT_UNDECIDED; side++) {
        qdot_expr zero = side == 0 ? a : b, other = side == 0 ? b : a;
        qdot_facts facts = {.n_relations = 1, .relations = &zero};
        qdot_decision inner;

        QDOT_TRY(qdot_decide_equal(pool, other, QDOT_ZERO, &facts, &inner));
        if (inner.verdict == QDOT_REFUTED) {
            *d = inner;
            if (side == 0) {
                d->right = inner.left;
                d->left = 0;
            }
        }
    }
    return QDOT_OK;
}

static qdot_status
decide_ratio(qdot_pool *pool, qdot_expr a, qdot_expr b, uint32_t fixed, const qdot_facts *facts,
             qdot_decision *d, qdot_expr *factor, bool *may_vanish)
{
    bool zero_a, zero_b, proved = false, moving = false;
    qdot_status status = QDOT_OK;
    qdot_expr e[2];
    qdot_field f;

    *d = (qdot_decision){.verdict = QDOT_UNDECIDED};
    *factor = QDOT_NIL;
    *may_vanish = false;
    QDOT_TRY(qdot_decide_equal(pool, a, b, facts, d));
    if (d->verdict == QDOT_PROVED) {
        *factor = QDOT_ONE;
        return QDOT_OK;
    }
    *d = (qdot_decision){.verdict = QDOT_UNDECIDED};
    zero_a = qdot_is_zero(pool, a, facts);
    zero_b = qdot_is_zero(pool, b, facts);
    if (zero_a || zero_b)
        return qdot_decide_equal(pool, a, b, facts, d);
    e[0] = qdot_prepare(pool, qdot_normal(pool, a, facts));
    e[1] = qdot_prepare(pool, qdot_normal(pool, b, facts));
    if (qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    qdot_field_begin(&f, pool, 2, e, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio x, y, k;

        qdot_field_cancelled(&f, &x, e[0]);
        qdot_field_cancelled(&f, &y, e[1]);
        qdot_ratio_init(&f, &k);
        status = find_constant_ratio(&f, &x, &y, fixed, &k, &proved, &moving);
        if (status == QDOT_OK && proved) {
            *may_vanish = !factors_are_nonzero(&f, k.n) || !factors_are_nonzero(&f, k.d);
            *factor = qdot_field_ratio_expr(&f, &k);
        }
        qdot_ratio_clear(&f, &x);
        qdot_ratio_clear(&f, &y);
        qdot_ratio_clear(&f, &k);
    }
    if (f.state == QDOT_FIELD_FAILED && status == QDOT_OK)
        status = f.status;
    qdot_field_end(&f);
    QDOT_TRY(status);
    if (qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    if (proved) {
        *factor = qdot_simplify(pool, *factor, facts);
        if (*may_vanish) {
            uint8_t sign = qdot_expr_node(pool, *factor)->sign;

            *may_vanish = !(sign & QDOT_NE0);
        }
        /* between equations without velocities any quotient is "a factor": it must not
         * vanish with a coordinate, else zeros would be lost */
        if (moving || !*may_vanish ||
            !(qdot_expr_node(pool, *factor)->holds & ~(uint32_t)QDOT_HAS_PARAM)) {
            d->verdict = QDOT_PROVED;
            return QDOT_OK;
        }
        *factor = QDOT_NIL;
        *may_vanish = false;
        return refute_by_zeros_of_one(pool, a, b, d);
    }
    return refute(pool, a, b, fixed, facts, d);
}

struct proportion {
    qdot_pool *pool;
    qdot_expr a, b;
    uint32_t fixed;
    const qdot_facts *facts;
    qdot_decision d;
    qdot_expr factor;
    bool may_vanish;
    qdot_status status;
};

static void
decide_proportion_task(void *user)
{
    struct proportion *x = user;

    x->status = decide_ratio(x->pool, x->a, x->b, x->fixed, x->facts, &x->d, &x->factor, &x->may_vanish);
}

qdot_status
qdot_decide_proportional(qdot_pool *pool, qdot_expr a, qdot_expr b, uint32_t fixed,
                         const qdot_facts *facts, qdot_decision *d, qdot_expr *factor,
                         bool *may_vanish)
{
    struct proportion x = {.pool = pool, .a = a, .b = b, .fixed = fixed, .facts = facts};
    qdot_status status = qdot_flint_run(pool, decide_proportion_task, &x);

    *d = status == QDOT_OK ? x.d : (qdot_decision){.verdict = QDOT_UNDECIDED};
    *factor = status == QDOT_OK ? x.factor : QDOT_NIL;
    *may_vanish = status == QDOT_OK && x.may_vanish;
    return status == QDOT_ELIMIT ? QDOT_OK : status != QDOT_OK ? status : x.status;
}
