/* Scenes in which a collision is regular: which pairs there are, and that the motion is the same. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "expr/constant.h"
#include "mech/coordinates/collision.h"
#include "mech/dynamics/quantity.h"

enum { MOST = 9, MANY = 24 };

/* A scene with its accelerations, and a state of it: q, q', t as exact numbers. */
typedef struct {
    kit *k;
    size_t n;
    qdot_expr accels[MOST];
    qdot_collision_equations of;
    qdot_collision_pairs pairs;
    qdot_expr from[2 * MOST + 1], to[2 * MOST + 1];
} given;

static given
given_of(kit *k)
{
    static const int64_t parts[2 * MOST] = {-7, 11, 13, 5, 9,  8, -3, 4, 6,
                                         -7, 2,  5,  1, -2, 8, 3,  9, -4};
    given g = {.k = k, .n = k->scene->coordinates.n};
    const qdot_expr V = qdot_mech_potential(k->scene);

    for (size_t i = 0; i < g.n; i++) {
        const qdot_expr q = k->scene->coordinates.at[i];

        g.accels[i] = qdot_mech_accel(k->scene, q);
        for (uint32_t order = 0; order < 2; order++) {
            g.from[order * g.n + i] = qdot_symbol_jet(k->pool, q, order);
            g.to[order * g.n + i] = qdot_expr_ratio(k->pool, parts[order * g.n + i], 10);
        }
    }
    g.from[2 * g.n] = QDOT_T;
    g.to[2 * g.n] = qdot_expr_ratio(k->pool, 3, 7);
    must(qdot_pool_check(k->pool));
    g.of = (qdot_collision_equations){k->pool, g.n, k->scene->coordinates.at, NULL,
                                      qdot_mech_energy(k->scene)};
    must(qdot_collision_find(&g.of, 1, &V, &g.pairs));
    return g;
}

static double
number(const given *g, qdot_expr e)
{
    double x;

    must(qdot_constant_double(g->k->pool,
                            qdot_subs(g->k->pool, e, 2 * g->n + 1, g->from, g->to), &x));
    return x;
}

/* The state in the scene in s: coordinates and their rates. */
typedef struct {
    size_t n;
    qdot_expr from[2 * MANY], to[2 * MANY];
} in_s;

static double
number_in_s(const given *g, const in_s *s, qdot_expr e)
{
    return number(g, qdot_subs(g->k->pool, e, 2 * s->n, s->from, s->to));
}

static in_s
state_in_s(const given *g, const qdot_collision *c)
{
    in_s s = {.n = c->scene->coordinates.n};

    assert_in_range(s.n, 1, MANY);
    assert_int_equal(c->q0.n, s.n);
    for (size_t i = 0; i < s.n; i++) {
        s.from[i] = c->scene->coordinates.at[i];
        s.from[s.n + i] = qdot_symbol_jet(g->k->pool, s.from[i], 1);
        s.to[i] = c->q0.at[i];
        s.to[s.n + i] = c->v0.at[i];
    }
    return s;
}

/* The second derivative of a coordinate by s: L is 1/2 sum of squares, so the force on it. */
static qdot_expr
second(const qdot_collision *c, qdot_expr q)
{
    for (size_t i = 0; i < c->scene->torques.n; i++)
        if (c->scene->torques.at[i].coordinate == q)
            return c->scene->torques.at[i].torque;
    return QDOT_ZERO;
}

/* de/ds */
static qdot_expr
rate(const given *g, const qdot_collision *c, const in_s *s, qdot_expr e)
{
    qdot_pool *pool = g->k->pool;
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < s->n; i++) {
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, qdot_diff(pool, e, s->from[i]), s->from[s->n + i]));
        sum = qdot_add(
            pool, sum,
            qdot_mul(pool, qdot_diff(pool, e, s->from[s->n + i]), second(c, s->from[i])));
    }
    return sum;
}

static void
same_number(double a, double b)
{
    if (!(fabs(a - b) <= 1e-12 * fmax(1, fabs(b))))
        fail_msg("%.17g, not %.17g", a, b);
}

/* q, q', q'', t and the energy are the same, and dt = R ds; at R = 0 all equations have values. */
static void
same_motion(kit *k, size_t pairs, size_t which)
{
    given g = given_of(k);
    const qdot_collision_pair *pair = g.pairs.at + which;
    qdot_collision c;
    in_s s;
    double R;

    assert_int_equal(g.pairs.n, pairs);
    R = number(&g, pair->distance);
    g.of.accels = g.accels;
    must(qdot_collision_make(k->scene, &g.of, pair, number(&g, pair->x[0]) < 0 ? -1 : 1,
                             &c));
    if (!c.scene)
        fail_msg("%s", c.hindrance);
    s = state_in_s(&g, &c);
    for (size_t i = 0; i < g.n; i++) {
        const qdot_expr v = qdot_collision_express(&c, g.from[g.n + i]);

        same_number(number_in_s(&g, &s, qdot_collision_express(&c, g.from[i])),
                    number(&g, g.from[i]));
        same_number(number_in_s(&g, &s, v), number(&g, g.from[g.n + i]));
        same_number(number_in_s(&g, &s, rate(&g, &c, &s, v)) / R,
                    number(&g, g.accels[i]));
        same_number(number_in_s(&g, &s,
                                qdot_collision_express(
                                    &c, qdot_symbol_jet(k->pool, g.from[i], 2))),
                    number(&g, g.accels[i]));
    }
    same_number(number_in_s(&g, &s, rate(&g, &c, &s, c.time)), R);
    same_number(number_in_s(&g, &s, c.energy), number(&g, g.of.energy));
    for (size_t i = 0; i < (pair->d == 3 ? 4 : pair->d); i++)
        s.to[i] = QDOT_ZERO;
    for (size_t i = 0; i < c.scene->torques.n; i++)
        assert_true(isfinite(number_in_s(&g, &s, c.scene->torques.at[i].torque)));
    qdot_collision_clear(&c);
    qdot_free(g.pairs.at);
}

/* That pair has no regular scene. */
static void
no_scene(kit *k, size_t pairs)
{
    given g = given_of(k);
    qdot_collision c;

    assert_int_equal(g.pairs.n, pairs);
    g.of.accels = g.accels;
    for (size_t i = 0; i < pairs; i++) {
        must(qdot_collision_make(k->scene, &g.of, g.pairs.at + i, 1, &c));
        assert_null(c.scene);
        assert_true(c.hindrance[0] != '\0');
        qdot_collision_clear(&c);
    }
    qdot_free(g.pairs.at);
}

static void
potential(kit *k, const char *V)
{
    must(qdot_scene_potential(k->scene, E(k, "%s", V)));
}

static void
plane_body(kit *k)
{
    coords(k, "x y");
    particle(k, "p", "2", "(x, y)");
    potential(k, "0 - 3/sqrt(x^2 + y^2)");
    same_motion(k, 1, 0);
}
TEST(plane)

/* A field, a force that grows with time, one along the velocity, one across it. */
static void
disturbed_body(kit *k)
{
    coords(k, "y x");
    particle(k, "p", "2", "(x, y)");
    potential(k, "0 - 3/sqrt((x - 1)^2 + y^2) + x*y + y^4");
    force(k, "(t - x', t^2*x - y')", "(x, y)");
    force(k, "(3*y', 0 - 3*x')", "(x, y)");
    same_motion(k, 1, 0);
}
TEST(disturbed)

static void
space_body(kit *k)
{
    coords(k, "x y z");
    particle(k, "p", "3", "(x, y, z)");
    potential(k, "0 - 1/sqrt(x^2 + y^2 + z^2) + x*z");
    force(k, "(t - t*x', 2*z - t*y', 0 - t*z')", "(x, y, z)");
    same_motion(k, 1, 0);
}
TEST(space)

static void
crooked_body(kit *k)
{
    coords(k, "x y z");
    particle(k, "p", "3", "(x, y, z)");
    potential(k, "0 - 1/sqrt(x^2 + y^2 + z^2)");
    force(k, "(0, 2*y', 0 - 2*y)", "(x, y, z)");
    no_scene(k, 1); /* a force along one component of the velocity is not smooth there */
}
TEST(crooked)

static void
field_body(kit *k)
{
    coords(k, "y z x");
    particle(k, "p", "3", "(x, y, z)");
    potential(k, "0 - 1/sqrt(x^2 + y^2 + z^2) + x*z");
    force(k, "(t, 5*z', 0 - 5*y')", "(x, y, z)");
    same_motion(k, 1, 0);
}
TEST(field)

static void
line_body(kit *k)
{
    coords(k, "x");
    particle(k, "p", "2", "x");
    potential(k, "0 - 3/abs(x) + x^2");
    same_motion(k, 1, 0);
}
TEST(line)

static void
side_body(kit *k)
{
    coords(k, "x");
    particle(k, "p", "2", "x");
    potential(k, "3/x");
    same_motion(k, 1, 0);
}
TEST(side)

static void
two_points_body(kit *k)
{
    coords(k, "x[1] y[1] x[2] y[2]");
    particle(k, "a", "2", "(x[1], y[1])");
    particle(k, "b", "3", "(x[2], y[2])");
    potential(k, "0 - 6/sqrt((x[1] - x[2])^2 + (y[1] - y[2])^2) + x[1]*y[2]");
    same_motion(k, 1, 0);
}
TEST(two_points)

static void
three_points_body(kit *k)
{
    coords(k, "x[1] y[1] x[2] y[2] x[3] y[3]");
    particle(k, "a", "2", "(x[1], y[1])");
    particle(k, "b", "3", "(x[2], y[2])");
    particle(k, "c", "1/7", "(x[3], y[3])");
    potential(k, "0 - 6/sqrt((x[1] - x[2])^2 + (y[1] - y[2])^2)");
    potential(k, "0 - 2/7/sqrt((x[1] - x[3])^2 + (y[1] - y[3])^2)");
    potential(k, "0 - 3/7/sqrt((x[2] - x[3])^2 + (y[2] - y[3])^2)");
    for (size_t i = 0; i < 3; i++)
        same_motion(k, 3, i);
}
TEST(three_points)

static void
none_body(kit *k)
{
    coords(k, "x y");
    particle(k, "p", "2", "(x, y)");
    potential(k, "0 - 3/sqrt(x^2 + y^2 + 1/100) - 1/(x^2 + y^2) - 1/sqrt(x^2 + 2*y^2)");
    no_scene(k, 0);
}
TEST(none)

static void
steep_body(kit *k)
{
    coords(k, "x y");
    particle(k, "p", "2", "(x, y)");
    potential(k, "0 - 3/sqrt(x^2 + y^2)^3");
    no_scene(k, 1);
}
TEST(steep)

static void
repelled_body(kit *k)
{
    coords(k, "x y");
    particle(k, "p", "2", "(x, y)");
    potential(k, "3/sqrt(x^2 + y^2)");
    no_scene(k, 1);
}
TEST(repelled)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane),      cmocka_unit_test(disturbed),
        cmocka_unit_test(space),      cmocka_unit_test(field),
        cmocka_unit_test(line),       cmocka_unit_test(side),
        cmocka_unit_test(two_points), cmocka_unit_test(three_points),
        cmocka_unit_test(none),       cmocka_unit_test(steep),
        cmocka_unit_test(repelled),     cmocka_unit_test(crooked),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
