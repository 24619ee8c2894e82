/* Conserved quantities: which are found, and that each is constant by the equations of motion. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/study/noether.h"
#include "normal/prove/decide.h"

/* The other way round: dE/dt with the accelerations of the equations is 0. */
static void
verify(kit *k, qdot_expr list)
{
    qdot_expr accels = qdot_mech_accels(k->scene);

    must(qdot_pool_check(k->pool));
    for (uint32_t i = 0; i < qdot_expr_count(k->pool, list); i++) {
        qdot_expr rate = qdot_ddt(k->pool, qdot_expr_arg(k->pool, list, i));

        for (uint32_t j = 0; j < qdot_expr_count(k->pool, accels); j++) {
            qdot_expr from = qdot_symbol_jet(k->pool, k->scene->coordinates.at[j], 2);
            qdot_expr to = qdot_expr_arg(k->pool, accels, j);

            rate = qdot_subs(k->pool, rate, 1, &from, &to);
        }
        if (k->scene->constraints.n == 0)
            same_at(k, rate, QDOT_ZERO, (int)i);
    }
}

static void
found(kit *k, uint32_t n)
{
    qdot_expr list = qdot_noether_conserved(k->scene);

    must(qdot_pool_check(k->pool));
    if (qdot_expr_count(k->pool, list) != n)
        fail_msg("%s: want %u", show(k, list), n);
    verify(k, list);
}

/* Whether e is in the span of what was found: e less a combination of at most two is constant, by
 * its being one of them up to a factor. */
static bool
among(kit *k, const char *text)
{
    qdot_expr list = qdot_noether_conserved(k->scene), e = E(k, "%s", text);

    for (uint32_t i = 0; i < qdot_expr_count(k->pool, list); i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            qdot_expr one = qdot_expr_arg(k->pool, list, i);

            one = sign < 0 ? qdot_add(k->pool, one, e) : qdot_sub(k->pool, one, e);
            if (qdot_is_zero(k->pool, one, NULL))
                return true;
        }
    return false;
}

/* Translations, energy, rotation about the vertical, boosts with gravity's K. */
static void
projectile_body(kit *k)
{
    coords(k, "x y z");
    particle(k, "b", "m", "(x, y, z)");
    gravity(k, "(0, 0, -g)");
    found(k, 8);
    assert_true(among(k, "m*x'"));
    assert_true(among(k, "m*(x'^2 + y'^2 + z'^2)/2 + m*g*z"));
    assert_true(among(k, "m*z' + m*g*t"));
    assert_true(among(k, "m*(x*y' - y*x')"));
    assert_true(among(k, "m*z - m*z'*t - m*g*t^2/2"));
}
TEST(projectile)

/* Seven in the plane: energy, two momenta, two angular momenta (in all and about the centre of
 * mass), two boosts. */
static void
two_bodies_body(kit *k)
{
    coords(k, "x1 y1 x2 y2");
    particle(k, "a", "m1", "(x1, y1)");
    particle(k, "b", "m2", "(x2, y2)");
    must(
        qdot_scene_potential(k->scene, E(k, "-G*m1*m2/sqrt((x1 - x2)^2 + (y1 - y2)^2)")));
    found(k, 7);
    assert_true(among(k, "m1*x1' + m2*x2'"));
    assert_true(among(k, "m1*(x1*y1' - y1*x1') + m2*(x2*y2' - y2*x2')"));
    assert_true(among(k, "m1*x1 + m2*x2 - t*(m1*x1' + m2*x2')"));
}
TEST(two_bodies)

/* Coefficients that hold parameters: a plane oscillator of unequal masses turns into itself in
 * stretched coordinates. */
static void
stretched_rotation_body(kit *k)
{
    coords(k, "x y");
    must(qdot_scene_lagrangian(k->scene,
                               E(k, "a*x'^2/2 + b*y'^2/2 - w*(a*x^2 + b*y^2)/2")));
    found(k, 2);
    assert_true(among(k, "b*(x*y' - y*x')"));
}
TEST(stretched_rotation)

static void
central_force_in_polar_coordinates_body(kit *k)
{
    coords(k, "r>0 phi");
    particle(k, "b", "m", "(r*cos(phi), r*sin(phi))");
    must(qdot_scene_potential(k->scene, E(k, "-c/r")));
    found(k, 2);
    assert_true(among(k, "m*r^2*phi'"));
}
TEST(central_force_in_polar_coordinates)

/* A field that turns: neither the energy nor the angular momentum, but E - w L. */
static void
turning_field_body(kit *k)
{
    coords(k, "x y");
    particle(k, "b", "m", "(x, y)");
    must(qdot_scene_potential(k->scene, E(k, "c*(x*cos(w*t) + y*sin(w*t))^2")));
    found(k, 1);
    assert_true(among(k, "m*(x'^2 + y'^2)/2 + c*(x*cos(w*t) + y*sin(w*t))^2 - "
                         "w*m*(x*y' - y*x')"));
}
TEST(turning_field)

/* Friction leaves nothing; along y nothing acts. */
static void
what_works_is_respected_body(kit *k)
{
    coords(k, "x y");
    particle(k, "b", "m", "(x, y)");
    torque(k, "-c*x'", "x");
    found(k, 2);
    assert_true(among(k, "m*y'"));
    assert_true(among(k, "m*y - t*m*y'"));
}
TEST(what_works_is_respected)

/* A cart that carries a pendulum: its centre of mass moves evenly, with a sine in K. */
static void
cart_with_a_pendulum_body(kit *k)
{
    coords(k, "x theta");
    particle(k, "cart", "M", "(x, 0)");
    particle(k, "bob", "m", "(x + l*sin(theta), -l*cos(theta))");
    gravity(k, "(0, -g)");
    found(k, 3);
    assert_true(among(k, "(m + M)*x' + m*l*cos(theta)*theta'"));
    assert_true(among(k, "t*((m + M)*x' + m*l*cos(theta)*theta') - (m + M)*x - "
                         "m*l*sin(theta)"));
}
TEST(cart_with_a_pendulum)

/* On the circle the rod takes the translations and boosts away, not the rotation. */
static void
constraints_are_respected_body(kit *k)
{
    coords(k, "x y");
    particle(k, "b", "m", "(x, y)");
    constraint(k, "rod", "x^2 + y^2", "L^2");
    found(k, 2);
    assert_true(among(k, "m*(x*y' - y*x')"));
    assert_true(among(k, "m*(x'^2 + y'^2)/2"));
}
TEST(constraints_are_respected)

static void
double_pendulum_has_its_energy_only_body(kit *k)
{
    coords(k, "theta1 theta2");
    particle(k, "a", "m1", "(L1*sin(theta1), -L1*cos(theta1))");
    particle(k, "b", "m2",
             "(L1*sin(theta1) + L2*sin(theta2), -L1*cos(theta1) - L2*cos(theta2))");
    gravity(k, "(0, -g)");
    found(k, 1);
}
TEST(double_pendulum_has_its_energy_only)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projectile),
        cmocka_unit_test(two_bodies),
        cmocka_unit_test(stretched_rotation),
        cmocka_unit_test(central_force_in_polar_coordinates),
        cmocka_unit_test(turning_field),
        cmocka_unit_test(what_works_is_respected),
        cmocka_unit_test(cart_with_a_pendulum),
        cmocka_unit_test(constraints_are_respected),
        cmocka_unit_test(double_pendulum_has_its_energy_only),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
