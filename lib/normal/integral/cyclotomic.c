/* cyclotomic.c -- integrates n/f where the roots of f are roots of unity times one number.
 *
 * f = x^M + C, or f is a cyclotomic polynomial Phi_m(x/r) r^d, which divides such an x^M + C. Its roots are rho = r exp(i theta),
 * and with N the numerator of n/f over x^M + C,
 *
 *     the residue at rho is A + iB = N(rho)/(M rho^(M - 1)) = -rho N(rho)/(M C),
 *     rho and its conjugate give A log(x^2 - 2 r cos(theta) x + r^2) - 2 B atan((x - r cos(theta))/(r sin(theta))).
 *
 * Source  Gradshteyn & Ryzhik, 2.142 to 2.147, generalised
 * Tests   tests/normal/integral/test_antiderivative.c
 */
#include "normal/integral/rational.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"

enum { MOST_ORDER = 2 * QDOT_POLY_MOST };

typedef struct {
    qdot_integral_task *t;
    qdot_poly N;    /* numerator over x^M + C, modulo f */
    int M;
    qdot_expr C, r; /* |C| = r^M */
} unity;

static int
greatest_divisor(int a, int b)
{
    return b == 0 ? a : greatest_divisor(b, a % b);
}

static int
totient(int m)
{
    int count = 0;

    for (int k = 1; k <= m; k++)
        count += greatest_divisor(k, m) == 1;
    return count;
}

/* The coefficients [degree + 1] of Phi_m: x^m - 1 divided by Phi_d for all d < m that divide m. */
static int
cyclotomic_polynomial(int m, int64_t *c)
{
    int degree = m;

    for (int i = 0; i <= m; i++)
        c[i] = i == 0 ? -1 : i == m;
    for (int d = 1; d < m; d++) {
        int64_t by[MOST_ORDER + 1];
        int n;

        if (m % d != 0)
            continue;
        n = cyclotomic_polynomial(d, by);
        for (int i = degree - n; i >= 0; i--) { /* monic */
            const int64_t q = c[i + n];

            for (int j = 0; j < n; j++)
                c[i + j] -= q * by[j];
        }
        for (int i = 0; i <= degree - n; i++)
            c[i] = c[i + n];
        degree -= n;
    }
    return degree;
}

/* cos or sin of p pi/q, 0 < p < q, in the first quadrant. */
static qdot_expr
wave(qdot_pool *pool, qdot_fun_id f, int p, int q)
{
    const bool second = 2 * p > q;
    const qdot_expr u = qdot_fun1(pool, f, qdot_mul(pool, QDOT_PI, qdot_expr_ratio(pool, second ? q - p : p, q)));

    return second && f == QDOT_COS ? qdot_neg(pool, u) : u;
}

/* cos or sin of n p pi/q for any integer n. */
static qdot_expr
wave_of_multiple(qdot_pool *pool, qdot_fun_id f, int n, int p, int q)
{
    const int k = n * p % (2 * q), half = k > q ? 2 * q - k : k;
    qdot_expr u;

    if (half == 0 || half == q)
        return f == QDOT_SIN ? QDOT_ZERO : half == 0 ? QDOT_ONE : QDOT_MINUS_ONE;
    u = wave(pool, f, half, q);
    return f == QDOT_SIN && k > q ? qdot_neg(pool, u) : u;
}

/* The real (or imaginary) part of the residue at r exp(i p pi/q). */
static qdot_expr
residue_part(const unity *u, qdot_fun_id f, int p, int q)
{
    qdot_pool *pool = u->t->pool;
    qdot_expr sum = QDOT_ZERO;

    for (int j = 0; j <= u->N.degree; j++)
        sum = qdot_add(pool, sum,
                       qdot_product(pool, 3, (qdot_expr[]){u->N.c[j], qdot_pow_int(pool, u->r, j + 1),
                                                           wave_of_multiple(pool, f, j + 1, p, q)}));
    return qdot_neg(pool, qdot_div(pool, sum, qdot_mul(pool, qdot_expr_int(pool, u->M), u->C)));
}

/* Add what the root at the angle p pi/q gives, 0 <= p <= q, with its conjugate. */
static bool
add_root(const unity *u, int p, int q, qdot_primitive *out)
{
    qdot_pool *pool = u->t->pool;
    const qdot_expr A = residue_part(u, QDOT_COS, p, q);
    qdot_expr real, imaginary;
    qdot_poly square;

    if (p == 0 || p == q)
        return qdot_primitive_add(u->t, out, false, A, qdot_poly_linear(u->t, QDOT_ONE, p == 0 ? qdot_neg(pool, u->r) : u->r));
    real = qdot_mul(pool, u->r, wave(pool, QDOT_COS, p, q));
    imaginary = qdot_mul(pool, u->r, wave(pool, QDOT_SIN, p, q));
    square = (qdot_poly){.degree = 2,
                         .c = {qdot_mul(pool, u->r, u->r), qdot_mul(pool, qdot_expr_int(pool, -2), real), QDOT_ONE}};
    return qdot_primitive_add(u->t, out, false, A, square) &&
           qdot_primitive_add(u->t, out, true, qdot_mul(pool, qdot_expr_int(pool, -2), residue_part(u, QDOT_SIN, p, q)),
                              qdot_poly_linear(u->t, qdot_div(pool, QDOT_ONE, imaginary),
                                               qdot_neg(pool, qdot_div(pool, real, imaginary))));
}

/* r > 0 with r^n = |c|. */
static qdot_expr
root_of_size(qdot_integral_task *t, qdot_expr c, int n, int *sign)
{
    *sign = qdot_integral_sign(t, c);
    if (*sign == 0)
        return QDOT_NIL;
    c = *sign < 0 ? qdot_neg(t->pool, c) : c;
    return qdot_integral_normal(t, qdot_pow(t->pool, c, qdot_expr_ratio(t->pool, 1, n)));
}

static bool
is_binomial(const qdot_poly *f)
{
    for (int i = 1; i < f->degree; i++)
        if (f->c[i] != QDOT_ZERO)
            return false;
    return true;
}

static bool
integrate_binomial(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    unity u = {.t = t, .N = *n, .M = f->degree, .C = f->c[0]};
    int sign;

    u.r = root_of_size(t, u.C, u.M, &sign);
    if (u.r == QDOT_NIL)
        return false;
    for (int k = sign > 0; k <= u.M; k += 2)
        if (!add_root(&u, k, u.M, out))
            return false;
    return true;
}

/* The order m for which f is Phi_m(x/r) r^d; 0: there is none. */
static int
find_order(qdot_integral_task *t, const qdot_poly *f, qdot_expr r)
{
    qdot_pool *pool = t->pool;

    for (int m = 5; m <= MOST_ORDER; m++) {
        int64_t c[MOST_ORDER + 1];
        bool same = totient(m) == f->degree && (m % 2 == 0 ? m / 2 : m) <= QDOT_POLY_MOST;

        if (!same)
            continue;
        (void)cyclotomic_polynomial(m, c);
        for (int i = 0; i <= f->degree && same; i++)
            same = qdot_integral_normal(
                       t, qdot_sub(pool, f->c[i], qdot_mul(pool, qdot_expr_int(pool, c[i]),
                                                           qdot_pow_int(pool, r, f->degree - i)))) == QDOT_ZERO;
        if (same)
            return m;
    }
    return 0;
}

bool
qdot_cyclotomic_integrate(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    qdot_pool *pool = t->pool;
    const qdot_expr over = qdot_div(pool, QDOT_ONE, f->c[f->degree]);
    const qdot_poly monic = qdot_poly_scale(t, f, over), top = qdot_poly_scale(t, n, over);
    qdot_poly whole, quotient, rest;
    unity u = {.t = t};
    int sign, m;

    if (monic.degree == -2 || top.degree == -2)
        return false;
    if (is_binomial(&monic))
        return integrate_binomial(t, &top, &monic, out);
    u.r = root_of_size(t, monic.c[0], monic.degree, &sign);
    m = u.r == QDOT_NIL || sign < 0 ? 0 : find_order(t, &monic, u.r);
    if (m == 0)
        return false;
    u.M = m % 2 == 0 ? m / 2 : m;
    u.C = qdot_pow_int(pool, u.r, u.M);
    u.C = m % 2 == 0 ? u.C : qdot_neg(pool, u.C);
    whole = qdot_poly_monomial(QDOT_ONE, u.M);
    rest = qdot_poly_constant(t, qdot_integral_normal(t, u.C));
    whole = qdot_poly_add(t, &whole, &rest);
    qdot_poly_divide(t, &whole, &monic, &quotient, &rest);
    if (rest.degree != -1)
        return false;
    whole = qdot_poly_mul(t, &top, &quotient);
    qdot_poly_divide(t, &whole, &monic, &quotient, &u.N);
    for (int k = 1; 2 * k < m && u.N.degree >= 0; k++)
        if (greatest_divisor(k, m) == 1 && !add_root(&u, 2 * k, m, out))
            return false;
    return u.N.degree >= 0;
}
