/* elliptic.c -- Legendre's elliptic integrals: special values, derivatives, values in double. */
#include "expr/elliptic.h"

#include <math.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

bool
qdot_is_elliptic(unsigned f)
{
    return f >= QDOT_ELLIPTIC_K && f <= QDOT_JACOBI_DN;
}

static qdot_expr
elliptic(qdot_pool *pool, qdot_fun_id f, qdot_expr a, qdot_expr b, qdot_expr c)
{
    return qdot_fun(pool, f, c != QDOT_NIL ? 3 : b != QDOT_NIL ? 2 : 1, (qdot_expr[]){a, b, c});
}

/* --- special values --------------------------------------------------------------------------- */

static bool
is_number_from(const qdot_pool *pool, qdot_expr m, int least, bool with_least)
{
    const fmpq *x = NUMBER(pool, m);
    const int side = x == NULL ? -1 : qdot_rational_cmp(x, &(fmpq){least, 1});

    return side > 0 || (side == 0 && with_least);
}

static qdot_expr
simplify_complete(qdot_pool *pool, qdot_fun_id f, qdot_expr n, qdot_expr m)
{
    const qdot_expr right = qdot_mul(pool, QDOT_HALF, QDOT_PI);

    if (is_number_from(pool, m, 1, f != QDOT_ELLIPTIC_E) || (n != QDOT_NIL && is_number_from(pool, n, 1, true)))
        return qdot_pool_refuse(pool, QDOT_EDOMAIN,
                                f == QDOT_ELLIPTIC_E ? "elliptic_E(m) is real for m <= 1"
                                : f == QDOT_ELLIPTIC_K ? "elliptic_K(m) is real for m < 1"
                                                       : "elliptic_Pi(n, m) is real for n < 1 and m < 1");
    if (f == QDOT_ELLIPTIC_E && m == QDOT_ONE)
        return QDOT_ONE;
    if (f == QDOT_ELLIPTIC_PI && n == QDOT_ZERO)
        return elliptic(pool, QDOT_ELLIPTIC_K, m, QDOT_NIL, QDOT_NIL);
    if (f == QDOT_ELLIPTIC_PI && m == QDOT_ZERO)
        return qdot_div(pool, right, qdot_sqrt(pool, qdot_sub(pool, QDOT_ONE, n)));
    return m == QDOT_ZERO && f != QDOT_ELLIPTIC_PI ? right : QDOT_NIL;
}

/* E(r pi, 1), the integral of |cos|: 2 n + sin(r pi - n pi) with n half turns between. */
static qdot_expr
area_of_cosine(qdot_pool *pool, const fmpq *r)
{
    qdot_expr n, rest;
    fmpq_t x;

    fmpq_init(x);
    fmpq_add(x, r, (fmpq[]){{1, 2}});
    fmpz_fdiv_q(fmpq_numref(x), fmpq_numref(x), fmpq_denref(x));
    fmpz_one(fmpq_denref(x));
    n = qdot_expr_fmpq(pool, x);
    fmpq_sub(x, r, x);
    rest = qdot_mul(pool, qdot_expr_fmpq(pool, x), QDOT_PI);
    fmpq_clear(x);
    return qdot_add(pool, qdot_mul(pool, qdot_expr_int(pool, 2), n), qdot_fun1(pool, QDOT_SIN, rest));
}

/* F and E up to the angle at which the root ends, m sin(phi)^2 = 1, phi < pi/2, by the parameter k = 1/m < 1:
 * F = K(k)/sqrt(m), E = sqrt(m) (E(k) - (1 - k) K(k)) (Byrd & Friedman, Handbook of Elliptic Integrals, 114.01). */
static qdot_expr
up_to_end_of_root(qdot_pool *pool, qdot_fun_id f, qdot_expr m)
{
    const qdot_expr k = qdot_div(pool, QDOT_ONE, m), root = qdot_sqrt(pool, m),
                    first = elliptic(pool, QDOT_ELLIPTIC_K, k, QDOT_NIL, QDOT_NIL);

    if (f == QDOT_ELLIPTIC_F)
        return qdot_div(pool, first, root);
    return qdot_mul(pool, root, qdot_sub(pool, elliptic(pool, QDOT_ELLIPTIC_E, k, QDOT_NIL, QDOT_NIL),
                                         qdot_mul(pool, qdot_sub(pool, QDOT_ONE, k), first)));
}

/* Whether 0 < phi < pi/2 is certain: a multiple of pi [turns], or an arcsine. */
static bool
is_acute(const qdot_pool *pool, qdot_expr phi, const fmpq *turns)
{
    return turns != NULL ? fmpq_sgn(turns) > 0 && qdot_rational_cmp(turns, &(fmpq){1, 2}) < 0
                         : NODE(pool, phi)->kind == QDOT_FUN && NODE(pool, phi)->op == QDOT_ASIN;
}

/* F, E and Pi at phi: odd in phi, and k times the complete integral at k pi/2. */
static qdot_expr
simplify_incomplete(qdot_pool *pool, qdot_fun_id f, qdot_expr n, qdot_expr phi, qdot_expr m)
{
    fmpq_t turns;
    bool of_pi;
    qdot_expr result = QDOT_NIL;

    if (phi == QDOT_ZERO)
        return QDOT_ZERO;
    if (f == QDOT_ELLIPTIC_PI && n == QDOT_ZERO)
        return elliptic(pool, QDOT_ELLIPTIC_F, phi, m, QDOT_NIL);
    if (f != QDOT_ELLIPTIC_PI && m == QDOT_ZERO)
        return phi;
    if (f == QDOT_ELLIPTIC_F && NODE(pool, phi)->kind == QDOT_FUN && NODE(pool, phi)->op == QDOT_JACOBI_AM && ARGS(pool, phi)[1] == m)
        return ARGS(pool, phi)[0];
    if (qdot_expr_is_negative(pool, phi)) {
        phi = qdot_neg(pool, phi);
        return qdot_neg(pool, n != QDOT_NIL ? elliptic(pool, f, n, phi, m) : elliptic(pool, f, phi, m, QDOT_NIL));
    }
    fmpq_init(turns);
    of_pi = qdot_expr_unscale(pool, phi, turns) == QDOT_PI;
    if (f != QDOT_ELLIPTIC_PI && is_number_from(pool, m, 1, false) && is_acute(pool, phi, of_pi ? turns : NULL) &&
        qdot_mul(pool, m, qdot_pow_int(pool, qdot_fun1(pool, QDOT_SIN, phi), 2)) == QDOT_ONE)
        result = up_to_end_of_root(pool, f, m);
    if (of_pi && result == QDOT_NIL) {
        if (f == QDOT_ELLIPTIC_E && m == QDOT_ONE)
            result = area_of_cosine(pool, turns);
        fmpq_mul(turns, turns, (fmpq[]){{2, 1}});
        if (result == QDOT_NIL && fmpz_is_one(fmpq_denref(turns)))
            result = qdot_mul(pool, qdot_expr_fmpq(pool, turns),
                              n != QDOT_NIL ? elliptic(pool, f, n, m, QDOT_NIL)
                                            : elliptic(pool, f == QDOT_ELLIPTIC_F ? QDOT_ELLIPTIC_K : f, m, QDOT_NIL,
                                                       QDOT_NIL));
    }
    fmpq_clear(turns);
    return result;
}

qdot_expr
qdot_elliptic_simplify(qdot_pool *pool, qdot_fun_id f, uint32_t n, const qdot_expr *args)
{
    if (f == QDOT_ELLIPTIC_PI)
        return n == 2 ? simplify_complete(pool, f, args[0], args[1])
                      : simplify_incomplete(pool, f, args[0], args[1], args[2]);
    return n == 1 ? simplify_complete(pool, f, QDOT_NIL, args[0])
                  : simplify_incomplete(pool, f, QDOT_NIL, args[0], args[1]);
}

/* --- derivatives -------------------------------------------------------------------------------- */

/* 1 - c sin(phi)^2; without phi 1 - c. */
static qdot_expr
one_less(qdot_pool *pool, qdot_expr c, qdot_expr phi)
{
    const qdot_expr square = phi == QDOT_NIL ? QDOT_ONE : qdot_pow_int(pool, qdot_fun1(pool, QDOT_SIN, phi), 2);

    return qdot_sub(pool, QDOT_ONE, qdot_mul(pool, c, square));
}

/* sin(phi) cos(phi); without phi 0. */
static qdot_expr
sine_cosine(qdot_pool *pool, qdot_expr phi)
{
    return phi == QDOT_NIL ? QDOT_ZERO
                           : qdot_mul(pool, qdot_fun1(pool, QDOT_SIN, phi), qdot_fun1(pool, QDOT_COS, phi));
}

/* F(phi, m), without phi K(m). */
static qdot_expr
first_kind(qdot_pool *pool, qdot_expr phi, qdot_expr m)
{
    return phi == QDOT_NIL ? elliptic(pool, QDOT_ELLIPTIC_K, m, QDOT_NIL, QDOT_NIL)
                           : elliptic(pool, QDOT_ELLIPTIC_F, phi, m, QDOT_NIL);
}

/* E(phi, m), without phi E(m). */
static qdot_expr
second_kind(qdot_pool *pool, qdot_expr phi, qdot_expr m)
{
    return phi == QDOT_NIL ? elliptic(pool, QDOT_ELLIPTIC_E, m, QDOT_NIL, QDOT_NIL)
                           : elliptic(pool, QDOT_ELLIPTIC_E, phi, m, QDOT_NIL);
}

/* dF/dm = E/(2 m (1 - m)) - F/(2 m) - sin cos/(2 (1 - m) D), dE/dm = (E - F)/(2 m). */
static qdot_expr
derivative_by_parameter(qdot_pool *pool, qdot_fun_id f, qdot_expr phi, qdot_expr m)
{
    const qdot_expr first = first_kind(pool, phi, m), second = second_kind(pool, phi, m);
    const qdot_expr twice = qdot_mul(pool, qdot_expr_int(pool, 2), m), rest = one_less(pool, m, QDOT_NIL);

    if (f == QDOT_ELLIPTIC_E)
        return qdot_div(pool, qdot_sub(pool, second, first), twice);
    return qdot_sum(pool, 3,
                    (qdot_expr[]){qdot_div(pool, second, qdot_mul(pool, twice, rest)),
                                  qdot_neg(pool, qdot_div(pool, first, twice)),
                                  qdot_neg(pool, qdot_div(pool, qdot_mul(pool, QDOT_HALF, sine_cosine(pool, phi)),
                                                          qdot_mul(pool, rest, qdot_sqrt(pool, one_less(pool, m, phi)))))});
}

/* With s = sin cos, D as above and N = 1 - n sin^2:
 *
 *     dPi/dm = (E/(m - 1) + Pi - m s/((m - 1) D))/(2 (n - m)),
 *     dPi/dn = (E + (m - n) F/n + (n^2 - m) Pi/n - n s D/N)/(2 (m - n) (n - 1)) */
static qdot_expr
derivative_of_third_kind(qdot_pool *pool, qdot_expr n, qdot_expr phi, qdot_expr m, bool by_m)
{
    const bool whole = phi == QDOT_NIL;
    const qdot_expr third = whole ? elliptic(pool, QDOT_ELLIPTIC_PI, n, m, QDOT_NIL)
                                  : elliptic(pool, QDOT_ELLIPTIC_PI, n, phi, m);
    const qdot_expr first = first_kind(pool, phi, m), second = second_kind(pool, phi, m);
    const qdot_expr D = qdot_sqrt(pool, one_less(pool, m, phi)), s = sine_cosine(pool, phi);
    const qdot_expr m1 = qdot_sub(pool, m, QDOT_ONE), apart = qdot_sub(pool, m, n);
    qdot_expr sum;

    if (by_m) {
        sum = qdot_sum(pool, 3,
                       (qdot_expr[]){qdot_div(pool, second, m1), third,
                                     qdot_neg(pool, qdot_div(pool, qdot_mul(pool, m, s), qdot_mul(pool, m1, D)))});
        return qdot_div(pool, sum, qdot_mul(pool, qdot_expr_int(pool, -2), apart));
    }
    sum = qdot_sum(pool, 4,
                   (qdot_expr[]){second, qdot_div(pool, qdot_mul(pool, apart, first), n),
                                 qdot_div(pool, qdot_mul(pool, qdot_sub(pool, qdot_pow_int(pool, n, 2), m), third), n),
                                 whole ? QDOT_ZERO
                                       : qdot_neg(pool, qdot_div(pool, qdot_product(pool, 3, (qdot_expr[]){n, s, D}),
                                                                 one_less(pool, n, phi)))});
    return qdot_div(pool, sum,
                    qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2), apart, qdot_sub(pool, n, QDOT_ONE)}));
}

qdot_expr
qdot_elliptic_derivative(qdot_pool *pool, qdot_fun_id f, uint32_t n, const qdot_expr *args, uint32_t i)
{
    const bool third = f == QDOT_ELLIPTIC_PI, whole = n == (third ? 2 : 1);
    const qdot_expr m = args[n - 1], phi = whole ? QDOT_NIL : args[n - 2], c = third ? args[0] : QDOT_NIL;

    if (!whole && i == n - 2) {
        const qdot_expr D = qdot_sqrt(pool, one_less(pool, m, phi));

        if (third)
            return qdot_div(pool, QDOT_ONE, qdot_mul(pool, one_less(pool, c, phi), D));
        return f == QDOT_ELLIPTIC_E ? D : qdot_div(pool, QDOT_ONE, D);
    }
    return third ? derivative_of_third_kind(pool, c, phi, m, i == n - 1) : derivative_by_parameter(pool, f, phi, m);
}

/* --- values in double, by Carlson's integrals --------------------------------------------------------- */

/* R_F(x, y, z) by duplication: each step brings the arguments four times closer to each other without changing R_F; when
 * they nearly agree, R_F is a power series in their differences. */
static double
carlson_first(double x, double y, double z)
{
    double a = (x + y + z) / 3, X, Y, Z, e2, e3;

    for (int k = 0; k < 60; k++) {
        const double l = sqrt(x) * sqrt(y) + sqrt(x) * sqrt(z) + sqrt(y) * sqrt(z);

        if (fmax(fmax(fabs(a - x), fabs(a - y)), fabs(a - z)) < 2e-3 * fabs(a))
            break;
        x = (x + l) / 4, y = (y + l) / 4, z = (z + l) / 4, a = (a + l) / 4;
    }
    X = 1 - x / a, Y = 1 - y / a, Z = -X - Y;
    e2 = X * Y - Z * Z, e3 = X * Y * Z;
    return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44 - 5 * e2 * e2 * e2 / 208 + 3 * e3 * e3 / 104) / sqrt(a);
}

/* R_C(1, 1 + e). */
static double
carlson_circular(double e)
{
    if (fabs(e) < 1e-4)
        return 1 - e / 3 + e * e / 5 - e * e * e / 7;
    return e > 0 ? atan(sqrt(e)) / sqrt(e) : atanh(sqrt(-e)) / sqrt(-e);
}

/* R_J(x, y, z, p), p > 0, the same way; R_D(x, y, z) = R_J(x, y, z, z). */
static double
carlson_third(double x, double y, double z, double p)
{
    double a = (x + y + z + 2 * p) / 5, sum = 0, power = 1, X, Y, Z, P, e2, e3, e4, e5;

    for (int k = 0; k < 60; k++) {
        const double rx = sqrt(x), ry = sqrt(y), rz = sqrt(z), rp = sqrt(p);
        const double l = rx * ry + rx * rz + ry * rz, d = (rp + rx) * (rp + ry) * (rp + rz);
        const double e = (p - x) / d * (p - y) / d * (p - z);

        if (fmax(fmax(fabs(a - x), fabs(a - y)), fmax(fabs(a - z), fabs(a - p))) < 1e-3 * fabs(a))
            break;
        sum += 6 * power / d * carlson_circular(e);
        power /= 4;
        x = (x + l) / 4, y = (y + l) / 4, z = (z + l) / 4, p = (p + l) / 4, a = (a + l) / 4;
    }
    X = 1 - x / a, Y = 1 - y / a, Z = 1 - z / a, P = (-X - Y - Z) / 2;
    e2 = X * Y + X * Z + Y * Z - 3 * P * P;
    e3 = X * Y * Z + 2 * e2 * P + 4 * P * P * P;
    e4 = (2 * X * Y * Z + e2 * P + 3 * P * P * P) * P;
    e5 = X * Y * Z * P * P;
    return power * (1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26) / (a * sqrt(a))
           + sum;
}

/* The integral of kind f from 0 to the angle with sine s and cosine c >= 0. */
static double
incomplete_double(unsigned f, double n, double s, double c, double m)
{
    const double q = 1 - m * s * s, p = 1 - n * s * s;
    double first;

    if (!(q >= 0) || (q == 0 && f != QDOT_ELLIPTIC_E) || !(p > 0))
        return NAN;
    if (q == 0 && c == 0)
        return s;
    first = s * carlson_first(c * c, q, 1);
    if (f == QDOT_ELLIPTIC_E)
        return first - m / 3 * s * s * s * carlson_third(c * c, q, 1, 1);
    return f == QDOT_ELLIPTIC_PI && n != 0 ? first + n / 3 * s * s * s * carlson_third(c * c, q, 1, p) : first;
}

qdot_expr
qdot_elliptic_coefficient(qdot_pool *pool, qdot_fun_id f, int64_t k)
{
    qdot_expr c = QDOT_ONE;

    if (f != QDOT_ELLIPTIC_K && f != QDOT_ELLIPTIC_E)
        return QDOT_NIL;
    for (int64_t i = 1; i <= k; i++)
        c = qdot_mul(pool, c, qdot_div(pool, qdot_expr_int(pool, 2 * i - 1), qdot_expr_int(pool, 2 * i)));
    c = qdot_mul(pool, qdot_div(pool, QDOT_PI, qdot_expr_int(pool, 2)), qdot_mul(pool, c, c));
    return f == QDOT_ELLIPTIC_K ? c : qdot_div(pool, c, qdot_expr_int(pool, 1 - 2 * k));
}

double
qdot_elliptic_double(unsigned f, uint32_t n, const double *x)
{
    const bool third = f == QDOT_ELLIPTIC_PI, whole = n == (third ? 2u : 1u);
    const double m = x[n - 1], c = third ? x[0] : 0, phi = whole ? M_PI_2 : x[n - 2];
    const double turns = whole ? 0 : nearbyint(phi / M_PI), rest = phi - turns * M_PI;
    const double part = whole ? incomplete_double(f, c, 1, 0, m) : incomplete_double(f, c, sin(rest), cos(rest), m);

    return turns == 0 ? part : part + 2 * turns * incomplete_double(f, c, 1, 0, m);
}
