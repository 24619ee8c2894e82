/* Higher derivatives: Euler's equation by another way, momenta, energy, total derivatives, the solved form. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/ostrogradsky.h"
#include "mech/dynamics/quantity.h"
#include "mech/fields/euler-lagrange.h"
#include "mech/kit.h"
#include "mech/scene/scene.h"

static qdot_expr
stated(kit *k, const char *L)
{
    assert_int_equal(qdot_scene_lagrangian(k->scene, E(k, "%s", L)), QDOT_OK);
    return k->scene->coordinates.at[0];
}

static qdot_expr
in_motion(kit *k, const char *e)
{
    return qdot_higher_in_motion(k->scene, E(k, "%s", e));
}

static void
equation_is_eulers_body(kit *k)
{
    static const char L[] = "x''^2*cos(x)/2 - x'^4 + x*x'*t";
    const qdot_expr t = QDOT_T;
    qdot_expr q, other;

    coords(k, "x");
    q = stated(k, L);
    other = qdot_fields_euler_lagrange(k->scene, E(k, "%s", L), q, 1, &t);
    assert_int_equal(k->scene->coordinates.n, 2);
    assert_int_equal(qdot_expand(k->pool, qdot_expr_arg(k->pool, qdot_ostrogradsky_equation(k->scene, q), 0)),
                     qdot_expand(k->pool, qdot_higher_in_motion(k->scene, qdot_expr_arg(k->pool, other, 0))));
}
TEST(equation_is_eulers)

static void
momenta_and_energy_body(kit *k)
{
    qdot_expr q;

    coords(k, "x");
    q = stated(k, "x''^2/2 - 2*x'^2 + x^2");
    assert_int_equal(qdot_ostrogradsky_momentum(k->scene, q), in_motion(k, "-4*x' - x'''"));
    assert_int_equal(qdot_ostrogradsky_momentum(k->scene, E(k, "x'")), in_motion(k, "x''"));
    assert_int_equal(qdot_ostrogradsky_momentum(k->scene, in_motion(k, "x''")), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_EINVAL);
    assert_int_equal(qdot_expand(k->pool, qdot_mech_energy(k->scene)),
                     qdot_expand(k->pool, in_motion(k, "x''^2/2 - 2*x'^2 - x^2 - x'*x'''")));
    assert_true(qdot_ostrogradsky_conserves(k->scene));
    assert_int_equal(qdot_expand(k->pool, qdot_ostrogradsky_accel(k->scene, q)), in_motion(k, "-4*x'' - 2*x"));
    assert_int_equal(qdot_ostrogradsky_force(k->scene, 0), in_motion(k, "x''"));
}
TEST(momenta_and_energy)

static void
total_derivatives_are_left_out_body(kit *k)
{
    coords(k, "x y");
    stated(k, "x*x''");
    assert_int_equal(k->scene->lagrangian, E(k, "-x'^2"));
    stated(k, "x'*x''*exp(x)*y + x''*y'*x + x'*y''*x + y'^2");
    assert_int_equal(k->scene->higher.n, 0);
    assert_int_equal(k->scene->coordinates.n, 2);
    /* the first of x'' is left, the second of y'' goes */
    stated(k, "x''^2/2 + y*y''");
    assert_int_equal(k->scene->higher.n, 1);
    assert_int_equal(k->scene->higher_lagrangian, in_motion(k, "x''^2/2 - y'^2"));
    assert_int_equal(qdot_scene_lagrangian(k->scene, E(k, "x'*y'' - y'*x''")), QDOT_ENOTBUILT);
}
TEST(total_derivatives_are_left_out)

static void
degenerate_is_told_body(kit *k)
{
    coords(k, "x y");
    stated(k, "(x'' + y'')^2/2 - x^2");
    assert_int_equal(qdot_ostrogradsky_force(k->scene, 0), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ESINGULAR);
    /* the equation of y is of the second order, that of x holds y''' */
    stated(k, "x''^2/2 + x''*y' + y'^2");
    assert_int_equal(qdot_ostrogradsky_force(k->scene, 0), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ENOTBUILT);
}
TEST(degenerate_is_told)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equation_is_eulers),
        cmocka_unit_test(momenta_and_energy),
        cmocka_unit_test(total_derivatives_are_left_out),
        cmocka_unit_test(degenerate_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
