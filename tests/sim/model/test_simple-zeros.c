/* test_simple-zeros.c -- exponents go down to 1 and 2, and what only touches 0 is told apart. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "sim/scenes.h"

#include "sim/model/simple-zeros.h"

typedef struct {
    fixture f;
    qdot_expr a, b, minus;
} factors;

static void
begin_factors(factors *s)
{
    *s = (factors){0};
    begin(&s->f);
    s->a = coordinate(&s->f, "a");
    s->b = qdot_sub(s->f.pool, coordinate(&s->f, "b"), QDOT_ONE);
    s->minus = qdot_expr_int(s->f.pool, -3);
}

/* -3 a^n b^m */
static qdot_expr
product(factors *s, int64_t n, int64_t m)
{
    return qdot_mul(s->f.pool, s->minus,
                    qdot_mul(s->f.pool, qdot_pow_int(s->f.pool, s->a, n), qdot_pow_int(s->f.pool, s->b, m)));
}

static void
exponents_are_the_least_of_their_sign(void **state)
{
    factors s;
    qdot_pool *pool;
    qdot_expr g;

    (void)state;
    begin_factors(&s);
    pool = s.f.pool;
    assert_int_equal(qdot_simple_zeros(pool, qdot_pow_int(pool, s.b, 10001)), s.b);
    assert_int_equal(qdot_simple_zeros(pool, product(&s, 4, 3)), product(&s, 2, 1));
    assert_int_equal(qdot_simple_zeros(pool, product(&s, -4, 6)), product(&s, -2, 2));
    assert_int_equal(qdot_simple_zeros(pool, product(&s, -10001, 1)), product(&s, -1, 1));
    assert_int_equal(qdot_simple_zeros(pool, qdot_mul(pool, number(&s.f, "-1e-320"), s.a)), qdot_neg(pool, s.a));
    assert_int_equal(qdot_simple_zeros(pool, product(&s, 1, 2)), product(&s, 1, 2));
    /* (a^3)^(1/2) is not there for a < 0 */
    assert_int_equal(qdot_simple_zeros(pool, qdot_pow(pool, qdot_pow_int(pool, s.a, 3), QDOT_HALF)),
                     qdot_pow(pool, qdot_pow_int(pool, s.a, 3), QDOT_HALF));
    /* of a sum no term is */
    assert_int_equal(qdot_simple_zeros(pool, qdot_add(pool, QDOT_ONE, qdot_pow_int(pool, s.a, 4))),
                     qdot_add(pool, QDOT_ONE, qdot_pow_int(pool, s.a, 4)));
    /* a double holds its coefficients to four digits */
    g = qdot_simple_zeros(pool, qdot_sub(pool, qdot_mul(pool, number(&s.f, "1e-320"), s.a), number(&s.f, "2e-320")));
    assert_int_equal(qdot_div(pool, qdot_expr_arg(pool, g, 0), qdot_expr_arg(pool, g, 2)), qdot_expr_int(pool, -2));
    assert_true(qdot_pool_check(pool) == QDOT_OK);
    end(&s.f);
}

static void
even_products_touch(void **state)
{
    factors s;
    qdot_pool *pool;
    qdot_expr modulus;

    (void)state;
    begin_factors(&s);
    pool = s.f.pool;
    modulus = qdot_fun1(pool, QDOT_ABS, s.a);
    assert_int_equal(qdot_touching_zeros(pool, modulus), s.a);
    assert_int_equal(qdot_touching_zeros(pool, product(&s, 10000, 2)), qdot_mul(pool, s.a, s.b));
    assert_int_equal(qdot_touching_zeros(pool, qdot_mul(pool, modulus, qdot_pow_int(pool, s.b, 2))),
                     qdot_mul(pool, s.a, s.b));
    assert_int_equal(qdot_touching_zeros(pool, s.a), QDOT_NIL);
    assert_int_equal(qdot_touching_zeros(pool, product(&s, 3, 2)), QDOT_NIL);
    assert_int_equal(qdot_touching_zeros(pool, product(&s, -2, 2)), QDOT_NIL);
    assert_int_equal(qdot_touching_zeros(pool, qdot_mul(pool, modulus, s.b)), QDOT_NIL);
    end(&s.f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exponents_are_the_least_of_their_sign),
        cmocka_unit_test(even_products_touch),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
