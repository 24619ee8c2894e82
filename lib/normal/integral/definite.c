/* definite.c -- integrals from a to b by antiderivatives, split where something is not continuous. */
#include "normal/integral/definite.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/calculus/switch.h"
#include "normal/inequality/less.h"
#include "normal/integral/antiderivative.h"
#include "normal/integral/ends.h"
#include "normal/integral/improper.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST_PLACES = 24, MOST_DANGERS = 40, MOST_CONDITIONS = 16 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x;      /* the variable; its domain is lo < x < hi where that is known to be a range */
    qdot_expr lo, hi; /* QDOT_INFINITY or its negative: no end */
    bool ordered;     /* lo < hi is known */
    qdot_expr place[MOST_PLACES]; /* [n] inside lo < x < hi, ascending */
    size_t n;
    qdot_status status;
    qdot_definite_answer *answer;
} range;

static bool
is_infinite(const qdot_pool *pool, qdot_expr e)
{
    return qdot_infinite(pool, e) != 0;
}

/* Whether 0 < e is proved. */
static bool
is_positive(range *r, qdot_expr e)
{
    qdot_decision decision = {.verdict = QDOT_UNDECIDED};

    if (e == QDOT_NIL || r->status != QDOT_OK)
        return false;
    if ((qdot_expr_sign(r->pool, e) & QDOT_POS) == QDOT_POS)
        return true;
    r->status = qdot_decide_less(r->pool, QDOT_ZERO, e, true, r->facts, &decision);
    return decision.verdict == QDOT_PROVED;
}

/* The sign of e, proved: 1 or -1; 0: not known. */
static int
proved_sign(range *r, qdot_expr e)
{
    return is_positive(r, e) ? 1 : is_positive(r, qdot_neg(r->pool, e)) ? -1 : 0;
}

/* The sign of g at a place; 0: not known. */
static int
sign_at(range *r, qdot_expr g, qdot_expr place)
{
    const qdot_expr value = qdot_subs(r->pool, g, 1, &r->x, &place);

    if (value == QDOT_NIL) { /* not defined there */
        r->status = qdot_grave(qdot_pool_check(r->pool));
        return 0;
    }
    return proved_sign(r, value);
}

/* The sign of g, which has no zeros inside the range: everywhere, at an end where it is continuous, or at one point
 * inside; 0: not known. */
static int
sign_inside(range *r, qdot_expr g)
{
    qdot_pool *pool = r->pool;
    bool no_lo = is_infinite(pool, r->lo), no_hi = is_infinite(pool, r->hi);
    int sign = proved_sign(r, g);

    if (sign != 0 || !r->ordered || r->status != QDOT_OK)
        return sign;
    if (!no_lo && !qdot_has_steps(pool, g, r->x))
        sign = sign_at(r, g, r->lo);
    if (sign == 0 && !no_hi && !qdot_has_steps(pool, g, r->x))
        sign = sign_at(r, g, r->hi);
    if (sign == 0)
        sign = sign_at(r, g,
                       no_lo && no_hi ? QDOT_ZERO
                       : no_lo        ? qdot_sub(pool, r->hi, QDOT_ONE)
                       : no_hi        ? qdot_add(pool, r->lo, QDOT_ONE)
                                      : qdot_mul(pool, QDOT_HALF, qdot_add(pool, r->lo, r->hi)));
    return sign;
}

/* --- places at which something may happen ---------------------------------------------- */

static void
add_place(range *r, qdot_expr at, bool *known)
{
    size_t i;

    if (is_infinite(r->pool, at))
        return;
    if (!r->ordered) {
        *known = false;
        return;
    }
    if ((!is_infinite(r->pool, r->lo) && qdot_is_zero(r->pool, qdot_sub(r->pool, at, r->lo), r->facts)) ||
        (!is_infinite(r->pool, r->hi) && qdot_is_zero(r->pool, qdot_sub(r->pool, at, r->hi), r->facts)))
        return;
    if ((!is_infinite(r->pool, r->lo) && is_positive(r, qdot_sub(r->pool, r->lo, at))) ||
        (!is_infinite(r->pool, r->hi) && is_positive(r, qdot_sub(r->pool, at, r->hi))))
        return;
    if ((!is_infinite(r->pool, r->lo) && !is_positive(r, qdot_sub(r->pool, at, r->lo))) ||
        (!is_infinite(r->pool, r->hi) && !is_positive(r, qdot_sub(r->pool, r->hi, at)))) {
        *known = false;
        return;
    }
    for (i = 0; i < r->n; i++) {
        if (qdot_is_zero(r->pool, qdot_sub(r->pool, at, r->place[i]), r->facts))
            return;
        if (is_positive(r, qdot_sub(r->pool, r->place[i], at)))
            break;
        if (!is_positive(r, qdot_sub(r->pool, at, r->place[i]))) {
            *known = false;
            return;
        }
    }
    if (r->n == MOST_PLACES) {
        *known = false;
        return;
    }
    for (size_t k = r->n++; k > i; k--)
        r->place[k] = r->place[k - 1];
    r->place[i] = at;
}

/* Add the zeros of g inside the range; false: they are not all known. */
static bool
add_zeros(range *r, qdot_expr g)
{
    qdot_solutions roots = {0};
    bool known = true;

    if (g == QDOT_NIL || !qdot_expr_contains(r->pool, g, r->x))
        return g != QDOT_NIL;
    if (proved_sign(r, g) != 0)
        return true;
    if (r->status != QDOT_OK)
        return false;
    r->status = qdot_solve_inside(r->pool, g, r->x, QDOT_NIL, r->facts, &roots);
    if (r->status != QDOT_OK && qdot_grave(r->status) == QDOT_OK) { /* g is 0 everywhere, or the like */
        r->status = QDOT_OK;
        known = false;
    }
    known = known && roots.complete && !roots.single && !roots.recurs;
    for (size_t i = 0; i < roots.root.n && known && r->status == QDOT_OK; i++) {
        const qdot_root *root = &roots.root.at[i];

        if (root->period != QDOT_NIL || root->value == r->x || qdot_expr_contains(r->pool, root->value, r->x))
            known = false;
        else
            add_place(r, root->value, &known);
    }
    qdot_solutions_clear(&roots);
    return known && r->status == QDOT_OK;
}

/* The expression whose zeros are the places where the node may not be continuous; one: there are none. *real: the node
 * is real only where it is > 0. `jumps`: the node may jump there; nil where it may not. */
static qdot_expr
danger_of(range *r, qdot_expr e, uint32_t i, bool jumps, bool *real)
{
    qdot_pool *pool = r->pool;
    qdot_expr u;

    *real = false;
    if (qdot_expr_kind(pool, e) == QDOT_PROD) {
        qdot_expr exponent = qdot_expr_arg(pool, e, i + 1);
        long k;

        u = qdot_expr_arg(pool, e, i);
        if (!qdot_expr_contains(pool, u, r->x))
            return QDOT_ONE;
        if (qdot_expr_to_int(pool, exponent, &k))
            return k > 0 ? QDOT_ONE : u;
        *real = true;
        return u;
    }
    u = qdot_expr_arg(pool, e, 0);
    *real = qdot_expr_is_function(pool, e, QDOT_LOG) || qdot_expr_is_function(pool, e, QDOT_ASIN) ||
            qdot_expr_is_function(pool, e, QDOT_ACOS) || qdot_expr_is_function(pool, e, QDOT_ATANH) ||
            qdot_expr_is_function(pool, e, QDOT_ACOSH);
    switch ((qdot_fun_id)qdot_expr_node(pool, e)->op) {
    case QDOT_TAN:
    case QDOT_SEC: return qdot_fun1(pool, QDOT_COS, u);
    case QDOT_COT:
    case QDOT_CSC: return qdot_fun1(pool, QDOT_SIN, u);
    case QDOT_ASIN:
    case QDOT_ACOS:
    case QDOT_ATANH: return qdot_sub(pool, QDOT_ONE, qdot_mul(pool, u, u));
    case QDOT_ACOSH: return qdot_sub(pool, u, QDOT_ONE);
    case QDOT_LOG: return u;
    case QDOT_ABS: return u;
    case QDOT_SIGN: return jumps ? u : QDOT_NIL;
    case QDOT_MAX:
    case QDOT_MIN: { /* where any two of them are equal */
        qdot_expr product = QDOT_ONE;

        for (uint32_t k = 0; k < qdot_expr_count(pool, e); k++)
            for (uint32_t j = 0; j < k; j++)
                product = qdot_mul(pool, product, qdot_sub(pool, qdot_expr_arg(pool, e, k), qdot_expr_arg(pool, e, j)));
        return product;
    }
    case QDOT_IF:
        return qdot_expr_kind(pool, u) != QDOT_REL ? QDOT_NIL
               : qdot_expr_contains(pool, u, r->x) && !jumps ? QDOT_NIL
               : qdot_expr_contains(pool, u, r->x) ? qdot_sub(pool, qdot_expr_arg(pool, u, 0), qdot_expr_arg(pool, u, 1))
                                                   : QDOT_ONE;
    case QDOT_MOD: /* where u is a multiple of the modulus */
        return qdot_expr_contains(pool, qdot_expr_arg(pool, e, 1), r->x) || !jumps
                   ? QDOT_NIL
                   : qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, QDOT_PI, qdot_div(pool, u, qdot_expr_arg(pool, e, 1))));
    case QDOT_FLOOR: return jumps ? qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, QDOT_PI, u)) : QDOT_NIL;
    case QDOT_ATAN2: return QDOT_NIL;
    default: return QDOT_ONE;
    }
}

typedef struct {
    size_t n;
    qdot_expr at[MOST_DANGERS];
    bool real[MOST_DANGERS]; /* must be positive for the expression to be real */
} dangers;

/* Collect the expressions at whose zeros e may have a kink, a jump (if `jumps`) or a pole; false: not all are known. */
static bool
collect_dangers(range *r, qdot_expr e, bool jumps, dangers *d)
{
    bool known = true;
    qdot_walk w;

    r->status = qdot_walk_begin(r->pool, e, &w);
    if (r->status != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && known; i++) {
        qdot_kind kind = qdot_expr_kind(r->pool, w.at[i]);
        uint32_t count = kind == QDOT_PROD ? qdot_expr_count(r->pool, w.at[i]) : kind == QDOT_FUN ? 2 : 0;

        /* all others have none: undefined functions are smooth */
        if (count == 0 || !qdot_expr_contains(r->pool, w.at[i], r->x))
            continue;
        for (uint32_t k = 1; k < count && known; k += 2) {
            bool real;
            qdot_expr g = danger_of(r, w.at[i], k, jumps, &real);

            known = g != QDOT_NIL && d->n < MOST_DANGERS;
            if (known && g != QDOT_ONE) {
                d->real[d->n] = real;
                d->at[d->n++] = g;
            }
        }
    }
    qdot_walk_end(&w);
    return known;
}

/* Add the places inside the range where e may have a kink, a jump (if `jumps`) or a pole; false: they are not all known. */
static bool
add_dangers(range *r, qdot_expr e, bool jumps)
{
    dangers d = {0};
    bool known = collect_dangers(r, e, jumps, &d);

    for (size_t i = 0; i < d.n && known; i++)
        known = add_zeros(r, d.at[i]);
    return known;
}

/* --- one piece ------------------------------------------------------------------------ */

/* A new variable with the domain lo < x < hi. */
static qdot_expr
variable_between(qdot_pool *pool, qdot_expr lo, qdot_expr hi)
{
    qdot_expr w = qdot_symbol_get(pool, QDOT_FORMAL, "between#");

    qdot_symbol_hide(pool, w);
    if (w != QDOT_NIL)
        qdot_symbol_domain(pool, w, is_infinite(pool, lo) ? QDOT_NIL : lo, true, is_infinite(pool, hi) ? QDOT_NIL : hi, true);
    return w;
}

/* F over the piece, taken from end to end; F is continuous between these. */
static qdot_status
between_ends(range *r, qdot_expr F, qdot_expr lo, qdot_expr hi)
{
    qdot_end from, to;

    QDOT_TRY(qdot_end_value(r->pool, F, r->x, lo, 1, r->facts, &from));
    QDOT_TRY(qdot_end_value(r->pool, F, r->x, hi, -1, r->facts, &to));
    if (from.kind == QDOT_END_INFINITE || to.kind == QDOT_END_INFINITE) {
        r->answer->kind = QDOT_DEFINITE_DIVERGES;
        r->answer->at = from.kind == QDOT_END_INFINITE ? lo : hi;
    } else if (from.kind == QDOT_END_VALUE && to.kind == QDOT_END_VALUE) {
        r->answer->kind = QDOT_DEFINITE_FOUND;
        r->answer->value = qdot_sub(r->pool, to.value, from.value);
    }
    return QDOT_OK;
}

/* The same for if(CONDITION, F, G) of parameters, case by case. */
static qdot_status
between_ends_by_cases(range *r, qdot_expr F)
{
    qdot_pool *pool = r->pool;
    qdot_expr sum = QDOT_ZERO, condition;
    qdot_definite_answer first;

    if (F != QDOT_NIL && qdot_expr_is_function(pool, F, QDOT_IF) && !qdot_expr_contains(pool, qdot_expr_arg(pool, F, 0), r->x)) {
        condition = qdot_expr_arg(pool, F, 0);
        QDOT_TRY(between_ends_by_cases(r, qdot_expr_arg(pool, F, 1)));
        if (r->answer->kind != QDOT_DEFINITE_FOUND)
            return QDOT_OK;
        first = *r->answer;
        *r->answer = (qdot_definite_answer){QDOT_DEFINITE_NOT_FOUND, QDOT_NIL, QDOT_NIL};
        QDOT_TRY(between_ends_by_cases(r, qdot_expr_arg(pool, F, 2)));
        if (r->answer->kind == QDOT_DEFINITE_FOUND && first.value != r->answer->value)
            r->answer->value = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){condition, first.value, r->answer->value});
        return QDOT_OK;
    }
    r->n = 0;
    if (F == QDOT_NIL || !add_dangers(r, F, false))
        return r->status;
    for (size_t i = 0; i <= r->n; i++) {
        r->answer->kind = QDOT_DEFINITE_NOT_FOUND;
        QDOT_TRY(between_ends(r, F, i == 0 ? r->lo : r->place[i - 1], i == r->n ? r->hi : r->place[i]));
        if (r->answer->kind != QDOT_DEFINITE_FOUND)
            return QDOT_OK;
        sum = qdot_add(pool, sum, r->answer->value);
    }
    r->answer->value = sum;
    return QDOT_OK;
}

/* The sign of the gaps that must be positive for e to be real, without zeros inside: 1 all are, -1 one is negative. */
static int
is_real_inside(range *r, qdot_expr e)
{
    dangers d = {0};
    int real = 1;

    if (!collect_dangers(r, e, true, &d))
        return 0;
    for (size_t i = 0; i < d.n && real == 1; i++)
        if (d.real[i])
            real = sign_inside(r, d.at[i]);
    return real;
}

/* Integrate over a piece in which e has neither kinks nor poles. */
static qdot_status
find_smooth_piece(range *r, qdot_expr e)
{
    int real = is_real_inside(r, e);
    qdot_expr F;

    QDOT_TRY(r->status);
    if (real != 1) {
        r->answer->kind = real < 0 ? QDOT_DEFINITE_UNDEFINED : QDOT_DEFINITE_NOT_FOUND;
        r->answer->at = r->lo;
        return QDOT_OK;
    }
    e = qdot_simplify(r->pool, e, r->facts);
    F = qdot_antiderivative_by_cases(r->pool, e, r->x, r->facts);
    return between_ends_by_cases(r, F);
}

/* floor(u) in the piece, in which it has no steps; nil if the ends of the piece are no numbers. */
static qdot_expr
floor_inside(range *r, qdot_expr u)
{
    qdot_pool *pool = r->pool;
    qdot_expr middle = qdot_mul(pool, QDOT_HALF, qdot_add(pool, r->lo, r->hi)), value = qdot_subs(pool, u, 1, &r->x, &middle);

    if (is_infinite(pool, r->lo) || is_infinite(pool, r->hi) || value == QDOT_NIL || !qdot_expr_is_constant(pool, value))
        return QDOT_NIL;
    value = qdot_fun1(pool, QDOT_FLOOR, value);
    return value != QDOT_NIL && qdot_expr_rational(pool, value) != NULL ? value : QDOT_NIL;
}

/* The largest (or least) of the arguments of max (or min) in the piece, in which their order is the same everywhere. */
static qdot_expr
extreme_inside(range *r, qdot_expr node, bool max)
{
    qdot_pool *pool = r->pool;
    qdot_expr best = qdot_expr_arg(pool, node, 0);

    for (uint32_t i = 1; i < qdot_expr_count(pool, node); i++) {
        const qdot_expr other = qdot_expr_arg(pool, node, i);
        const int sign = sign_inside(r, qdot_sub(pool, other, best));

        if (sign == 0)
            return node;
        best = (sign > 0) == max ? other : best;
    }
    return best;
}

/* Replace abs, sign, max, min, floor, mod and if by what they are in the piece: by their values at a point of it. */
static qdot_expr
without_kinks(qdot_pool *pool, qdot_expr node, void *user)
{
    range *r = user;
    qdot_fun_id id = (qdot_fun_id)qdot_expr_node(pool, node)->op;
    qdot_expr u = qdot_expr_arg(pool, node, 0), gap, modulus;
    int sign;

    if (!qdot_expr_contains(pool, node, r->x))
        return node;
    if (id == QDOT_MAX || id == QDOT_MIN)
        return extreme_inside(r, node, id == QDOT_MAX);
    if (id == QDOT_FLOOR || id == QDOT_MOD) {
        modulus = id == QDOT_MOD ? qdot_expr_arg(pool, node, 1) : QDOT_ONE;
        gap = qdot_expr_contains(pool, modulus, r->x) ? QDOT_NIL : floor_inside(r, qdot_div(pool, u, modulus));
        return gap == QDOT_NIL ? node : id == QDOT_FLOOR ? gap : qdot_sub(pool, u, qdot_mul(pool, modulus, gap));
    }
    if ((id != QDOT_ABS && id != QDOT_SIGN && id != QDOT_IF) ||
        (id == QDOT_IF && (qdot_expr_kind(pool, u) != QDOT_REL || !qdot_expr_contains(pool, u, r->x))))
        return node;
    gap = id == QDOT_IF ? qdot_sub(pool, qdot_expr_arg(pool, u, 1), qdot_expr_arg(pool, u, 0)) : u;
    sign = sign_inside(r, gap);
    if (sign == 0)
        return node;
    switch (id) {
    case QDOT_ABS: return sign > 0 ? u : qdot_neg(pool, u);
    case QDOT_SIGN: return sign > 0 ? QDOT_ONE : QDOT_MINUS_ONE;
    default: return qdot_expr_arg(pool, node, sign > 0 ? 1 : 2);
    }
}

static qdot_status
find_piece(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts, bool ordered,
           qdot_definite_answer *answer)
{
    range r = {.pool = pool, .facts = facts, .lo = lo, .hi = hi, .ordered = ordered, .status = QDOT_OK, .answer = answer};

    *answer = (qdot_definite_answer){QDOT_DEFINITE_NOT_FOUND, QDOT_NIL, QDOT_NIL};
    r.x = ordered ? variable_between(pool, lo, hi) : x;
    e = qdot_subs(pool, e, 1, &x, &r.x);
    if (ordered)
        e = qdot_walk_replace(pool, e, QDOT_FUN, without_kinks, &r);
    QDOT_TRY(r.status);
    QDOT_TRY(find_smooth_piece(&r, e));
    if (answer->value != QDOT_NIL && qdot_expr_contains(pool, answer->value, r.x))
        answer->kind = QDOT_DEFINITE_NOT_FOUND;
    return qdot_grave(qdot_pool_check(pool));
}

/* --- the whole range -------------------------------------------------------------------- */

static qdot_status
find_ordered(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts,
             qdot_definite_answer *answer)
{
    qdot_expr w = variable_between(pool, lo, hi), sum = QDOT_ZERO;
    range r = {.pool = pool, .facts = facts, .x = w, .lo = lo, .hi = hi, .ordered = true, .status = QDOT_OK, .answer = answer};

    e = qdot_subs(pool, e, 1, &x, &w);
    if (e == QDOT_NIL)
        return qdot_grave(qdot_pool_check(pool));
    if (!add_dangers(&r, e, true))
        return r.status;
    for (size_t i = 0; i <= r.n; i++) {
        QDOT_TRY(find_piece(pool, e, w, i == 0 ? lo : r.place[i - 1], i == r.n ? hi : r.place[i], facts, true, answer));
        if (answer->kind != QDOT_DEFINITE_FOUND)
            return QDOT_OK;
        sum = qdot_add(pool, sum, answer->value);
    }
    answer->value = sum;
    return QDOT_OK;
}

qdot_status
qdot_definite(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts,
              qdot_definite_answer *answer)
{
    range r = {.pool = pool, .facts = facts, .status = QDOT_OK};
    bool backward = false, ordered = true;

    *answer = (qdot_definite_answer){QDOT_DEFINITE_NOT_FOUND, QDOT_NIL, QDOT_NIL};
    if (lo == hi) {
        *answer = (qdot_definite_answer){QDOT_DEFINITE_FOUND, QDOT_ZERO, QDOT_NIL};
        return QDOT_OK;
    }
    if (is_infinite(pool, lo) || is_infinite(pool, hi)) {
        backward = qdot_infinite(pool, lo) > 0 || qdot_infinite(pool, hi) < 0;
    } else if (!is_positive(&r, qdot_sub(pool, hi, lo))) {
        backward = is_positive(&r, qdot_sub(pool, lo, hi));
        ordered = backward;
    }
    QDOT_TRY(r.status);
    if (backward) {
        qdot_expr other = lo;

        lo = hi;
        hi = other;
    }
    if (ordered)
        QDOT_TRY(find_ordered(pool, e, x, lo, hi, facts, answer));
    if (answer->kind == QDOT_DEFINITE_NOT_FOUND && qdot_infinite(pool, hi) > 0 && (lo == QDOT_ZERO || is_infinite(pool, lo))) {
        QDOT_TRY(qdot_improper(pool, e, x, lo != QDOT_ZERO, facts, &answer->value));
        if (answer->value != QDOT_NIL)
            answer->kind = QDOT_DEFINITE_FOUND;
    }
    if (!ordered)
        QDOT_TRY(find_piece(pool, e, x, lo, hi, facts, false, answer));
    if (answer->kind == QDOT_DEFINITE_FOUND && answer->value != QDOT_NIL) {
        qdot_expr value = qdot_simplify(pool, backward ? qdot_neg(pool, answer->value) : answer->value, facts);

        answer->value = value;
    }
    return qdot_grave(qdot_pool_check(pool));
}
