/* Statics: the forces of bars from the equations of equilibrium. */
#include "mech/kit.h"

#include "mech/dynamics/rate.h"
#include "mech/dynamics/statics.h"

/* A joint on two bars, loaded by (F, -P): Q + sum lambda df/dq = 0, checked component by component. */
static void
bars_carry_the_load(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    constraint(&k, "one", "x^2 + y^2", "l^2");
    constraint(&k, "two", "(x - a)^2 + y^2", "l^2");
    force(&k, "(F, -P)", "(x, y)");
    assert_true(qdot_statics_applies(k.scene) && qdot_statics_acts(k.scene));
    qdot_expr one = qdot_rate_on_motion(k.scene, k.scene->constraints.at[0].multiplier);
    qdot_expr two = qdot_statics_multiplier(k.scene, 1);
    qdot_expr x = E(&k, "2*x"), y = E(&k, "2*y"), far = E(&k, "2*(x - a)");

    must(qdot_pool_check(k.pool));
    same_at(&k, qdot_add(k.pool, qdot_mul(k.pool, one, x), qdot_mul(k.pool, two, far)), E(&k, "-F"), __LINE__);
    same_at(&k, qdot_add(k.pool, qdot_mul(k.pool, one, y), qdot_mul(k.pool, two, y)), E(&k, "P"), __LINE__);
    kit_close(&k);
}

static void
indeterminate_scenes_are_told(void **state)
{
    kit k;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    force(&k, "(0, -P)", "(x, y)");
    constraint(&k, "one", "x^2 + y^2", "l^2");
    assert_int_equal(qdot_statics_multiplier(k.scene, 0), QDOT_NIL);
    assert_int_equal(qdot_last_error()->status, QDOT_EINVAL);
    kit_close(&k);
    kit_open(&k);
    coords(&k, "x");
    constraint(&k, "one", "x", "l");
    constraint(&k, "two", "2*x", "2*l");
    assert_int_equal(qdot_statics_multiplier(k.scene, 0), QDOT_NIL);
    assert_int_equal(qdot_last_error()->status, QDOT_EINVAL);
    kit_close(&k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bars_carry_the_load),
        cmocka_unit_test(indeterminate_scenes_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
