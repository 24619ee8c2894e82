/* Geometry and the vector operators, each against a formula of the books and, for the operators,
 * against the same field in Cartesian coordinates. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/geometry/geometry.h"
#include "mech/geometry/metric.h"

static qdot_expr
curvature(kit *k, const char *R)
{
    return qdot_geometry_scalar_curvature(k->scene, E(k, "%s", R));
}

static void
curvature_of_surfaces_body(kit *k)
{
    coords(k, "u v r>0 phi theta x y>0");
    SAME(k, curvature(k, "(R*sin(u)*cos(v), R*sin(u)*sin(v), R*cos(u))"), "2/R^2");
    SAME(k, curvature(k, "((b + a*cos(u))*cos(v), (b + a*cos(u))*sin(v), a*sin(u))"),
         "2*cos(u)/(a*(b + a*cos(u)))");
    SAME(k, curvature(k, "(a*cosh(v)*cos(u), a*cosh(v)*sin(u), a*v)"),
         "-2/(a^2*cosh(v)^4)");
    SAME(k, curvature(k, "(v*cos(u), v*sin(u), a*u)"), "-2*a^2/(v^2 + a^2)^2");
    SAME(k, curvature(k, "(r*cos(phi), r*sin(phi), a)"), "0");
    SAME(k, curvature(k, "dr^2 + sinh(r)^2*dphi^2"), "-2");
    SAME(k, curvature(k, "(dx^2 + dy^2)/y^2"), "-2");
    SAME(k, curvature(k, "R^2*(dtheta^2 + sin(theta)^2*(dphi^2 + sin(phi)^2*du^2))"),
         "6/R^2");
}
TEST(curvature_of_surfaces)

static void
connection_of_the_sphere_body(kit *k)
{
    qdot_expr S, G, R4, geodesic;

    coords(k, "theta phi");
    S = E(k, "(R*sin(theta)*cos(phi), R*sin(theta)*sin(phi), R*cos(theta))");
    G = qdot_geometry_christoffel(k->scene, S);
    must(qdot_pool_check(k->pool));
    SAME(k, qdot_entry2(k->pool, qdot_entry(k->pool, G, 1), 2, 2),
         "-sin(theta)*cos(theta)");
    SAME(k, qdot_entry2(k->pool, qdot_entry(k->pool, G, 2), 1, 2), "cot(theta)");
    R4 = qdot_geometry_riemann(k->scene, S);
    SAME(k,
         qdot_entry2(k->pool, qdot_entry(k->pool, qdot_entry(k->pool, R4, 1), 2), 1, 2),
         "sin(theta)^2");
    SAME(k, qdot_entry2(k->pool, qdot_geometry_ricci(k->scene, S), 2, 2), "sin(theta)^2");
    geodesic = qdot_geometry_geodesic(k->scene, S);
    SAME(k, lhs(k, qdot_entry(k->pool, geodesic, 2)), "phi'' + 2*cot(theta)*theta'*phi'");
}
TEST(connection_of_the_sphere)

/* Schwarzschild, and a sphere of three dimensions: constant curvature, so no Weyl tensor. */
static void
curvature_of_spacetimes_body(kit *k)
{
    const char *hole = "-(1 - 2*M/r)*dt^2 + dr^2/(1 - 2*M/r) + r^2*(dtheta^2 + sin(theta)^2*dphi^2)";
    const char *ball = "du^2 + sin(u)^2*(dtheta^2 + sin(theta)^2*dphi^2)";
    qdot_expr W, e;

    coords(k, "u r>0 theta phi");
    SAME(k, qdot_geometry_kretschmann(k->scene, E(k, "%s", hole)), "48*M^2/r^6");
    W = qdot_geometry_weyl(k->scene, E(k, "%s", hole));
    SAME(k, qdot_entry2(k->pool, qdot_entry(k->pool, qdot_entry(k->pool, W, 1), 2), 1, 2), "2*M/(r^2*(r - 2*M))");
    SAME(k, qdot_entry2(k->pool, qdot_entry(k->pool, qdot_entry(k->pool, W, 1), 2), 2, 1), "-2*M/(r^2*(r - 2*M))");
    e = qdot_geometry_geodesic(k->scene, E(k, "%s", hole));
    assert_int_equal(qdot_expr_count(k->pool, e), 4);
    SAME(k, qdot_geometry_kretschmann(k->scene, E(k, "%s", ball)), "12");
    W = qdot_geometry_weyl(k->scene, E(k, "%s", ball));
    SAME(k, qdot_entry2(k->pool, qdot_entry(k->pool, qdot_entry(k->pool, W, 1), 2), 1, 2), "0");
    e = qdot_geometry_einstein(k->scene, E(k, "%s", ball));
    SAME(k, qdot_entry2(k->pool, e, 2, 2), "-sin(u)^2");
    assert_int_equal(qdot_geometry_weyl(k->scene, E(k, "dtheta^2 + sin(theta)^2*dphi^2")), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
}
TEST(curvature_of_spacetimes)

/* A metric that is not diagonal has an inverse too: a plane in oblique coordinates is flat, and so
 * is one whose coordinates bend. */
static void
flat_however_it_is_written_body(kit *k)
{
    coords(k, "u v");
    SAME(k, curvature(k, "(u + v*cos(a), v*sin(a))"), "0");
    SAME(k, curvature(k, "(u + v^2, v + u*v)"), "0");
}
TEST(flat_however_it_is_written)

/* Coordinates of space, all orthogonal. */
static const struct {
    const char *names, *R;
} systems[] = {
    {"r>0 phi z", "(r*cos(phi), r*sin(phi), z)"},
    {"r>0 theta phi", "(r*sin(theta)*cos(phi), r*sin(theta)*sin(phi), r*cos(theta))"},
    {"u>0 v>0 phi", "(u*v*cos(phi), u*v*sin(phi), (u^2 - v^2)/2)"},
    {"u>0 theta phi", "(a*sinh(u)*sin(theta)*cos(phi), a*sinh(u)*sin(theta)*sin(phi), "
                      "a*cosh(u)*cos(theta))"},
    {"u>0 theta phi", "(a*cosh(u)*sin(theta)*cos(phi), a*cosh(u)*sin(theta)*sin(phi), "
                      "a*sinh(u)*cos(theta))"},
    {"u>0 v phi",
     "(a*sinh(u)*cos(phi)/(cosh(u) - cos(v)), a*sinh(u)*sin(phi)/(cosh(u) - cos(v)), "
     "a*sin(v)/(cosh(u) - cos(v)))"},
};

/* The coordinates of a system; theta between 0 and pi. */
static void
open_system(kit *k, const char *names)
{
    qdot_expr theta;

    kit_open(k);
    theta = qdot_symbol_get(k->pool, QDOT_COORD, "theta");
    qdot_symbol_domain(k->pool, theta, QDOT_ZERO, true, QDOT_PI, true);
    coords(k, names);
}

/* Of f = x^2 z + y^3 the Laplacian is 2 z + 6 y whatever the coordinates. */
static void
laplacian_is_that_of_space(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        kit k_, *k = &k_;
        qdot_expr R, x, y, z, f, want;

        open_system(k, systems[i].names);
        R = E(k, "%s", systems[i].R);
        x = qdot_entry(k->pool, R, 1);
        y = qdot_entry(k->pool, R, 2);
        z = qdot_entry(k->pool, R, 3);
        f = qdot_add(k->pool, qdot_mul(k->pool, qdot_mul(k->pool, x, x), z),
                     qdot_pow_int(k->pool, y, 3));
        want = qdot_add(k->pool, qdot_mul(k->pool, qdot_expr_int(k->pool, 2), z),
                        qdot_mul(k->pool, qdot_expr_int(k->pool, 6), y));
        same_at(k, qdot_geometry_laplacian(k->scene, f, R), want, (int)i);
        must(qdot_pool_check(k->pool));
        kit_close(k);
    }
}

/* F = (-y, x, z^2) of space has divergence 2 z and curl (0, 0, 2): taken into the frame and there
 * differentiated. (Not the last system: the scale factors in its frame are absolute values.) */
static void
divergence_and_curl_are_those_of_space(void **state)
{
    (void)state;
    for (size_t i = 0; i + 1 < sizeof systems / sizeof *systems; i++) {
        kit k_, *k = &k_;
        qdot_expr R, field, axis, parts[3], want[3], over, h, F, curl;

        open_system(k, systems[i].names);
        R = E(k, "%s", systems[i].R);
        field = qdot_vector(
            k->pool, 3,
            (qdot_expr[]){qdot_neg(k->pool, qdot_entry(k->pool, R, 2)),
                          qdot_entry(k->pool, R, 1),
                          qdot_pow_int(k->pool, qdot_entry(k->pool, R, 3), 2)});
        axis = E(k, "(0, 0, 2)");
        over = qdot_mech_metric_coordinates(k->scene, R);
        h = qdot_geometry_scale_factors(k->scene, R);
        for (uint32_t q = 0; q < 3; q++) {
            qdot_expr e = qdot_diff(k->pool, R, qdot_expr_arg(k->pool, over, q));

            e = qdot_value_div(k->pool, e, qdot_expr_arg(k->pool, h, q));
            parts[q] = qdot_dot(k->pool, field, e);
            want[q] = qdot_dot(k->pool, axis, e);
        }
        F = qdot_vector(k->pool, 3, parts);
        same_at(k, qdot_geometry_divergence(k->scene, F, R),
                qdot_mul(k->pool, qdot_expr_int(k->pool, 2), qdot_entry(k->pool, R, 3)),
                (int)i);
        curl = qdot_geometry_curl(k->scene, F, R);
        for (uint32_t q = 0; q < 3; q++)
            same_at(k, qdot_expr_arg(k->pool, curl, q), want[q], (int)(10 * i + q));
        kit_close(k);
    }
}

static void
operators_of_the_books_body(kit *k)
{
    qdot_expr polar, grad;

    coords(k, "r>0 theta z");
    function(k, "f", "r, theta");
    polar = E(k, "(r*cos(theta), r*sin(theta))");
    SAME(k, qdot_geometry_laplacian(k->scene, E(k, "f(r, theta)"), polar),
         "diff(diff(f(r, theta), r), r) + diff(f(r, theta), r)/r + "
         "diff(diff(f(r, theta), theta), theta)/r^2");
    grad = qdot_geometry_gradient(k->scene, E(k, "f(r, theta)"), polar);
    SAME(k, qdot_entry(k->pool, grad, 2), "diff(f(r, theta), theta)/r");
    SAME(k, qdot_geometry_curl(k->scene, E(k, "(0, r)"), polar), "2");
    SAME(k, qdot_geometry_volume_element(k->scene, polar), "r");
}
TEST(operators_of_the_books)

/* The same turning field, the frame left-handed because the coordinates stand the other way round:
 * the curl is still +2 along z. */
static void
curl_knows_the_hand_of_the_frame_body(kit *k)
{
    qdot_expr R, curl;

    coords(k, "theta r>0 z");
    R = E(k, "(r*cos(theta), r*sin(theta), z)");
    curl = qdot_geometry_curl(k->scene, E(k, "(r, 0, 0)"), R);
    SAME(k, qdot_entry(k->pool, curl, 3), "2");
    R = E(k, "(r*cos(theta), r*sin(theta))");
    SAME(k, qdot_geometry_curl(k->scene, E(k, "(r, 0)"), R), "2");
}
TEST(curl_knows_the_hand_of_the_frame)

static void
refuse(kit *k, qdot_expr e, qdot_status status, const char *words)
{
    assert_int_equal(e, QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), status);
    if (strstr(qdot_last_error()->message, words) == NULL)
        fail_msg("%s", qdot_last_error()->message);
}

/* In oblique coordinates u, v of the plane: u = x - y cot a, along the unit vectors (1, 0) and (cos a, sin a). */
static void
operators_where_coordinates_are_oblique_body(kit *k)
{
    const char *skew = "(u + v*cos(a), v*sin(a))";
    qdot_expr slope;

    coords(k, "u v");
    slope = qdot_geometry_gradient(k->scene, E(k, "u"), E(k, "%s", skew));
    SAME(k, qdot_entry(k->pool, slope, 1), "1/sin(a)^2");
    SAME(k, qdot_entry(k->pool, slope, 2), "-cos(a)/sin(a)^2");
    SAME(k, qdot_geometry_laplacian(k->scene, E(k, "u^2 + v^2"), E(k, "%s", skew)), "4/sin(a)^2");
    SAME(k, qdot_geometry_divergence(k->scene, E(k, "(u, u^2 + v)"), E(k, "%s", skew)), "2");
    SAME(k, qdot_geometry_curl(k->scene, E(k, "(v*sin(a), 0)"), E(k, "%s", skew)), "-1");
}
TEST(operators_where_coordinates_are_oblique)

static void
what_cannot_be_is_refused_body(kit *k)
{
    coords(k, "u v");
    refuse(k, qdot_geometry_divergence(k->scene, E(k, "(1, 2, 3)"), E(k, "(u, v)")),
           QDOT_ETYPE, "2 components");
    refuse(k, qdot_geometry_christoffel(k->scene, E(k, "(u + v, u + v)")), QDOT_EDOMAIN,
           "singular");
    refuse(k, qdot_geometry_gradient(k->scene, E(k, "(u, v)"), E(k, "(u, v)")),
           QDOT_ETYPE, "scalar");
    refuse(k, qdot_geometry_curl(k->scene, E(k, "u"), E(k, "u")), QDOT_ETYPE, "2 or 3");
}
TEST(what_cannot_be_is_refused)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curvature_of_surfaces),
        cmocka_unit_test(connection_of_the_sphere),
        cmocka_unit_test(curvature_of_spacetimes),
        cmocka_unit_test(flat_however_it_is_written),
        cmocka_unit_test(laplacian_is_that_of_space),
        cmocka_unit_test(divergence_and_curl_are_those_of_space),
        cmocka_unit_test(operators_of_the_books),
        cmocka_unit_test(curl_knows_the_hand_of_the_frame),
        cmocka_unit_test(operators_where_coordinates_are_oblique),
        cmocka_unit_test(what_cannot_be_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
