/* Velocity constraints that are holonomic in disguise: their integrals, and where these are used. */
#include "expr/build.h"
#include "mech/kit.h"

#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"

static void
wheel(kit *k, const char *label, const char *left)
{
    constraint(k, label, left, "0");
}

static void
same(kit *k, qdot_expr e, const char *other)
{
    const qdot_facts facts = qdot_scene_facts(k->scene);

    must(qdot_pool_check(k->pool));
    if (!qdot_is_zero(k->pool, qdot_sub(k->pool, e, E(k, "%s", other)), &facts))
        fail_msg("%s is not %s", show(k, e), other);
}

static void
a_factor_is_left_out_body(kit *k)
{
    qdot_expr mu;

    coords(k, "x y");
    wheel(k, "w", "sin(x)*(x' - 2*y')");
    same(k, qdot_integrated_of(k->scene, 0, &mu), "x - 2*y");
    same(k, mu, "1/sin(x)");
    same(k, qdot_integrated_slope(k->scene, 0, 1), "-2");
    same(k, qdot_integrated_rate(k->scene, 0, &mu), "x' - 2*y'");
}
TEST(a_factor_is_left_out)

/* x/y = const has no slopes at y = 0, where y x' - x y' = 0 has some. */
static void
poles_are_not_brought_in_body(kit *k)
{
    qdot_expr mu;

    coords(k, "x y");
    wheel(k, "w", "y*x' - x*y'");
    assert_int_equal(qdot_integrated_of(k->scene, 0, &mu), QDOT_NIL);
    same(k, qdot_integrated_slope(k->scene, 0, 0), "y");
}
TEST(poles_are_not_brought_in)

/* Runs keep what was declared where its slopes never vanish together. */
static void
runs_keep_the_declared_one_body(kit *k)
{
    qdot_expr mu;

    coords(k, "x y");
    wheel(k, "w", "exp(y)*x' - exp(y)*y'");
    same(k, qdot_integrated_of(k->scene, 0, &mu), "x - y");
    assert_int_equal(qdot_integrated_rate(k->scene, 0, &mu), k->scene->constraints.at[0].f);
    assert_int_equal(mu, QDOT_ONE);
}
TEST(runs_keep_the_declared_one)

/* q'' where the declared slopes vanish; lambda belongs to the declared constraint. */
static void
accelerations_at_the_zero_body(kit *k)
{
    qdot_expr zero = QDOT_ZERO, x, at;

    coords(k, "x y");
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 + y'^2/2 - y^2/2 - x")));
    wheel(k, "w", "x*(x' - 2*y')");
    x = E(k, "x");
    at = qdot_subs(k->pool, qdot_mech_accel(k->scene, E(k, "y")), 1, &x, &zero);
    same(k, at, "-(y + 2)/5");
    same(k, qdot_mech_multiplier(k->scene, 0), "(1 - 2*y)/(5*x)");
}
TEST(accelerations_at_the_zero)

static void
is_holonomic(kit *k, bool wanted)
{
    bool yes = !wanted;

    must(qdot_mech_is_holonomic(k->scene, &yes));
    assert_int_equal(yes, wanted);
}

static void
a_blade_is_not_body(kit *k)
{
    coords(k, "x y phi");
    wheel(k, "blade", "x'*sin(phi) - y'*cos(phi)");
    is_holonomic(k, false);
    wheel(k, "straight", "phi'");
    is_holonomic(k, true);
}
TEST(a_blade_is_not)

/* A surface that moves by itself: no modes about a rest on it. */
static void
surfaces_that_move_are_not_body(kit *k)
{
    coords(k, "x y");
    wheel(k, "w", "x' - y' - x*t");
    is_holonomic(k, false);
}
TEST(surfaces_that_move_are_not)

static void
a_drift_is_not_body(kit *k)
{
    coords(k, "x y");
    wheel(k, "w", "x' + x");
    is_holonomic(k, false);
}
TEST(a_drift_is_not)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_factor_is_left_out),       cmocka_unit_test(poles_are_not_brought_in),
        cmocka_unit_test(runs_keep_the_declared_one), cmocka_unit_test(accelerations_at_the_zero),
        cmocka_unit_test(a_blade_is_not),             cmocka_unit_test(surfaces_that_move_are_not),
        cmocka_unit_test(a_drift_is_not),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
