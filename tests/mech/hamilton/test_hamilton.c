/* Hamilton's and Routh's functions against the textbooks', and against each other's equations. */
#include "expr/build.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"

static qdot_expr
P(kit *k, const char *q)
{
    return qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "%s", q));
}

/* e with every p[q] replaced by dL/dq'. */
static qdot_expr
in_velocities(kit *k, qdot_expr e)
{
    for (size_t i = 0; i < k->scene->coordinates.n; i++) {
        qdot_expr q = k->scene->coordinates.at[i];
        qdot_expr from = qdot_symbol_of(k->pool, QDOT_MOMENTUM, q);
        qdot_expr to = qdot_mech_momentum(k->scene, q);

        e = qdot_subs(k->pool, e, 1, &from, &to);
    }
    return e;
}

static void
hamiltonian_of_the_pendulum_body(kit *k)
{
    qdot_expr H, want;

    coords(k, "theta");
    particle(k, "bob", "m", "(l*sin(theta), -l*cos(theta))");
    gravity(k, "(0, -g)");
    H = qdot_hamilton_hamiltonian(k->scene);
    want = qdot_add(
        k->pool,
        qdot_mul(k->pool, qdot_pow_int(k->pool, P(k, "theta"), 2), E(k, "1/(2*m*l^2)")),
        E(k, "-m*g*l*cos(theta)"));
    same_at(k, H, want, __LINE__);
}
TEST(hamiltonian_of_the_pendulum)

/* In velocities H is the energy; dH/dp = q', -dH/dq = dL/dq. */
static void
hamiltons_equations_hold_body(kit *k)
{
    qdot_expr H;

    symbolic_double_pendulum(k);
    H = qdot_hamilton_hamiltonian(k->scene);
    same_at(k, in_velocities(k, H), qdot_mech_energy(k->scene), __LINE__);
    same_at(k, in_velocities(k, qdot_diff(k->pool, H, P(k, "theta2"))), E(k, "theta2'"),
            __LINE__);
    same_at(k, in_velocities(k, qdot_neg(k->pool, qdot_diff(k->pool, H, E(k, "theta1")))),
            qdot_diff(k->pool, qdot_mech_lagrangian(k->scene), E(k, "theta1")), __LINE__);
}
TEST(hamiltons_equations_hold)

/* A charge in a magnetic field: (p - q A)^2/2m. */
static void
magnetic_momentum_is_taken_off_body(kit *k)
{
    qdot_expr H, p;

    coords(k, "x y");
    must(
        qdot_scene_lagrangian(k->scene, E(k, "m*(x'^2 + y'^2)/2 + e*B*(x*y' - y*x')/2")));
    H = qdot_hamilton_hamiltonian(k->scene);
    p = qdot_add(k->pool,
                 qdot_pow_int(k->pool, qdot_add(k->pool, P(k, "x"), E(k, "e*B*y/2")), 2),
                 qdot_pow_int(k->pool, qdot_sub(k->pool, P(k, "y"), E(k, "e*B*x/2")), 2));
    same_at(k, H, qdot_div(k->pool, p, E(k, "2*m")), __LINE__);
}
TEST(magnetic_momentum_is_taken_off)

static void
routhian_of_the_spherical_pendulum_body(kit *k)
{
    qdot_expr R, want;

    coords(k, "theta phi");
    particle(k, "bob", "m",
             "(l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), -l*cos(theta))");
    gravity(k, "(0, 0, -g)");
    R = qdot_hamilton_routhian(k->scene, 0, NULL);
    want = qdot_sub(k->pool, E(k, "m*l^2*theta'^2/2 + m*g*l*cos(theta)"),
                    qdot_div(k->pool, qdot_pow_int(k->pool, P(k, "phi"), 2),
                             E(k, "2*m*l^2*sin(theta)^2")));
    same_at(k, R, want, __LINE__);
}
TEST(routhian_of_the_spherical_pendulum)

/* Over all coordinates it is -H. */
static void
routhian_over_named_coordinates_body(kit *k)
{
    qdot_expr q[2], R;

    coords(k, "r theta");
    particle(k, "bob", "m", "(r*cos(theta), r*sin(theta))");
    assert_int_equal(qdot_scene_potential(k->scene, E(k, "k*r^2/2")), QDOT_OK);
    q[0] = E(k, "r");
    q[1] = E(k, "theta");
    R = qdot_hamilton_routhian(k->scene, 1, q);
    same_at(k, R,
            qdot_sub(k->pool, E(k, "m*r^2*theta'^2/2 - k*r^2/2"),
                     qdot_div(k->pool, qdot_pow_int(k->pool, P(k, "r"), 2), E(k, "2*m"))),
            __LINE__);
    R = qdot_hamilton_routhian(k->scene, 2, q);
    same_at(k, R, qdot_neg(k->pool, qdot_hamilton_hamiltonian(k->scene)), __LINE__);
}
TEST(routhian_over_named_coordinates)

static void
without_a_cyclic_coordinate_it_is_L_body(kit *k)
{
    symbolic_double_pendulum(k);
    same_at(k, qdot_hamilton_routhian(k->scene, 0, NULL), qdot_mech_lagrangian(k->scene),
            __LINE__);
}
TEST(without_a_cyclic_coordinate_it_is_L)

static void
what_has_no_transform_is_refused_body(kit *k)
{
    coords(k, "x y");
    must(qdot_scene_lagrangian(k->scene, E(k, "m*(x' + y')^2/2")));
    assert_int_equal(qdot_hamilton_hamiltonian(k->scene), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ESINGULAR);
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^4 + y'^2")));
    assert_int_equal(qdot_hamilton_hamiltonian(k->scene), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_EDOMAIN);
}
TEST(what_has_no_transform_is_refused)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hamiltonian_of_the_pendulum),
        cmocka_unit_test(hamiltons_equations_hold),
        cmocka_unit_test(magnetic_momentum_is_taken_off),
        cmocka_unit_test(routhian_of_the_spherical_pendulum),
        cmocka_unit_test(routhian_over_named_coordinates),
        cmocka_unit_test(without_a_cyclic_coordinate_it_is_L),
        cmocka_unit_test(what_has_no_transform_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
