/* Distances that never change: rods of r(q), rods of constraints, points fixed in bodies. */
#include "kit.h"

#include "mech/study/rods.h"

/* Whether there is a rod between the two, of that label. */
static bool
joined(const qdot_rods *rods, qdot_expr a, qdot_expr b, const char *name)
{
    for (size_t i = 0; i < rods->n; i++) {
        const qdot_rod *r = &rods->at[i];

        if (((r->ends[0] == a && r->ends[1] == b) ||
             (r->ends[0] == b && r->ends[1] == a)) &&
            (name == NULL ? r->name == NULL
                          : r->name != NULL && strcmp(r->name, name) == 0))
            return true;
    }
    return false;
}

static qdot_rods
rods_of(kit *k)
{
    qdot_rods rods = {0};

    must(qdot_mech_rods(k->scene, &rods));
    return rods;
}

/* Bob to bob and to the pivot, once each. */
static void
double_pendulum_body(kit *k)
{
    qdot_rods rods;

    coords(k, "theta1 theta2");
    particle(k, "a", "m1", "(L1*sin(theta1), 0 - L1*cos(theta1))");
    particle(k, "b", "m2",
             "(L1*sin(theta1) + L2*sin(theta2), 0 - L1*cos(theta1) - L2*cos(theta2))");
    rods = rods_of(k);
    assert_int_equal(rods.n, 2);
    assert_true(joined(&rods, E(k, "(L1*sin(theta1), 0 - L1*cos(theta1))"),
                       E(k, "(0, 0)"), NULL));
    assert_true(joined(&rods, k->scene->particles.at[1].position,
                       k->scene->particles.at[0].position, NULL));
    qdot_free(rods.at);
}
TEST(double_pendulum)

/* An elbow that is no particle is a hinge; a support that moves by itself is one too. */
static void
elbow_body(kit *k)
{
    qdot_rods rods;

    coords(k, "theta1 theta2");
    particle(k, "b", "m",
             "(a*cos(w*t) + L1*sin(theta1) + L2*sin(theta2), "
             "0 - L1*cos(theta1) - L2*cos(theta2))");
    rods = rods_of(k);
    assert_int_equal(rods.n, 2);
    assert_true(joined(&rods, k->scene->particles.at[0].position,
                       E(k, "(a*cos(w*t) + L1*sin(theta1), 0 - L1*cos(theta1))"), NULL));
    assert_true(joined(&rods, E(k, "(a*cos(w*t) + L1*sin(theta1), 0 - L1*cos(theta1))"),
                       E(k, "(a*cos(w*t), 0)"), NULL));
    qdot_free(rods.at);
}
TEST(elbow)

/* A bob on a spring, planets, a bead that slides: no distance is constant. */
static void
no_rod_body(kit *k)
{
    qdot_rods rods;

    coords(k, "r theta x y");
    particle(k, "bob", "m", "(r*sin(theta), 0 - r*cos(theta))");
    particle(k, "free", "m", "(x, y)");
    rods = rods_of(k);
    assert_int_equal(rods.n, 0);
    qdot_free(rods.at);
}
TEST(no_rod)

/* Circles written in four ways, one about a place that nothing else names; a parabola is none. */
static void
constraints_body(kit *k)
{
    qdot_rods rods;

    coords(k, "x1 y1 x2 y2 x3 y3");
    particle(k, "a", "m", "(x1, y1)");
    particle(k, "b", "m", "(x2, y2)");
    particle(k, "c", "m", "(x3, y3)");
    constraint(k, "first", "x1^2 + y1^2", "L^2");
    constraint(k, "second", "sqrt((x2 - x1)^2 + (y2 - y1)^2)", "l");
    constraint(k, "third", "sqrt((x3 - d)^2 + (y3 - 2)^2)", "l");
    constraint(k, "bowl", "y2", "x2^2");
    constraint(k, "half", "(x3 - x2)^2/2 + (y3 - y2)^2/2 - 3", "0");
    rods = rods_of(k);
    assert_int_equal(rods.n, 4);
    assert_true(joined(&rods, E(k, "(x1, y1)"), E(k, "(0, 0)"), "first"));
    assert_true(joined(&rods, E(k, "(x2, y2)"), E(k, "(x1, y1)"), "second"));
    assert_true(joined(&rods, E(k, "(x3, y3)"), E(k, "(d, 2)"), "third"));
    assert_true(joined(&rods, E(k, "(x3, y3)"), E(k, "(x2, y2)"), "half"));
    qdot_free(rods.at);
}
TEST(constraints)

/* An ellipse is no rod; a length that time changes is none either. */
static void
near_misses_body(kit *k)
{
    qdot_rods rods;

    coords(k, "x y");
    particle(k, "a", "m", "(x, y)");
    constraint(k, "ellipse", "x^2 + 2*y^2", "1");
    constraint(k, "hoist", "x^2 + y^2", "(1 + t)^2");
    rods = rods_of(k);
    assert_int_equal(rods.n, 0);
    qdot_free(rods.at);
}
TEST(near_misses)

/* On a sphere in space: one rod to the centre, none to the foot on the axis. */
static void
spherical_body(kit *k)
{
    qdot_rods rods;

    coords(k, "theta phi");
    particle(k, "a", "m",
             "(L*sin(theta)*cos(phi), L*sin(theta)*sin(phi), 0 - L*cos(theta))");
    rods = rods_of(k);
    assert_int_equal(rods.n, 1);
    assert_true(
        joined(&rods, k->scene->particles.at[0].position, E(k, "(0, 0, 0)"), NULL));
    qdot_free(rods.at);
}
TEST(spherical)

/* The hinge of a physical pendulum, and the joint with the next; no arm to the centre itself. */
static void
arms_body(kit *k)
{
    qdot_arms arms = {0};
    qdot_expr joint;

    coords(k, "u v");
    must(declare_body(k->scene, "A", E(k, "m"), E(k, "J"), QDOT_NIL,
                      E(k, "(a*sin(u), 0 - a*cos(u))"), E(k, "u"), QDOT_NIL));
    must(declare_body(k->scene, "B", E(k, "m"), E(k, "J"), QDOT_NIL,
                      E(k, "(2*a*sin(u) + b*sin(v), 0 - 2*a*cos(u) - b*cos(v))"),
                      E(k, "v"), QDOT_NIL));
    joint = E(k, "(2*a*sin(u), 0 - 2*a*cos(u))");
    must(qdot_mech_arms(k->scene, 0, &arms));
    assert_int_equal(arms.n, 1);
    assert_int_equal(arms.at[0], E(k, "(0, 0)"));
    must(qdot_mech_arms(k->scene, 1, &arms));
    assert_int_equal(arms.n, 2);
    assert_int_equal(arms.at[1], joint);
    qdot_free(arms.at);
}
TEST(arms)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(double_pendulum),
        cmocka_unit_test(elbow),
        cmocka_unit_test(no_rod),
        cmocka_unit_test(constraints),
        cmocka_unit_test(near_misses),
        cmocka_unit_test(spherical),
        cmocka_unit_test(arms),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
