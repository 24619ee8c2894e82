/* limit.c -- limits at a place, from one side or both: kinks and steps are decided near the place, then Gruntz's
 * algorithm finds the limit at infinity. */
#include "normal/calculus/limit.h"

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/elliptic.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/calculus/growth.h"
#include "normal/calculus/switch.h"
#include "normal/field/budget.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { QUESTIONS = 600, WORK = 4000000, MOST_BOUNDED = 8 };

typedef struct {
    qdot_growth growth;
    qdot_expr bounded[MOST_BOUNDED]; /* symbols for parts that are bounded but have no limit */
    size_t n;
    bool expands_elliptic; /* complete elliptic integrals are expanded where m tends to 0 or 1 */
    qdot_status status;
} approach;

/* --- kinks, steps and what oscillates -------------------------------------------------------------- */

static qdot_expr
fail_approach(approach *a, qdot_status status)
{
    a->status = status == QDOT_OK ? QDOT_EFAILED : status;
    return QDOT_NIL;
}

static qdot_expr
bounded_symbol(approach *a)
{
    static const char *const names[MOST_BOUNDED] = {"bounded 1", "bounded 2", "bounded 3", "bounded 4",
                                                    "bounded 5", "bounded 6", "bounded 7", "bounded 8"};

    if (a->n == MOST_BOUNDED)
        return fail_approach(a, QDOT_EFAILED);
    a->bounded[a->n] = qdot_symbol_get(a->growth.pool, QDOT_FORMAL, names[a->n]);
    return a->bounded[a->n++];
}

static bool
holds_bounded(const approach *a, qdot_expr e)
{
    return qdot_expr_contains_any(a->growth.pool, e, a->n, a->bounded);
}

/* The sign of u near the place. */
static bool
find_sign(approach *a, qdot_expr u, int *sign)
{
    const qdot_status status = holds_bounded(a, u) ? QDOT_EFAILED : qdot_growth_sign(&a->growth, u, sign);

    if (status != QDOT_OK)
        fail_approach(a, status);
    return status == QDOT_OK;
}

/* floor(u): constant near the place, except where u grows: there it is u less something bounded. */
static qdot_expr
resolve_floor(approach *a, qdot_expr u)
{
    qdot_pool *pool = a->growth.pool;
    qdot_expr limit = QDOT_NIL;
    const qdot_status status = holds_bounded(a, u) ? QDOT_EFAILED : qdot_growth_limit(&a->growth, u, &limit);
    int64_t whole;
    int sign;

    if (status != QDOT_OK)
        return fail_approach(a, status);
    if (qdot_infinite(pool, limit) != 0)
        return qdot_sub(pool, u, bounded_symbol(a));
    limit = qdot_simplify(pool, limit, a->growth.facts);
    if (limit == QDOT_NIL || qdot_expr_rational(pool, limit) == NULL)
        return fail_approach(a, QDOT_EFAILED);
    if (!qdot_expr_to_int(pool, limit, &whole))
        return qdot_fun1(pool, QDOT_FLOOR, limit);
    if (!find_sign(a, qdot_sub(pool, u, limit), &sign))
        return QDOT_NIL;
    return sign < 0 ? qdot_sub(pool, limit, QDOT_ONE) : limit;
}

static qdot_expr
resolve_choice(approach *a, qdot_expr e)
{
    qdot_pool *pool = a->growth.pool;
    const qdot_expr c = qdot_expr_arg(pool, e, 0);
    int sign;
    bool holds;

    if (qdot_expr_kind(pool, c) != QDOT_REL)
        return fail_approach(a, QDOT_EFAILED);
    if (!find_sign(a, qdot_sub(pool, qdot_expr_arg(pool, c, 0), qdot_expr_arg(pool, c, 1)), &sign))
        return QDOT_NIL;
    switch (qdot_expr_node(pool, c)->op) {
    case QDOT_EQ: holds = sign == 0; break;
    case QDOT_LT: holds = sign < 0; break;
    default: holds = sign <= 0;
    }
    return qdot_expr_arg(pool, e, holds ? 1 : 2);
}

static qdot_expr
resolve_extreme(approach *a, qdot_expr e)
{
    qdot_pool *pool = a->growth.pool;
    const bool max = qdot_expr_is_function(pool, e, QDOT_MAX);
    qdot_expr best = qdot_expr_arg(pool, e, 0);

    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i++) {
        const qdot_expr other = qdot_expr_arg(pool, e, i);
        int sign;

        if (!find_sign(a, qdot_sub(pool, other, best), &sign))
            return QDOT_NIL;
        if (max ? sign > 0 : sign < 0)
            best = other;
    }
    return best;
}

/* sin, cos: as they stand while the argument is bounded; the hyperbolic ones by exponentials where it is not. */
static qdot_expr
resolve_wave(approach *a, qdot_expr e, qdot_expr u)
{
    qdot_pool *pool = a->growth.pool;
    const qdot_fun_id f = (qdot_fun_id)qdot_expr_node(pool, e)->op;
    qdot_expr limit = QDOT_NIL, up, down, sum, difference;
    const qdot_expr undecided = a->growth.undecided;
    const qdot_status status = holds_bounded(a, u) ? QDOT_EFAILED : qdot_growth_limit(&a->growth, u, &limit);

    if (status == QDOT_EFAILED && (f == QDOT_SIN || f == QDOT_COS)) { /* whatever u does */
        a->growth.undecided = undecided;
        return qdot_pool_check(pool) == QDOT_OK ? bounded_symbol(a) : fail_approach(a, status);
    }
    if (status != QDOT_OK)
        return fail_approach(a, status);
    if (qdot_infinite(pool, limit) == 0)
        return e;
    if (f == QDOT_SIN || f == QDOT_COS)
        return bounded_symbol(a);
    up = qdot_fun1(pool, QDOT_EXP, u);
    down = qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, u));
    sum = qdot_mul(pool, QDOT_HALF, qdot_add(pool, up, down));
    difference = qdot_mul(pool, QDOT_HALF, qdot_sub(pool, up, down));
    return f == QDOT_COSH ? sum : f == QDOT_SINH ? difference : qdot_div(pool, difference, sum);
}

/* K(m) or E(m) where m tends to 0: the first terms of the series, and the rest. */
static qdot_expr
expand_elliptic_at_zero(approach *a, qdot_expr e, qdot_expr m)
{
    enum { TERMS = 4 };
    qdot_pool *pool = a->growth.pool;
    qdot_expr sum = qdot_mul(pool, bounded_symbol(a), qdot_pow_int(pool, m, TERMS));

    for (int64_t k = 0; k < TERMS; k++)
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_elliptic_coefficient(pool, (qdot_fun_id)qdot_expr_node(pool, e)->op, k),
                                           qdot_pow_int(pool, m, k)));
    return sum;
}

/* K(m) or E(m) where m tends to 1 from below, r = 1 - m, l = log(1/r)/2:
 *
 *     K = l + 2 log 2 + r/4 (l + 2 log 2 - 1) + 9/64 r^2 (l + 2 log 2 - 7/6) + O(r^3 (1 + l))
 *     E = 1 + r/2 (l + 2 log 2 - 1/2) + 3/16 r^2 (l + 2 log 2 - 13/12) + O(r^3 (1 + l))
 *
 * Source  NIST DLMF, 19.12.1 and 19.12.2 */
static qdot_expr
expand_elliptic_at_one(approach *a, qdot_expr e, qdot_expr m)
{
    static const int64_t of_K[3][4] = {{1, 1, 0, 1}, {1, 4, -1, 1}, {9, 64, -7, 6}},
                      of_E[3][4] = {{0, 1, 0, 1}, {1, 2, -1, 2}, {3, 16, -13, 12}};
    qdot_pool *pool = a->growth.pool;
    const bool K = qdot_expr_is_function(pool, e, QDOT_ELLIPTIC_K);
    const qdot_expr r = qdot_sub(pool, QDOT_ONE, m);
    qdot_expr l, sum = K ? QDOT_ZERO : QDOT_ONE;
    int sign;

    if (!find_sign(a, r, &sign))
        return QDOT_NIL;
    if (sign <= 0) {
        a->growth.undefined = true;
        return fail_approach(a, QDOT_EFAILED);
    }
    l = qdot_mul(pool, qdot_neg(pool, QDOT_HALF), qdot_fun1(pool, QDOT_LOG, r));
    for (int k = 0; k < 3; k++) {
        const int64_t *c = K ? of_K[k] : of_E[k];
        const qdot_expr log_4 = qdot_mul(pool, qdot_expr_int(pool, 2), qdot_fun1(pool, QDOT_LOG, qdot_expr_int(pool, 2)));
        const qdot_expr inner = qdot_sum(pool, 3, (qdot_expr[]){l, log_4, qdot_expr_ratio(pool, c[2], c[3])});

        sum = qdot_add(pool, sum,
                       qdot_product(pool, 3, (qdot_expr[]){qdot_expr_ratio(pool, c[0], c[1]), qdot_pow_int(pool, r, k), inner}));
    }
    return qdot_add(pool, sum,
                    qdot_product(pool, 3, (qdot_expr[]){bounded_symbol(a), qdot_pow_int(pool, r, 3), qdot_add(pool, QDOT_ONE, l)}));
}

static qdot_expr
resolve_complete_elliptic(approach *a, qdot_expr e, qdot_expr m)
{
    qdot_expr limit = QDOT_NIL;
    const qdot_status status = holds_bounded(a, m) ? QDOT_EFAILED : qdot_growth_limit(&a->growth, m, &limit);

    if (status != QDOT_OK)
        return fail_approach(a, status);
    limit = qdot_simplify(a->growth.pool, limit, a->growth.facts);
    return limit == QDOT_ZERO  ? expand_elliptic_at_zero(a, e, m)
           : limit == QDOT_ONE ? expand_elliptic_at_one(a, e, m)
                               : e;
}

static qdot_expr
resolve_function(qdot_pool *pool, qdot_expr e, void *user)
{
    approach *a = user;
    const qdot_fun_id f = (qdot_fun_id)qdot_expr_node(pool, e)->op;
    const qdot_expr u = qdot_expr_arg(pool, e, 0);
    int sign;

    if (!qdot_expr_contains(pool, e, a->growth.x))
        return e;
    switch (f) {
    case QDOT_ABS: return !find_sign(a, u, &sign) ? QDOT_NIL : sign < 0 ? qdot_neg(pool, u) : u;
    case QDOT_SIGN: return find_sign(a, u, &sign) ? qdot_expr_int(pool, sign) : QDOT_NIL;
    case QDOT_MIN:
    case QDOT_MAX: return resolve_extreme(a, e);
    case QDOT_FLOOR: return resolve_floor(a, u);
    case QDOT_MOD: {
        const qdot_expr m = qdot_expr_arg(pool, e, 1), whole = resolve_floor(a, qdot_div(pool, u, m));

        return whole == QDOT_NIL ? whole : qdot_expand(pool, qdot_sub(pool, u, qdot_mul(pool, m, whole)));
    }
    case QDOT_IF: return resolve_choice(a, e);
    case QDOT_SIN:
    case QDOT_COS:
    case QDOT_SINH:
    case QDOT_COSH:
    case QDOT_TANH: return resolve_wave(a, e, u);
    case QDOT_ELLIPTIC_K:
    case QDOT_ELLIPTIC_E:
        return a->expands_elliptic && qdot_expr_count(pool, e) == 1 ? resolve_complete_elliptic(a, e, u) : e;
    default: return e;
    }
}

/* --- bounded parts -------------------------------------------------------------------------------------- */

/* Whether the term is a polynomial in the bounded symbols; *rest: its other factors. */
static bool
split_bounded(const approach *a, qdot_expr t, qdot_expr *rest)
{
    qdot_pool *pool = a->growth.pool;

    *rest = QDOT_ONE;
    if (qdot_expr_place(a->n, a->bounded, t) < a->n)
        return true;
    if (qdot_expr_kind(pool, t) != QDOT_PROD)
        return false;
    for (uint32_t i = 1; i < qdot_expr_count(pool, t); i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, t, i), p = qdot_expr_arg(pool, t, i + 1);
        int64_t k;

        if (qdot_expr_place(a->n, a->bounded, b) < a->n) {
            if (!qdot_expr_to_int(pool, p, &k) || k < 1)
                return false;
        } else {
            *rest = qdot_mul(pool, *rest, qdot_pow(pool, b, p));
        }
    }
    return *rest != QDOT_NIL && !holds_bounded(a, *rest);
}

/* Leave out the terms with bounded parts whose coefficients have a limit; *remain: one of these limits is not 0, so that
 * something bounded is left out. QDOT_EFAILED where one grows. */
static qdot_status
drop_bounded(approach *a, qdot_expr *e, bool *remain)
{
    qdot_pool *pool = a->growth.pool;
    qdot_expr kept, sum;

    if (a->n == 0)
        return QDOT_OK;
    sum = qdot_expand(pool, *e);
    if (sum == QDOT_NIL)
        return QDOT_EFAILED;
    kept = qdot_expr_kind(pool, sum) == QDOT_SUM ? qdot_expr_arg(pool, sum, 0) : QDOT_ZERO;
    for (uint32_t i = 1; i < (qdot_expr_kind(pool, sum) == QDOT_SUM ? qdot_expr_count(pool, sum) : 2); i += 2) {
        const bool whole = qdot_expr_kind(pool, sum) != QDOT_SUM;
        const qdot_expr t = whole ? sum : qdot_expr_arg(pool, sum, i), c = whole ? QDOT_ONE : qdot_expr_arg(pool, sum, i + 1);
        qdot_expr rest, limit;

        if (!holds_bounded(a, t)) {
            kept = qdot_add(pool, kept, qdot_mul(pool, c, t));
            continue;
        }
        if (!split_bounded(a, t, &rest))
            return QDOT_EFAILED;
        QDOT_TRY(qdot_growth_limit(&a->growth, rest, &limit));
        if (qdot_infinite(pool, limit) != 0)
            return QDOT_EFAILED;
        *remain = *remain || limit != QDOT_ZERO;
    }
    *e = kept;
    return QDOT_OK;
}

/* Whether e holds a power whose base is negative near the place and whose exponent moves: it has no real values on an interval. */
static bool
has_power_of_negative(approach *a, qdot_expr e)
{
    qdot_pool *pool = a->growth.pool;
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && !found; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && k < qdot_expr_count(pool, w.at[i]) && !found; k += 2) {
            const qdot_expr b = qdot_expr_arg(pool, w.at[i], k), p = qdot_expr_arg(pool, w.at[i], k + 1);
            int sign;

            found = qdot_expr_contains(pool, p, a->growth.x) && !holds_bounded(a, b) &&
                    qdot_growth_sign(&a->growth, b, &sign) == QDOT_OK && sign < 0;
        }
    qdot_walk_end(&w);
    return found;
}

/* --- one side, both sides -------------------------------------------------------------------------------- */

/* The limit of e as x tends to at + sign/X, X to infinity; `at` may be infinite. Complete elliptic integrals are expanded, or
 * stay as they are. */
static qdot_status
limit_on_side_by(qdot_pool *pool, const qdot_facts *facts, qdot_expr e, qdot_expr x, qdot_expr at, int sign,
                 bool expands_elliptic, qdot_limit_answer *answer)
{
    const qdot_expr X = qdot_symbol_get(pool, QDOT_FORMAL, "a large number"),
                    w = qdot_symbol_get(pool, QDOT_FORMAL, "a small number");
    approach a = {.growth = {.pool = pool, .facts = facts, .x = X, .w = w, .work = QUESTIONS},
                  .expands_elliptic = expands_elliptic};
    qdot_expr place, limit = QDOT_NIL;
    bool remain = false;
    qdot_status status;

    *answer = (qdot_limit_answer){.kind = QDOT_LIMIT_NOT_FOUND};
    qdot_symbol_domain(pool, X, QDOT_ZERO, true, QDOT_NIL, false);
    qdot_symbol_domain(pool, w, QDOT_ZERO, true, QDOT_NIL, false);
    if (qdot_infinite(pool, at) != 0)
        place = qdot_mul(pool, qdot_expr_int(pool, qdot_infinite(pool, at)), X);
    else
        place = qdot_add(pool, at, qdot_div(pool, qdot_expr_int(pool, sign), X));
    e = qdot_subs(pool, e, 1, &x, &place);
    status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN)
        answer->kind = QDOT_LIMIT_UNDEFINED;
    if (status == QDOT_OK)
        e = qdot_walk_replace(pool, e, QDOT_FUN, resolve_function, &a);
    if (status == QDOT_OK)
        status = a.status != QDOT_OK ? a.status : qdot_pool_check(pool);
    if (status == QDOT_OK && has_power_of_negative(&a, e)) {
        a.growth.undefined = true;
        status = QDOT_EFAILED;
    }
    if (status == QDOT_OK)
        status = drop_bounded(&a, &e, &remain);
    if (status == QDOT_OK)
        status = qdot_growth_limit(&a.growth, e, &limit);
    if (status == QDOT_OK && remain && qdot_infinite(pool, limit) == 0)
        status = QDOT_EFAILED;
    if (qdot_grave(status) != QDOT_OK)
        return status;
    if (status != QDOT_OK) {
        if (a.growth.undefined)
            answer->kind = QDOT_LIMIT_UNDEFINED;
        answer->undecided = a.growth.undecided;
        QDOT_TRY(qdot_grave(qdot_pool_check(pool)));
        return QDOT_OK;
    }
    answer->kind = qdot_infinite(pool, limit) != 0 ? QDOT_LIMIT_INFINITE : QDOT_LIMIT_VALUE;
    answer->value = answer->kind == QDOT_LIMIT_VALUE ? qdot_simplify(pool, limit, facts) : limit;
    QDOT_TRY(qdot_grave(qdot_pool_check(pool)));
    if (answer->value == QDOT_NIL)
        answer->value = limit;
    return QDOT_OK;
}

/* The limit of an e without steps, which is continuous: its value at the place, if it has one. */
static qdot_status
put_place(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr at, qdot_limit_answer *answer)
{
    qdot_expr value;

    if (qdot_infinite(pool, at) != 0 || qdot_has_steps(pool, e, x))
        return QDOT_OK;
    value = qdot_subs(pool, e, 1, &x, &at);
    if (value != QDOT_NIL)
        *answer = (qdot_limit_answer){.kind = QDOT_LIMIT_VALUE, .value = value};
    return qdot_grave(qdot_pool_check(pool));
}

/* The limit of e as x tends to `at` from one side. Complete elliptic integrals in e stay as they are at first; if no limit
 * is found so, they are expanded where m tends to 0 or 1; if none is found then, e has its value at the place as limit. */
static qdot_status
limit_on_side(qdot_pool *pool, const qdot_facts *facts, qdot_expr e, qdot_expr x, qdot_expr at, int sign,
              qdot_limit_answer *answer)
{
    static const qdot_fun_id complete[] = {QDOT_ELLIPTIC_K, QDOT_ELLIPTIC_E};

    QDOT_TRY(limit_on_side_by(pool, facts, e, x, at, sign, false, answer));
    if (answer->kind != QDOT_LIMIT_NOT_FOUND || qdot_expr_find_function(pool, e, 2, complete, x) == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(limit_on_side_by(pool, facts, e, x, at, sign, true, answer));
    return answer->kind == QDOT_LIMIT_NOT_FOUND ? put_place(pool, e, x, at, answer) : QDOT_OK;
}

/* Join what was found on both sides. */
static qdot_status
join_sides(qdot_pool *pool, const qdot_facts *facts, const qdot_limit_answer *left, const qdot_limit_answer *right,
           qdot_limit_answer *answer)
{
    qdot_decision decision = {.verdict = QDOT_UNDECIDED};

    *answer = left->kind == QDOT_LIMIT_UNDEFINED ? *right : *left;
    if (left->kind == QDOT_LIMIT_UNDEFINED || right->kind == QDOT_LIMIT_UNDEFINED)
        return QDOT_OK;
    *answer = (qdot_limit_answer){.kind = QDOT_LIMIT_NOT_FOUND,
                                  .undecided = left->undecided != QDOT_NIL ? left->undecided : right->undecided};
    if (left->kind == QDOT_LIMIT_NOT_FOUND || right->kind == QDOT_LIMIT_NOT_FOUND)
        return QDOT_OK;
    if (left->value == right->value) {
        *answer = *right;
        return QDOT_OK;
    }
    if (left->kind == QDOT_LIMIT_VALUE && right->kind == QDOT_LIMIT_VALUE) {
        QDOT_TRY(qdot_decide_equal(pool, left->value, right->value, facts, &decision));
        if (decision.verdict == QDOT_PROVED)
            *answer = *right;
        if (decision.verdict != QDOT_REFUTED)
            return QDOT_OK;
    }
    *answer = (qdot_limit_answer){.kind = QDOT_LIMIT_NONE, .left = left->value, .right = right->value};
    return QDOT_OK;
}

qdot_status
qdot_limit(qdot_pool *pool, const qdot_facts *facts, qdot_expr e, qdot_expr x, qdot_expr at, int side,
           qdot_limit_answer *answer)
{
    const qdot_budget budget = qdot_budget_begin(pool, WORK);
    qdot_limit_answer left, right;
    qdot_status status;

    *answer = (qdot_limit_answer){.kind = QDOT_LIMIT_NOT_FOUND};
    if (side != 0 || qdot_infinite(pool, at) != 0) {
        status = limit_on_side(pool, facts, e, x, at, side < 0 ? -1 : 1, answer);
    } else {
        status = limit_on_side(pool, facts, e, x, at, 1, &right);
        if (status == QDOT_OK)
            status = limit_on_side(pool, facts, e, x, at, -1, &left);
        if (status == QDOT_OK)
            status = join_sides(pool, facts, &left, &right, answer);
    }
    qdot_budget_end(pool, &budget);
    return status;
}
