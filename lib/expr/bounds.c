/* bounds.c -- finds the sign of a sum from rational bounds of its terms. */
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/pool.h"

/* One bound of a value: a rational number if it is known; `open`: the value does not reach it. */
struct bound {
    fmpq x;
    bool known, open;
};

static void
set_bound(struct bound *b, int64_t n, int64_t d, bool open)
{
    b->x = (fmpq){n, d};
    b->known = true;
    b->open = open;
}

/* A declared bound as a rational; a multiple of pi is replaced by a rational slightly beyond it.
 * `up`: an upper bound. */
static void
set_declared_bound(const qdot_pool *pool, qdot_expr e, bool open, bool up, struct bound *b)
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
    b->open = open || turn;
    qdot_rational_set(&b->x, c == NULL ? &(fmpq){1, 1} : c);
    if (turn) { /* replace pi by one of its rational bounds 333/106 < pi < 355/113 */
        bool more = (qdot_rational_sgn(&b->x) > 0) == up;

        qdot_rational_mul(&b->x, &b->x, more ? &(fmpq){355, 113} : &(fmpq){333, 106});
    }
}

/* An end of a function's range; a multiple of pi is replaced by a rational slightly beyond it.
 * `up`: the upper end. */
static void
set_range_bound(const qdot_fun_end *end, bool up, struct bound *b)
{
    if (!end->known)
        return;
    if (!end->angle)
        set_bound(b, end->number, 1, end->open);
    else if ((end->number > 0) == up)
        set_bound(b, 355 * end->number, 226, true);
    else
        set_bound(b, 333 * end->number, 212, true);
}

/* Find the bounds of a function's values for any real arguments. */
static void
bounds_of_function(qdot_fun_id id, struct bound *lo, struct bound *hi)
{
    set_range_bound(&qdot_fun_facts_of(id)->lo, false, lo);
    set_range_bound(&qdot_fun_facts_of(id)->hi, true, hi);
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
    struct bound least = {{0, 1}, false, false}, most = {{0, 1}, false, false};

    set_declared_bound(pool, s->lo, s->lo_open, false, &least);
    set_declared_bound(pool, s->hi, s->hi_open, true, &most);
    if (least.known && qdot_rational_sgn(&least.x) >= 0) {
        set_squared_bound(lo, &least);
        if (most.known)
            set_squared_bound(hi, &most);
    } else if (most.known && qdot_rational_sgn(&most.x) <= 0) {
        set_squared_bound(lo, &most);
        if (least.known)
            set_squared_bound(hi, &least);
    } else if (least.known && most.known) {
        struct bound other = {{0, 1}, false, false};
        int d;

        set_squared_bound(hi, &least);
        set_squared_bound(&other, &most);
        d = qdot_rational_cmp(&other.x, &hi->x);
        if (d > 0)
            set_squared_bound(hi, &most);
        else if (d == 0)
            hi->open &= other.open;
        fmpq_clear(&other.x);
    }
    fmpq_clear(&least.x);
    fmpq_clear(&most.x);
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
        set_declared_bound(pool, s->lo, s->lo_open, false, lo);
        set_declared_bound(pool, s->hi, s->hi_open, true, hi);
        if (e == QDOT_PI)
            set_bound(lo, 333, 106, true), set_bound(hi, 355, 113, true);
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
    if ((node->sign & QDOT_GE0) && (!lo->known || qdot_rational_sgn(&lo->x) < 0)) {
        qdot_rational_set(&lo->x, &(fmpq){0, 1});
        lo->known = true;
        lo->open = node->sign & QDOT_NE0;
    }
    if ((node->sign & QDOT_LE0) && (!hi->known || qdot_rational_sgn(&hi->x) > 0)) {
        qdot_rational_set(&hi->x, &(fmpq){0, 1});
        hi->known = true;
        hi->open = node->sign & QDOT_NE0;
    }
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
    round_bound_outward(sum, up);
}

uint8_t
qdot_sign_by_bounds(const qdot_pool *pool, uint32_t n, const qdot_expr *args)
{
    struct bound least = {{0, 1}, true, false}, most = {{0, 1}, true, false};
    uint8_t sign = 0;

    qdot_rational_set(&least.x, RATIONAL(pool, args[0]));
    qdot_rational_set(&most.x, RATIONAL(pool, args[0]));
    for (uint32_t i = 1; i < n && (least.known || most.known); i += 2) {
        struct bound lo = {{0, 1}, false, false}, hi = {{0, 1}, false, false};
        const fmpq *c = RATIONAL(pool, args[i + 1]);
        bool up = qdot_rational_sgn(c) > 0;

        bounds_of_term(pool, args[i], &lo, &hi);
        add_scaled_bound(&least, c, up ? &lo : &hi, false);
        add_scaled_bound(&most, c, up ? &hi : &lo, true);
        fmpq_clear(&lo.x);
        fmpq_clear(&hi.x);
    }
    if (least.known && qdot_rational_sgn(&least.x) >= 0)
        sign = QDOT_GE0 | (least.open || qdot_rational_sgn(&least.x) > 0 ? QDOT_NE0 : 0);
    else if (most.known && qdot_rational_sgn(&most.x) <= 0)
        sign = QDOT_LE0 | (most.open || qdot_rational_sgn(&most.x) < 0 ? QDOT_NE0 : 0);
    fmpq_clear(&least.x);
    fmpq_clear(&most.x);
    return sign;
}
