/* test_unit.c -- units as symbols: how they print, and their numbers. */
#include "kit.h"

#include "expr/exact.h"
#include "expr/print.h"
#include "expr/unit.h"

static void
prints(qdot_expr e, const char *expected)
{
    qdot_text text = {0};

    assert_int_equal(qdot_print(p.pool, e, QDOT_PLAIN, &text), QDOT_OK);
    assert_string_equal(qdot_text_str(&text), expected);
    qdot_text_clear(&text);
}

static void
units_print_behind_their_number(void **state)
{
    const qdot_expr m = qdot_unit_symbol(p.pool, 0), kg = qdot_unit_symbol(p.pool, 1), s = qdot_unit_symbol(p.pool, 2);
    const qdot_expr k = qdot_symbol_get(p.pool, QDOT_PARAM, "k");
    const qdot_expr force = qdot_mul(p.pool, qdot_mul(p.pool, kg, m), qdot_pow(p.pool, s, qdot_expr_int(p.pool, -2)));

    (void)state;
    prints(m, "1 [m]");
    prints(qdot_mul(p.pool, qdot_expr_ratio(p.pool, 981, 100), qdot_mul(p.pool, m, k)), "9.81 [m]*k");
    prints(qdot_mul(p.pool, qdot_expr_int(p.pool, -3), force), "-3 [N]");
    prints(qdot_div(p.pool, k, m), "1 [1/m]*k");
    prints(qdot_mul(p.pool, qdot_expr_ratio(p.pool, 1, 3), m), "(1/3) [m]");
    prints(qdot_pow(p.pool, qdot_add(p.pool, k, qdot_mul(p.pool, qdot_expr_int(p.pool, 2), m)), qdot_expr_int(p.pool, 2)),
           "(k + 2 [m])^2");
    prints(qdot_pow(p.pool, qdot_mul(p.pool, qdot_expr_int(p.pool, 2), m), QDOT_HALF), "1 [m^(1/2)]*sqrt(2)");
}

static void
a_number_in_si_has_no_units(void **state)
{
    const qdot_expr m = qdot_unit_symbol(p.pool, 0), e = qdot_mul(p.pool, qdot_expr_int(p.pool, 5), m);

    (void)state;
    assert_true(qdot_expr_has_units(p.pool, e));
    assert_false(qdot_expr_has_units(p.pool, QDOT_PI));
    assert_int_equal(qdot_expr_in_si(p.pool, e), qdot_expr_int(p.pool, 5));
    assert_int_equal(qdot_unit_symbol_base(p.pool, qdot_unit_symbol(p.pool, 6)), 6);
    assert_int_equal(qdot_unit_symbol_base(p.pool, qdot_symbol_get(p.pool, QDOT_PARAM, "m")), -1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {TEST(units_print_behind_their_number), TEST(a_number_in_si_has_no_units)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
