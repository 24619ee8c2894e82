/* range.c -- finds signs of generators of a field, and of polynomials in them, from declared ranges. */
#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"
#include "normal/prove/zero.h"
#include "normal/refute/ball.h"
#include "normal/refute/constant.h"

enum { MOST_SQUARES = 2, LONGEST = 60 };

#define EITHER (QDOT_GE0 | QDOT_LE0)

static uint8_t
sign_of_product(uint8_t a, uint8_t b)
{
    uint8_t known = 0;

    if ((a & b & EITHER) != 0)
        known = QDOT_GE0;
    else if ((a & EITHER) && (b & EITHER))
        known = QDOT_LE0;
    return (uint8_t)(known | (a & b & QDOT_NE0));
}

/* --- angles and their sines -------------------------------------------------------- */

/* The least and greatest value of an angle as constants; open: the angle does not reach this value. */
struct range {
    qdot_expr lo, hi;
    bool lo_open, hi_open;
};

/* Add c x to the range r, where the symbol x has its declared bounds. */
static bool
add_symbol_range(qdot_pool *pool, struct range *r, qdot_expr c, qdot_expr x)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);
    bool up = fmpq_sgn(qdot_expr_rational(pool, c)) > 0;
    qdot_symbol own;

    if (s == NULL || s->lo == QDOT_NIL || s->hi == QDOT_NIL ||
        !qdot_expr_is_constant(pool, s->lo) || !qdot_expr_is_constant(pool, s->hi))
        return false;
    own = *s; /* copy the symbol, since making expressions may move the pool's memory */
    r->lo = qdot_add(pool, r->lo, qdot_mul(pool, c, up ? own.lo : own.hi));
    r->hi = qdot_add(pool, r->hi, qdot_mul(pool, c, up ? own.hi : own.lo));
    r->lo_open |= up ? own.lo_open : own.hi_open;
    r->hi_open |= up ? own.hi_open : own.lo_open;
    return true;
}

static bool
find_range(qdot_pool *pool, qdot_expr e, struct range *r)
{
    uint32_t n = qdot_expr_count(pool, e);
    bool known = true;

    *r = (struct range){QDOT_ZERO, QDOT_ZERO, false, false};
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_SYM: return add_symbol_range(pool, r, QDOT_ONE, e);
    case QDOT_PROD:
        return n == 3 && qdot_expr_arg(pool, e, 2) == QDOT_ONE &&
               add_symbol_range(pool, r, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    case QDOT_SUM:
        r->lo = r->hi = qdot_expr_arg(pool, e, 0);
        for (uint32_t i = 1; i < n && known; i += 2) {
            qdot_expr t = qdot_expr_arg(pool, e, i), c = qdot_expr_arg(pool, e, i + 1);

            if (qdot_expr_is_constant(pool, t)) {
                r->lo = qdot_add(pool, r->lo, qdot_mul(pool, c, t));
                r->hi = qdot_add(pool, r->hi, qdot_mul(pool, c, t));
            } else {
                known = add_symbol_range(pool, r, c, t);
            }
        }
        return known;
    default: return false;
    }
}

/* Whether 0 <= e is proved; *open is set if 0 < e is proved, too. */
static bool
is_proved_nonnegative(qdot_pool *pool, qdot_expr e, bool *open)
{
    qdot_constant_sign sign;

    if (e == QDOT_NIL || qdot_constant_decide(pool, e, &sign) != QDOT_OK)
        return false;
    *open |= sign == QDOT_CONSTANT_POSITIVE;
    return sign == QDOT_CONSTANT_POSITIVE || sign == QDOT_CONSTANT_ZERO;
}

/* The sign of sin(x) for x in a range: (-1)^k between k pi and (k + 1) pi. */
static uint8_t
sign_of_sine(qdot_pool *pool, struct range r)
{
    qdot_expr k;
    double lo, n;
    bool open;

    if (!qdot_ball_double(pool, r.lo, NULL, NULL, &lo) || fabs(lo) > 1e6)
        return 0;
    n = floor(lo / M_PI + 1e-9);
    k = qdot_expr_int(pool, (int64_t)n);
    r.lo = qdot_sub(pool, r.lo, qdot_mul(pool, k, QDOT_PI));
    r.hi = qdot_sub(pool, qdot_mul(pool, qdot_add(pool, k, QDOT_ONE), QDOT_PI), r.hi);
    if (!is_proved_nonnegative(pool, r.lo, &r.lo_open) || !is_proved_nonnegative(pool, r.hi, &r.hi_open))
        return 0;
    open = r.lo_open && r.hi_open;
    return (uint8_t)((fmod(n, 2) == 0 ? QDOT_GE0 : QDOT_LE0) | (open ? QDOT_NE0 : 0));
}

uint8_t
qdot_range_sign(qdot_pool *pool, const qdot_gen *gen)
{
    uint8_t sign = qdot_expr_node(pool, gen->expr)->sign;
    struct range r;

    if (gen->kind == QDOT_GEN_ROOT || gen->kind == QDOT_GEN_ABS)
        sign |= QDOT_GE0;
    if (qdot_expr_is_constant(pool, gen->expr)) {
        qdot_constant_sign known;

        if (qdot_constant_decide(pool, gen->expr, &known) == QDOT_OK)
            sign |= known == QDOT_CONSTANT_POSITIVE   ? QDOT_POS
                    : known == QDOT_CONSTANT_NEGATIVE ? QDOT_NEG
                                                      : 0;
        return sign;
    }
    if ((gen->kind != QDOT_GEN_SIN && gen->kind != QDOT_GEN_COS) ||
        !find_range(pool, gen->of, &r))
        return sign;
    if (gen->kind == QDOT_GEN_COS) {
        qdot_expr quarter = qdot_mul(pool, QDOT_HALF, QDOT_PI);

        r.lo = qdot_add(pool, r.lo, quarter);
        r.hi = qdot_add(pool, r.hi, quarter);
    }
    return sign | sign_of_sine(pool, r);
}

/* --- signs of polynomials ---------------------------------------------------------- */

static uint8_t
sign_of_term(const qdot_zero *z, const fmpz_mpoly_t p, slong i, ulong *exp)
{
    const qdot_field *f = z->f;
    uint8_t sign =
        fmpz_sgn(fmpz_mpoly_term_coeff_ref((fmpz_mpoly_struct *)p, i, f->ctx)) > 0
            ? QDOT_POS
            : QDOT_NEG;

    fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
    for (slong v = 0; v < f->n && sign != 0; v++)
        if (exp[v] != 0)
            sign = sign_of_product(sign, exp[v] % 2 == 0
                                   ? (uint8_t)(QDOT_GE0 | (z->sign[v] & QDOT_NE0))
                                   : z->sign[v]);
    return sign;
}

/* The sign of a sum if all its terms have the same sign. */
static uint8_t
sign_by_terms(const qdot_zero *z, const fmpz_mpoly_t p)
{
    slong n = fmpz_mpoly_length(p, z->f->ctx);
    ulong *exp = qdot_malloc(((size_t)z->f->n + 1) * sizeof *exp);
    uint8_t all = EITHER, any = 0;

    for (slong i = 0; exp != NULL && i < n && all != 0; i++) {
        uint8_t s = sign_of_term(z, p, i, exp);

        all &= s;
        any |= s & QDOT_NE0;
    }
    if (exp == NULL)
        all = 0;
    qdot_free(exp);
    return all == 0 ? 0 : all | any;
}

/* The sign of p if it is c times an expression known to be positive, perhaps times another one of known sign. */
static uint8_t
sign_by_facts(const qdot_zero *z, const fmpz_mpoly_t p)
{
    qdot_field *f = z->f;
    uint8_t sign = 0;
    fmpz_mpoly_t q, product;

    fmpz_mpoly_init(q, f->ctx);
    fmpz_mpoly_init(product, f->ctx);
    for (size_t i = 0; i < z->n_positive && sign == 0; i++) {
        const qdot_ratio *r = qdot_field_value(f, z->positive[i]);

        if (r == NULL || fmpz_mpoly_is_zero(r->n, f->ctx))
            continue;
        /* n/d > 0 is equivalent to n d > 0 */
        qdot_field_mul(f, product, r->n, r->d);
        if (qdot_field_goes(f) && fmpz_mpoly_divides(q, product, p, f->ctx))
            sign = sign_by_terms(z, q); /* p q > 0, so p has the sign of q */
        if (sign != 0)
            sign |= QDOT_NE0;
    }
    fmpz_mpoly_clear(q, f->ctx);
    fmpz_mpoly_clear(product, f->ctx);
    return sign & EITHER ? sign : 0;
}

/* The sign of p if it is c times a node of known sign, such as cosh(x + y). */
static uint8_t
sign_by_nodes(const qdot_zero *z, const fmpz_mpoly_t p)
{
    qdot_field *f = z->f;
    slong length = fmpz_mpoly_length(p, f->ctx);
    uint8_t sign = 0;
    fmpz_mpoly_t q;

    fmpz_mpoly_init(q, f->ctx);
    for (size_t i = 0; i < f->n_nodes && sign == 0; i++) {
        uint8_t here = qdot_expr_node(f->pool, f->node[i])->sign;
        const qdot_ratio *r = &f->value[i];

        if (!(here & EITHER) || !fmpz_mpoly_is_fmpz(r->d, f->ctx) ||
            fmpz_mpoly_length(r->n, f->ctx) != length ||
            !fmpz_mpoly_divides(q, r->n, p, f->ctx) || !fmpz_mpoly_is_fmpz(q, f->ctx) ||
            fmpz_mpoly_is_zero(q, f->ctx))
            continue;
        sign = sign_of_product(here, sign_of_product(sign_by_terms(z, q), sign_by_terms(z, r->d)));
    }
    fmpz_mpoly_clear(q, f->ctx);
    return sign;
}

/* The sign of p after c^2 = 1 - s^2 is inserted for one angle, if all terms then have the same sign. */
static uint8_t
sign_by_sines(const qdot_zero *z, const fmpz_mpoly_t p)
{
    qdot_field *f = z->f;
    uint8_t sign = 0;
    fmpz_mpoly_t q;

    fmpz_mpoly_init(q, f->ctx);
    for (slong v = 0; v < f->n && sign == 0; v++)
        if ((f->gen[v].kind == QDOT_GEN_COS || f->gen[v].kind == QDOT_GEN_COSH) &&
            fmpz_mpoly_degree_si(p, v, f->ctx) >= 2 &&
            qdot_factor_flip(f, q, p, v) == QDOT_OK && qdot_field_goes(f))
            sign = sign_by_terms(z, q);
    fmpz_mpoly_clear(q, f->ctx);
    return sign & EITHER ? sign : 0;
}

static bool
contains_roots(const qdot_field *f, const fmpz_mpoly_t p)
{
    for (slong v = 0; v < f->n; v++)
        if (f->gen[v].kind == QDOT_GEN_ROOT && fmpz_mpoly_degree_si(p, v, f->ctx) > 0)
            return true;
    return false;
}

static uint8_t sign_of_polynomial(qdot_zero *z, const fmpz_mpoly_t p, int depth);

/* A - B for A, B >= 0 has the sign of A^2 - B^2, which has fewer roots. depth bounds the
 * recursion. */
static uint8_t
sign_by_squares(qdot_zero *z, const fmpz_mpoly_t p, int depth)
{
    qdot_field *f = z->f;
    slong n = fmpz_mpoly_length(p, f->ctx);
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    fmpz_mpoly_t part[2], term;
    uint8_t sign = EITHER;

    if (exp == NULL)
        return 0;
    fmpz_mpoly_init(part[0], f->ctx);
    fmpz_mpoly_init(part[1], f->ctx);
    fmpz_mpoly_init(term, f->ctx);
    for (slong i = 0; i < n && sign != 0; i++) {
        sign = sign_of_term(z, p, i, exp) & EITHER;
        fmpz_mpoly_get_term(term, p, i, f->ctx);
        if (sign & QDOT_GE0) {
            fmpz_mpoly_add(part[0], part[0], term, f->ctx);
        } else {
            fmpz_mpoly_sub(part[1], part[1], term, f->ctx);
        }
    }
    if (sign != 0) {
        qdot_field_mul(f, part[0], part[0], part[0]);
        qdot_field_mul(f, part[1], part[1], part[1]);
        fmpz_mpoly_sub(term, part[0], part[1], f->ctx);
        sign = qdot_field_goes(f) ? sign_of_polynomial(z, term, depth - 1) : 0;
    }
    fmpz_mpoly_clear(part[0], f->ctx);
    fmpz_mpoly_clear(part[1], f->ctx);
    fmpz_mpoly_clear(term, f->ctx);
    qdot_free(exp);
    return sign;
}

/* p = P + Q r, r a square root of B: where Q^2 B >= P^2 the sign is that of Q, where P^2 >= Q^2 B that of
 * P: y + sqrt(y^2 + 1) > 0. */
static uint8_t
sign_by_dominant_part(qdot_zero *z, const fmpz_mpoly_t p, int depth)
{
    qdot_field *f = z->f;
    const qdot_rule *rule = NULL;
    fmpz_mpoly_t P, Q, d, r;
    uint8_t sign = 0, more;

    for (size_t i = 0; i < f->n_rules && rule == NULL; i++)
        if (f->rule[i].power == 2 && f->gen[f->rule[i].var].kind == QDOT_GEN_ROOT &&
            fmpz_mpoly_degree_si(p, f->rule[i].var, f->ctx) == 1)
            rule = &f->rule[i];
    if (rule == NULL)
        return 0;
    fmpz_mpoly_init(P, f->ctx);
    fmpz_mpoly_init(Q, f->ctx);
    fmpz_mpoly_init(d, f->ctx);
    fmpz_mpoly_init(r, f->ctx);
    fmpz_mpoly_derivative(Q, p, rule->var, f->ctx);
    fmpz_mpoly_gen(r, rule->var, f->ctx);
    fmpz_mpoly_mul(d, Q, r, f->ctx);
    fmpz_mpoly_sub(P, p, d, f->ctx);
    qdot_field_mul(f, d, d, d); /* d is now Q^2 B */
    qdot_field_mul(f, r, P, P);
    fmpz_mpoly_sub(d, d, r, f->ctx);
    if (qdot_field_goes(f)) {
        more = sign_of_polynomial(z, d, depth - 1);
        if (more & EITHER)
            sign = sign_of_polynomial(z, more & QDOT_GE0 ? Q : P, depth - 1);
        if (!(more & QDOT_NE0))
            sign &= EITHER;
    }
    fmpz_mpoly_clear(P, f->ctx);
    fmpz_mpoly_clear(Q, f->ctx);
    fmpz_mpoly_clear(d, f->ctx);
    fmpz_mpoly_clear(r, f->ctx);
    return sign & EITHER ? sign : 0;
}

static uint8_t
sign_of_factor(qdot_zero *z, const fmpz_mpoly_t p, int depth)
{
    uint8_t sign = sign_by_terms(z, p);

    if (sign & EITHER)
        return sign;
    sign = sign_by_facts(z, p);
    if (sign == 0)
        sign = sign_by_nodes(z, p);
    if (sign == 0)
        sign = sign_by_sines(z, p);
    if (sign == 0 && depth > 0 && fmpz_mpoly_length(p, z->f->ctx) <= LONGEST &&
        contains_roots(z->f, p))
        sign = sign_by_squares(z, p, depth);
    if (sign == 0 && depth > 0 && fmpz_mpoly_length(p, z->f->ctx) <= LONGEST)
        sign = sign_by_dominant_part(z, p, depth);
    return sign;
}

static uint8_t
sign_of_polynomial(qdot_zero *z, const fmpz_mpoly_t p, int depth)
{
    qdot_field *f = z->f;
    qdot_factors factors;
    uint8_t sign;

    if (fmpz_mpoly_is_zero(p, f->ctx))
        return EITHER;
    sign = sign_of_factor(z, p, 0);
    if (sign != 0)
        return sign;
    if (qdot_factor(f, &factors, p) == QDOT_OK) {
        sign = fmpz_sgn(factors.content) > 0 ? QDOT_POS : QDOT_NEG;
        for (slong i = 0; i < factors.n && sign != 0; i++) {
            uint8_t one = sign_of_factor(z, factors.poly + i, depth);

            if (factors.exp[i] % 2 == 0)
                one = (uint8_t)(QDOT_GE0 | (one & QDOT_NE0));
            sign = one & EITHER ? sign_of_product(sign, one) : 0;
        }
    }
    qdot_factor_clear(f, &factors);
    return sign;
}

uint8_t
qdot_zero_sign(qdot_zero *z, const fmpz_mpoly_t p)
{
    return qdot_field_goes(z->f) ? sign_of_polynomial(z, p, MOST_SQUARES) : 0;
}
