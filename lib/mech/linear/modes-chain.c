/* modes-chain.c -- the modes of uniform chains and rings, in closed form for any number of masses.
 *
 * Let X stand for M and for H. In a uniform chain X is tridiagonal: x on the diagonal, x' beside it, apart from the ends.
 * Then y_k = sin((k - p) u) or cos((k - p) u), k = 1 .. n, fulfils the inner equations with the value x + 2 x' cos(u) of X,
 * and the first and last ones if y is odd or even about a point at each end:
 *
 *     end        X_11      y is                          as of
 *     fixed      x         odd about p = 0               a wall one spring away
 *     free       x + x'    even about p = 1/2            no spring beyond the last mass
 *     held       x - x'    odd about p = 1/2             a wall half a spring away
 *     half       x/2       even about p = 1              half a mass at the end
 *
 * and at the other end about n + 1 - p'. With L = n + 1 - p' - p the two conditions hold for u = pi k/L if both ends are odd
 * (k = 1 ..) or both even (k = 0 ..), and for u = pi (k - 1/2)/L else: n values in 0 <= u <= pi, so these are all modes.
 * In a ring X is circulant, X_jk = x_|j-k|, and y_j = cos(j u), sin(j u) with u = 2 pi k/n, of the value x_0 + sum x_l cos(l u).
 * Then
 *
 *     w^2 = h(u)/m(u);  for the springs of a chain of equal masses  w = 2 sqrt(k/m) sin(u/2).
 *
 * Source  Strang, "The discrete cosine transform", SIAM Review 41 (1999) 135; Goldstein, Poole, Safko, chapter 13.1.
 * Tests   tests/script/rests/modes-chains.lag
 */
#include "mech/linear/modes-parts.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "normal/simplify/simplify.h"

typedef enum { FIXED, FREE, HELD, HALF, NO_END } end;

typedef struct {
    qdot_modes_job *j;
    qdot_pool *pool;
    size_t n;
    const size_t *which;
    bool is_ring, plain; /* plain: amplitudes of unknowns are those of coordinates */
    end first, last;
} chain;

/* The entry of M (k = 0) or H (k = 1) between two masses of the chain. */
static qdot_expr
chain_entry(const chain *c, int k, size_t a, size_t b)
{
    return (k == 0 ? c->j->m.M : c->j->m.H)[c->which[a] * c->j->m.n + c->which[b]];
}

static bool
entries_are_equal(const chain *c, qdot_expr a, qdot_expr b)
{
    return a == b || qdot_modes_is_zero(c->j, qdot_sub(c->pool, a, b));
}

/* --- recognition -------------------------------------------------------------------------- */

static bool
is_ring(const chain *c)
{
    for (int k = 0; k < 2; k++)
        for (size_t a = 0; a < c->n; a++)
            for (size_t b = 0; b < c->n; b++)
                if (!entries_are_equal(c, chain_entry(c, k, a, b), chain_entry(c, k, 0, (b + c->n - a) % c->n)) ||
                    !entries_are_equal(c, chain_entry(c, k, a, b), chain_entry(c, k, b, a)))
                    return false;
    return true;
}

/* The kind of an end of mass a, NO_END: none of them. */
static end
end_of_chain(const chain *c, size_t a)
{
    for (end e = FIXED; e < NO_END; e++) {
        bool is = true;

        for (int k = 0; k < 2 && is; k++) {
            const qdot_expr x = chain_entry(c, k, 1, 1), beside = chain_entry(c, k, 0, 1);
            const qdot_expr value[] = {x, qdot_add(c->pool, x, beside), qdot_sub(c->pool, x, beside),
                                       qdot_div(c->pool, x, qdot_expr_int(c->pool, 2))};

            is = entries_are_equal(c, chain_entry(c, k, a, a), value[e]);
        }
        if (is)
            return e;
    }
    return NO_END;
}

static bool
is_chain(chain *c)
{
    for (int k = 0; k < 2; k++)
        for (size_t a = 0; a < c->n; a++)
            for (size_t b = 0; b < c->n; b++) {
                const bool end = a == b && (a == 0 || a + 1 == c->n);
                const qdot_expr like = a == b                      ? chain_entry(c, k, 1, 1)
                                       : a + 1 == b || b + 1 == a ? chain_entry(c, k, 0, 1)
                                                                    : QDOT_ZERO;

                if (!end && !entries_are_equal(c, chain_entry(c, k, a, b), like))
                    return false;
            }
    c->first = end_of_chain(c, 0);
    c->last = end_of_chain(c, c->n - 1);
    return c->first != NO_END && c->last != NO_END;
}

/* --- formulas ----------------------------------------------------------------------------- */

/* sin(pi p/q), with the angle brought to 0 .. pi/2. */
static qdot_expr
sine(const chain *c, int64_t p, int64_t q)
{
    bool negative = false;
    qdot_expr u;

    p %= 2 * q;
    p += p < 0 ? 2 * q : 0;
    if (p >= q) {
        p -= q;
        negative = true;
    }
    if (2 * p > q)
        p = q - p;
    u = qdot_mul(c->pool, QDOT_PI, qdot_expr_ratio(c->pool, p, q));
    u = qdot_fun(c->pool, QDOT_SIN, 1, &u);
    return negative ? qdot_neg(c->pool, u) : u;
}

/* The value of M (k = 0) or H (k = 1) for u = pi p/q, as that for u = 0 and what the wave adds. */
static void
value_of_wave(const chain *c, int k, int64_t p, int64_t q, qdot_expr *constant, qdot_expr *wave)
{
    qdot_expr all = chain_entry(c, k, 1, 1), sum = QDOT_ZERO;
    const size_t reach = c->is_ring ? c->n / 2 : 1;

    for (size_t l = 1; l <= reach; l++) {
        const qdot_expr x = c->is_ring ? chain_entry(c, k, 0, l) : chain_entry(c, k, 0, 1);
        const int64_t times = c->is_ring && 2 * l == c->n ? 1 : 2;
        const qdot_expr root = sine(c, (int64_t)l * p, 2 * q);

        /* times x cos(l u) = times x - 2 times x sin(l u/2)^2 */
        all = qdot_add(c->pool, all, qdot_mul(c->pool, qdot_expr_int(c->pool, times), x));
        sum = qdot_add(c->pool, sum, qdot_product(c->pool, 3, (qdot_expr[]){qdot_expr_int(c->pool, -2 * times), x,
                                                                            qdot_mul(c->pool, root, root)}));
    }
    *constant = qdot_simplify(c->pool, all, &c->j->facts);
    *wave = sum;
}

/* Whether H couples neighbours alone, and M nothing. */
static bool
neighbours_alone_couple(const chain *c)
{
    for (size_t l = 1; l < c->n; l++)
        if (chain_entry(c, 0, 0, l) != QDOT_ZERO ||
            (l > 1 && !(c->is_ring && l + 1 == c->n) && chain_entry(c, 1, 0, l) != QDOT_ZERO))
            return false;
    return true;
}

/* The frequency for u = pi p/q, 0 <= u <= pi: 2 sqrt(-h'/m) sin(u/2) of masses m that equal springs alone couple. */
static qdot_status
frequency_of_wave(const chain *c, int64_t p, int64_t q, qdot_expr *w)
{
    qdot_pool *pool = c->pool;
    qdot_expr constant[2], wave[2], square;

    for (int k = 0; k < 2; k++)
        value_of_wave(c, k, p, q, &constant[k], &wave[k]);
    if (constant[1] == QDOT_ZERO && neighbours_alone_couple(c)) {
        square = qdot_div(pool, qdot_neg(pool, chain_entry(c, 1, 0, 1)), constant[0]);
        QDOT_TRY(qdot_modes_frequency(c->j, square, w));
        *w = qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2), *w, sine(c, p, 2 * q)});
        return qdot_pool_check(pool);
    }
    square = qdot_add(pool, constant[1], wave[1]);
    square = qdot_div(pool, square, qdot_add(pool, constant[0], wave[0]));
    return qdot_modes_frequency(c->j, square, w);
}

/* Whether every coordinate is one of the unknowns, or does not move. */
static bool
unknowns_are_coordinates(const qdot_modes_job *j)
{
    for (size_t i = 0; i < j->s->coordinates.n; i++) {
        size_t moves = 0;

        for (size_t a = 0; a < j->m.n; a++) {
            const qdot_expr e = j->m.N[i * j->m.n + a];

            moves += e == QDOT_ONE ? 1 : e == QDOT_ZERO ? 0 : 2;
        }
        if (moves > 1)
            return false;
    }
    return true;
}

/* Add the mode y_k = sin((k - p) u), or cos where `even`, with u = pi t/q, p = twice/2; its first component that is not 0
 * is 1. */
static qdot_status
add_wave(const chain *c, bool even, int64_t twice, int64_t t, int64_t q)
{
    qdot_expr *y = qdot_calloc(c->j->m.n + 1, sizeof *y), w = QDOT_NIL, first = QDOT_ZERO;
    qdot_status status = y == NULL ? QDOT_ENOMEM : frequency_of_wave(c, t, q, &w);

    for (size_t i = 0; i < c->j->m.n && status == QDOT_OK; i++)
        y[i] = QDOT_ZERO;
    for (size_t i = 0; i < c->n && status == QDOT_OK; i++) {
        const qdot_expr x = sine(c, (2 * (int64_t)(i + 1) - twice) * t + (even ? q : 0), 2 * q);

        first = first == QDOT_ZERO ? x : first;
        y[c->which[i]] = first == QDOT_ZERO ? QDOT_ZERO : qdot_div(c->pool, x, first);
    }
    if (status == QDOT_OK)
        status = c->plain ? qdot_modes_add_as_it_is(c->j, w, y) : qdot_modes_add(c->j, w, y);
    qdot_free(y);
    return status;
}

/* Waves of a chain: u = pi t/q with q = 2 L or 4 L, so that all is in whole numbers. */
static qdot_status
add_waves_of_chain(const chain *c)
{
    static const int64_t twice_p[] = {[FIXED] = 0, [FREE] = 1, [HELD] = 1, [HALF] = 2};
    const bool odd = c->first == FIXED || c->first == HELD, odd_last = c->last == FIXED || c->last == HELD;
    const int64_t twice_L = 2 * (int64_t)c->n + 2 - twice_p[c->first] - twice_p[c->last];

    for (int64_t k = odd ? 1 : odd_last ? 1 : 0, i = 0; i < (int64_t)c->n; k++, i++)
        QDOT_TRY(odd == odd_last
                     ? add_wave(c, !odd, twice_p[c->first], 2 * k, twice_L)
                     : add_wave(c, !odd, twice_p[c->first], 2 * k - 1, twice_L));
    return QDOT_OK;
}

static qdot_status
add_waves_of_ring(const chain *c)
{
    for (int64_t k = 0; 2 * k <= (int64_t)c->n; k++) {
        QDOT_TRY(add_wave(c, true, 0, 2 * k, (int64_t)c->n));
        if (k > 0 && 2 * k < (int64_t)c->n)
            QDOT_TRY(add_wave(c, false, 0, 2 * k, (int64_t)c->n));
    }
    return QDOT_OK;
}

qdot_status
qdot_modes_of_chain(qdot_modes_job *j, size_t n, const size_t *which, bool *done)
{
    chain c = {.j = j, .pool = j->pool, .n = n, .which = which};

    *done = false;
    if (n < 3)
        return QDOT_OK;
    c.plain = unknowns_are_coordinates(j);
    c.is_ring = is_ring(&c);
    if (!c.is_ring && !is_chain(&c))
        return qdot_pool_check(j->pool);
    QDOT_TRY(c.is_ring ? add_waves_of_ring(&c) : add_waves_of_chain(&c));
    *done = true;
    return qdot_pool_check(j->pool);
}
