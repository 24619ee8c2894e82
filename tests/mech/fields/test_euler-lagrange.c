/* Equations of densities against those of the books, and against the total derivatives that have none. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/fields/euler-lagrange.h"
#include "mech/kit.h"

/* The left side of the equation of `field` with the variables, separated by commas. */
static qdot_expr
equation(kit *k, const char *density, const char *field, const char *variables)
{
    qdot_expr list = E(k, "(%s, 0)", variables), x[4], e;
    uint32_t m = qdot_expr_count(k->pool, list) - 1;

    for (uint32_t i = 0; i < m; i++)
        x[i] = qdot_expr_arg(k->pool, list, i);
    e = qdot_fields_euler_lagrange(k->scene, E(k, "%s", density), E(k, "%s", field), m, x);
    return e == QDOT_NIL ? e : qdot_expr_arg(k->pool, e, 0);
}

static void
waves_and_beams_body(kit *k)
{
    function(k, "y", "x, t");
    SAME(k, equation(k, "rho*diff(y(x, t), t)^2/2 - s*diff(y(x, t), x)^2/2", "y(x, t)", "x, t"),
         "rho*diff(diff(y(x, t), t), t) - s*diff(diff(y(x, t), x), x)");
    SAME(k, equation(k, "rho*diff(y(x, t), t)^2/2 - b*diff(diff(y(x, t), x), x)^2/2", "y(x, t)", "x, t"),
         "rho*diff(diff(y(x, t), t), t) + b*diff(diff(diff(diff(y(x, t), x), x), x), x)");
    SAME(k, equation(k, "rho*x*diff(y(x, t), t)^2/2 - x^2*diff(y(x, t), x)^2/2 + cos(y(x, t))", "y(x, t)", "x, t"),
         "rho*x*diff(diff(y(x, t), t), t) - x^2*diff(diff(y(x, t), x), x) - 2*x*diff(y(x, t), x) + sin(y(x, t))");
}
TEST(waves_and_beams)

/* The mixed derivative y_xt is one variable: its square gives y_xxtt once. */
static void
mixed_derivatives_count_once_body(kit *k)
{
    function(k, "y", "x, t");
    SAME(k, equation(k, "diff(diff(y(x, t), x), t)^2/2", "y(x, t)", "x, t"),
         "-diff(diff(diff(diff(y(x, t), x), x), t), t)");
    SAME(k, equation(k, "diff(diff(y(x, t), x), t)*y(x, t)", "y(x, t)", "x, t"), "-2*diff(diff(y(x, t), x), t)");
}
TEST(mixed_derivatives_count_once)

static void
total_derivatives_have_no_equation_body(kit *k)
{
    function(k, "y", "x, t");
    SAME(k, equation(k, "diff(x*y(x, t)^2*diff(y(x, t), t), x)", "y(x, t)", "x, t"), "0");
    SAME(k, equation(k, "diff(sin(y(x, t))*diff(y(x, t), x), t)", "y(x, t)", "x, t"), "0");
    SAME(k, equation(k, "diff(diff(y(x, t), x), x)*diff(diff(y(x, t), t), t) - diff(diff(y(x, t), x), t)^2", "y(x, t)",
                     "x, t"), "0");
}
TEST(total_derivatives_have_no_equation)

static void
coordinates_move_with_time_body(kit *k)
{
    coords(k, "x r>0 theta");
    function(k, "h", "t");
    SAME(k, equation(k, "m*(r'^2 + r^2*theta'^2)/2 + c/r", "r", "t"), "m*r'' - m*r*theta'^2 + c/r^2");
    SAME(k, equation(k, "a*x''^2/2 - m*x'^2/2", "x", "t"), "-a*x'''' - m*x''");
    SAME(k, equation(k, "m*(x' + diff(h(t), t))^2/2", "h(t)", "t"), "m*x'' + m*diff(diff(h(t), t), t)");
}
TEST(coordinates_move_with_time)

static void
no_density(kit *k, const char *density, const char *field, const char *variables, qdot_status status)
{
    assert_int_equal(equation(k, density, field, variables), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), status);
}

static void
what_is_no_density_is_refused_body(kit *k)
{
    coords(k, "q");
    function(k, "y", "x, t");
    no_density(k, "(1, 2)", "y(x, t)", "x, t", QDOT_ETYPE);
    no_density(k, "y(x, t)^2", "m", "x, t", QDOT_ETYPE);
    no_density(k, "y(x, t)^2", "diff(y(x, t), x)", "x, t", QDOT_ETYPE);
    no_density(k, "y(x, t)*y(x, 2*t)", "y(x, t)", "x, t", QDOT_EINVAL);
    no_density(k, "diff(y(x, t), t)^2", "y(x, t)", "x", QDOT_EINVAL);
    no_density(k, "y(x, t)^2", "y(x, t)", "x, z", QDOT_EINVAL);
    no_density(k, "y(x, t)^2", "y(x, t)", "x, x", QDOT_EINVAL);
    no_density(k, "q'*y(x, t)", "y(x, t)", "x, t", QDOT_EINVAL);
    no_density(k, "q*y(x, t)", "y(x, t)", "x, t", QDOT_EINVAL);
}
TEST(what_is_no_density_is_refused)

/* d_i T_ik = y_k times the equation, where L does not depend on x and t. */
static void
energy_and_momentum_are_conserved_body(kit *k)
{
    const char *L = "diff(y(x, t), t)^2/2 - diff(y(x, t), x)^4 - cos(y(x, t))";
    qdot_expr x[2], T4, law;

    function(k, "y", "x, t");
    x[0] = E(k, "x");
    x[1] = QDOT_T;
    law = equation(k, L, "y(x, t)", "x, t");
    T4 = qdot_fields_energy_momentum(k->scene, E(k, "%s", L), 1, (qdot_expr[]){E(k, "y(x, t)")}, 2, x);
    for (uint32_t c = 0; c < 2; c++) {
        qdot_expr sum = QDOT_ZERO, y = E(k, "y(x, t)");

        for (uint32_t i = 0; i < 2; i++)
            sum = qdot_add(k->pool, sum, qdot_diff(k->pool, qdot_expr_arg(k->pool, T4, 2 * i + c), x[i]));
        SAME(k, qdot_sub(k->pool, sum, qdot_mul(k->pool, law, qdot_diff(k->pool, y, x[c]))), "0");
    }
}
TEST(energy_and_momentum_are_conserved)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_and_beams),
        cmocka_unit_test(mixed_derivatives_count_once),
        cmocka_unit_test(total_derivatives_have_no_equation),
        cmocka_unit_test(coordinates_move_with_time),
        cmocka_unit_test(what_is_no_density_is_refused),
        cmocka_unit_test(energy_and_momentum_are_conserved),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
