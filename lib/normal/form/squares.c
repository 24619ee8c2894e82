/* squares.c -- squares of differences and sums put together again:
 *
 *     x^2 - 2*x*y + y^2 + z^2 = (x - y)^2 + z^2.
 */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "normal/form/form.h"

enum { MOST_TERMS = 24 };

/* A polynomial as arrays of coefficients and exponents: c[i] times the monomial with exponents exp + i gens. */
struct terms {
    qdot_field *f;
    slong n;
    ulong *exp; /* [n x gens] exponents of each term */
    fmpz *c;    /* [n] coefficient of each term */
    bool used[MOST_TERMS];
};

static const ulong *
exponents_of_term(const struct terms *t, slong i)
{
    return t->exp + i * t->f->n;
}

/* c_i m_i, c_j m_j, c_k m_k as g common (a^2, b^2, +-2 a b): whether 4 c_i c_j = c_k^2,
 * m_i m_j = m_k^2 and both are squares but for what they share. */
static bool
is_complete_square(const struct terms *t, slong i, slong j, slong k, fmpz_t g)
{
    const ulong *a = exponents_of_term(t, i), *b = exponents_of_term(t, j), *ab = exponents_of_term(t, k);
    bool good = fmpz_sgn(t->c + i) == fmpz_sgn(t->c + j), same = true;
    bool moving = false, still = false;
    ulong fast = 0;
    fmpz_t x, y;

    for (slong v = 0; v < t->f->n && good; v++) {
        good = a[v] + b[v] == 2 * ab[v];
        same &= a[v] == b[v];
        fast += t->f->gen[v].fast ? a[v] - b[v] : 0;
        moving |= t->f->gen[v].fast && a[v] != b[v];
        still |= !t->f->gen[v].fast && a[v] != b[v];
    }
    /* velocities (momenta, ...) must not mix with other symbols: E*du^2 + 2*F*du*dv + G*dv^2 stays collected */
    if (!good || same || fast != 0 || (moving && still))
        return false;
    fmpz_init(x);
    fmpz_init(y);
    fmpz_mul(x, t->c + i, t->c + j);
    fmpz_mul_2exp(x, x, 2);
    fmpz_mul(y, t->c + k, t->c + k);
    good = fmpz_equal(x, y);
    fmpz_gcd(g, t->c + i, t->c + j);
    if (fmpz_sgn(t->c + i) < 0)
        fmpz_neg(g, g);
    fmpz_divexact(x, t->c + i, g);
    good = good && fmpz_is_square(x);
    fmpz_clear(x);
    fmpz_clear(y);
    return good;
}

/* The square root of term i divided by its common factor with the term `other`: sqrt(c/g) times a monomial. */
static qdot_expr
term_root(const struct terms *t, slong i, slong other, const fmpz_t g, ulong *exp)
{
    const ulong *a = exponents_of_term(t, i), *b = exponents_of_term(t, other);
    qdot_expr e;
    fmpq_t c;

    fmpq_init(c);
    fmpz_divexact(fmpq_numref(c), t->c + i, g);
    fmpz_sqrt(fmpq_numref(c), fmpq_numref(c));
    for (slong v = 0; v < t->f->n; v++)
        exp[v] = (a[v] - (a[v] < b[v] ? a[v] : b[v])) / 2;
    e = qdot_form_monomial(t->f, c, exp);
    fmpq_clear(c);
    return e;
}

/* Write the terms i, j, k as a square, g (common powers) (a +- b)^2; a +- b is written without a leading minus. */
static qdot_expr
write_square(const struct terms *t, slong i, slong j, slong k, const fmpz_t g, ulong *exp)
{
    qdot_pool *pool = t->f->pool;
    qdot_expr a = term_root(t, i, j, g, exp), b = term_root(t, j, i, g, exp), e;
    fmpq_t c;

    if (fmpz_sgn(t->c + k) != fmpz_sgn(g))
        b = qdot_neg(pool, b);
    e = qdot_add(pool, a, b);
    if (e != QDOT_NIL && qdot_expr_is_negative(pool, e))
        e = qdot_neg(pool, e);
    for (slong v = 0; v < t->f->n; v++) {
        ulong x = exponents_of_term(t, i)[v], y = exponents_of_term(t, j)[v];

        exp[v] = x < y ? x : y;
    }
    fmpq_init(c);
    fmpq_set_fmpz(c, g);
    e = qdot_mul(pool, qdot_form_monomial(t->f, c, exp), qdot_pow_int(pool, e, 2));
    fmpq_clear(c);
    return e;
}

/* Find one complete square among the terms not used yet; nil if there is none. */
static qdot_expr
next_square(struct terms *t, ulong *exp)
{
    qdot_expr e = QDOT_NIL;
    fmpz_t g;

    fmpz_init(g);
    for (slong i = 0; i < t->n && e == QDOT_NIL; i++)
        for (slong j = i + 1; j < t->n && e == QDOT_NIL && !t->used[i]; j++)
            for (slong k = 0; k < t->n && e == QDOT_NIL && !t->used[j]; k++) {
                if (k == i || k == j || t->used[k] || !is_complete_square(t, i, j, k, g))
                    continue;
                e = write_square(t, i, j, k, g, exp);
                t->used[i] = t->used[j] = t->used[k] = true;
            }
    fmpz_clear(g);
    return e;
}

qdot_expr
qdot_form_squares(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr sum = QDOT_ZERO, e, scale = qdot_expr_fmpq(pool, c);
    struct terms t = {.f = f, .n = fmpz_mpoly_length(p, f->ctx)};
    fmpz_mpoly_t rest, term;
    bool any = false;
    ulong *exp;

    if (t.n < 4 || t.n > MOST_TERMS || !qdot_field_charge(f, t.n * t.n, t.n))
        return QDOT_NIL;
    t.exp = qdot_malloc((size_t)((t.n + 1) * (f->n + 1)) * sizeof *t.exp);
    if (t.exp == NULL)
        return qdot_pool_fail(pool);
    exp = t.exp + t.n * f->n;
    t.c = _fmpz_vec_init(t.n);
    for (slong i = 0; i < t.n; i++) {
        fmpz_mpoly_get_term_exp_ui(t.exp + i * f->n, p, i, f->ctx);
        fmpz_mpoly_get_term_coeff_fmpz(t.c + i, p, i, f->ctx);
    }
    while ((e = next_square(&t, exp)) != QDOT_NIL) {
        sum = qdot_add(pool, sum, qdot_mul(pool, scale, e));
        any = true;
    }
    if (any) {
        fmpz_mpoly_init(rest, f->ctx);
        fmpz_mpoly_init(term, f->ctx);
        for (slong i = 0; i < t.n; i++)
            if (!t.used[i]) {
                fmpz_mpoly_get_term(term, p, i, f->ctx);
                fmpz_mpoly_add(rest, rest, term, f->ctx);
            }
        e = qdot_form_horner(form, rest);
        sum = qdot_add(pool, sum, qdot_mul(pool, scale, e));
        fmpz_mpoly_clear(rest, f->ctx);
        fmpz_mpoly_clear(term, f->ctx);
    }
    _fmpz_vec_clear(t.c, t.n);
    qdot_free(t.exp);
    return any ? sum : QDOT_NIL;
}
