/* test_tangents.c -- states and directions on constraints, against closed forms. */
#include "expr/build.h"
#include "expr/exact.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/study/tangents.h"

/* x^2 + y^2 = l^2 of a particle in the plane. */
static qdot_expr
build(fixture *f)
{
    qdot_expr x, y, l;

    begin(f);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    l = set_free(f, "l");
    must(qdot_scene_particle(f->scene, "b", QDOT_ONE, pair(f, x, y)));
    must(qdot_scene_constraint(f->scene, "rod", qdot_add(f->pool, times(f, x, x), times(f, y, y)), times(f, l, l)));
    return l;
}

static void
near(double is, double wanted)
{
    if (!(fabs(is - wanted) <= 1e-14))
        fail_msg("%.17g for %.17g", is, wanted);
}

/* (0.3, 0.4) goes to the circle of radius 2.385 along its normal, (-1, 1) to its part along the tangent. */
static void
states_come_to_the_constraints(void **state)
{
    const double l = 2.385;
    double z[] = {0.3, 0.4, -1, 1}, slope[] = {0, 0, 0, 0}, turning[] = {1, 0, 0, 0}, N[16];
    qdot_tangents x = {0};
    fixture f;
    qdot_expr p = build(&f);

    (void)state;
    must(qdot_tangents_begin(&x, f.scene, &f.request, 1, &p));
    must(qdot_tangents_settle(&x, 0, &l, z));
    assert_true(fabs(hypot(z[0], z[1]) - l) < 1e-14 && fabs(z[0] * z[2] + z[1] * z[3]) < 1e-14);
    assert_int_equal(x.rank, 2);
    qdot_tangents_project(&x, 0, slope); /* by l: f_l = -2 l = -2 r.s */
    near(z[0] * slope[0] + z[1] * slope[1], l);
    near(z[2] * slope[0] + z[3] * slope[1] + z[0] * slope[2] + z[1] * slope[3], 0);
    qdot_tangents_project(&x, SIZE_MAX, turning);
    near(z[0] * turning[0] + z[1] * turning[1], 0);
    qdot_tangents_basis(&x, N);
    for (int k = 0; k < 2; k++) {
        const double *v = N + 4 * k;

        near(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3], 1);
        near(z[0] * v[0] + z[1] * v[1], 0);
        near(z[2] * v[0] + z[3] * v[1] + z[0] * v[2] + z[1] * v[3], 0);
    }
    qdot_tangents_end(&x);
    end(&f);
}

/* From the centre there is no way out. */
static void
a_state_without_a_way_is_refused(void **state)
{
    const double l = 1;
    double z[] = {0, 0, 0, 0};
    qdot_tangents x = {0};
    fixture f;
    qdot_expr p = build(&f);

    (void)state;
    must(qdot_tangents_begin(&x, f.scene, &f.request, 1, &p));
    assert_int_equal(qdot_tangents_settle(&x, 0, &l, z), QDOT_EFAILED);
    qdot_tangents_end(&x);
    end(&f);
}

/* x' + 2 y' = 0 leaves x + 2 y = const: of four directions two, with or without a third coordinate without mass whose
 * equation z - x = 0 fixes it and its velocity. */
static void
leaves_and_massless_ones_have_no_directions(void **state)
{
    double z[] = {0.3, 0.4, 0.1, -0.6, 0.3, 0.2}, N[36];
    qdot_tangents x = {0};
    qdot_expr q[3], f;
    fixture own;
    size_t count;

    (void)state;
    begin(&own);
    q[0] = coordinate(&own, "x");
    q[1] = coordinate(&own, "y");
    q[2] = coordinate(&own, "z");
    must(qdot_scene_particle(own.scene, "b", QDOT_ONE, pair(&own, q[0], q[1])));
    f = qdot_sub(own.pool, q[2], q[0]);
    must(qdot_scene_potential(own.scene, times(&own, QDOT_HALF, times(&own, f, f))));
    f = qdot_add(own.pool, velocity(&own, q[0]), times(&own, qdot_expr_int(own.pool, 2), velocity(&own, q[1])));
    must(qdot_scene_constraint(own.scene, "roll", f, QDOT_ZERO));
    must(qdot_tangents_begin(&x, own.scene, &own.request, 0, NULL));
    assert_int_equal(x.rows, 3);
    assert_int_equal(x.leaves, 1);
    must(qdot_tangents_settle(&x, 0, NULL, z));
    near(z[2] - z[0], 0);
    near(z[5] - z[3], 0);
    count = qdot_tangents_basis(&x, N);
    assert_int_equal(count, 2);
    for (size_t k = 0; k < count; k++) {
        const double *v = N + 6 * k;

        near(v[0] + 2 * v[1], 0);
        near(v[3] + 2 * v[4], 0);
        near(v[2] - v[0], 0);
        near(v[5] - v[3], 0);
    }
    assert_int_equal(x.rank, 3); /* what slopes of the start are projected by */
    qdot_tangents_end(&x);
    end(&own);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_come_to_the_constraints),
        cmocka_unit_test(a_state_without_a_way_is_refused),
        cmocka_unit_test(leaves_and_massless_ones_have_no_directions),
    };

    return cmocka_run_group_tests_name("tangents", tests, NULL, NULL);
}
