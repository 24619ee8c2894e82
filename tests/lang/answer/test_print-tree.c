/* test_print-tree.c -- expressions as JSON arrays in prefix form. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

#include "base/memory.h"
#include "expr/expr.h"
#include "expr/calculus.h"
#include "expr/integral.h"
#include "lang/answer/print-tree.h"
#include "expr/unit.h"

static void
is_written(qdot_pool *pool, qdot_expr e, const char *wanted)
{
    qdot_text text = {0};

    assert_int_equal(qdot_print_tree(pool, e, &text), QDOT_OK);
    assert_string_equal(qdot_text_str(&text), wanted);
    qdot_text_clear(&text);
}

static qdot_expr
symbol(qdot_pool *pool, qdot_class class, const char *name)
{
    return qdot_symbol_get(pool, class, name);
}

static void
numbers_and_symbols(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr q = symbol(pool, QDOT_COORD, "theta[1]");
    const qdot_expr large = qdot_pow_int(pool, qdot_expr_int(pool, 10), 30);

    (void)state;
    is_written(pool, QDOT_ZERO, "\"0\"");
    is_written(pool, qdot_expr_int(pool, -7), "\"-7\"");
    is_written(pool, qdot_expr_ratio(pool, -981, 100), "[\"/\",\"-981\",\"100\"]");
    is_written(pool, large, "\"1000000000000000000000000000000\"");
    is_written(pool, qdot_div(pool, QDOT_ONE, large), "[\"/\",\"1\",\"1000000000000000000000000000000\"]");
    is_written(pool, QDOT_PI, "\"pi\"");
    is_written(pool, QDOT_T, "\"t\"");
    is_written(pool, q, "\"theta[1]\"");
    is_written(pool, qdot_symbol_jet(pool, q, 2), "[\"'\",\"theta[1]\",2]");
    is_written(pool, qdot_symbol_of(pool, QDOT_MOMENTUM, q), "[\"p\",\"theta[1]\"]");
    is_written(pool, qdot_symbol_jet(pool, qdot_symbol_of(pool, QDOT_MOMENTUM, q), 1), "[\"'\",[\"p\",\"theta[1]\"],1]");
    is_written(pool, qdot_symbol_of(pool, QDOT_DIFFERENTIAL, q), "[\"d\",\"theta[1]\"]");
    is_written(pool, qdot_symbol_of(pool, QDOT_DELTA, q), "[\"delta\",\"theta[1]\"]");
    is_written(pool, qdot_unit_symbol(pool, 1), "[\"unit\",\"kg\"]");
    qdot_pool_free(pool);
}

static void
sums_products_functions(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr a = symbol(pool, QDOT_PARAM, "a"), b = symbol(pool, QDOT_PARAM, "b"), two = qdot_expr_int(pool, 2);
    const qdot_expr less = qdot_rel(pool, QDOT_LT, a, b), entries[] = {a, b, QDOT_ZERO, QDOT_ONE};
    qdot_expr choice[3] = {less, a, b};

    (void)state;
    is_written(pool, qdot_mul(pool, a, b), "[\"*\",\"a\",\"b\"]");
    is_written(pool, qdot_pow(pool, a, qdot_expr_ratio(pool, 1, 2)), "[\"^\",\"a\",[\"/\",\"1\",\"2\"]]");
    is_written(pool, qdot_mul(pool, two, qdot_pow_int(pool, a, -1)), "[\"*\",\"2\",[\"^\",\"a\",\"-1\"]]");
    is_written(pool, qdot_sub(pool, qdot_mul(pool, two, a), qdot_add(pool, b, two)),
               "[\"+\",[\"*\",\"2\",\"a\"],[\"*\",\"-1\",\"b\"],\"-2\"]");
    is_written(pool, qdot_sub(pool, a, qdot_mul(pool, a, b)), "[\"+\",\"a\",[\"*\",\"-1\",\"a\",\"b\"]]");
    is_written(pool, qdot_fun1(pool, QDOT_SIN, a), "[\"sin\",\"a\"]");
    is_written(pool, less, "[\"<\",\"a\",\"b\"]");
    choice[2] = qdot_fun(pool, QDOT_IF, 3, choice);
    choice[0] = qdot_rel(pool, QDOT_LE, b, QDOT_ZERO);
    is_written(pool, qdot_fun(pool, QDOT_IF, 3, choice), "[\"if\",[\"<=\",\"b\",\"0\"],\"a\",[\"<\",\"a\",\"b\"],\"a\",\"b\"]");
    is_written(pool, qdot_matrix(pool, 2, 2, entries), "[\"matrix\",[\"a\",\"b\"],[\"0\",\"1\"]]");
    is_written(pool, qdot_list(pool, 0, NULL), "[\"list\"]");
    is_written(pool, qdot_vector(pool, 2, entries), "[\"vector\",\"a\",\"b\"]");
    qdot_pool_free(pool);
}

static void
undefined_functions(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr a = symbol(pool, QDOT_PARAM, "a"), b = symbol(pool, QDOT_PARAM, "b"), both[] = {a, b};
    const qdot_expr other[] = {qdot_mul(pool, a, b), b};
    const uint32_t orders[] = {2, 1};
    uint32_t f;

    (void)state;
    assert_int_equal(qdot_ufun_declare(pool, "list", 2, both, &f), QDOT_OK);
    is_written(pool, qdot_ufun_apply(pool, f, both, NULL), "[\"apply\",\"list\",\"a\",\"b\"]");
    is_written(pool, qdot_ufun_apply(pool, f, both, orders),
               "[\"diff\",[\"diff\",[\"diff\",[\"apply\",\"list\",\"a\",\"b\"],\"a\"],\"a\"],\"b\"]");
    is_written(pool, qdot_ufun_apply(pool, f, other, orders), "[\"D\",[2,1],\"list\",[\"*\",\"a\",\"b\"],\"b\"]");
    is_written(pool, qdot_delayed(pool, symbol(pool, QDOT_COORD, "x"), a, 1), "[\"'\",[\"apply\",\"x\",\"a\"],1]");
    qdot_pool_free(pool);
}

/* The variable of an integral has a name that means nothing else in it. */
static void
integrals(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr x = symbol(pool, QDOT_FORMAL, "x"), a = symbol(pool, QDOT_PARAM, "a");
    const qdot_expr f = qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, a, x));
    qdot_expr e = qdot_integral(pool, f, x, QDOT_ZERO, a);

    (void)state;
    is_written(pool, e, "[\"integral\",[\"sin\",[\"*\",\"a\",\"x\"]],\"x\",\"0\",\"a\"]");
    e = qdot_subs(pool, e, 1, &a, &x);
    is_written(pool, e, "[\"integral\",[\"sin\",[\"*\",\"x\",\"u1\"]],\"u1\",\"0\",\"x\"]");
    is_written(pool, qdot_integral_unfound(pool, f, x), "[\"integral\",[\"sin\",[\"*\",\"a\",\"x\"]],\"x\"]");
    qdot_pool_free(pool);
}

/* Deep expressions are written without recursion; failing memory is told. */
static void
depth_and_memory(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr a = symbol(pool, QDOT_PARAM, "a");
    qdot_expr e = a;
    qdot_text text = {0};

    (void)state;
    for (int i = 0; i < 100000; i++)
        e = qdot_fun1(pool, QDOT_SIN, qdot_add(pool, e, a));
    assert_int_equal(qdot_print_tree(pool, e, &text), QDOT_OK);
    assert_int_equal(text.n, 100000 * strlen("[\"sin\",[\"+\",\"a\",]]") + strlen("\"a\"") - strlen("[\"+\",\"a\",]") + strlen("[\"*\",\"2\",]"));
    qdot_text_clear(&text);
    for (long n = 0;; n++) {
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_print_tree(pool, qdot_expr_args(pool, qdot_expr_args(pool, e)[0])[1], &text);
        qdot_memory_fail_at(-1);
        qdot_text_clear(&text);
        if (status == QDOT_OK)
            break;
        assert_int_equal(status, QDOT_ENOMEM);
    }
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_and_symbols), cmocka_unit_test(sums_products_functions),
        cmocka_unit_test(undefined_functions), cmocka_unit_test(integrals),
        cmocka_unit_test(depth_and_memory),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
