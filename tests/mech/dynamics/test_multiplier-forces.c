/* Forces that hold multipliers, against Newton's equations solved by hand. */
#include "mech/kit.h"

#include "mech/dynamics/multiplier-forces.h"
#include "mech/dynamics/quantity.h"

/* On a floor friction does not change the pressure. */
static void
pressure_of_a_floor_is_the_weight(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    particle(&k, "b", "m", "(x, y)");
    gravity(&k, "(0, -g)");
    constraint(&k, "floor", "y", "0");
    force(&k, "(-mu*abs(lambda[floor])*sign(x'), 0)", "(x, y)");
    SAME(&k, qdot_mech_accel(k.scene, E(&k, "x")), "-mu*abs(m*g)*sign(x')/m");
    SAME(&k, qdot_mech_multiplier(k.scene, 0), "m*g");
    assert_false(qdot_multipliers_are_bound(k.scene));
    kit_close(&k);
}

/* A horizontal force on a slope does: lambda (1 + c (c - mu s)) = m g while that factor is positive, for s = -1 and 1. */
static void
friction_that_acts_back_is_solved_for(void **state)
{
    static const char *const sides[] = {"-1", "1"};

    (void)state;
    for (size_t i = 0; i < 2; i++) {
        char text[80];
        qdot_expr lambda;
        kit k;

        kit_open(&k);
        coords(&k, "x y");
        particle(&k, "b", "2", "(x, y)");
        gravity(&k, "(0, -10)");
        constraint(&k, "slope", "y + x/4", "0");
        snprintf(text, sizeof text, "(-1/2*abs(lambda[slope])*(%s), 0)", sides[i]);
        force(&k, text, "(x, y)");
        lambda = E(&k, "20/(1 + 1/4*(1/4 - 1/2*(%s)))", sides[i]);
        same_at(&k, qdot_mech_multiplier(k.scene, 0), lambda, __LINE__);
        same_at(&k, qdot_mech_accel(k.scene, E(&k, "x")),
                qdot_mul(k.pool, lambda, E(&k, "(1/4 - 1/2*(%s))/2", sides[i])), __LINE__);
        assert_true(qdot_multipliers_are_bound(k.scene));
        kit_close(&k);
    }
}

/* One constraint's friction may hang on another's: a block on a block on a floor. */
static void
friction_is_solved_for_one_behind_another(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y u v");
    particle(&k, "lower", "M", "(x, y)");
    particle(&k, "upper", "m", "(u, v)");
    gravity(&k, "(0, -g)");
    constraint(&k, "floor", "y", "0");
    constraint(&k, "stack", "v - y", "1");
    force(&k, "(-mu*lambda[floor]*s, 0)", "(x, y)");
    force(&k, "(mu*lambda[stack], 0)", "(u, v)");
    SAME(&k, qdot_mech_accel(k.scene, E(&k, "x")), "-mu*s*(M + m)*g/M");
    SAME(&k, qdot_mech_accel(k.scene, E(&k, "u")), "mu*g");
    kit_close(&k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_of_a_floor_is_the_weight),
        cmocka_unit_test(friction_that_acts_back_is_solved_for),
        cmocka_unit_test(friction_is_solved_for_one_behind_another),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
