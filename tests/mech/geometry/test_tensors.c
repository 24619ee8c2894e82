/* Covariant and Lie derivatives and commutators: the metric is constant, rotations are symmetries, so(3). */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/geometry/metric.h"
#include "mech/geometry/tensors.h"
#include "mech/kit.h"

static const char sphere[] = "dtheta^2 + sin(theta)^2*dphi^2";
static const char X[] = "(sin(phi), cot(theta)*cos(phi))", Y[] = "(cos(phi), -cot(theta)*sin(phi))";

static void
covariant_derivatives_on_the_sphere_body(kit *k)
{
    qdot_expr D, w, g;

    coords(k, "theta phi");
    D = qdot_tensors_covariant(k->scene, E(k, "(0, 1)"), E(k, sphere));
    SAME(k, qdot_entry2(k->pool, D, 1, 2), "-sin(theta)*cos(theta)");
    SAME(k, qdot_entry2(k->pool, D, 2, 1), "cot(theta)");
    w = qdot_tensors_covariant(k->scene, E(k, "sin(theta)^2*dphi"), E(k, sphere));
    SAME(k, qdot_entry2(k->pool, w, 1, 2), "-sin(theta)*cos(theta)");
    SAME(k, qdot_entry2(k->pool, w, 2, 1), "sin(theta)*cos(theta)");
    g = qdot_tensors_covariant(k->scene, qdot_mech_metric(k->scene, E(k, sphere)), E(k, sphere));
    for (uint32_t i = 0; i < 8; i++)
        assert_int_equal(qdot_expr_arg(k->pool, qdot_expr_arg(k->pool, g, i / 4), i % 4), QDOT_ZERO);
    SAME(k, qdot_entry(k->pool, qdot_tensors_covariant(k->scene, E(k, "cos(theta)*phi"), E(k, sphere)), 2), "cos(theta)");
}
TEST(covariant_derivatives_on_the_sphere)

static void
rotations_are_symmetries_of_the_sphere_body(kit *k)
{
    qdot_expr q[2], Z;

    coords(k, "theta phi");
    q[0] = E(k, "theta");
    q[1] = E(k, "phi");
    assert_int_equal(qdot_tensors_lie(k->scene, E(k, sphere), E(k, X), 2, q), QDOT_ZERO);
    SAME(k, qdot_tensors_lie(k->scene, E(k, sphere), E(k, "(1, 0)"), 2, q), "2*sin(theta)*cos(theta)*dphi^2");
    SAME(k, qdot_entry2(k->pool, qdot_tensors_lie(k->scene, qdot_mech_metric(k->scene, E(k, sphere)), E(k, "(1, 0)"), 2, q),
                        2, 2), "2*sin(theta)*cos(theta)");
    Z = qdot_tensors_commutator(k->scene, E(k, X), E(k, Y), 2, q);
    SAME(k, qdot_entry(k->pool, Z, 1), "0");
    SAME(k, qdot_entry(k->pool, Z, 2), "1");
    assert_int_equal(qdot_tensors_lie(k->scene, E(k, Y), E(k, X), 2, q), Z);
}
TEST(rotations_are_symmetries_of_the_sphere)

static void
components_that_do_not_fit_are_refused_body(kit *k)
{
    qdot_expr q[2];

    coords(k, "theta phi");
    q[0] = E(k, "theta");
    q[1] = E(k, "phi");
    assert_int_equal(qdot_tensors_commutator(k->scene, E(k, "(1, 2, 3)"), E(k, X), 2, q), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
    assert_int_equal(qdot_tensors_covariant(k->scene, E(k, "dphi^2"), E(k, sphere)), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
    assert_int_equal(qdot_tensors_covariant(k->scene, E(k, "(1, 2, 3)"), E(k, sphere)), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
}
TEST(components_that_do_not_fit_are_refused)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covariant_derivatives_on_the_sphere),
        cmocka_unit_test(rotations_are_symmetries_of_the_sphere),
        cmocka_unit_test(components_that_do_not_fit_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
