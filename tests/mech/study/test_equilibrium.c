/* Equilibria and the modes about them. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/dynamics/generic.h"
#include "mech/dynamics/quantity.h"
#include "mech/study/equilibrium.h"
#include "mech/linear/modes.h"
#include "normal/solve/isolate.h"

static void
find(kit *k, qdot_equilibria *r, size_t n)
{
    must(qdot_equilibrium_find(k->scene, NULL, NULL, r));
    if (r->n != n)
        fail_msg("%zu equilibria, not %zu, the first %s", r->n, n,
                 r->n > 0 ? show(k, r->at[0].equations) : "none");
    /* the other way round: the equations of motion hold there */
    for (size_t i = 0; i < r->n; i++)
        for (size_t j = 0; j < k->scene->coordinates.n; j++) {
            qdot_expr e = qdot_mech_equation(k->scene, k->scene->coordinates.at[j]);

            e = qdot_sub(k->pool, lhs(k, e), rhs(k, e));
            for (size_t q = 0; q < k->scene->coordinates.n; q++)
                for (uint32_t order = 1; order < 3; order++) {
                    qdot_expr jet =
                        qdot_symbol_jet(k->pool, k->scene->coordinates.at[q], order);

                    e = qdot_subs(k->pool, e, 1, &jet, (qdot_expr[]){QDOT_ZERO});
                }
            for (uint32_t u = 0; u < qdot_expr_count(k->pool, r->at[i].equations);
                 u++) {
                qdot_expr one = qdot_expr_arg(k->pool, r->at[i].equations, u);
                qdot_expr from = lhs(k, one), to = rhs(k, one);

                e = qdot_subs(k->pool, e, 1, &from, &to);
            }
            if (!r->at[i].numeric)
                same_at(k, e, QDOT_ZERO, (int)i);
        }
}

static void
is(kit *k, const qdot_equilibrium *e, const char *equations, qdot_stability stability,
   const char *when, const char *exists)
{
    assert_string_equal(show(k, e->equations), equations);
    assert_int_equal(e->stability, stability);
    assert_string_equal(show(k, e->stable_when), when);
    assert_string_equal(show(k, e->exists), exists);
}

/* Seed row 17: a bead on a hoop that turns. */
static void
rotating_hoop_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "theta");
    particle(k, "bead", "m",
             "(R*sin(theta)*cos(W*t), R*sin(theta)*sin(W*t), -R*cos(theta))");
    gravity(k, "(0, 0, -g)");
    find(k, &r, 4);
    is(k, &r.at[0], "[theta = 0]", QDOT_STABLE, "[R*W^2 < g]", "nil");
    is(k, &r.at[1], "[theta = pi]", QDOT_UNSTABLE, "nil", "nil");
    is(k, &r.at[2], "[theta = acos(g/(R*W^2))]", QDOT_STABLE, "nil", "[g < R*W^2]");
    is(k, &r.at[3], "[theta = -acos(g/(R*W^2))]", QDOT_STABLE, "nil", "[g < R*W^2]");
    qdot_equilibria_clear(&r);
}
TEST(rotating_hoop)

static void
multipliers_are_included_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x y");
    particle(k, "bob", "m", "(x, y)");
    gravity(k, "(0, -g)");
    constraint(k, "rod", "x^2 + y^2", "L^2");
    find(k, &r, 2);
    is(k, &r.at[0], "[x = 0, y = -L, lambda[rod] = -1/2*m*g/L]", QDOT_STABLE, "nil",
       "nil");
    is(k, &r.at[1], "[x = 0, y = L, lambda[rod] = 1/2*m*g/L]", QDOT_UNSTABLE, "nil",
       "nil");
    qdot_equilibria_clear(&r);
}
TEST(multipliers_are_included)

static void
double_pendulum(kit *k)
{
    coords(k, "u v");
    particle(k, "a", "m", "(l*sin(u), -l*cos(u))");
    particle(k, "b", "m", "(l*sin(u) + l*sin(v), -l*cos(u) - l*cos(v))");
    gravity(k, "(0, -g)");
}

static void
every_combination_body(kit *k)
{
    qdot_equilibria r;

    double_pendulum(k);
    find(k, &r, 4);
    is(k, &r.at[0], "[u = 0, v = 0]", QDOT_STABLE, "nil", "nil");
    for (int i = 1; i < 4; i++)
        assert_int_equal(r.at[i].stability, QDOT_UNSTABLE);
    qdot_equilibria_clear(&r);
}
TEST(every_combination)

/* Kelvin: two saddles made a stable one by a strong enough gyroscopic term. */
static void
gyroscopic_stabilisation_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x y");
    must(qdot_scene_lagrangian(
        k->scene, E(k, "m*(x'^2 + y'^2)/2 + c*(x*y' - y*x')/2 + a*(x^2 + y^2)/2")));
    find(k, &r, 1);
    assert_int_equal(r.at[0].stability, QDOT_STABLE);
    assert_non_null(strstr(show(k, r.at[0].stable_when), "4*m*a < c^2"));
    qdot_equilibria_clear(&r);
    torque(k, "-d*x'", "x"); /* dissipation undoes that */
    find(k, &r, 1);
    assert_int_equal(r.at[0].stability, QDOT_UNSTABLE);
    qdot_equilibria_clear(&r);
}
TEST(gyroscopic_stabilisation)

/* Higher terms decide where the second derivative is 0. */
static void
flat_bottoms_body(kit *k)
{
    static const struct {
        const char *V;
        qdot_stability stability;
    } rows[] = {{"x^4", QDOT_STABLE}, {"-x^4", QDOT_UNSTABLE}, {"x^3", QDOT_UNSTABLE}};
    qdot_equilibria r;

    coords(k, "x");
    for (int i = 0; i < 3; i++) {
        must(qdot_scene_lagrangian(k->scene, E(k, "m*x'^2/2 - c*(%s)", rows[i].V)));
        find(k, &r, 1);
        assert_int_equal(r.at[0].stability, rows[i].stability);
        qdot_equilibria_clear(&r);
    }
}
TEST(flat_bottoms)

/* A spring of rest length L from (0, a): bent to one side when L > a. */
static void
roots_of_radicals_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x");
    particle(k, "b", "m", "(x, 0)");
    must(qdot_scene_potential(k->scene, E(k, "c*(sqrt(x^2 + a^2) - L)^2/2")));
    find(k, &r, 3);
    is(k, &r.at[0], "[x = 0]", QDOT_STABLE, "[L < a]", "nil");
    assert_int_equal(r.at[1].stability, QDOT_STABLE);
    assert_string_equal(show(k, r.at[1].exists), "[a < L]");
    qdot_equilibria_clear(&r);
}
TEST(roots_of_radicals)

/* s >= 1 in place of s > 1 where the place is a rest at s = 1 too, and no other entry lists it. */
static void
ends_of_conditions_body(kit *k)
{
    static const struct {
        const char *V, *exists, *when; /* of the last place */
        size_t n;
        qdot_stability stability;
    } rows[] = {
        {"x^3/3 - (s - 1)*x", "[s >= 1]", "[s > 1]", 2, QDOT_STABLE},
        {"x^4/4 - (s - 1)*x^2/2", "[s > 1]", "nil", 3, QDOT_STABLE}, /* at s = 1: x = 0, which is listed */
        {"(s - 1)*x^3/3 - x", "[s > 1]", "nil", 2, QDOT_STABLE},     /* at s = 1 there is none */
        {"sin(x) - s*x", "[s <= 1]", "[s < 1]", 2, QDOT_STABLE},
    };
    qdot_equilibria r;

    coords(k, "x");
    (void)qdot_symbol_get(k->pool, QDOT_PARAM, "s");
    for (int i = 0; i < 4; i++) {
        must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - (%s)", rows[i].V)));
        find(k, &r, rows[i].n);
        assert_string_equal(show(k, r.at[r.n - 1].exists), rows[i].exists);
        assert_string_equal(show(k, r.at[r.n - 1].stable_when), rows[i].when);
        assert_int_equal(r.at[r.n - 1].stability, rows[i].stability);
        qdot_equilibria_clear(&r);
    }
}
TEST(ends_of_conditions)

static void
what_no_formula_gives_is_found_in_numbers_body(kit *k)
{
    qdot_equilibria r;
    double x;

    coords(k, "x");
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - x^2/4 - sin(x)")));
    find(k, &r, 1);
    assert_true(r.at[0].numeric);
    must(qdot_generic_evaluate(
        k->pool, 1, (qdot_expr[]){rhs(k, qdot_expr_arg(k->pool, r.at[0].equations, 0))}, NULL, &x));
    assert_true(fabs(x / 2 + cos(x)) < 1e-13);
    assert_int_equal(r.at[0].stability, QDOT_STABLE);
    qdot_equilibria_clear(&r);
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - c*x^2/4 - sin(x)")));
    assert_int_equal(qdot_equilibrium_find(k->scene, NULL, NULL, &r), QDOT_EUNSET);
}
TEST(what_no_formula_gives_is_found_in_numbers)

/* A force that comes and goes has no place of rest; where it only changes with time there is one. */
static void
rest_lasts_for_all_times_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x");
    must(qdot_scene_lagrangian(k->scene, E(k, "m*x'^2/2 - c*x^2/2 + x*cos(t)")));
    find(k, &r, 0);
    assert_true(r.complete);
    qdot_equilibria_clear(&r);
    must(qdot_scene_lagrangian(k->scene, E(k, "m*x'^2/2 - (1 + a*cos(t))*x^2/2")));
    find(k, &r, 1);
    is(k, &r.at[0], "[x = 0]", QDOT_STABILITY_UNDECIDED, "nil", "nil");
    qdot_equilibria_clear(&r);
    must(qdot_scene_lagrangian(k->scene, E(k, "m*x'^2/2 - cos(t)*(x - 2)^2*(x - 1)")));
    find(k, &r, 2);
    qdot_equilibria_clear(&r);
}
TEST(rest_lasts_for_all_times)

/* Multipliers may change with time though nothing moves. */
static void
multipliers_change_at_rest_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x y");
    particle(k, "bob", "m", "(x, y)");
    must(qdot_scene_potential(k->scene, E(k, "m*(g + cos(t))*y")));
    constraint(k, "rod", "x^2 + y^2", "L^2");
    find(k, &r, 2);
    is(k, &r.at[0], "[x = 0, y = -L, lambda[rod] = -1/2*m*(g + cos(t))/L]",
       QDOT_STABILITY_UNDECIDED, "nil", "nil");
    qdot_equilibria_clear(&r);
}
TEST(multipliers_change_at_rest)

/* Two fixed centres: one place; far away the force only fades. */
static void
a_fading_force_is_no_rest_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x y");
    must(qdot_scene_lagrangian(
        k->scene, E(k, "(x'^2 + y'^2)/2 + 1/sqrt((x - 1)^2 + y^2) + 1/sqrt((x + 1)^2 + y^2)")));
    find(k, &r, 1);
    is(k, &r.at[0], "[x = 0, y = 0]", QDOT_UNSTABLE, "nil", "nil");
    assert_int_equal(r.unproved, 0);
    assert_true(r.complete && r.starts == 0); /* by exclusion, also far away */
    qdot_equilibria_clear(&r);
}
TEST(a_fading_force_is_no_rest)

/* Exclusion: every place of a turn; a domain; a multiplier. What waves for ever is searched from starts. */
static void
few_unknowns_are_searched_whole_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x y");
    must(qdot_scene_lagrangian(
        k->scene,
        E(k, "(x'^2 + y'^2)/2 - cos(x) - cos(2*y - x)/3 - sin(y + 1)*cos(x)/2")));
    find(k, &r, 8);
    assert_true(r.complete && r.starts == 0);
    qdot_equilibria_clear(&r);
    must(qdot_scene_lagrangian(k->scene, E(k, "(x'^2 + y'^2)/2 - cos(x/3)*cosh(y) - sin(x/5)")));
    assert_int_equal(qdot_equilibrium_find(k->scene, NULL, NULL, &r), QDOT_OK);
    assert_true(!r.complete && r.starts > 0);
    qdot_equilibria_clear(&r);
}
TEST(few_unknowns_are_searched_whole)

/* Beside a corner at -2 the equation repeats, across it not: places on one side are none of the other. */
static void
places_of_one_side_stay_there_body(kit *k)
{
    qdot_equilibria r;
    size_t numeric = 0;

    coords(k, "x");
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - cos(x) - abs(x + 2)/2")));
    must(qdot_equilibrium_find(k->scene, NULL, NULL, &r));
    for (size_t i = 0; i < r.n; i++) {
        qdot_expr x = rhs(k, qdot_expr_arg(k->pool, r.at[i].equations, 0));
        double at;

        if (!r.at[i].numeric)
            continue;
        must(qdot_generic_evaluate(k->pool, 1, &x, NULL, &at));
        if (fabs(sin(at) - (at > -2 ? 0.5 : -0.5)) > 1e-12)
            fail_msg("%.17g is no rest", at);
        numeric++;
    }
    assert_true(numeric > 10 && !r.complete);
    qdot_equilibria_clear(&r);
}
TEST(places_of_one_side_stay_there)

/* No formula, no values of parameters: what a symmetry provides, and what a search would need. */
static void
symmetric_places_need_no_values_body(kit *k)
{
    qdot_equilibria r;

    coords(k, "x");
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - a*x^4/4 + b*cos(x)")));
    find(k, &r, 1);
    is(k, &r.at[0], "[x = 0]", QDOT_STABLE, "nil", "nil");
    assert_true(!r.complete && r.unset != NULL && strcmp(r.unset, "a") == 0);
    qdot_equilibria_clear(&r);
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - a*exp(x) - x^2")));
    assert_int_equal(qdot_equilibrium_find(k->scene, NULL, NULL, &r), QDOT_EUNSET);
    qdot_equilibria_clear(&r);
}
TEST(symmetric_places_need_no_values)

/* From far away the proof still ends at the zero, to the digits of a double. */
static void
proved_places_are_sharp_body(kit *k)
{
    qdot_expr x, f;
    qdot_isolate isolate;
    double at = -0.5, radius;

    coords(k, "x");
    x = E(k, "x");
    f = E(k, "sin(x) - 1/2");
    must(qdot_isolate_begin(&isolate, k->pool, 1, &f, &x));
    assert_true(qdot_isolate_prove(&isolate, &at, &radius));
    assert_true(fabs(at - acos(-1.0) / 6) <= 2e-16 && radius <= 1e-15);
    qdot_isolate_end(&isolate);
}
TEST(proved_places_are_sharp)

/* w^2 = (2 -+ sqrt 2) g/l, amplitudes 1 : +-sqrt 2. */
static void
modes_of_the_double_pendulum_body(kit *k)
{
    qdot_modes m;
    qdot_equilibria r;

    double_pendulum(k);
    find(k, &r, 4);
    must(qdot_modes_about(k->scene, r.at[0].equations, false, NULL, NULL, &m));
    assert_int_equal(m.n, 2);
    SAME(k, qdot_pow_int(k->pool, m.frequency[0], 2), "(2 - sqrt(2))*g/l");
    SAME(k, m.amplitude[0], "1");
    SAME(k, m.amplitude[1], "sqrt(2)");
    SAME(k, m.amplitude[3], "-sqrt(2)");
    qdot_modes_clear(&m);
    assert_int_equal(
        qdot_modes_about(k->scene, r.at[3].equations, false, NULL, NULL, &m),
        QDOT_EDOMAIN);
    qdot_equilibria_clear(&r);
}
TEST(modes_of_the_double_pendulum)

/* Numbers and the exact formula agree: five equal masses between springs,
 * w_k = 2 sin(k pi/12). */
static void
modes_in_numbers_body(kit *k)
{
    double w, a[5], want;
    qdot_modes m;
    qdot_equilibria r;

    coords(k, "x1 x2 x3 x4 x5");
    must(qdot_scene_lagrangian(
        k->scene,
        E(k, "(x1'^2 + x2'^2 + x3'^2 + x4'^2 + x5'^2)/2 - (x1^2 + (x2 - x1)^2 + "
             "(x3 - x2)^2 + (x4 - x3)^2 + (x5 - x4)^2 + x5^2)/2")));
    find(k, &r, 1);
    must(qdot_modes_about(k->scene, r.at[0].equations, true, NULL, NULL, &m));
    assert_true(m.numeric);
    for (size_t i = 0; i < 5; i++) {
        must(qdot_generic_evaluate(k->pool, 1, &m.frequency[i], NULL, &w));
        assert_true(fabs(w - 2 * sin((double)(i + 1) * M_PI / 12)) < 1e-13);
        must(qdot_generic_evaluate(k->pool, 5, m.amplitude + 5 * i, NULL, a));
        for (size_t j = 0; j < 5; j++) {
            want = sin((double)(i + 1) * (double)(j + 1) * M_PI / 6) /
                   sin((double)(i + 1) * M_PI / 6);
            assert_true(fabs(a[j] - want) < 1e-12);
        }
    }
    qdot_modes_clear(&m);
    qdot_equilibria_clear(&r);
}
TEST(modes_in_numbers)

/* A free pair: one mode of no frequency, both together. */
static void
free_motion_is_a_mode_body(kit *k)
{
    qdot_modes m;
    qdot_equilibria r;

    coords(k, "x y");
    must(qdot_scene_lagrangian(k->scene, E(k, "a*x'^2/2 + b*y'^2/2 - c*(x - y)^2/2")));
    find(k, &r, 1);
    assert_int_equal(r.at[0].stability, QDOT_STABILITY_UNDECIDED);
    must(qdot_modes_about(k->scene, r.at[0].equations, false, NULL, NULL, &m));
    assert_int_equal(m.n, 2);
    SAME(k, m.frequency[0], "0");
    SAME(k, m.amplitude[1], "1");
    SAME(k, qdot_pow_int(k->pool, m.frequency[1], 2), "c/a + c/b");
    SAME(k, m.amplitude[3], "-a/b");
    qdot_modes_clear(&m);
    qdot_equilibria_clear(&r);
}
TEST(free_motion_is_a_mode)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rotating_hoop),
        cmocka_unit_test(multipliers_are_included),
        cmocka_unit_test(every_combination),
        cmocka_unit_test(gyroscopic_stabilisation),
        cmocka_unit_test(flat_bottoms),
        cmocka_unit_test(roots_of_radicals),
        cmocka_unit_test(ends_of_conditions),
        cmocka_unit_test(what_no_formula_gives_is_found_in_numbers),
        cmocka_unit_test(rest_lasts_for_all_times),
        cmocka_unit_test(multipliers_change_at_rest),
        cmocka_unit_test(a_fading_force_is_no_rest),
        cmocka_unit_test(few_unknowns_are_searched_whole),
        cmocka_unit_test(places_of_one_side_stay_there),
        cmocka_unit_test(symmetric_places_need_no_values),
        cmocka_unit_test(proved_places_are_sharp),
        cmocka_unit_test(modes_of_the_double_pendulum),
        cmocka_unit_test(modes_in_numbers),
        cmocka_unit_test(free_motion_is_a_mode),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
