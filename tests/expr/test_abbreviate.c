/* test_abbreviate.c -- names for repeated parts: put back, they give the expression. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "expr/abbreviate.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/symbol.h"

static bool
is_d2(const char *name, void *user)
{
    (void)user;
    return strcmp(name, "D2") == 0;
}

/* 1/(1 + sin(a + b)^2), k times in different sums. */
static qdot_expr
repeated(qdot_pool *pool, unsigned k)
{
    qdot_expr a = qdot_symbol_get(pool, QDOT_PARAM, "a"),
              b = qdot_symbol_get(pool, QDOT_PARAM, "b");
    qdot_expr s = qdot_fun1(pool, QDOT_SIN, qdot_add(pool, a, b));
    qdot_expr d = qdot_add(pool, QDOT_ONE, qdot_mul(pool, s, s)), e = QDOT_ONE;

    for (unsigned i = 0; i < k; i++) {
        char name[16];

        snprintf(name, sizeof name, "x%u", i);
        e = qdot_mul(pool, e,
                     qdot_add(pool, qdot_symbol_get(pool, QDOT_PARAM, name),
                              qdot_div(pool, s, d)));
    }
    return e;
}

static void
parts_put_back_give_the_expression(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr e = repeated(pool, 5), back;
    qdot_abbreviated a;

    (void)state;
    assert_int_equal(qdot_abbreviate(pool, e, is_d2, NULL, &a), QDOT_OK);
    assert_true(a.parts.n >= 1);
    back = a.whole;
    for (size_t i = a.parts.n; i-- > 0;) {
        assert_string_not_equal(qdot_expr_symbol(pool, a.symbols.at[i])->name, "D2");
        back = qdot_subs(pool, back, 1, &a.symbols.at[i], &a.parts.at[i]);
    }
    assert_int_equal(back, e);
    assert_true(qdot_expr_symbol(pool, a.symbols.at[0])->name[1] == '1');
    qdot_abbreviated_clear(&a);
    qdot_pool_free(pool);
}

static void
what_stands_once_gets_no_name(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr e = repeated(pool, 0);
    qdot_abbreviated a;

    (void)state;
    e = qdot_add(pool, e,
                 qdot_fun1(pool, QDOT_SIN, qdot_symbol_get(pool, QDOT_PARAM, "a")));
    assert_int_equal(qdot_abbreviate(pool, e, is_d2, NULL, &a), QDOT_OK);
    assert_int_equal(a.parts.n, 0);
    assert_int_equal(a.whole, e);
    qdot_abbreviated_clear(&a);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_put_back_give_the_expression),
        cmocka_unit_test(what_stands_once_gets_no_name),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
