/* order.c -- the canonical order of factors and terms; signs of composite expressions.
 *
 * Interning makes comparison a loop: two different nodes of one shape first differ in some
 * pair of children, and that pair alone decides.
 */
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/pool.h"

#include <math.h>

/* The rank of a factor in a product: parameters, time, coordinates, velocities ... */
static int
rank_of_factor(uint32_t holds)
{
    static const struct {
        uint32_t mask;
        int level;
    } rows[] = {
        {QDOT_HAS_DELTA, 9},        {QDOT_HAS_DIFFERENTIAL, 8}, {QDOT_HAS_MULTIPLIER, 7},
        {QDOT_HAS_ACCELERATION, 6}, {QDOT_HAS_VELOCITY, 5},     {QDOT_HAS_MOMENTUM, 4},
        {QDOT_HAS_COORD | QDOT_HAS_BOUND, 3}, {QDOT_HAS_UFUN, 3},         {QDOT_HAS_TIME, 2},
        {QDOT_HAS_FORMAL, 1},       {QDOT_HAS_PARAM, 1},
    };
    const uint32_t above_coordinates = QDOT_HAS_DELTA | QDOT_HAS_DIFFERENTIAL |
                                       QDOT_HAS_MULTIPLIER | QDOT_HAS_ACCELERATION |
                                       QDOT_HAS_VELOCITY | QDOT_HAS_MOMENTUM;

    /* skip the table rows before that of the coordinates unless e contains a symbol of theirs, which is rare */
    for (size_t i = holds & above_coordinates ? 0 : 6; i < sizeof rows / sizeof *rows;
         i++)
        if (holds & rows[i].mask)
            return rows[i].level;
    return 0;
}

/* The level of a factor: a function of parameters or time stands with those of coordinates, behind
 * what it multiplies: m*g*x*sin(alpha). */
static int
level_of_factor(const qdot_node *node)
{
    int l = rank_of_factor(node->holds);

    if (node->kind == QDOT_INTEGRAL && l < 3)
        return 3;
    return node->kind == QDOT_FUN && l > 0 && l < 3 ? 3 : l;
}

/* Order of kinds within a level: among parameters a sum of symbols stands first, (m1 + m2)*L^2, a
 * longer one behind, m*(R^2 + h^2); undefined functions stand last but for their values at a place, f'(a)*(x - a). */
static int
rank_of_kind(const qdot_node *node)
{
    static const int rank[] = {0, 1, 3, 6, 5, 4, 7, 8, 9, 10, 11, 12, 13};

    if (node->kind == QDOT_SUM && rank_of_factor(node->holds) == 1 && node->size <= node->n / 2)
        return 2; /* a sum of k terms with about k operations: its terms are hardly more than symbols */
    if (node->kind == QDOT_UFUN && !(node->holds & (QDOT_HAS_COORD | QDOT_HAS_TIME)))
        return rank[QDOT_FUN];
    return rank[node->kind];
}

static int
compare_numbers(uint32_t a, uint32_t b)
{
    return a < b ? -1 : a > b;
}

static int
compare_symbols(const qdot_symbol *a, const qdot_symbol *b)
{
    if (a->class != b->class)
        return a->class < b->class ? -1 : 1;
    if (a->rank != b->rank)
        return compare_numbers(a->rank, b->rank);
    return compare_numbers(a->order, b->order);
}

/* The height of a node if it exceeds 64, else 64: very deep nodes come last, the deepest at the end. */
static uint32_t
depth_beyond_64(const qdot_node *node)
{
    return node->height > 64 ? node->height : 64;
}

int
qdot_expr_compare(const qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    for (;;) {
        const qdot_node *x = NODE(pool, a), *y = NODE(pool, b);
        int d;
        uint32_t i = 0;

        if (a == b)
            return 0;
        if (depth_beyond_64(x) != depth_beyond_64(y)) /* so that the comparison of deep expressions does not visit all levels */
            return compare_numbers(depth_beyond_64(x), depth_beyond_64(y));
        d = x->holds == y->holds && x->kind == y->kind ? 0 : level_of_factor(x) - level_of_factor(y);
        if (d == 0)
            d = rank_of_kind(x) - rank_of_kind(y);
        if (d != 0)
            return d;
        if (x->kind == QDOT_NUM)
            return qdot_rational_cmp(RATIONAL(pool, a), RATIONAL(pool, b));
        if (x->kind == QDOT_SYM) {
            d = compare_symbols(&pool->symbols.at[x->at], &pool->symbols.at[y->at]);
            if (d != 0)
                return d;
            a = pool->symbols.at[x->at].base; /* p[x] and p[x'], products of differentials: by what they belong to */
            b = pool->symbols.at[y->at].base;
            if (a == QDOT_NIL || b == QDOT_NIL)
                return 0;
            continue;
        }
        if (x->kind != y->kind) /* one of the two is an elementary function, the other an undefined one */
            return compare_numbers(x->kind, y->kind);
        if (x->kind == QDOT_FUN && x->n == 1 && y->n == 1 &&
            /* if the arguments differ, order sinh(u)^2, sin(v)^2 by u and v first */
            ARGS(pool, a)[0] != ARGS(pool, b)[0]) {
            a = ARGS(pool, a)[0];
            b = ARGS(pool, b)[0];
            continue;
        }
        if (x->kind == QDOT_FUN && (x->n == 1) != (y->n == 1))
            return compare_numbers(x->n, y->n);
        if (x->op != y->op)
            return compare_numbers(x->op, y->op);
        if (x->n != y->n)
            return compare_numbers(x->n, y->n);
        while (ARGS(pool, a)[i] == ARGS(pool, b)[i])
            i++;
        d = (int)i;
        a = ARGS(pool, a)[d];
        b = ARGS(pool, b)[d];
    }
}

/* Find the i-th base and exponent of a term, which is treated as a product of powers. */
static void
term_factor_at(const qdot_pool *pool, qdot_expr e, uint32_t i, qdot_expr *base,
               qdot_expr *exponent)
{
    if (NODE(pool, e)->kind != QDOT_PROD) {
        *base = e;
        *exponent = QDOT_ONE;
        return;
    }
    *base = ARGS(pool, e)[1 + 2 * i];
    *exponent = ARGS(pool, e)[2 + 2 * i];
}

static uint32_t
factor_count(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_PROD ? (NODE(pool, e)->n - 1) / 2 : 1;
}

/* Whether base^exponent is a root of a sum: among terms it comes after symbols, a + d - sqrt(...). */
static bool
is_root_of_sum(const qdot_pool *pool, qdot_expr base, qdot_expr exponent)
{
    const fmpq *x = NUMBER(pool, exponent);

    return NODE(pool, base)->kind == QDOT_SUM && x != NULL &&
           !fmpz_is_one(fmpq_denref(x));
}

/* Bases among terms: sums of parameters first; derivatives of a function by its first argument before
 * others, the higher before the lower: f_rr + f_r/r + f_pp/r^2. */
static int
compare_bases(const qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    const qdot_node *x = NODE(pool, a), *y = NODE(pool, b);

    if ((x->kind == QDOT_SUM) != (y->kind == QDOT_SUM) && depth_beyond_64(x) == depth_beyond_64(y) &&
        level_of_factor(x) == 1 && level_of_factor(y) == 1)
        return x->kind == QDOT_SUM ? -1 : 1;
    if (x->kind == QDOT_UFUN && y->kind == QDOT_UFUN && x->op == y->op && x->n == y->n &&
        depth_beyond_64(x) == depth_beyond_64(y) && rank_of_factor(x->holds) == rank_of_factor(y->holds))
        for (uint32_t i = x->n / 2; i < x->n; i++) {
            int d = qdot_rational_cmp(RATIONAL(pool, ARGS(pool, b)[i]),
                                      RATIONAL(pool, ARGS(pool, a)[i]));

            if (d != 0)
                return d;
        }
    return qdot_expr_compare(pool, a, b);
}

int
qdot_expr_compare_terms(const qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    uint32_t na = factor_count(pool, a), nb = factor_count(pool, b), ha = NODE(pool, a)->holds;
    int d = NODE(pool, b)->holds == ha ? 0 : rank_of_factor(NODE(pool, b)->holds) - rank_of_factor(ha);

    if (d != 0 || a == b)
        return d;
    while (na > 0 && nb > 0) {
        qdot_expr base_a, base_b, exp_a, exp_b;

        term_factor_at(pool, a, --na, &base_a, &exp_a);
        term_factor_at(pool, b, --nb, &base_b, &exp_b);
        d = rank_of_factor(NODE(pool, base_a)->holds) != rank_of_factor(NODE(pool, base_b)->holds)
                ? 0
                : is_root_of_sum(pool, base_a, exp_a) - is_root_of_sum(pool, base_b, exp_b);
        if (d == 0)
            d = compare_bases(pool, base_a, base_b);
        if (d == 0)
            d = qdot_expr_compare(pool, exp_b, exp_a);
        if (d != 0)
            return d;
    }
    return compare_numbers(na, nb);
}

bool
qdot_expr_is_negative(const qdot_pool *pool, qdot_expr e)
{
    switch (NODE(pool, e)->kind) {
    case QDOT_NUM: return qdot_rational_sgn(RATIONAL(pool, e)) < 0;
    case QDOT_PROD: return qdot_rational_sgn(RATIONAL(pool, ARGS(pool, e)[0])) < 0;
    case QDOT_SUM: /* a sum known to be positive is not replaced by its negative: cosh(v) - cos(u) */
        return NODE(pool, e)->sign & (QDOT_GE0 | QDOT_LE0)
                   ? !(NODE(pool, e)->sign & QDOT_GE0)
                   : qdot_rational_sgn(RATIONAL(pool, ARGS(pool, e)[2])) < 0;
    default: return false;
    }
}

/* --- signs of products and sums --------------------------------------------------------- */

static uint8_t
flip_sign_bits(uint8_t s)
{
    return (uint8_t)((s & QDOT_NE0) | (s & QDOT_GE0 ? QDOT_LE0 : 0) |
                     (s & QDOT_LE0 ? QDOT_GE0 : 0));
}

static uint8_t
sign_of_product(uint8_t a, uint8_t b)
{
    uint8_t known = 0;

    if ((a & QDOT_GE0) && (b & QDOT_GE0))
        known = QDOT_GE0;
    else if ((a & QDOT_LE0) && (b & QDOT_LE0))
        known = QDOT_GE0;
    else if ((a & (QDOT_GE0 | QDOT_LE0)) && (b & (QDOT_GE0 | QDOT_LE0)))
        known = QDOT_LE0;
    return (uint8_t)(known | (a & b & QDOT_NE0));
}

static uint8_t
sign_of_power(const qdot_pool *pool, qdot_expr base, qdot_expr exponent)
{
    uint8_t s = NODE(pool, base)->sign;
    const fmpq *x = NUMBER(pool, exponent);

    if (x == NULL)
        return (s & QDOT_POS) == QDOT_POS ? QDOT_POS : 0;
    if (!fmpz_is_one(fmpq_denref(x))) /* the exponent is a fraction: a real root, so its base is not negative */
        return (uint8_t)(QDOT_GE0 | (s & QDOT_NE0) | (qdot_rational_sgn(x) < 0 ? QDOT_NE0 : 0));
    if (fmpz_is_even(fmpq_numref(x)))
        s = (uint8_t)(QDOT_GE0 | (s & QDOT_NE0));
    if (qdot_rational_sgn(x) < 0 && (s & (QDOT_GE0 | QDOT_LE0)))
        s |= QDOT_NE0;
    return s;
}

uint8_t
qdot_sign_of_product(const qdot_pool *pool, uint32_t n, const qdot_expr *args)
{
    uint8_t s = NODE(pool, args[0])->sign;

    for (uint32_t i = 1; i < n && s != 0; i += 2)
        s = sign_of_product(s, sign_of_power(pool, args[i], args[i + 1]));
    return s;
}

uint8_t
qdot_sign_of_sum(const qdot_pool *pool, uint32_t n, const qdot_expr *args)
{
    uint8_t all = NODE(pool, args[0])->sign, any = all & QDOT_NE0;

    all &= QDOT_GE0 | QDOT_LE0;
    for (uint32_t i = 1; i < n && all != 0; i += 2) {
        uint8_t s = NODE(pool, args[i])->sign;

        if (qdot_rational_sgn(RATIONAL(pool, args[i + 1])) < 0)
            s = flip_sign_bits(s);
        all &= s;
        any |= s & QDOT_NE0;
    }
    return all == 0 ? qdot_sign_by_bounds(pool, n, args) : (uint8_t)(all | any);
}

/* Whether x is a symbol declared within [lo, hi], in units of pi/2; *open: strictly. */
static bool
is_declared_between(const qdot_pool *pool, qdot_expr x, int lo, int hi, bool *open)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);
    int bound[2];

    if (s == NULL || s->lo == QDOT_NIL || s->hi == QDOT_NIL)
        return false;
    for (int i = 0; i < 2; i++) {
        qdot_expr e = i == 0 ? s->lo : s->hi;
        const fmpq *c = NULL;

        if (e == QDOT_ZERO) {
            bound[i] = 0;
        } else if (e == QDOT_PI) {
            bound[i] = 2;
        } else {
            if (NODE(pool, e)->kind == QDOT_PROD && NODE(pool, e)->n == 3 &&
                ARGS(pool, e)[1] == QDOT_PI && ARGS(pool, e)[2] == QDOT_ONE)
                c = RATIONAL(pool, ARGS(pool, e)[0]);
            if (c == NULL || !qdot_integer_is(fmpq_denref(c), 2) ||
                (!fmpz_is_one(fmpq_numref(c)) && !qdot_integer_is(fmpq_numref(c), -1)))
                return false;
            bound[i] = (int)fmpz_get_si(fmpq_numref(c));
        }
    }
    *open = (s->lo_open || bound[0] > lo) && (s->hi_open || bound[1] < hi);
    return bound[0] >= lo && bound[1] <= hi;
}

uint8_t
qdot_sign_of_function(const qdot_pool *pool, qdot_fun_id id, const qdot_expr *args)
{
    uint8_t s = NODE(pool, args[0])->sign;
    const qdot_fun_end *lo = &qdot_fun_facts_of(id)->lo;
    bool open;

    if (qdot_fun_is(id, QDOT_FUN_ODD | QDOT_FUN_RISING))
        return s;
    if (lo->known && lo->number >= 0)
        return lo->open || lo->number > 0 ? QDOT_POS
               : id == QDOT_ABS           ? (uint8_t)(QDOT_GE0 | (s & QDOT_NE0))
                                          : QDOT_GE0;
    switch (id) {
    case QDOT_SIGN:
    case QDOT_HOLD: return s;
    case QDOT_SIN:
    case QDOT_CSC:
        return is_declared_between(pool, args[0], 0, 2, &open) ? (open ? QDOT_POS : QDOT_GE0) : 0;
    case QDOT_COS:
    case QDOT_SEC:
        return is_declared_between(pool, args[0], -1, 1, &open) ? (open ? QDOT_POS : QDOT_GE0) : 0;
    default: return 0;
    }
}
