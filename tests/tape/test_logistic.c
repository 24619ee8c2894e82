/* test_logistic.c -- quotients of exponentials: the same values as they are written, and finite where
 * their parts are not. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "tape/logistic.h"
#include "tape/tape.h"

typedef struct {
    qdot_pool *pool;
    qdot_expr x;
} fixture;

static qdot_expr
fun(fixture *f, qdot_fun_id id, qdot_expr u)
{
    return qdot_fun1(f->pool, id, u);
}

static qdot_expr
power(fixture *f, qdot_expr b, int64_t n)
{
    return qdot_pow_int(f->pool, b, n);
}

/* c + e^(k x) */
static qdot_expr
shifted(fixture *f, int64_t c, int64_t k)
{
    qdot_expr e = fun(f, QDOT_EXP, qdot_mul(f->pool, qdot_expr_int(f->pool, k), f->x));

    return qdot_add(f->pool, qdot_expr_int(f->pool, c), e);
}

/* c + d cosh(x) + sinh(x)/2 */
static qdot_expr
cosine(fixture *f, int64_t c, int64_t d)
{
    qdot_expr e = qdot_mul(f->pool, qdot_expr_int(f->pool, d), fun(f, QDOT_COSH, f->x));

    e = qdot_add(f->pool, e, qdot_mul(f->pool, QDOT_HALF, fun(f, QDOT_SINH, f->x)));
    return qdot_add(f->pool, e, qdot_expr_int(f->pool, c));
}

enum { CASES = 20 };

/* Case k as an expression, its value in long double, and its limits far left and right. */
static qdot_expr
written(fixture *f, int k)
{
    qdot_pool *pool = f->pool;
    const qdot_expr x = f->x, c = fun(f, QDOT_COSH, x), s = fun(f, QDOT_SINH, x);
    const qdot_expr e = fun(f, QDOT_EXP, x);
    const qdot_expr root = qdot_expr_ratio(pool, -3, 2);

    switch (k) {
    case 0: return power(f, c, -2);
    case 1: return power(f, shifted(f, 1, 1), -1);
    case 2: return qdot_div(pool, e, shifted(f, 3, 1));
    case 3: return qdot_div(pool, e, power(f, shifted(f, 1, 1), 2));
    case 4: return qdot_div(pool, s, power(f, c, 3));
    case 5: return power(f, s, -2);
    case 6: return qdot_div(pool, qdot_sub(pool, e, QDOT_ONE), qdot_add(pool, e, QDOT_ONE));
    case 7: return power(f, qdot_add(pool, e, fun(f, QDOT_EXP, qdot_neg(pool, x))), -1);
    case 8: return qdot_pow(pool, shifted(f, 2, 2), root);
    case 9: return power(f, qdot_mul(pool, shifted(f, 1, -1), shifted(f, 1, 3)), -1);
    case 10: return qdot_div(pool, s, power(f, cosine(f, 2, 3), 2));
    case 11: return fun(f, QDOT_LOG, c);
    case 12: return fun(f, QDOT_LOG, shifted(f, 1, 1));
    case 13: return fun(f, QDOT_LOG, shifted(f, 2, 1));
    case 14: return qdot_div(pool, c, qdot_add(pool, QDOT_ONE, power(f, c, 2)));
    case 15: return qdot_div(pool, qdot_sub(pool, QDOT_ONE, e), qdot_add(pool, e, shifted(f, 1, 2)));
    case 16: return qdot_div(pool, e, power(f, shifted(f, -1, 1), 2));
    case 17: return fun(f, QDOT_LOG, qdot_add(pool, QDOT_ONE, power(f, c, 2)));
    case 18: return qdot_div(pool, s, qdot_add(pool, QDOT_ONE, power(f, s, 2)));
    default: return fun(f, QDOT_LOG, qdot_add(pool, e, shifted(f, 3, 2)));
    }
}

static long double
value(int k, long double x)
{
    const long double c = coshl(x), s = sinhl(x), e = expl(x), w = 2 + 3 * c + s / 2;

    switch (k) {
    case 0: return 1 / (c * c);
    case 1: return 1 / (1 + e);
    case 2: return e / (3 + e);
    case 3: return e / ((1 + e) * (1 + e));
    case 4: return s / (c * c * c);
    case 5: return 1 / (s * s);
    case 6: return (e - 1) / (e + 1);
    case 7: return 1 / (e + 1 / e);
    case 8: return powl(2 + e * e, -1.5L);
    case 9: return 1 / ((1 + 1 / e) * (1 + e * e * e));
    case 10: return s / (w * w);
    case 11: return logl(c);
    case 12: return log1pl(e);
    case 13: return logl(2 + e);
    case 14: return c / (1 + c * c);
    case 15: return (1 - e) / (1 + e + e * e);
    case 16: return e / ((e - 1) * (e - 1));
    case 17: return logl(1 + c * c);
    case 18: return s / (1 + s * s);
    default: return logl(3 + e + e * e);
    }
}

static void
begin(fixture *f)
{
    f->pool = qdot_pool_new();
    assert_non_null(f->pool);
    f->x = qdot_symbol_get(f->pool, QDOT_COORD, "x");
}

static double
at(fixture *f, qdot_expr e, double x)
{
    qdot_tape *tape;
    double out, *work;

    assert_int_equal(qdot_tape_new(f->pool, 1, &f->x, 1, &e, &tape), QDOT_OK);
    work = malloc((qdot_tape_work(tape) + 1) * sizeof *work);
    qdot_tape_eval(tape, &x, &out, work);
    free(work);
    qdot_tape_free(tape);
    return out;
}

/* To the relative precision of what is seen, however small: the argument of e^ is one of |x|. */
static void
values_are_as_written(void **state)
{
    static const double places[] = {-90, -31.7, -3.2, -0.4, 0.0625, 1.7, 12.3, 44, 101};
    fixture f;

    (void)state;
    begin(&f);
    for (int k = 0; k < CASES; k++)
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            const double x = places[i], got = at(&f, written(&f, k), x);
            const double want = (double)value(k, x);

            if (!(fabs(got - want) <= 1e-15 * (4 + 4 * fabs(x)) * fabs(want) + (k == 11 ? 4e-16 : 0)))
                fail_msg("case %d at %g: %.17g, not %.17g", k, x, got, want);
        }
    qdot_pool_free(f.pool);
}

static void
far_sides_are_finite(void **state)
{
    static const double limits[CASES][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 0}, {0, 0}, {-1, 1},
                                            {0, 0}, {0.35355339059327376, 0}, {0, 0}, {0, 0},
                                            {4999.3068528194400547, 4999.3068528194400547},
                                            {0, 5000}, {0.69314718055994531, 5000}, {0, 0},
                                            {1, 0}, {0, 0}, {9998.6137056388801, 9998.6137056388801},
                                            {0, 0}, {1.0986122886681098, 10000}};
    fixture f;

    (void)state;
    begin(&f);
    for (int k = 0; k < CASES; k++)
        for (int side = 0; side < 2; side++) {
            const double x = side ? 5000 : -5000, got = at(&f, written(&f, k), x);

            if (!(fabs(got - limits[k][side]) <= 1e-15 * fabs(limits[k][side])))
                fail_msg("case %d at %g: %.17g, not %.17g", k, x, got, limits[k][side]);
            if (!isfinite(at(&f, qdot_diff(f.pool, written(&f, k), f.x), x)))
                fail_msg("the slope of case %d at %g is not finite", k, x);
        }
    qdot_pool_free(f.pool);
}

/* What grows, and what has a pole, stays what it is. */
static void
others_are_left_alone(void **state)
{
    fixture f;
    qdot_expr e[2];

    (void)state;
    begin(&f);
    e[0] = fun(&f, QDOT_COSH, f.x);
    e[1] = qdot_div(f.pool, fun(&f, QDOT_COSH, f.x), fun(&f, QDOT_SINH, f.x));
    assert_int_equal(qdot_logistic_form(f.pool, e[0]), e[0]);
    assert_true(fabs(at(&f, e[1], 900) - 1) < 1e-15);
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_as_written),
        cmocka_unit_test(far_sides_are_finite),
        cmocka_unit_test(others_are_left_alone),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
