/* Legendre's transform there and back, where momenta are not linear in the velocities too. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "normal/prove/decide.h"

static qdot_expr
P(kit *k, const char *q)
{
    return qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "%s", q));
}

/* State L, take H from it, state that, and get L again. */
static void
goes_there_and_back(kit *k, const char *L, int line)
{
    qdot_facts facts;
    qdot_expr H, again = QDOT_NIL;

    must(qdot_scene_lagrangian(k->scene, E(k, "%s", L)));
    H = qdot_hamilton_hamiltonian(k->scene);
    must(qdot_pool_check(k->pool));
    must(qdot_scene_hamiltonian(k->scene, H, QDOT_NIL));
    must(qdot_hamilton_lagrangian(k->scene, &again));
    facts = qdot_scene_facts(k->scene);
    if (!qdot_is_zero(k->pool, qdot_sub(k->pool, again, E(k, "%s", L)), &facts))
        fail_msg("line %d: L is not found again", line);
}

static void
quadratic_lagrangians_return_body(kit *k)
{
    coords(k, "x y");
    goes_there_and_back(k, "m*(x'^2 + y'^2)/2 + e*B*(x*y' - y*x')/2 - x^2*y", __LINE__);
    goes_there_and_back(k, "x'^2/2 + (3 + cos(x))*y'^2 + x'*y'*sin(y) + t*x' - cos(x)", __LINE__);
}
TEST(quadratic_lagrangians_return)

static void
relativistic_lagrangians_return_body(kit *k)
{
    coords(k, "x y");
    goes_there_and_back(k, "-m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2) - k*x^2", __LINE__);
    goes_there_and_back(k, "-m*c^2*sqrt(1 - (x'^2 + x^2*y'^2)/c^2) + e*x*y' - 1/x", __LINE__);
    goes_there_and_back(k, "-sqrt(1 - x'^2) + m*y'^2/2 + x*y'", __LINE__);
}
TEST(relativistic_lagrangians_return)

static void
momenta_by_one_equation_return_body(kit *k)
{
    coords(k, "x");
    goes_there_and_back(k, "exp(x') - x", __LINE__);
}
TEST(momenta_by_one_equation_return)

/* L of first degree in the velocities: H is 0, and the momenta lie on the mass shell. */
static void
first_degree_names_its_constraint_body(kit *k)
{
    coords(k, "x s");
    must(qdot_scene_lagrangian(k->scene, E(k, "-m*c*sqrt(c^2*s'^2 - x'^2)")));
    assert_int_equal(qdot_hamilton_hamiltonian(k->scene), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ESINGULAR);
    assert_non_null(strstr(qdot_last_error()->message, "p[s]^2 - c^2*p[x]^2 - m^2*c^4 = 0"));
}
TEST(first_degree_names_its_constraint)

static void
hamiltons_equations_of_a_stated_function_body(kit *k)
{
    qdot_expr H, pair;

    coords(k, "x");
    H = qdot_add(k->pool, qdot_mul(k->pool, P(k, "x"), E(k, "sin(x)")), E(k, "x^2"));
    must(qdot_scene_hamiltonian(k->scene, H, QDOT_NIL));
    pair = qdot_hamilton_equation(k->scene, E(k, "x"));
    same_at(k, qdot_expr_arg(k->pool, qdot_expr_arg(k->pool, pair, 0), 1), E(k, "sin(x)"), __LINE__);
    same_at(k, qdot_expr_arg(k->pool, qdot_expr_arg(k->pool, pair, 1), 1),
            qdot_neg(k->pool, qdot_add(k->pool, qdot_mul(k->pool, P(k, "x"), E(k, "cos(x)")), E(k, "2*x"))), __LINE__);
    assert_int_equal(qdot_hamilton_need_lagrangian(k->scene), QDOT_EINVAL);
}
TEST(hamiltons_equations_of_a_stated_function)

/* |p| has no second derivative but at 0: it is no part of a quadratic H, whose L would not know it. */
static void
kinks_are_not_quadratic_body(kit *k)
{
    qdot_expr H, L;

    coords(k, "x");
    H = qdot_add(k->pool, qdot_pow_int(k->pool, P(k, "x"), 2), qdot_fun1(k->pool, QDOT_ABS, P(k, "x")));
    must(qdot_scene_hamiltonian(k->scene, H, QDOT_NIL));
    assert_int_equal(qdot_hamilton_lagrangian(k->scene, &L), QDOT_EDOMAIN);
}
TEST(kinks_are_not_quadratic)

/* L linear in y' and z': these terms cancel in H, and p[z] = y is a constraint. */
static void
linear_velocities_cancel_body(kit *k)
{
    qdot_expr list;

    coords(k, "x y z");
    must(qdot_scene_lagrangian(k->scene, E(k, "m*x'^2/2 + y*z' - x*y - z^2")));
    same_at(k, qdot_hamilton_hamiltonian(k->scene),
            qdot_add(k->pool, E(k, "x*y + z^2"), qdot_div(k->pool, qdot_pow_int(k->pool, P(k, "x"), 2), E(k, "2*m"))), __LINE__);
    list = qdot_hamilton_linear(k->scene);
    assert_int_equal(qdot_expr_count(k->pool, list), 2);
    assert_int_equal(qdot_expr_arg(k->pool, list, 1), E(k, "z"));
    must(qdot_scene_lagrangian(k->scene, E(k, "m*x'^2/2 - x*y - z^2")));
    assert_int_equal(qdot_hamilton_linear(k->scene), QDOT_NIL);
    must(qdot_pool_check(k->pool));
}
TEST(linear_velocities_cancel)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quadratic_lagrangians_return),
        cmocka_unit_test(relativistic_lagrangians_return),
        cmocka_unit_test(momenta_by_one_equation_return),
        cmocka_unit_test(first_degree_names_its_constraint),
        cmocka_unit_test(linear_velocities_cancel),
        cmocka_unit_test(hamiltons_equations_of_a_stated_function),
        cmocka_unit_test(kinks_are_not_quadratic),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
