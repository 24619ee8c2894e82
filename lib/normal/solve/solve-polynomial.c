/* solve-polynomial.c -- the zeros of a polynomial in y that is linear or quadratic in a power of y. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/solve/solve-factors.h"
#include "normal/solve/solver.h"

/* Add the real y for which y^k = v: v^(1/k), and its negative if k is even. */
static qdot_status
add_kth_roots(qdot_solver *s, qdot_expr v, int64_t k, qdot_expr when, qdot_arguments *out)
{
    qdot_pool *pool = s->pool;
    qdot_expr y, exponent = qdot_expr_ratio(pool, 1, k);
    uint8_t sign;

    QDOT_TRY(qdot_pool_check(pool));
    if (v == QDOT_ZERO || k == 1)
        return qdot_vec_push(out, ((qdot_argument){v, when}));
    if (k % 2 == 0) {
        when = qdot_conditions_and(pool, when, qdot_solver_positive(s, v));
        if (when == QDOT_FALSE)
            return QDOT_OK;
    }
    sign = qdot_expr_node(pool, v)->sign;
    if (k % 2 == 0 || (sign & QDOT_GE0) != 0)
        y = qdot_pow(pool, v, exponent);
    else if ((sign & QDOT_LE0) != 0)
        y = qdot_neg(pool, qdot_pow(pool, qdot_neg(pool, v), exponent));
    else
        y = qdot_mul(pool, qdot_fun1(pool, QDOT_SIGN, v),
                     qdot_pow(pool, qdot_fun1(pool, QDOT_ABS, v), exponent));
    QDOT_TRY(qdot_pool_check(pool));
    if (k % 2 == 0)
        QDOT_TRY(qdot_vec_push(out, ((qdot_argument){qdot_neg(pool, y), when})));
    return qdot_vec_push(out, ((qdot_argument){y, when}));
}

/* The largest k for which the polynomial sum c_i y^i, c [degree + 1], is one in y^k; 0 for a constant. */
static int64_t
largest_inner_power(const qdot_expr *c, int64_t degree)
{
    int64_t step = 0;

    for (int64_t k = 1; k <= degree; k++)
        for (int64_t rest = k; c[k] != QDOT_ZERO && rest > 0;) {
            int64_t swap = step % rest;

            if (step == 0) {
                step = rest;
                break;
            }
            step = rest;
            rest = swap;
        }
    return step;
}

/* The zeros of each factor of the polynomial, among roots of parameters too, which keep the field from factoring:
 * y^3 - 3 sqrt(c) y^2 + 3 c y - c sqrt(c) is (y - sqrt(c))^3. A factor of the full degree cannot be solved. */
static qdot_status
add_zeros_of_factors(qdot_solver *s, const qdot_expr *c, int64_t degree, qdot_expr when, qdot_arguments *out)
{
    qdot_pool *pool = s->pool;
    qdot_expr y = qdot_symbol_get(pool, QDOT_FORMAL, "(y)"), sum = QDOT_ZERO, list,
              *parts = qdot_calloc((size_t)degree + 1, sizeof *parts);
    qdot_status status = parts == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (int64_t k = 0; k <= degree; k++)
        sum = qdot_add(pool, sum, qdot_mul(pool, c[k], qdot_pow_int(pool, y, k)));
    list = qdot_solve_factors(pool, sum);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    for (uint32_t i = 0; status == QDOT_OK && i < qdot_expr_count(pool, list); i++) {
        const qdot_expr one = qdot_expr_arg(pool, list, i);
        int64_t n = 0;

        for (int64_t k = 0; k <= degree; k++) {
            parts[k] = qdot_coefficient(pool, one, y, k);
            n = parts[k] == QDOT_ZERO ? n : k;
        }
        status = qdot_pool_check(pool);
        if (status != QDOT_OK)
            break;
        if (n == degree)
            s->out->complete = false;
        else
            status = n == 0 ? qdot_solver_divide(s, one) : qdot_solver_polynomial(s, parts, n, when, out);
    }
    qdot_free(parts);
    return status;
}

qdot_status
qdot_solver_polynomial(qdot_solver *s, const qdot_expr *c, int64_t degree, qdot_expr when, qdot_arguments *out)
{
    qdot_pool *pool = s->pool;
    int64_t step = largest_inner_power(c, degree);
    qdot_expr a, b, discriminant, root, two_a;

    if (step == 0)
        return QDOT_OK;
    if (degree / step > 2)
        return add_zeros_of_factors(s, c, degree, when, out);
    a = c[degree];
    QDOT_TRY(qdot_solver_divide(s, a));
    if (degree == step)
        return add_kth_roots(s, qdot_solver_tidy(s, qdot_neg(pool, qdot_div(pool, c[0], a))), step,
                       when, out);
    b = c[step];
    discriminant = qdot_solver_tidy(
        s,
        qdot_sub(pool, qdot_mul(pool, b, b),
                 qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 4), a, c[0]})));
    QDOT_TRY(qdot_pool_check(pool));
    if (discriminant != QDOT_ZERO)
        when = qdot_conditions_and(pool, when, qdot_solver_positive(s, discriminant));
    if (when == QDOT_FALSE)
        return QDOT_OK;
    root = qdot_sqrt(pool, discriminant);
    two_a = qdot_mul(pool, qdot_expr_int(pool, 2), a);
    for (int sign = -1; sign <= 1; sign += 2) {
        qdot_expr y = sign < 0 ? qdot_add(pool, b, root) : qdot_sub(pool, b, root);

        y = qdot_solver_tidy(s, qdot_neg(pool, qdot_div(pool, y, two_a)));
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(add_kth_roots(s, y, step, when, out));
        if (discriminant == QDOT_ZERO)
            break;
    }
    return QDOT_OK;
}

