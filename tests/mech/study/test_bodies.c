/* Momenta, inertia and energy: laws that hold whatever the scene. */
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/dynamics/rate.h"
#include "mech/study/bodies.h"

/* A heavy symmetric top whose tip is the origin, at h along its axis. */
static void
heavy_top(kit *k)
{
    coords(k, "phi theta psi");
    must(declare_body(k->scene, "top", E(k, "M"), E(k, "(A, A, C)"), QDOT_NIL,
                      E(k, "(h*sin(theta)*sin(phi), -h*sin(theta)*cos(phi), h*cos(theta))"), QDOT_NIL,
                      qdot_scene_euler(k->pool, E(k, "phi"), E(k, "theta"), E(k, "psi"))));
    gravity(k, "(0, 0, -g)");
}

static void
angular_momentum_is_inertia_times_spin(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    heavy_top(&k);
    qdot_expr tip = E(&k, "(0, 0, 0)"), w = qdot_scene_spin(k.scene, "top");
    qdot_expr L = qdot_bodies_angular_momentum(k.scene, "top", QDOT_NIL);
    qdot_expr Jw = qdot_value_mul(k.pool, qdot_bodies_inertia(k.scene, "top", tip), w);

    for (uint32_t i = 0; i < 3; i++)
        same_at(&k, qdot_expr_arg(k.pool, L, i), qdot_expr_arg(k.pool, Jw, i), (int)i);
    same_at(&k, qdot_expr_arg(k.pool, L, 2), qdot_mech_momentum(k.scene, E(&k, "phi")), __LINE__);
    same_at(&k, qdot_bodies_energy(k.scene, "top"), qdot_mech_energy(k.scene), __LINE__);
    kit_close(&k);
}

/* Euler's law: the rate is the moment of the weight. */
static void
rate_is_the_torque(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    heavy_top(&k);
    qdot_expr L = qdot_bodies_angular_momentum(k.scene, NULL, QDOT_NIL);
    qdot_expr torque = qdot_cross(k.pool, qdot_scene_position(k.scene, "top"), E(&k, "(0, 0, -M*g)"));

    for (uint32_t i = 0; i < 3; i++)
        same_at(&k, qdot_rate_of(k.scene, qdot_expr_arg(k.pool, L, i)), qdot_expr_arg(k.pool, torque, i), (int)i);
    kit_close(&k);
}

/* Of a plate and a particle in the plane: sums over the scene, and the axis moved by Steiner's theorem. */
static void
plane_scenes_have_numbers(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y alpha s");
    must(declare_body(k.scene, "plate", E(&k, "M"), E(&k, "J"), QDOT_NIL, E(&k, "(x, y)"), E(&k, "alpha"), QDOT_NIL));
    particle(&k, "bead", "m", "(x + s, y)");
    same_at(&k, qdot_bodies_inertia(k.scene, "plate", QDOT_NIL), E(&k, "J"), __LINE__);
    same_at(&k, qdot_bodies_inertia(k.scene, "plate", E(&k, "(x + a, y - b)")), E(&k, "J + M*(a^2 + b^2)"), __LINE__);
    same_at(&k, qdot_bodies_inertia(k.scene, "bead", E(&k, "(x, y)")), E(&k, "m*s^2"), __LINE__);
    same_at(&k, qdot_bodies_angular_momentum(k.scene, NULL, QDOT_NIL),
            qdot_add(k.pool, qdot_bodies_angular_momentum(k.scene, "plate", QDOT_NIL),
                     qdot_bodies_angular_momentum(k.scene, "bead", QDOT_NIL)), __LINE__);
    same_at(&k, qdot_bodies_angular_momentum(k.scene, "bead", E(&k, "(x, y)")), E(&k, "m*s*y'"), __LINE__);
    same_at(&k, qdot_expr_arg(k.pool, qdot_bodies_momentum(k.scene, NULL), 0), E(&k, "M*x' + m*(x' + s')"), __LINE__);
    assert_int_equal(qdot_bodies_inertia(k.scene, "plate", E(&k, "(1, 2, 3)")), QDOT_NIL);
    assert_int_equal(qdot_last_error()->status, QDOT_ETYPE);
    kit_close(&k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(angular_momentum_is_inertia_times_spin),
        cmocka_unit_test(rate_is_the_torque),
        cmocka_unit_test(plane_scenes_have_numbers),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
