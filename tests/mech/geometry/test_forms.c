/* Forms: antisymmetry, d d = 0, Cartan's formula, the dual with its orientation and signature. */
#include "expr/build.h"
#include "expr/symbol.h"
#include "mech/geometry/forms.h"
#include "mech/geometry/tensors.h"
#include "mech/kit.h"

static qdot_expr
two_form(kit *k, const char *a, const char *b)
{
    return qdot_forms_wedge(k->scene, E(k, "%s", a), E(k, "%s", b));
}

static void
products_are_antisymmetric_body(kit *k)
{
    coords(k, "x y z");
    assert_int_equal(two_form(k, "dx", "dx"), QDOT_ZERO);
    assert_int_equal(two_form(k, "dx", "dy"), qdot_neg(k->pool, two_form(k, "dy", "dx")));
    assert_int_equal(two_form(k, "x*dx + y*dy", "y*dx - x*dy"),
                     qdot_mul(k->pool, E(k, "-x^2 - y^2"), two_form(k, "dx", "dy")));
    assert_int_equal(qdot_forms_wedge(k->scene, two_form(k, "dz", "dx"), E(k, "dy")),
                     qdot_forms_wedge(k->scene, E(k, "dx"), two_form(k, "dy", "dz")));
    assert_int_equal(two_form(k, "x", "dy"), E(k, "x*dy"));
}
TEST(products_are_antisymmetric)

static void
derivative_of_a_derivative_is_zero_body(kit *k)
{
    qdot_expr w;

    coords(k, "x y z");
    SAME(k, qdot_forms_exterior_derivative(k->scene, E(k, "x^2*sin(y)*t")),
         "2*x*sin(y)*t*dx + x^2*cos(y)*t*dy + x^2*sin(y)*dt");
    w = qdot_forms_exterior_derivative(k->scene, E(k, "x*y*z*dx + exp(x)*dy + t*dz"));
    assert_int_not_equal(w, QDOT_ZERO);
    assert_int_equal(qdot_forms_exterior_derivative(k->scene, w), QDOT_ZERO);
    w = qdot_mul(k->pool, E(k, "x*y*z"), two_form(k, "dx", "dy"));
    assert_int_equal(qdot_forms_exterior_derivative(k->scene, w),
                     qdot_mul(k->pool, E(k, "x*y"), qdot_forms_wedge(k->scene, two_form(k, "dx", "dy"), E(k, "dz"))));
}
TEST(derivative_of_a_derivative_is_zero)

static void
lie_derivative_is_cartans_body(kit *k)
{
    qdot_expr q[3], X, w;

    coords(k, "x y z");
    q[0] = E(k, "x");
    q[1] = E(k, "y");
    q[2] = E(k, "z");
    X = E(k, "(y*z, -x, x*y)");
    w = E(k, "x*y*dx + z^2*dy + sin(x)*dz");
    /* of a one-form qdot_tensors_lie goes another way */
    assert_int_equal(qdot_tensors_lie(k->scene, w, X, 3, q), qdot_forms_lie(k->scene, w, X, 3, q));
    assert_int_equal(qdot_tensors_lie(k->scene, qdot_forms_exterior_derivative(k->scene, w), X, 3, q),
                     qdot_forms_exterior_derivative(k->scene, qdot_tensors_lie(k->scene, w, X, 3, q)));
    SAME(k, qdot_forms_interior(k->scene, X, two_form(k, "dx", "dz"), 3, q), "y*z*dz - x*y*dx");
}
TEST(lie_derivative_is_cartans)

static void
dual_has_orientation_and_signature_body(kit *k)
{
    static const char flat[] = "-dt^2 + dx^2 + dy^2 + dz^2";
    qdot_expr F, all;

    coords(k, "x y z");
    all = qdot_forms_hodge(k->scene, QDOT_ONE, E(k, flat));
    assert_int_equal(all, qdot_forms_wedge(k->scene, two_form(k, "dt", "dx"), two_form(k, "dy", "dz")));
    assert_int_equal(qdot_forms_hodge(k->scene, all, E(k, flat)), QDOT_MINUS_ONE);
    F = qdot_mul(k->pool, E(k, "x*y"), two_form(k, "dt", "dx"));
    assert_int_equal(qdot_forms_hodge(k->scene, F, E(k, flat)), qdot_mul(k->pool, E(k, "-x*y"), two_form(k, "dy", "dz")));
    assert_int_equal(qdot_forms_hodge(k->scene, qdot_forms_hodge(k->scene, F, E(k, flat)), E(k, flat)), qdot_neg(k->pool, F));
    /* two oblique coordinates: *dx = sqrt(det g) (g^xx dy - g^xy dx), with det g = 1 */
    SAME(k, qdot_forms_hodge(k->scene, E(k, "dx"), E(k, "2*dx^2 + 2*dx*dy + dy^2")), "dx + dy");
}
TEST(dual_has_orientation_and_signature)

/* dx ^ dy = r dr ^ dphi, which commutes with d. */
static void
pullback_replaces_differentials_body(kit *k)
{
    qdot_expr q[2], to[2], w, dx;

    coords(k, "x y r phi");
    q[0] = E(k, "x");
    q[1] = E(k, "y");
    to[0] = E(k, "r*cos(phi)");
    to[1] = E(k, "r*sin(phi)");
    assert_int_equal(qdot_forms_pullback(k->scene, two_form(k, "dx", "dy"), 2, q, to), qdot_mul(k->pool, E(k, "r"), two_form(k, "dr", "dphi")));
    SAME(k, qdot_forms_pullback(k->scene, E(k, "dx^2 + dy^2"), 2, q, to), "dr^2 + r^2*dphi^2");
    w = E(k, "x*y^2*dx");
    assert_int_equal(qdot_forms_pullback(k->scene, qdot_forms_exterior_derivative(k->scene, w), 2, q, to),
                     qdot_forms_exterior_derivative(k->scene, qdot_forms_pullback(k->scene, w, 2, q, to)));
    dx = E(k, "dx");
    w = E(k, "dy");
    assert_int_equal(qdot_forms_subs(k->scene, two_form(k, "dx", "dy"), 1, &dx, &w), QDOT_ZERO);
    assert_int_equal(qdot_forms_subs(k->scene, two_form(k, "dr", "dy"), 1, &dx, &w), two_form(k, "dr", "dy"));
}
TEST(pullback_replaces_differentials)

static void
what_is_no_form_is_refused_body(kit *k)
{
    static const char *const wrong[] = {"dx*dy", "1 + dx", "(1, 2)"};

    coords(k, "x y");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(qdot_forms_exterior_derivative(k->scene, E(k, "%s", wrong[i])), QDOT_NIL);
        assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
    }
    assert_int_equal(qdot_forms_hodge(k->scene, E(k, "dt"), E(k, "dx^2 + dy^2")), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_EINVAL);
    assert_int_equal(qdot_forms_interior(k->scene, E(k, "(1, 2, 3)"), E(k, "dx"), 2, (qdot_expr[]){E(k, "x"), E(k, "y")}),
                     QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
}
TEST(what_is_no_form_is_refused)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_are_antisymmetric),
        cmocka_unit_test(derivative_of_a_derivative_is_zero),
        cmocka_unit_test(lie_derivative_is_cartans),
        cmocka_unit_test(dual_has_orientation_and_signature),
        cmocka_unit_test(pullback_replaces_differentials),
        cmocka_unit_test(what_is_no_form_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
