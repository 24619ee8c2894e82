/* span.c -- signs of expressions over a range, and the places inside it where an expression may not be smooth. */
#include "normal/integral/span.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/calculus/switch.h"
#include "normal/inequality/less.h"
#include "normal/refute/enclosure.h"
#include "normal/solve/solve.h"

enum { MOST_DANGERS = 40 };

static bool
is_infinite(const qdot_pool *pool, qdot_expr e)
{
    return qdot_infinite(pool, e) != 0;
}

bool
qdot_span_is_positive(qdot_span *r, qdot_expr e)
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
proved_sign(qdot_span *r, qdot_expr e)
{
    return qdot_span_is_positive(r, e) ? 1 : qdot_span_is_positive(r, qdot_neg(r->pool, e)) ? -1 : 0;
}

/* The sign of g at a place; 0: not known. */
static int
sign_at(qdot_span *r, qdot_expr g, qdot_expr place)
{
    const qdot_expr value = qdot_subs(r->pool, g, 1, &r->x, &place);

    if (value == QDOT_NIL) { /* not defined there */
        r->status = qdot_grave(qdot_pool_check(r->pool));
        return 0;
    }
    return proved_sign(r, value);
}

int
qdot_span_sign(qdot_span *r, qdot_expr g)
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
add_place(qdot_span *r, qdot_expr at, bool *known)
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
    if ((!is_infinite(r->pool, r->lo) && qdot_span_is_positive(r, qdot_sub(r->pool, r->lo, at))) ||
        (!is_infinite(r->pool, r->hi) && qdot_span_is_positive(r, qdot_sub(r->pool, at, r->hi))))
        return;
    if ((!is_infinite(r->pool, r->lo) && !qdot_span_is_positive(r, qdot_sub(r->pool, at, r->lo))) ||
        (!is_infinite(r->pool, r->hi) && !qdot_span_is_positive(r, qdot_sub(r->pool, r->hi, at)))) {
        *known = false;
        return;
    }
    for (i = 0; i < r->n; i++) {
        if (qdot_is_zero(r->pool, qdot_sub(r->pool, at, r->place[i]), r->facts))
            return;
        if (qdot_span_is_positive(r, qdot_sub(r->pool, r->place[i], at)))
            break;
        if (!qdot_span_is_positive(r, qdot_sub(r->pool, at, r->place[i]))) {
            *known = false;
            return;
        }
    }
    if (r->n == QDOT_SPAN_PLACES) {
        *known = false;
        return;
    }
    for (size_t k = r->n++; k > i; k--)
        r->place[k] = r->place[k - 1];
    r->place[i] = at;
}

/* Bounds of e over the range; false: an end is no number, or e has none. */
static bool
find_bounds(qdot_span *r, qdot_expr e, qdot_interval *bounds)
{
    qdot_enclosure *enclosure = NULL;
    double lo, hi;
    qdot_interval over;

    if (is_infinite(r->pool, r->lo) || is_infinite(r->pool, r->hi) || !qdot_expr_is_constant(r->pool, r->lo) ||
        !qdot_expr_is_constant(r->pool, r->hi) || qdot_constant_double(r->pool, r->lo, &lo) != QDOT_OK ||
        qdot_constant_double(r->pool, r->hi, &hi) != QDOT_OK)
        return false;
    r->status = qdot_enclosure_new(r->pool, 1, &e, 1, &r->x, &enclosure);
    if (r->status != QDOT_OK) {
        r->status = qdot_grave(r->status);
        return false;
    }
    over = qdot_interval_outward(lo, hi);
    qdot_enclosure_eval(enclosure, &over, false);
    *bounds = qdot_enclosure_get(enclosure, 0)->y;
    qdot_enclosure_free(enclosure);
    return isfinite(bounds->lo) && isfinite(bounds->hi);
}

static bool add_zeros(qdot_span *r, qdot_expr g);

/* The same for g = sin(u) with a bounded u: the zeros of u - n pi. */
static bool
add_zeros_of_sine(qdot_span *r, qdot_expr g)
{
    qdot_pool *pool = r->pool;
    qdot_interval turns;
    qdot_expr u;

    if (!qdot_expr_is_function(pool, g, QDOT_SIN))
        return false;
    u = qdot_div(pool, qdot_expr_arg(pool, g, 0), QDOT_PI);
    if (!find_bounds(r, u, &turns) || turns.hi - turns.lo > QDOT_SPAN_PLACES)
        return false;
    for (double n = ceil(turns.lo); n <= floor(turns.hi); n++)
        if (!add_zeros(r, qdot_sub(pool, u, qdot_expr_int(pool, (int64_t)n))))
            return false;
    return true;
}

/* Add the zeros of g inside the range; false: they are not all known. */
static bool
add_zeros(qdot_span *r, qdot_expr g)
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
    return r->status == QDOT_OK && (known || add_zeros_of_sine(r, g));
}

/* The expression whose zeros are the places where the node may not be continuous; one: there are none. *real: the node
 * is real only where it is > 0. `jumps`: the node may jump there; nil where it may not. */
static qdot_expr
danger_of(qdot_span *r, qdot_expr e, uint32_t i, bool jumps, bool *real)
{
    qdot_pool *pool = r->pool;
    qdot_expr u;

    *real = false;
    if (qdot_expr_kind(pool, e) == QDOT_PROD) {
        qdot_expr exponent = qdot_expr_arg(pool, e, i + 1);
        int64_t k;

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
collect_dangers(qdot_span *r, qdot_expr e, bool jumps, dangers *d)
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

bool
qdot_span_add_dangers(qdot_span *r, qdot_expr e, bool jumps)
{
    dangers d = {0};
    bool known = collect_dangers(r, e, jumps, &d);

    for (size_t i = 0; i < d.n && known; i++)
        known = add_zeros(r, d.at[i]);
    return known;
}

int
qdot_span_is_real(qdot_span *r, qdot_expr e)
{
    dangers d = {0};
    int real = 1;

    if (!collect_dangers(r, e, true, &d))
        return 0;
    for (size_t i = 0; i < d.n && real == 1; i++)
        if (d.real[i])
            real = qdot_span_sign(r, d.at[i]);
    return real;
}
