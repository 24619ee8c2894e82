/* Distances that never change: rods of r(q), rods of constraints, points fixed in bodies. */
#include "expr/build.h"
#include "mech/kit.h"

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
    must(qdot_mech_arms(k->scene, 0, &(qdot_rods){0}, &arms));
    assert_int_equal(arms.n, 1);
    assert_int_equal(arms.at[0], E(k, "(0, 0)"));
    must(qdot_mech_arms(k->scene, 1, &(qdot_rods){0}, &arms));
    assert_int_equal(arms.n, 2);
    assert_int_equal(arms.at[1], joint);
    qdot_free(arms.at);
}
TEST(arms)

/* The body NAME, free in the plane at (xNAME, yNAME), turned by uNAME. */
static void
free_body(kit *k, char name)
{
    char text[40], label[2] = {name, '\0'}, angle[3] = {'u', name, '\0'};

    snprintf(text, sizeof text, "(x%c, y%c)", name, name);
    must(declare_body(k->scene, label, E(k, "m"), E(k, "J"), QDOT_NIL, E(k, "%s", text),
                      E(k, "%s", angle), QDOT_NIL));
}

/* Of two free bodies: one rod written by its square, one by its length; one to a place in space;
 * one to a particle. The ends are arms of their bodies. */
static void
rods_between_bodies_body(kit *k)
{
    qdot_rods rods;
    qdot_arms arms = {0};

    coords(k, "xa ya ua xb yb ub xp yp");
    free_body(k, 'a');
    free_body(k, 'b');
    particle(k, "p", "m", "(xp, yp)");
    constraint(k, "ab",
               "(xa + cos(ua) - xb + 2*sin(ub))^2 + (ya + sin(ua) - yb - 2*cos(ub))^2",
               "L^2");
    constraint(k, "ba",
               "sqrt((xb + cos(ub)/2 - xa + sin(ua))^2 + (yb + sin(ub)/2 - ya - cos(ua))^2)",
               "3");
    constraint(k, "fixed", "(xa - l*cos(ua) - 5)^2 + (ya - l*sin(ua) + h)^2", "1");
    constraint(k, "hung", "(xp - xb - cos(ub))^2 + (yp - yb - sin(ub))^2 - 4", "0");
    rods = rods_of(k);
    assert_int_equal(rods.n, 4);
    assert_true(joined(&rods, E(k, "(xa + cos(ua), ya + sin(ua))"),
                       E(k, "(xb - 2*sin(ub), yb + 2*cos(ub))"), "ab"));
    assert_true(joined(&rods, E(k, "(xb + cos(ub)/2, yb + sin(ub)/2)"),
                       E(k, "(xa - sin(ua), ya + cos(ua))"), "ba"));
    assert_true(joined(&rods, E(k, "(xa - l*cos(ua), ya - l*sin(ua))"),
                       E(k, "(5, 0 - h)"), "fixed"));
    assert_true(joined(&rods, E(k, "(xb + cos(ub), yb + sin(ub))"), E(k, "(xp, yp)"), "hung"));
    must(qdot_mech_arms(k->scene, 0, &rods, &arms));
    assert_int_equal(arms.n, 3);
    assert_int_equal(arms.at[0], E(k, "(xa + cos(ua), ya + sin(ua))"));
    qdot_free(rods.at);
    qdot_free(arms.at);
}
TEST(rods_between_bodies)

/* The second body hangs on the first: they share a coordinate, but a rod holds their ends. */
static void
rod_in_a_chain_body(kit *k)
{
    qdot_rods rods;

    coords(k, "u v w");
    must(declare_body(k->scene, "A", E(k, "m"), E(k, "J"), QDOT_NIL,
                      E(k, "(cos(u), sin(u))"), E(k, "u"), QDOT_NIL));
    must(declare_body(k->scene, "B", E(k, "m"), E(k, "J"), QDOT_NIL,
                      E(k, "(2*cos(u) + cos(v), 2*sin(u) + sin(v))"), E(k, "v"), QDOT_NIL));
    must(declare_body(k->scene, "C", E(k, "m"), E(k, "J"), QDOT_NIL,
                      E(k, "(7 + cos(w), sin(w))"), E(k, "w"), QDOT_NIL));
    constraint(k, "rod",
               "(2*cos(u) + 2*cos(v) - 7 - 2*cos(w))^2 + (2*sin(u) + 2*sin(v) - 2*sin(w))^2",
               "L^2");
    rods = rods_of(k);
    assert_int_equal(rods.n, 1);
    assert_true(joined(&rods, E(k, "(2*cos(u) + 2*cos(v), 2*sin(u) + 2*sin(v))"),
                       E(k, "(7 + 2*cos(w), 2*sin(w))"), "rod"));
    qdot_free(rods.at);
}
TEST(rod_in_a_chain)

/* A weight on one square, a point that slides on its body: no rod. */
static void
no_rod_between_bodies_body(kit *k)
{
    qdot_rods rods;

    coords(k, "xa ya ua xb yb ub s");
    free_body(k, 'a');
    free_body(k, 'b');
    constraint(k, "oval",
               "(xa + cos(ua) - xb + 2*sin(ub))^2 + 2*(ya + sin(ua) - yb - 2*cos(ub))^2",
               "L^2");
    constraint(k, "slide", "(xa + s*cos(ua) - xb)^2 + (ya + s*sin(ua) - yb)^2", "L^2");
    constraint(k, "hoist", "(xa + cos(ua) - xb)^2 + (ya + sin(ua) - yb)^2", "(2 + s)^2");
    rods = rods_of(k);
    assert_int_equal(rods.n, 0);
    qdot_free(rods.at);
}
TEST(no_rod_between_bodies)

/* In space, both turned about the z axis and tilted. */
static void
rod_in_space_body(kit *k)
{
    qdot_rods rods;
    const qdot_expr one = E(k, "1");
    qdot_expr entries[9];

    coords(k, "x y z a b p q r");
    entries[0] = E(k, "cos(a)");
    entries[1] = E(k, "0 - sin(a)*cos(b)");
    entries[2] = E(k, "sin(a)*sin(b)");
    entries[3] = E(k, "sin(a)");
    entries[4] = E(k, "cos(a)*cos(b)");
    entries[5] = E(k, "0 - cos(a)*sin(b)");
    entries[6] = E(k, "0");
    entries[7] = E(k, "sin(b)");
    entries[8] = E(k, "cos(b)");
    must(declare_body(k->scene, "top", E(k, "m"),
                      qdot_matrix(k->pool, 3, 3,
                                  (qdot_expr[]){one, QDOT_ZERO, QDOT_ZERO, QDOT_ZERO, one, QDOT_ZERO,
                                               QDOT_ZERO, QDOT_ZERO, one}),
                      QDOT_NIL, E(k, "(x, y, z)"), QDOT_NIL,
                      qdot_matrix(k->pool, 3, 3, entries)));
    particle(k, "bob", "m", "(p, q, r)");
    constraint(k, "rod",
               "(p - x - sin(a)*sin(b))^2 + (q - y + cos(a)*sin(b))^2 + (r - z - cos(b))^2",
               "L^2");
    rods = rods_of(k);
    assert_int_equal(rods.n, 1);
    assert_true(joined(&rods, E(k, "(p, q, r)"),
                       E(k, "(x + sin(a)*sin(b), y - cos(a)*sin(b), z + cos(b))"), "rod"));
    qdot_free(rods.at);
}
TEST(rod_in_space)

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
        cmocka_unit_test(rods_between_bodies),
        cmocka_unit_test(rod_in_a_chain),
        cmocka_unit_test(no_rod_between_bodies),
        cmocka_unit_test(rod_in_space),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
