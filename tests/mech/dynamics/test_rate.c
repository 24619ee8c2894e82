/* Rates along the motion: against accelerations put in by hand, and on the constraints' manifold. */
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/dynamics/rate.h"

/* The shortest way: ddt, then every acceleration replaced. */
static qdot_expr
by_accelerations(kit *k, qdot_expr e)
{
    e = qdot_ddt(k->pool, e);
    for (size_t i = 0; i < k->scene->coordinates.n; i++) {
        qdot_expr q = k->scene->coordinates.at[i], from = qdot_symbol_jet(k->pool, q, 2);
        qdot_expr to = qdot_mech_accel(k->scene, q);

        e = qdot_subs(k->pool, e, 1, &from, &to);
    }
    return e;
}

static void
rates_are_those_of_accelerations(void **state)
{
    static const char *const of[] = {"theta1'", "theta1'*theta2' + t^2", "sin(theta1)", "m*cos(theta1 - theta2)*theta2'^3"};
    kit k;

    (void)state;
    kit_open(&k);
    symbolic_double_pendulum(&k);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        qdot_expr e = E(&k, "%s", of[i]);

        same_at(&k, qdot_rate_of(k.scene, e), by_accelerations(&k, e), (int)i);
    }
    kit_close(&k);
}

/* The energy and momenta, whose rates need no accelerations. */
static void
energy_and_momenta_have_the_rates_of_the_equations(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    particle(&k, "b", "m", "(x, y)");
    gravity(&k, "(0, -g)");
    force(&k, "(-c*x', -c*y')", "(x, y)");
    same_at(&k, qdot_rate_of(k.scene, qdot_mech_energy(k.scene)), E(&k, "-c*x'^2 - c*y'^2"), __LINE__);
    same_at(&k, qdot_rate_of(k.scene, E(&k, "m*y'")), E(&k, "-m*g - c*y'"), __LINE__);
    same_at(&k, qdot_rate_of(k.scene, E(&k, "y''")), E(&k, "c*(g + c*y'/m)/m"), __LINE__);
    kit_close(&k);
}

/* Momenta that are not linear in velocities: with and without accelerations solved for, the same. */
static void
combinations_of_momenta_have_the_rates_of_accelerations(void **state)
{
    static const char *const of[] = {"x*p_y - y*p_x", "2*p_x - t*p_y/3 + x^2*t", "x*p_x + y*p_y", "x'*p_y"};
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    must(qdot_scene_lagrangian(k.scene, E(&k, "(x'^2 + y'^2)/2 + (x'^2 + 2*y'^2)^2/8 - x^2*y + t*y")));
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const qdot_expr from[] = {E(&k, "p_x"), E(&k, "p_y")},
                        to[] = {qdot_mech_momentum(k.scene, k.scene->coordinates.at[0]),
                                qdot_mech_momentum(k.scene, k.scene->coordinates.at[1])};
        const qdot_expr e = qdot_subs(k.pool, E(&k, "%s", of[i]), 2, from, to);

        assert_int_equal(qdot_mech_rate(k.scene, e) != QDOT_NIL, i < 3);
        same_at(&k, qdot_rate_of(k.scene, e), by_accelerations(&k, e), (int)i);
    }
    kit_close(&k);
}

/* On a circle: the multiplier put in; the energy's rate is 0 where the constraint holds, which takes a proof. */
static void
multipliers_are_eliminated(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    particle(&k, "b", "m", "(x, y)");
    gravity(&k, "(0, -g)");
    constraint(&k, "rod", "x^2 + y^2", "l^2");
    qdot_expr lambda = k.scene->constraints.at[0].multiplier;

    same_at(&k, qdot_rate_on_motion(k.scene, lambda), E(&k, "m*(g*y - x'^2 - y'^2)/(2*(x^2 + y^2))"), __LINE__);
    same_at(&k, qdot_rate_of(k.scene, E(&k, "x*y' - y*x'")), E(&k, "-g*x"), __LINE__);
    assert_int_equal(qdot_rate_of(k.scene, qdot_mech_energy(k.scene)), QDOT_ZERO);
    constraint(&k, "again", "2*x^2 + 2*y^2", "2*l^2");
    assert_int_equal(qdot_rate_on_motion(k.scene, lambda), QDOT_NIL);
    assert_int_equal(qdot_last_error()->status, QDOT_EINVAL);
    kit_close(&k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_are_those_of_accelerations),
        cmocka_unit_test(energy_and_momenta_have_the_rates_of_the_equations),
        cmocka_unit_test(combinations_of_momenta_have_the_rates_of_accelerations),
        cmocka_unit_test(multipliers_are_eliminated),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
