/* Scenes in other coordinates: which there are, and that the motion is the same in them. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "expr/constant.h"
#include "mech/coordinates/chart.h"
#include "mech/dynamics/quantity.h"

enum { MOST = 6 };

/* q, q', q'' of the scene given, as exact numbers. */
typedef struct {
    size_t n;
    qdot_expr from[3 * MOST], to[3 * MOST];
    double number[3 * MOST];
} state;

static state
state_of(kit *k)
{
    static const int64_t parts[3 * MOST] = {7,  11, 13, 5, 9,  8, -3, 4, 6,
                                         -7, 2,  5,  1, -2, 8, 3,  9, -4};
    state s = {.n = k->scene->coordinates.n};

    for (size_t order = 0; order < 3; order++)
        for (size_t i = 0; i < s.n; i++) {
            const size_t at = order * s.n + i;

            s.from[at] =
                qdot_symbol_jet(k->pool, k->scene->coordinates.at[i], (uint32_t)order);
            s.to[at] = qdot_expr_ratio(k->pool, parts[at], 10);
            s.number[at] = (double)parts[at] / 10;
        }
    return s;
}

static double
number(kit *k, const state *s, qdot_expr e)
{
    double x;

    must(
        qdot_constant_double(k->pool, qdot_subs(k->pool, e, 3 * s->n, s->from, s->to), &x));
    return x;
}

/* The same e in the coordinates of the chart, these being as given. */
static double
number_in_chart(kit *k, const state *s, const qdot_chart *c, qdot_expr e)
{
    qdot_expr from[3 * MOST], to[3 * MOST];
    size_t n = 0;

    for (size_t i = 0; i < c->fresh.n; i++) {
        qdot_expr given = c->fresh.at[i].given;

        for (uint32_t order = 0; order < 3; order++) {
            from[n] = qdot_symbol_jet(k->pool, c->fresh.at[i].q, order);
            to[n++] = given;
            given = qdot_ddt(k->pool, given);
        }
    }
    return number(k, s, qdot_subs(k->pool, e, n, from, to));
}

static void
same_number(double a, double b)
{
    if (!(fabs(a - b) <= 1e-12 * fmax(1, fabs(b))))
        fail_msg("%.17g, not %.17g", a, b);
}

static qdot_chart_groups
groups_of(kit *k)
{
    qdot_chart_groups groups = {0};

    must(qdot_chart_find(k->scene, false, &groups));
    return groups;
}

/* One group of that kind; T and V and all coordinates are the same in its chart. */
static void
same_motion(kit *k, qdot_chart_kind kind)
{
    qdot_chart_groups groups = groups_of(k);
    const state s = state_of(k);
    qdot_chart c = {0};
    qdot_expr h;

    assert_int_equal(groups.n, 1);
    assert_int_equal(groups.at[0].kind, kind);
    must(qdot_chart_make(k->scene, &groups, NULL, false, &c));
    assert_non_null(c.scene);
    h = qdot_mech_energy(k->scene);
    same_number(number_in_chart(k, &s, &c, qdot_mech_energy(c.scene)), number(k, &s, h));
    for (size_t i = 0; i < 3 * s.n; i++) {
        int64_t quarters[3 * MOST] = {0};
        bool turns;

        for (size_t j = 0; j < c.moved.n;
             j++) /* two quarters off, less than half a turn */
            if (c.moved.at[j].bare != QDOT_NIL)
                quarters[j] = llround(number(k, &s, c.moved.at[j].given) / 1.5707963267948966)
                              + (int64_t)(i % 3) - 1;
        for (size_t j = 0; j < c.signs.n; j++)
            quarters[c.moved.n + j] = 1;
        same_number(number_in_chart(k, &s, &c,
                                    qdot_chart_express(&c, s.from[i], quarters, &turns)),
                    s.number[i]);
    }
    qdot_chart_clear(&c);
    qdot_free(groups.at);
}

static void
plane_body(kit *k)
{
    coords(k, "r phi");
    particle(k, "p", "2", "(r*cos(phi), r*sin(phi))");
    gravity(k, "(0, 0 - 9)");
    same_motion(k, QDOT_CHART_PLANE);
}
TEST(plane)

static void
cylinder_body(kit *k)
{
    coords(k, "z phi r");
    particle(k, "p", "3", "(r*cos(phi), r*sin(phi), z)");
    must(qdot_scene_potential(k->scene, E(k, "0 - 1/sqrt(r^2 + z^2)")));
    same_motion(k, QDOT_CHART_PLANE);
}
TEST(cylinder)

static void
space_body(kit *k)
{
    coords(k, "r theta phi");
    particle(k, "p", "3", "(r*sin(theta)*cos(phi), r*sin(theta)*sin(phi), r*cos(theta))");
    must(qdot_scene_potential(k->scene,
                              E(k, "0 - 1/r + r*sin(theta)*cos(2*phi)*r*sin(theta)")));
    same_motion(k, QDOT_CHART_SPACE);
}
TEST(space)

static void
sphere_body(kit *k)
{
    coords(k, "theta phi");
    particle(k, "p", "3",
             "(2*sin(theta)*cos(phi), 2*sin(theta)*sin(phi), 0 - 2*cos(theta))");
    gravity(k, "(0, 0, 0 - 9)");
    must(qdot_scene_potential(k->scene,
                              E(k, "sin(theta)^2*sin(2*phi + 1) + tan(theta)^2")));
    same_motion(k, QDOT_CHART_SPHERE);
}
TEST(sphere)

static void
body_body(kit *k)
{
    qdot_expr q[3], moments[3] = {E(k, "1"), E(k, "12/10"), E(k, "7/10")};

    coords(k, "phi theta psi");
    for (size_t i = 0; i < 3; i++)
        q[i] = k->scene->coordinates.at[i];
    must(declare_body(k->scene, "b", E(k, "2"), qdot_vector(k->pool, 3, moments),
                      QDOT_NIL,
                      E(k, "(sin(theta)*sin(phi), 0 - sin(theta)*cos(phi), cos(theta))"),
                      QDOT_NIL, qdot_scene_euler(k->pool, q[0], q[1], q[2])));
    gravity(k, "(0, 0, 0 - 9)");
    same_motion(k, QDOT_CHART_BODY);
}
TEST(body)

/* A body whose axes are not its principal ones. */
static void
tilted_body(kit *k)
{
    const qdot_expr I[] = {E(k, "1"),        E(k, "0 - 1/10"), E(k, "0"),
                           E(k, "0 - 1/10"), E(k, "12/10"),    E(k, "0"),
                           E(k, "0"),        E(k, "0"),        E(k, "7/10")};
    qdot_expr q[3];

    coords(k, "phi theta psi");
    for (size_t i = 0; i < 3; i++)
        q[i] = k->scene->coordinates.at[i];
    must(declare_body(k->scene, "b", E(k, "2"), qdot_matrix(k->pool, 3, 3, I), QDOT_NIL,
                      E(k, "(0, 0, 0)"), QDOT_NIL,
                      qdot_scene_euler(k->pool, q[0], q[1], q[2])));
    same_motion(k, QDOT_CHART_BODY);
}
TEST(tilted)

/* --- other groups ---------------------------------------------------------------------------- */

static void
latitude_body(kit *k)
{
    coords(k, "b phi");
    particle(k, "p", "3", "(2*cos(b)*cos(phi), 2*cos(b)*sin(phi), 2*sin(b))");
    gravity(k, "(0, 0, 0 - 9)");
    same_motion(k, QDOT_CHART_SPHERE);
}
TEST(latitude)

static void
parabolic_body(kit *k)
{
    coords(k, "xi eta");
    particle(k, "p", "3", "(xi*eta, (xi^2 - eta^2)/2)");
    gravity(k, "(0, 0 - 9)");
    must(qdot_scene_potential(k->scene, E(k, "(xi^2 + eta^2)^2 + xi^3*eta^3")));
    same_motion(k, QDOT_CHART_PARABOLIC);
}
TEST(parabolic)

static void
paraboloids_body(kit *k)
{
    coords(k, "xi eta phi");
    particle(k, "p", "3", "(xi*eta*cos(phi), xi*eta*sin(phi), (xi^2 - eta^2)/2)");
    must(qdot_scene_potential(k->scene, E(k, "(xi^2 + eta^2)^2 + xi*eta*cos(phi)")));
    same_motion(k, QDOT_CHART_PARABOLOIDS);
}
TEST(paraboloids)

static void
elliptic_body(kit *k)
{
    coords(k, "u v");
    particle(k, "p", "3", "(2*cosh(u)*cos(v), 2*sinh(u)*sin(v))");
    must(qdot_scene_potential(k->scene,
                              E(k, "cosh(u)^2 - sin(v)^2 + (sinh(u)^2 + sin(v)^2)^2")));
    same_motion(k, QDOT_CHART_ELLIPTIC);
}
TEST(elliptic)

static void
turned_elliptic_body(kit *k)
{
    coords(k, "v u");
    particle(k, "p", "3", "(2*cosh(u)*sin(v), 2*sinh(u)*cos(v))");
    gravity(k, "(0, 0 - 9)");
    same_motion(k, QDOT_CHART_ELLIPTIC);
}
TEST(turned_elliptic)

static void
prolate_body(kit *k)
{
    coords(k, "u v phi");
    particle(k, "p", "3",
             "(sinh(u)*sin(v)*cos(phi), sinh(u)*sin(v)*sin(phi), cosh(u)*cos(v))");
    gravity(k, "(0, 0, 0 - 9)");
    same_motion(k, QDOT_CHART_PROLATE);
}
TEST(prolate)

static void
oblate_body(kit *k)
{
    coords(k, "u v phi");
    particle(k, "p", "3",
             "(cosh(u)*cos(v)*cos(phi), cosh(u)*cos(v)*sin(phi), sinh(u)*sin(v))");
    must(qdot_scene_potential(k->scene, E(k, "cosh(u)^2 - sin(v)^2")));
    same_motion(k, QDOT_CHART_OBLATE);
}
TEST(oblate)

static void
root_body(kit *k)
{
    coords(k, "phi x");
    particle(k, "p", "3", "(4 + x, 0 - 2*sqrt(9 - x^2), phi)");
    gravity(k, "(0, 0 - 9, 0)");
    same_motion(k, QDOT_CHART_ROOT);
}
TEST(root)

/* Constraints go along, with their names and multipliers. */
static void
constrained_body(kit *k)
{
    coords(k, "r phi z");
    particle(k, "p", "3", "(r*cos(phi), r*sin(phi), z)");
    must(qdot_scene_constraint(k->scene, "cup", E(k, "z"), E(k, "r^2*cos(phi)^2 + 2*r^2")));
    same_motion(k, QDOT_CHART_PLANE);
    must(qdot_scene_constraint(k->scene, "ring", E(k, "r"), E(k, "1 + z")));
    {
        qdot_chart_groups groups = groups_of(k);

        assert_int_equal(groups.n, 0);
        qdot_free(groups.at);
    }
}
TEST(constrained)

static size_t
count_groups(kit *k)
{
    qdot_chart_groups groups = groups_of(k);

    qdot_free(groups.at);
    return groups.n;
}

/* A kink, or a force on a coordinate itself, is left where it is. */
static void
no_chart_body(kit *k)
{
    coords(k, "theta phi");
    particle(k, "p", "3",
             "(2*sin(theta)*cos(phi), 2*sin(theta)*sin(phi), 0 - 2*cos(theta))");
    assert_int_equal(count_groups(k), 1);
    must(qdot_scene_potential(k->scene, E(k, "theta")));
    assert_int_equal(count_groups(k), 0);
    must(qdot_scene_remove_at(k->scene, QDOT_POTENTIAL, 0));
    must(qdot_scene_potential(k->scene, E(k, "sin(theta)*cos(2*phi)")));
    assert_int_equal(count_groups(k), 0);
    must(qdot_scene_remove_at(k->scene, QDOT_POTENTIAL, 0));
    torque(k, "1", "phi");
    assert_int_equal(count_groups(k), 0);
}
TEST(no_chart)

static void
collision_body(kit *k)
{
    coords(k, "r phi");
    particle(k, "p", "3", "(r*cos(phi), r*sin(phi))");
    must(qdot_scene_potential(k->scene, E(k, "0 - 1/r")));
    assert_int_equal(count_groups(k), 0);
}
TEST(collision)

/* Two pendulums, each on a sphere of its own. */
static void
two_groups_body(kit *k)
{
    qdot_chart_groups groups;

    coords(k, "a phi b psi");
    particle(k, "p", "3", "(sin(a)*cos(phi), sin(a)*sin(phi), 0 - cos(a))");
    particle(k, "q", "3",
             "(sin(a)*cos(phi) + sin(b)*cos(psi), sin(a)*sin(phi) + sin(b)*sin(psi), 0 - "
             "cos(a) - "
             "cos(b))");
    groups = groups_of(k);
    assert_int_equal(groups.n, 2);
    assert_int_equal(groups.at[0].kind, QDOT_CHART_SPHERE);
    assert_int_equal(groups.at[1].kind, QDOT_CHART_SPHERE);
    assert_int_equal(groups.at[0].index[1], 1);
    assert_int_equal(groups.at[1].index[0], 2);
    qdot_free(groups.at);
}
TEST(two_groups)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane),      cmocka_unit_test(cylinder),
        cmocka_unit_test(space),      cmocka_unit_test(sphere),
        cmocka_unit_test(body),       cmocka_unit_test(tilted),
        cmocka_unit_test(no_chart),   cmocka_unit_test(collision),
        cmocka_unit_test(two_groups), cmocka_unit_test(latitude),
        cmocka_unit_test(parabolic),  cmocka_unit_test(paraboloids),
        cmocka_unit_test(elliptic),   cmocka_unit_test(turned_elliptic),
        cmocka_unit_test(prolate),    cmocka_unit_test(oblate),
        cmocka_unit_test(root),       cmocka_unit_test(constrained),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
