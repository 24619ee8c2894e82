/* jacobi.c -- Jacobi's elliptic functions: special values, derivatives, values in double. */
#include "expr/jacobi.h"

#include <math.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

static qdot_expr
of_two(qdot_pool *pool, qdot_fun_id f, qdot_expr u, qdot_expr m)
{
    return qdot_fun(pool, f, 2, (qdot_expr[]){u, m});
}

static bool
is_number_above_one(const qdot_pool *pool, qdot_expr m)
{
    return NUMBER(pool, m) != NULL && qdot_rational_cmp(NUMBER(pool, m), &(fmpq){1, 1}) > 0;
}

/* The argument k u of the functions of 1/m, k = sqrt(m). */
static qdot_expr
stretched(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    return qdot_mul(pool, qdot_sqrt(pool, m), u);
}

static qdot_expr
simplify_sn(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    if (is_number_above_one(pool, m))
        return qdot_div(pool, simplify_sn(pool, stretched(pool, u, m), qdot_div(pool, QDOT_ONE, m)), qdot_sqrt(pool, m));
    if (m == QDOT_ONE)
        return qdot_fun1(pool, QDOT_TANH, u);
    return qdot_fun1(pool, QDOT_SIN, of_two(pool, QDOT_JACOBI_AM, u, m));
}

static qdot_expr
simplify_cn(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    if (is_number_above_one(pool, m))
        return of_two(pool, QDOT_JACOBI_DN, stretched(pool, u, m), qdot_div(pool, QDOT_ONE, m));
    if (m == QDOT_ONE)
        return qdot_div(pool, QDOT_ONE, qdot_fun1(pool, QDOT_COSH, u));
    return qdot_fun1(pool, QDOT_COS, of_two(pool, QDOT_JACOBI_AM, u, m));
}

qdot_expr
qdot_jacobi_dn_squared(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    return qdot_sub(pool, QDOT_ONE, qdot_mul(pool, m, qdot_pow_int(pool, simplify_sn(pool, u, m), 2)));
}

/* --- special values --------------------------------------------------------------------------- */

/* r pi/2 if u is r K(m) with a whole number r; otherwise nil. */
static qdot_expr
amplitude_of_quarters(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    const qdot_expr r = qdot_div(pool, u, qdot_fun1(pool, QDOT_ELLIPTIC_K, m));
    int64_t whole;

    return r != QDOT_NIL && qdot_expr_to_int(pool, r, &whole) ? qdot_mul(pool, r, qdot_mul(pool, QDOT_HALF, QDOT_PI))
                                                              : QDOT_NIL;
}

static qdot_expr
simplify_amplitude(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    if (is_number_above_one(pool, m))
        return qdot_pool_refuse(pool, QDOT_EDOMAIN, "jacobi_am(u, m) is taken for m <= 1");
    if (u == QDOT_ZERO || m == QDOT_ZERO)
        return u;
    if (m == QDOT_ONE)
        return qdot_fun1(pool, QDOT_ATAN, qdot_fun1(pool, QDOT_SINH, u));
    if (qdot_expr_is_negative(pool, u))
        return qdot_neg(pool, of_two(pool, QDOT_JACOBI_AM, qdot_neg(pool, u), m));
    if (NODE(pool, u)->kind == QDOT_FUN && NODE(pool, u)->op == QDOT_ELLIPTIC_F && ARGS(pool, u)[1] == m)
        return ARGS(pool, u)[0];
    return amplitude_of_quarters(pool, u, m);
}

static qdot_expr
simplify_dn(qdot_pool *pool, qdot_expr u, qdot_expr m)
{
    if (is_number_above_one(pool, m))
        return simplify_cn(pool, stretched(pool, u, m), qdot_div(pool, QDOT_ONE, m));
    if (u == QDOT_ZERO || m == QDOT_ZERO)
        return QDOT_ONE;
    if (m == QDOT_ONE)
        return qdot_div(pool, QDOT_ONE, qdot_fun1(pool, QDOT_COSH, u));
    if (qdot_expr_is_negative(pool, u))
        return of_two(pool, QDOT_JACOBI_DN, qdot_neg(pool, u), m);
    return amplitude_of_quarters(pool, u, m) == QDOT_NIL ? QDOT_NIL : qdot_sqrt(pool, qdot_jacobi_dn_squared(pool, u, m));
}

qdot_expr
qdot_jacobi_simplify(qdot_pool *pool, qdot_fun_id f, const qdot_expr *args)
{
    switch ((int)f) {
    case QDOT_JACOBI_AM: return simplify_amplitude(pool, args[0], args[1]);
    case QDOT_JACOBI_SN: return simplify_sn(pool, args[0], args[1]);
    case QDOT_JACOBI_CN: return simplify_cn(pool, args[0], args[1]);
    default: return simplify_dn(pool, args[0], args[1]);
    }
}

/* --- derivatives -------------------------------------------------------------------------------- */

static qdot_expr
amplitude_by_parameter(qdot_pool *pool, qdot_expr u, qdot_expr m, qdot_expr dn, qdot_expr sncn)
{
    const qdot_expr rest = qdot_sub(pool, QDOT_ONE, m), E = of_two(pool, QDOT_ELLIPTIC_E, of_two(pool, QDOT_JACOBI_AM, u, m), m);
    const qdot_expr over = qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2), m, rest});

    return qdot_div(pool, qdot_add(pool, qdot_mul(pool, qdot_sub(pool, qdot_mul(pool, rest, u), E), dn),
                                   qdot_mul(pool, m, sncn)),
                    over);
}

qdot_expr
qdot_jacobi_derivative(qdot_pool *pool, qdot_fun_id f, const qdot_expr *args, uint32_t i)
{
    const qdot_expr u = args[0], m = args[1], sn = simplify_sn(pool, u, m), cn = simplify_cn(pool, u, m);
    const qdot_expr dn = of_two(pool, QDOT_JACOBI_DN, u, m), sncn = qdot_mul(pool, sn, cn);
    qdot_expr slope;

    if (i == 0)
        return f == QDOT_JACOBI_AM ? dn : qdot_neg(pool, qdot_mul(pool, m, sncn));
    slope = amplitude_by_parameter(pool, u, m, dn, sncn);
    if (f == QDOT_JACOBI_AM)
        return slope;
    slope = qdot_add(pool, qdot_mul(pool, QDOT_HALF, qdot_pow_int(pool, sn, 2)),
                     qdot_product(pool, 3, (qdot_expr[]){m, sncn, slope}));
    return qdot_neg(pool, qdot_div(pool, slope, dn));
}

/* --- values in double --------------------------------------------------------------------------- */

/* am(u, m) by arithmetic and geometric means, as on tapes (tape/elliptic.h). */
static double
amplitude_double(double u, double m)
{
    enum { STEPS = 9 };
    double a[STEPS + 1], b[STEPS + 1], c[STEPS + 1], phi;

    if (m == 1)
        return atan(sinh(u));
    a[0] = 1, b[0] = sqrt(1 - m), c[0] = 0;
    for (int n = 0; n < STEPS; n++)
        a[n + 1] = (a[n] + b[n]) / 2, b[n + 1] = sqrt(a[n] * b[n]), c[n + 1] = (a[n] - b[n]) / 2;
    phi = ldexp(a[STEPS] * u, STEPS);
    for (int n = STEPS; n > 0; n--)
        phi = (phi + atan(c[n] * sin(phi) / hypot(a[n] * cos(phi), b[n] * sin(phi)))) / 2;
    return phi;
}

double
qdot_jacobi_double(unsigned f, const double *x)
{
    const double phi = amplitude_double(x[0], x[1]);

    switch (f) {
    case QDOT_JACOBI_AM: return phi;
    case QDOT_JACOBI_SN: return sin(phi);
    case QDOT_JACOBI_CN: return cos(phi);
    default: return hypot(cos(phi), sqrt(1 - x[1]) * sin(phi));
    }
}
