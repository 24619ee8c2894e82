/* constant.c -- the root bound, node by node; enclosures with growing precision until they
 * fall below it. */
#include "normal/refute/constant.h"

#include <math.h>

#include <flint/ulong_extras.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/refute/ball.h"

#define MOST_BITS 60000
#define MOST_DEGREE 4096
#define MOST_NODES 4000
#define MOST_EXPONENT_BITS 20

/* Bounds of the conjugates of an algebraic number, as logarithms to base 2, rounded up. */
typedef struct {
    double u, l;
} size;

struct root {
    qdot_expr base;
    ulong order;
};

typedef struct {
    qdot_pool *pool;
    qdot_walk walk;
    size *of; /* [walk.n] bounds of the conjugates of each node */
    qdot_vec(struct root) roots;
    ulong unity; /* order n of the roots of unity e^(2 pi i/n) that occur */
} bound;

/* x increased a little, to cover the rounding of the logarithms themselves. */
static double
round_up_a_little(double x)
{
    return x + 1e-9 * (1 + fabs(x));
}

static double
log2_of(const fmpz_t n)
{
    return fmpz_is_zero(n) ? 0 : round_up_a_little((double)fmpz_bits(n));
}

static double
log2_sum(double a, double b)
{
    double most = a > b ? a : b, least = a > b ? b : a;

    return round_up_a_little(most + log2(1 + exp2(least - most)));
}

static size
bound_of_sum(size a, size b)
{
    return (size){log2_sum(a.u + b.l, b.u + a.l), round_up_a_little(a.l + b.l)};
}

static size
bound_of_product(size a, size b)
{
    return (size){round_up_a_little(a.u + b.u), round_up_a_little(a.l + b.l)};
}

static size
bound_of_number(const fmpq *x)
{
    double n = log2_of(fmpq_numref(x));

    /* an integer of b bits is below 2^b; 1 is 2^0 */
    if (fmpz_is_pm1(fmpq_numref(x)))
        n = 0;
    return (size){n, fmpz_is_one(fmpq_denref(x)) ? 0 : log2_of(fmpq_denref(x))};
}

/* Bounds of the k-th root: (U L^(k-1))^(1/k) / L. The alternative U / (U^(k-1) L)^(1/k) fails for U = 0. */
static size
bound_of_root(size a, double k)
{
    return (size){round_up_a_little((a.u + (k - 1) * a.l) / k), a.l};
}

/* Record a root; roots of the same base are treated as one root of their least common order. */
static qdot_status
record_root(bound *b, qdot_expr base, ulong order)
{
    for (size_t i = 0; i < b->roots.n; i++)
        if (b->roots.at[i].base == base) {
            ulong have = b->roots.at[i].order;

            b->roots.at[i].order = have / n_gcd(have, order) * order;
            return QDOT_OK;
        }
    return qdot_vec_push(&b->roots, ((struct root){base, order}));
}

static size
bound_of_node(const bound *b, qdot_expr e)
{
    return b->of[qdot_walk_index(&b->walk, e)];
}

/* Find the bounds of the conjugates of a power; QDOT_EFAILED if the rules do not apply. */
static qdot_status
find_bound_of_power(bound *b, qdot_expr base, qdot_expr exponent, size *s)
{
    const fmpq *x = qdot_expr_rational(b->pool, exponent);
    ulong p, q;
    double swap;

    if (x == NULL || fmpz_bits(fmpq_numref(x)) > MOST_EXPONENT_BITS ||
        fmpz_bits(fmpq_denref(x)) > MOST_EXPONENT_BITS)
        return QDOT_EFAILED;
    p = fmpz_get_ui(fmpq_numref(x)); /* p is |numerator| of the exponent */
    q = fmpz_get_ui(fmpq_denref(x));
    *s = bound_of_node(b, base);
    if (q > 1) {
        QDOT_TRY(record_root(b, base, q));
        *s = bound_of_root(*s, (double)q);
    }
    s->u = round_up_a_little(s->u * (double)p);
    s->l = round_up_a_little(s->l * (double)p);
    if (fmpq_sgn(x) < 0) {
        swap = s->u;
        s->u = s->l;
        s->l = swap;
    }
    return QDOT_OK;
}

/* Find the rational c if e is c pi. */
static bool
is_multiple_of_pi(const qdot_pool *pool, qdot_expr e, fmpq_t c)
{
    fmpq_one(c);
    if (e == QDOT_PI)
        return true;
    if (qdot_expr_kind(pool, e) != QDOT_PROD || qdot_expr_count(pool, e) != 3 ||
        qdot_expr_arg(pool, e, 1) != QDOT_PI || qdot_expr_arg(pool, e, 2) != QDOT_ONE)
        return false;
    fmpq_set(c, qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0)));
    return true;
}

static qdot_status
find_bound_of_function(bound *b, qdot_expr e, size *s)
{
    uint32_t op = qdot_expr_node(b->pool, e)->op;
    qdot_expr arg = qdot_expr_arg(b->pool, e, 0);
    qdot_status status = QDOT_EFAILED;
    fmpq_t c;

    if (op == QDOT_ABS) {
        *s = bound_of_node(b, arg);
        return QDOT_OK;
    }
    fmpq_init(c);
    if (op <= QDOT_COT && is_multiple_of_pi(b->pool, arg, c) &&
        fmpz_cmp_ui(fmpq_denref(c), MOST_DEGREE) <= 0) {
        /* the angle is 2 pi p/q, where q divides twice the denominator; a sine needs a further quarter turn */
        ulong q = 4 * fmpz_get_ui(fmpq_denref(c));

        b->unity = b->unity / n_gcd(b->unity, q) * q;
        /* 2 cos and 2 sin are algebraic integers; sin, cos and tan are quotients of these and 2 */
        *s = (size){1, 1};
        status = b->unity > 16 * MOST_DEGREE ? QDOT_EFAILED : QDOT_OK;
    }
    fmpq_clear(c);
    return status;
}

static qdot_status
find_bound_of_node(bound *b, qdot_expr e, size *s)
{
    qdot_pool *pool = b->pool;
    uint32_t n = qdot_expr_count(pool, e);
    size one;

    switch (qdot_expr_kind(pool, e)) {
    case QDOT_NUM: *s = bound_of_number(qdot_expr_rational(pool, e)); return QDOT_OK;
    case QDOT_SYM: /* a symbol: pi, allowed only in angles of sine and cosine */
        *s = (size){NAN, NAN};
        return e == QDOT_PI ? QDOT_OK : QDOT_EFAILED;
    case QDOT_SUM:
        *s = bound_of_number(qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0)));
        for (uint32_t i = 1; i < n; i += 2) {
            one = bound_of_product(bound_of_node(b, qdot_expr_arg(pool, e, i)),
                                   bound_of_node(b, qdot_expr_arg(pool, e, i + 1)));
            *s = bound_of_sum(*s, one);
        }
        return QDOT_OK;
    case QDOT_PROD:
        *s = bound_of_number(qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0)));
        for (uint32_t i = 1; i < n; i += 2) {
            QDOT_TRY(
                find_bound_of_power(b, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1), &one));
            *s = bound_of_product(*s, one);
        }
        return QDOT_OK;
    case QDOT_FUN: return find_bound_of_function(b, e, s);
    default: return QDOT_EFAILED;
    }
}

static ulong
field_degree(const bound *b)
{
    ulong d = b->unity > 2 ? n_euler_phi(b->unity) / 2 : 1;

    for (size_t i = 0; i < b->roots.n && d <= MOST_DEGREE; i++)
        d *= b->roots.at[i].order;
    return d;
}

/* Find *bits such that a constant with |e| below 2^-bits must be zero; QDOT_EFAILED if no such
 * bound is known. */
static qdot_status
find_root_separation(bound *b, qdot_expr e, double *bits)
{
    qdot_status status = QDOT_OK;
    size s = {0, 0};

    for (size_t i = 0; i < b->walk.n && status == QDOT_OK; i++) {
        status = find_bound_of_node(b, b->walk.at[i], &b->of[i]);
        s = b->of[i];
    }
    if (status == QDOT_OK)
        s = bound_of_node(b, e);
    if (status == QDOT_OK &&
        (isnan(s.u) || isnan(s.l) || s.u < 0 || s.l < 0 || field_degree(b) > MOST_DEGREE))
        status = QDOT_EFAILED;
    *bits = status == QDOT_OK ? round_up_a_little((double)(field_degree(b) - 1) * s.u + s.l) + 1 : 0;
    return status == QDOT_OK && *bits > MOST_BITS ? QDOT_EFAILED : status;
}

/* Enclosures with more and more bits, until one has no zero in it or is smaller than
 * 2^-bits. */
static qdot_status
find_sign_by_enclosure(qdot_pool *pool, qdot_expr e, double bits, qdot_constant_sign *sign)
{
    slong most = (slong)bits * 3 + 512;
    qdot_status status = QDOT_OK;
    qdot_ball ball;
    mag_t small, size;

    QDOT_TRY(qdot_ball_begin(&ball, pool, 1, &e));
    mag_init(small);
    mag_init(size);
    mag_one(small);
    mag_mul_2exp_si(small, small, -(slong)bits - 1);
    for (slong prec = 64; prec < 2 * most && *sign == QDOT_CONSTANT_UNKNOWN; prec *= 2) {
        arb_srcptr value;

        if (qdot_interrupt_is_set()) {
            status = qdot_interrupt_check();
            break;
        }
        qdot_ball_eval(&ball, prec, NULL, NULL);
        value = qdot_ball_get(&ball, e);
        if (value == NULL)
            continue;
        if (arb_is_positive(value))
            *sign = QDOT_CONSTANT_POSITIVE;
        else if (arb_is_negative(value))
            *sign = QDOT_CONSTANT_NEGATIVE;
        else if (arb_is_zero(value))
            *sign = QDOT_CONSTANT_ZERO;
        arb_get_mag(size, value);
        if (*sign == QDOT_CONSTANT_UNKNOWN && bits > 0 && mag_cmp(size, small) < 0)
            *sign = QDOT_CONSTANT_ZERO;
    }
    mag_clear(small);
    mag_clear(size);
    qdot_ball_end(&ball);
    return status;
}

qdot_status
qdot_constant_decide(qdot_pool *pool, qdot_expr e, qdot_constant_sign *sign)
{
    bound b = {.pool = pool, .unity = 1};
    qdot_status status;
    double bits = 0;

    *sign = QDOT_CONSTANT_UNKNOWN;
    if (!qdot_expr_is_constant(pool, e))
        return QDOT_OK;
    if (e == QDOT_ZERO) {
        *sign = QDOT_CONSTANT_ZERO;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_walk_begin(pool, e, &b.walk));
    b.of = qdot_calloc(b.walk.n + 1, sizeof *b.of);
    status = b.of == NULL             ? QDOT_ENOMEM
             : b.walk.n <= MOST_NODES ? find_root_separation(&b, e, &bits)
                                      : QDOT_EFAILED;
    qdot_walk_end(&b.walk);
    qdot_free(b.of);
    qdot_free(b.roots.at);
    if (status == QDOT_ENOMEM)
        return status;
    return find_sign_by_enclosure(pool, e, bits, sign);
}
