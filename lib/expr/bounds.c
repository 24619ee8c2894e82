/* bounds.c -- finds the sign of a sum from bounds of its terms, which are rational numbers and multiples of pi. */
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/pool.h"

/* One bound of a value, x + turns pi, if it is known; `open`: the value does not reach it. */
struct bound {
    fmpq x, turns;
    bool known, open;
};

#define NO_BOUND {{0, 1}, {0, 1}, false, false}

static void
clear_bound(struct bound *b)
{
    fmpq_clear(&b->x);
    fmpq_clear(&b->turns);
}

static void
set_bound(struct bound *b, int n, int d, bool open)
{
    b->x = (fmpq){n, d};
    b->known = true;
    b->open = open;
}

/* A declared bound that is a rational number or a rational multiple of pi. */
static void
set_declared_bound(const qdot_pool *pool, qdot_expr e, bool open, struct bound *b)
{
    const fmpq *c = NUMBER(pool, e);
    bool turn = e == QDOT_PI;

    if (e == QDOT_NIL)
        return;
    if (NODE(pool, e)->kind == QDOT_PROD && NODE(pool, e)->n == 3 &&
        ARGS(pool, e)[1] == QDOT_PI && ARGS(pool, e)[2] == QDOT_ONE) {
        c = RATIONAL(pool, ARGS(pool, e)[0]);
        turn = true;
    }
    if (c == NULL && !turn)
        return;
    b->known = true;
    b->open = open;
    qdot_rational_set(turn ? &b->turns : &b->x, c == NULL ? &(fmpq){1, 1} : c);
}

/* Replace the multiple of pi in a bound by a rational number slightly beyond it. `up`: an upper bound. */
static void
make_bound_rational(struct bound *b, bool up)
{
    const int sign = qdot_rational_sgn(&b->turns);

    if (sign == 0)
        return;
    qdot_rational_addmul(&b->x, &b->turns, (sign > 0) == up ? &(fmpq){355, 113} : &(fmpq){333, 106});
    qdot_rational_set(&b->turns, &(fmpq){0, 1});
    b->open = true;
}

/* An end of a function's range. */
static void
set_range_bound(const qdot_fun_end *end, struct bound *b)
{
    if (!end->known)
        return;
    set_bound(b, end->angle ? 0 : end->number, 1, end->open);
    if (end->angle)
        qdot_rational_mul(&b->turns, &(fmpq){end->number, 1}, &(fmpq){1, 2});
}

/* Find the bounds of a function's values for any real arguments. */
static void
bounds_of_function(qdot_fun_id id, struct bound *lo, struct bound *hi)
{
    set_range_bound(&qdot_fun_facts_of(id)->lo, lo);
    set_range_bound(&qdot_fun_facts_of(id)->hi, hi);
}

/* Find bounds of f^k for a positive integer k, where |f| <= 1 or f >= 1. */
static void
bounds_of_power(const qdot_pool *pool, qdot_expr e, struct bound *lo, struct bound *hi)
{
    qdot_expr b = ARGS(pool, e)[1];
    const fmpq *k = NUMBER(pool, ARGS(pool, e)[2]);
    const qdot_fun_facts *f;

    if (k == NULL || qdot_rational_sgn(k) < 0 || !fmpz_is_one(fmpq_denref(k)) ||
        NODE(pool, b)->kind != QDOT_FUN)
        return;
    f = qdot_fun_facts_of(NODE(pool, b)->op);
    if (f->lo.angle || !f->lo.known)
        return;
    if (f->lo.number == 1) {
        set_bound(lo, 1, 1, false);
    } else if (f->lo.number == -1 && f->hi.number == 1) {
        set_bound(lo, fmpz_is_even(fmpq_numref(k)) ? 0 : -1, 1, false);
        set_bound(hi, 1, 1, f->hi.open);
    }
}

static bool
is_two(const fmpq *k)
{
    return k != NULL && fmpz_is_one(fmpq_denref(k)) && qdot_integer_is(fmpq_numref(k), 2);
}

static void
set_squared_bound(struct bound *b, const struct bound *end)
{
    qdot_rational_mul(&b->x, &end->x, &end->x);
    b->known = true;
    b->open = end->open;
}

/* The bounds of s^2 for a symbol s with bounds: if these have opposite signs the larger square is
 * the upper bound. */
static void
bounds_of_square(const qdot_pool *pool, const qdot_symbol *s, struct bound *lo, struct bound *hi)
{
    struct bound least = NO_BOUND, most = NO_BOUND;

    set_declared_bound(pool, s->lo, s->lo_open, &least);
    set_declared_bound(pool, s->hi, s->hi_open, &most);
    make_bound_rational(&least, false);
    make_bound_rational(&most, true);
    if (least.known && qdot_rational_sgn(&least.x) >= 0) {
        set_squared_bound(lo, &least);
        if (most.known)
            set_squared_bound(hi, &most);
    } else if (most.known && qdot_rational_sgn(&most.x) <= 0) {
        set_squared_bound(lo, &most);
        if (least.known)
            set_squared_bound(hi, &least);
    } else if (least.known && most.known) {
        struct bound other = NO_BOUND;
        int d;

        set_squared_bound(hi, &least);
        set_squared_bound(&other, &most);
        d = qdot_rational_cmp(&other.x, &hi->x);
        if (d > 0)
            set_squared_bound(hi, &most);
        else if (d == 0)
            hi->open &= other.open;
        clear_bound(&other);
    }
    clear_bound(&least);
    clear_bound(&most);
}

/* 0 as the bound of a value with this sign, unless *b is a better one; `beyond`: the sign of a worse one. */
static void
bound_by_zero(struct bound *b, uint8_t sign, int beyond)
{
    if (b->known && qdot_rational_sgn(&b->x) != beyond && qdot_rational_sgn(&b->turns) != beyond)
        return;
    qdot_rational_set(&b->x, &(fmpq){0, 1});
    qdot_rational_set(&b->turns, &(fmpq){0, 1});
    b->known = true;
    b->open = sign & QDOT_NE0;
}

/* Find the bounds of a term without its coefficient. */
static void
bounds_of_term(const qdot_pool *pool, qdot_expr e, struct bound *lo, struct bound *hi)
{
    const qdot_node *node = NODE(pool, e);
    const qdot_symbol *s;

    switch (node->kind) {
    case QDOT_SYM:
        s = &pool->symbols.at[node->at];
        set_declared_bound(pool, e == QDOT_PI ? e : s->lo, s->lo_open, lo);
        set_declared_bound(pool, e == QDOT_PI ? e : s->hi, s->hi_open, hi);
        break;
    case QDOT_FUN: bounds_of_function(node->op, lo, hi); break;
    case QDOT_PROD:
        if (node->n != 3 || ARGS(pool, e)[0] != QDOT_ONE)
            break;
        s = qdot_expr_symbol(pool, ARGS(pool, e)[1]);
        if (s == NULL)
            bounds_of_power(pool, e, lo, hi);
        else if (is_two(NUMBER(pool, ARGS(pool, e)[2])))
            bounds_of_square(pool, s, lo, hi);
        break;
    default: break;
    }
    if (node->sign & QDOT_GE0)
        bound_by_zero(lo, node->sign, -1);
    if (node->sign & QDOT_LE0)
        bound_by_zero(hi, node->sign, 1);
}

/* A bound with a long denominator by a shorter one beyond it, above where `up`: the denominator of a sum of thousands of
 * fractions would grow with each. */
static void
round_bound_outward(struct bound *b, bool up)
{
    enum { LONG = 1024, SHORT = 256 };
    fmpq_t y;

    /* small numbers need no call of FLINT */
    if (qdot_rational_is_small(&b->x) || fmpz_bits(fmpq_denref(&b->x)) <= LONG)
        return;
    fmpq_init(y);
    fmpz_mul_2exp(fmpq_numref(y), fmpq_numref(&b->x), SHORT);
    if (up)
        fmpz_cdiv_q(fmpq_numref(y), fmpq_numref(y), fmpq_denref(&b->x));
    else
        fmpz_fdiv_q(fmpq_numref(y), fmpq_numref(y), fmpq_denref(&b->x));
    fmpz_mul_2exp(fmpq_denref(y), fmpq_denref(y), SHORT);
    fmpq_canonicalise(y);
    fmpq_swap(&b->x, y);
    fmpq_clear(y);
    b->open = true;
}

/* Add c times the bound b to the bound *sum of a sum, if both are known; up: an upper bound, else a lower one. */
static void
add_scaled_bound(struct bound *sum, const fmpq *c, const struct bound *b, bool up)
{
    sum->known &= b->known;
    sum->open |= b->open;
    if (!sum->known)
        return;
    qdot_rational_addmul(&sum->x, c, &b->x);
    qdot_rational_addmul(&sum->turns, c, &b->turns);
    round_bound_outward(sum, up);
}

/* The term args[k] of the sum that the term args[i], a symbol, is bounded by, with a coefficient of the other sign, as
 * a - x with x < a; 0: none. *open: it is not reached. */
static uint32_t
bounding_term(const qdot_pool *pool, uint32_t n, const qdot_expr *args, uint32_t i, bool up, bool *open)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, args[i]);
    const bool high = (qdot_rational_sgn(RATIONAL(pool, args[i + 1])) > 0) == up;
    const qdot_expr bound = s == NULL ? QDOT_NIL : high ? s->hi : s->lo;

    if (bound == QDOT_NIL || bound == QDOT_PI)
        return 0;
    *open = high ? s->hi_open : s->lo_open;
    for (uint32_t k = 1; k < n; k += 2)
        if (args[k] == bound && qdot_rational_sgn(RATIONAL(pool, args[k + 1])) != qdot_rational_sgn(RATIONAL(pool, args[i + 1])))
            return k;
    return 0;
}

/* The upper or lower bound of a sum. */
static void
bound_sum(const qdot_pool *pool, uint32_t n, const qdot_expr *args, bool up, struct bound *sum)
{
    enum { MOST = 33 };
    fmpq c[MOST] = {{0, 0}};
    const uint32_t terms = n < MOST ? n : 0; /* only a short sum is searched for terms that bound others */

    sum->known = true;
    qdot_rational_set(&sum->x, RATIONAL(pool, args[0]));
    for (uint32_t i = 1; i < terms; i += 2) {
        c[i] = (fmpq){0, 1};
        qdot_rational_set(&c[i], RATIONAL(pool, args[i + 1]));
    }
    for (uint32_t i = 1; i < terms; i += 2) {
        bool open;
        uint32_t k = bounding_term(pool, n, args, i, up, &open);

        if (k == 0)
            continue;
        qdot_rational_addmul(&c[k], RATIONAL(pool, args[i + 1]), &(fmpq){1, 1});
        qdot_rational_addmul(&c[i], RATIONAL(pool, args[i + 1]), &(fmpq){-1, 1});
        sum->open |= open;
    }
    for (uint32_t i = 1; i < n && sum->known; i += 2) {
        struct bound lo = NO_BOUND, hi = NO_BOUND;
        const fmpq *coefficient = i < terms ? &c[i] : RATIONAL(pool, args[i + 1]);
        const int sign = qdot_rational_sgn(coefficient);

        if (sign == 0)
            continue;
        bounds_of_term(pool, args[i], &lo, &hi);
        add_scaled_bound(sum, coefficient, (sign > 0) == up ? &hi : &lo, up);
        clear_bound(&lo);
        clear_bound(&hi);
    }
    for (uint32_t i = 1; i < terms; i += 2)
        fmpq_clear(&c[i]);
    make_bound_rational(sum, up);
}

uint8_t
qdot_sign_by_bounds(const qdot_pool *pool, uint32_t n, const qdot_expr *args)
{
    struct bound least = NO_BOUND, most = NO_BOUND;
    uint8_t sign = 0;

    bound_sum(pool, n, args, false, &least);
    if (least.known && qdot_rational_sgn(&least.x) >= 0) {
        sign = QDOT_GE0 | (least.open || qdot_rational_sgn(&least.x) > 0 ? QDOT_NE0 : 0);
    } else {
        bound_sum(pool, n, args, true, &most);
        if (most.known && qdot_rational_sgn(&most.x) <= 0)
            sign = QDOT_LE0 | (most.open || qdot_rational_sgn(&most.x) < 0 ? QDOT_NE0 : 0);
    }
    clear_bound(&least);
    clear_bound(&most);
    return sign;
}
