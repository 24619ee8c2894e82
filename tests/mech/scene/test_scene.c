/* Declaring: what is refused, what is left out, what is printed; ranks; the chain's cost.
 * */
#include <inttypes.h>
#include <time.h>

#include "expr/build.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/dynamics/quantity.h"
#include "mech/kit.h"
#include "sanitized.h"

static void
wrong_declarations_are_refused(void **state)
{
    kit k_, *k = &k_;
    qdot_force f;
    qdot_link link;

    (void)state;
    kit_open(k);
    coords(k, "x y");
    particle(k, "bob", "m", "(x, y)");
    refused(k, qdot_scene_coordinate(k->scene, E(k, "x")), QDOT_ENAME, "already");
    refused(k, qdot_scene_coordinate(k->scene, E(k, "m")), QDOT_ETYPE, "name");
    refused(k, qdot_scene_gravity(k->scene, E(k, "(0, 0, -g)")), QDOT_ETYPE,
            "3 components");
    refused(k, qdot_scene_gravity(k->scene, E(k, "(0, -x)")), QDOT_EINVAL, "coordinates");
    refused(k, qdot_scene_particle(k->scene, "bob", E(k, "m"), E(k, "(x, y)")),
            QDOT_ENAME, "bob");
    refused(k, qdot_scene_particle(k->scene, "c", E(k, "m"), E(k, "(x', y)")),
            QDOT_EINVAL, "velocities");
    refused(k, qdot_scene_particle(k->scene, "c", E(k, "(m, m)"), E(k, "(x, y)")),
            QDOT_ETYPE, "number");
    refused(k, qdot_scene_particle(k->scene, "c", E(k, "-m"), E(k, "(x, y)")),
            QDOT_EDOMAIN, "negative");
    f = (qdot_force){.force = E(k, "(0, 0, F)"), .point = E(k, "(x, y)")};
    refused(k, qdot_scene_force(k->scene, &f), QDOT_ETYPE, "3 components");
    f.force = E(k, "(0, F*x'')");
    refused(k, qdot_scene_force(k->scene, &f), QDOT_EINVAL, "accelerations");
    f = (qdot_force){
        .force = E(k, "(0, F)"), .point = E(k, "(x, y)"), .on = (char *)"bob", .material = true};
    refused(k, qdot_scene_force(k->scene, &f), QDOT_EINVAL, "material");
    refused(k, qdot_scene_dissipation(k->scene, E(k, "x''^2")), QDOT_EINVAL,
            "accelerations");
    link = (qdot_link){.at = {E(k, "(x, y)"), E(k, "(x, y)")}, .stiffness = E(k, "kk")};
    refused(k, qdot_scene_spring(k->scene, &link), QDOT_EINVAL, "one point");
    refused(k, qdot_scene_constraint(k->scene, "c", E(k, "a"), E(k, "2")), QDOT_EINVAL,
            "without coordinates");
    refused(k, qdot_scene_constraint(k->scene, "c", E(k, "2"), E(k, "2")), QDOT_EINVAL,
            "without coordinates");
    refused(k, qdot_scene_constraint(k->scene, "c", E(k, "x''*y''"), E(k, "2")), QDOT_EINVAL,
            "constraint c is not linear in the accelerations");
    refused(k, qdot_scene_constraint(k->scene, "bob", E(k, "x"), E(k, "2")), QDOT_ENAME,
            "bob");
    refused(k, qdot_scene_constraint(k->scene, "c", E(k, "(x, y)"), E(k, "2")),
            QDOT_ETYPE, "components");
    refused(k, qdot_scene_lagrangian(k->scene, E(k, "x'^2")), QDOT_EINVAL, "particles");
    refused(k, qdot_scene_remove(k->scene, "nobody"), QDOT_ENAME, "nobody");
    assert_int_equal(k->scene->particles.n, 1);
    assert_int_equal(k->scene->constraints.n, 0);
    assert_int_equal(qdot_scene_position(k->scene, "nobody"), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ENAME);
    kit_close(k);
}

static void
components_that_hold_identically_are_left_out(void **state)
{
    kit k_, *k = &k_;

    (void)state;
    kit_open(k);
    coords(k, "x y");
    constraint(k, "pin", "(x, sin(y)^2 + cos(y)^2, y)", "(a, 1, b)");
    assert_int_equal(k->scene->constraints.n, 2);
    assert_string_equal(k->scene->constraints.at[1].name, "pin, 3");
    assert_int_equal(k->scene->constraints.at[1].multiplier, E(k, "lambda[pin, 3]"));
    assert_int_equal(k->scene->dropped.n, 1);
    assert_string_equal(k->scene->dropped.at[0], "pin, 2");
    constraint(k, NULL, "x*y", "c");
    assert_string_equal(k->scene->constraints.at[2].name, "2");
    assert_int_equal(k->scene->dropped.n, 0);
    must(qdot_scene_remove(k->scene, "pin"));
    assert_int_equal(k->scene->constraints.n, 1);
    constraint(k, NULL, "x", "y");
    assert_string_equal(k->scene->constraints.at[1].name, "3");
    kit_close(k);
}

static void
what_acts_on_a_removed_particle_goes_with_it(void **state)
{
    kit k_, *k = &k_;
    qdot_link s;
    qdot_force f;

    (void)state;
    kit_open(k);
    coords(k, "x y");
    particle(k, "a", "m", "x");
    particle(k, "b", "m", "y");
    s = (qdot_link){.name = "s1",
                    .at = {E(k, "x"), E(k, "y")},
                    .end = {"a", "b"},
                    .stiffness = E(k, "kk")};
    must(qdot_scene_spring(k->scene, &s));
    f = (qdot_force){.force = E(k, "F"), .point = E(k, "x"), .on = "a"};
    must(qdot_scene_force(k->scene, &f));
    SAME(k, qdot_mech_force(k->scene, E(k, "x")), "F - kk*(x - y)");
    must(qdot_scene_remove(k->scene, "a"));
    assert_int_equal(k->scene->dropped.n, 2);
    assert_string_equal(k->scene->dropped.at[0], "spring s1");
    assert_string_equal(k->scene->dropped.at[1], "a force");
    SAME(k, qdot_mech_force(k->scene, E(k, "x")), "0");
    kit_close(k);
}

/* By number in the order of `scene`; what was derived goes with it. */
static void
things_without_label_go_by_number(void **state)
{
    kit k_, *k = &k_;
    qdot_torque on_y;

    (void)state;
    kit_open(k);
    coords(k, "x y");
    particle(k, "a", "m", "(x, y)");
    must(qdot_scene_gravity(k->scene, E(k, "(0, -g)")));
    must(qdot_scene_gravity(k->scene, E(k, "(0, -2*g)")));
    assert_int_equal(qdot_scene_count(k->scene, QDOT_GRAVITY), 1);
    must(qdot_scene_term(k->scene, QDOT_GRAVITY, "wind", E(k, "(w, 0)")));
    must(qdot_scene_potential(k->scene, E(k, "x*y")));
    must(qdot_scene_term(k->scene, QDOT_POTENTIAL, "well", E(k, "x*y")));
    assert_false(qdot_scene_said_twice(k->scene, QDOT_POTENTIAL));
    must(qdot_scene_potential(k->scene, E(k, "x*y")));
    assert_true(qdot_scene_said_twice(k->scene, QDOT_POTENTIAL));
    refused(k, qdot_scene_term(k->scene, QDOT_DISSIPATION, "wind", E(k, "x'^2")), QDOT_ENAME,
            "wind");
    torque(k, "tau", "y");
    on_y = (qdot_torque){.torque = E(k, "f"), .coordinate = E(k, "y"), .force = true, .body = -1};
    must(qdot_scene_torque(k->scene, &on_y));
    assert_int_equal(qdot_scene_count(k->scene, QDOT_FORCE), 1);
    assert_int_equal(qdot_scene_count(k->scene, QDOT_TORQUE), 1);
    SAME(k, qdot_mech_force(k->scene, E(k, "x")), "m*w - 3*y");
    SAME(k, qdot_mech_force(k->scene, E(k, "y")), "-2*m*g - 3*x + tau + f");
    must(qdot_scene_remove_at(k->scene, QDOT_FORCE, 0));
    must(qdot_scene_remove_at(k->scene, QDOT_GRAVITY, 0));
    must(qdot_scene_remove_at(k->scene, QDOT_POTENTIAL, 2));
    must(qdot_scene_remove(k->scene, "well"));
    refused(k, qdot_scene_remove_at(k->scene, QDOT_FORCE, 0), QDOT_EINVAL, "number 1");
    SAME(k, qdot_mech_force(k->scene, E(k, "x")), "m*w - y");
    SAME(k, qdot_mech_force(k->scene, E(k, "y")), "-x + tau");
    kit_close(k);
}

static void
scene_prints_as_statements(void **state)
{
    kit k_, *k = &k_;
    qdot_link s;
    qdot_text out = {0};

    (void)state;
    kit_open(k);
    coords(k, "r>0 phi");
    particle(k, "bob", "m", "(r*cos(phi), r*sin(phi))");
    must(declare_body(k->scene, "plate", E(k, "M"), E(k, "I"), QDOT_NIL,
                         E(k, "(r, 0)"), E(k, "phi"), QDOT_NIL));
    gravity(k, "(0, -g)");
    s = (qdot_link){
        .name = "s1", .end = {"bob", NULL}, .stiffness = E(k, "kk"), .rest = E(k, "a")};
    s.at[0] = qdot_scene_position(k->scene, "bob");
    s.at[1] = E(k, "(0, h)");
    must(qdot_scene_spring(k->scene, &s));
    torque(k, "tau", "phi");
    constraint(k, "pin", "(r, 0, phi)", "(a, 0, b)");
    must(qdot_scene_print(k->scene, &out));
    assert_string_equal(qdot_text_str(&out),
                        "coord r > 0\n"
                        "coord phi\n"
                        "particle bob mass m at (r*cos(phi), r*sin(phi))\n"
                        "body plate mass M inertia I at (r, 0) angle phi\n"
                        "gravity (0, -g)\n"
                        "spring s1 between bob, (0, h) stiffness kk rest a\n"
                        "torque tau on phi\n"
                        "constraint pin: (r, 0, phi) = (a, 0, b)\n");
    qdot_text_clear(&out);
    kit_close(k);
}

static void
a_matrix_that_is_no_rotation_is_refused(void **state)
{
    kit k_, *k = &k_;
    qdot_expr e[9], R;

    (void)state;
    kit_open(k);
    coords(k, "phi");
    for (int i = 0; i < 9; i++)
        e[i] = i % 4 ? QDOT_ZERO : QDOT_ONE;
    e[0] = E(k, "cos(phi)");
    R = qdot_matrix(k->pool, 3, 3, e);
    refused(k,
            declare_body(k->scene, "b", E(k, "m"), E(k, "(A, B, C)"), QDOT_NIL,
                            E(k, "(0, 0, 0)"), QDOT_NIL, R),
            QDOT_EDOMAIN, "not a rotation");
    kit_close(k);
}

static qdot_expr
turned(kit *k, qdot_expr angle, int axis, qdot_expr of_cosine)
{
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const qdot_expr c = qdot_fun1(k->pool, QDOT_COS, of_cosine), s = qdot_fun1(k->pool, QDOT_SIN, angle);
    qdot_expr e[9];

    for (int n = 0; n < 9; n++)
        e[n] = QDOT_ZERO;
    e[4 * axis] = QDOT_ONE;
    e[4 * i] = e[4 * j] = c;
    e[3 * i + j] = qdot_neg(k->pool, s);
    e[3 * j + i] = s;
    return qdot_matrix(k->pool, 3, 3, e);
}

/* The entries of such a product are of degree 40; one factor that is no rotation is found in it all the same. */
static void
products_of_rotations_are_rotations_by_their_factors(void **state)
{
    kit k_, *k = &k_;
    qdot_expr R, wrong, A, a, b, mirror[9];
    size_t before;

    (void)state;
    kit_open(k);
    coords(k, "a b");
    a = E(k, "a");
    b = E(k, "b");
    A = turned(k, a, 2, a);
    R = qdot_value_mul(k->pool, A, turned(k, b, 0, b));
    wrong = qdot_value_mul(k->pool, A, turned(k, b, 0, a));
    refused(k, declare_body(k->scene, "w", E(k, "m"), E(k, "(A, B, C)"), QDOT_NIL, E(k, "(0, 0, 0)"), QDOT_NIL, wrong),
            QDOT_EDOMAIN, "not a rotation");
    for (int i = 0; i < 9; i++)
        mirror[i] = i % 4 ? QDOT_ZERO : i ? QDOT_ONE : QDOT_MINUS_ONE;
    wrong = qdot_value_mul(k->pool, R, qdot_matrix(k->pool, 3, 3, mirror));
    refused(k, declare_body(k->scene, "w", E(k, "m"), E(k, "(A, B, C)"), QDOT_NIL, E(k, "(0, 0, 0)"), QDOT_NIL, wrong),
            QDOT_EDOMAIN, "a reflection");
    for (int i = 1; i < 20; i++)
        R = qdot_value_mul(k->pool, qdot_transpose(k->pool, R), qdot_value_mul(k->pool, R, A));
    before = qdot_pool_count(k->pool);
    must(declare_body(k->scene, "b", E(k, "m"), E(k, "(A, B, C)"), QDOT_NIL, E(k, "(0, 0, 0)"), QDOT_NIL, R));
    assert_true(qdot_pool_count(k->pool) - before < 1000); /* nothing was made of the entries of R */
    kit_close(k);
}

static size_t
freedom(kit *k, size_t *independent)
{
    qdot_dof dof;

    must(qdot_mech_dof(k->scene, &dof));
    *independent = dof.independent;
    return dof.freedom;
}

static void
redundant_constraints_do_not_count(void **state)
{
    kit k_, *k = &k_;
    size_t independent;

    (void)state;
    kit_open(k);
    coords(k, "x1 y1 z1 x2 y2 z2");
    particle(k, "a", "m1", "(x1, y1, z1)");
    particle(k, "b", "m2", "(x2, y2, z2)");
    assert_int_equal(freedom(k, &independent), 6);
    constraint(k, "rod", "(x1 - x2)^2 + (y1 - y2)^2 + (z1 - z2)^2", "L^2");
    assert_int_equal(freedom(k, &independent), 5);
    constraint(k, "again", "2*(x1 - x2)^2 + 2*(y1 - y2)^2 + 2*(z1 - z2)^2", "2*L^2");
    assert_int_equal(freedom(k, &independent), 5);
    constraint(k, "plane", "z1", "0");
    constraint(k, "plane2", "z2", "z1");
    assert_int_equal(freedom(k, &independent), 3);
    /* Implied by the planes, and its own time derivative. */
    constraint(k, "both", "z1 + 3*z2", "0");
    constraint(k, "moving", "x1*(x1' - x2') - x2*(x1' - x2') + (y1 - y2)*(y1' - y2')",
               "0");
    assert_int_equal(freedom(k, &independent), 3);
    assert_int_equal(independent, 3);
    SAME(k, qdot_mech_accel(k->scene, E(k, "z1")), "0");
    kit_close(k);
}

/* Three equal parallel cranks hold a plate: the third repeats the others on the manifold
 * only. */
static void
parallel_cranks_are_redundant(void **state)
{
    kit k_, *k = &k_;
    size_t independent;

    (void)state;
    kit_open(k);
    coords(k, "theta1 theta2");
    constraint(k, "a", "theta1", "theta2");
    constraint(k, "b", "(L*cos(theta1), L*sin(theta1))",
               "(L*cos(theta2), L*sin(theta2))");
    assert_int_equal(freedom(k, &independent), 1);
    kit_close(k);
}

/* Everything derived of a scene with one of each; the first failure's status. */
static qdot_status
everything(qdot_pool *pool, qdot_scene *s, const qdot_expr *e)
{
    qdot_link link = {.name = (char *)"s1",
                      .end = {(char *)"bob", NULL},
                      .at = {e[3], e[4]},
                      .stiffness = e[2],
                      .rest = e[2]};
    qdot_force force = {.force = e[4], .point = e[3], .on = (char *)"bob"};
    qdot_torque torque = {.torque = e[2], .coordinate = e[1]};
    qdot_text out = {0};
    qdot_cyclic *list = NULL;
    size_t n;
    bool conserved;
    qdot_dof dof;
    qdot_status status;

    QDOT_TRY(qdot_scene_coordinate(s, e[0]));
    QDOT_TRY(qdot_scene_coordinate(s, e[1]));
    QDOT_TRY(qdot_scene_particle(s, "bob", e[2], e[3]));
    QDOT_TRY(declare_body(s, "plate", e[2], e[2], QDOT_NIL, e[3], e[1], QDOT_NIL));
    QDOT_TRY(qdot_scene_gravity(s, e[4]));
    QDOT_TRY(qdot_scene_spring(s, &link));
    link.name = (char *)"d1";
    QDOT_TRY(qdot_scene_damper(s, &link));
    QDOT_TRY(qdot_scene_force(s, &force));
    force = (qdot_force){.force = e[4], .point = e[4], .on = (char *)"plate", .material = true};
    QDOT_TRY(qdot_scene_force(s, &force));
    status = qdot_scene_moves_within(s, e[4], NULL, &out);
    qdot_text_clear(&out);
    QDOT_TRY(status);
    QDOT_TRY(qdot_scene_term(s, QDOT_POTENTIAL, "well", e[0]));
    QDOT_TRY(qdot_scene_remove_at(s, QDOT_POTENTIAL, 0));
    QDOT_TRY(qdot_scene_term(s, QDOT_DISSIPATION, "drag", e[1]));
    QDOT_TRY(qdot_scene_torque(s, &torque));
    QDOT_TRY(qdot_scene_constraint(s, "pin", e[3], e[4]));
    QDOT_TRY(qdot_scene_assume(s, qdot_rel(pool, QDOT_EQ, e[5], QDOT_ONE), false));
    qdot_mech_numeric_forcing(s);
    qdot_mech_equations(s);
    qdot_mech_energy(s);
    qdot_mech_momenta(s);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_mech_dof(s, &dof));
    QDOT_TRY(qdot_mech_energy_conserved(s, &conserved));
    QDOT_TRY(qdot_mech_cyclic(s, &list, &n));
    qdot_free(list);
    status = qdot_scene_print(s, &out);
    qdot_text_clear(&out);
    QDOT_TRY(status);
    QDOT_TRY(qdot_scene_remove(s, "bob"));
    return qdot_pool_check(pool);
}

/* Allocation number n and all after it fail, for growing n: an error each time, never a
 * crash or (under the sanitizer) a leak; and the scene works once there is memory again.
 * */
static void
running_out_of_memory_anywhere_is_an_error(void **state)
{
    bool passed = false;

    (void)state;
    for (int64_t n = 0; !passed; n += 1 + n / 8) {
        kit k_, *k = &k_;
        qdot_expr e[6];
        qdot_status status;

        kit_open(k);
        function(k, "f", "s");
        e[0] = qdot_symbol_get(k->pool, QDOT_COORD, "r");
        e[1] = qdot_symbol_get(k->pool, QDOT_COORD, "phi");
        e[2] = E(k, "m");
        e[3] = qdot_value_mul(
            k->pool, e[0],
            qdot_vector(k->pool, 2,
                        (qdot_expr[]){qdot_fun1(k->pool, QDOT_COS, e[1]),
                                      qdot_fun1(k->pool, QDOT_SIN, e[1])}));
        e[4] = E(k, "(0, -g)");
        e[5] = E(k, "f(s)^2");
        must(qdot_pool_check(k->pool));
        qdot_memory_fail_at(n);
        status = everything(k->pool, k->scene, e);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK)
            passed = true;
        else if (status != QDOT_ENOMEM)
            fail_msg("allocation %" PRId64 ": status %d: %s", n, (int)status,
                     qdot_last_error()->message);
        (void)!qdot_pool_check(k->pool);
        if (k->scene->coordinates.n == 2) {
            qdot_mech_equations(k->scene);
            qdot_mech_numeric_mass(k->scene);
            must(qdot_pool_check(k->pool));
        }
        kit_close(k);
    }
}

#ifdef SANITIZED
static const double PATIENCE = 5; /* s */
#else
static const double PATIENCE = 1;
#endif

static double
seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void
chain(kit *k, int n)
{
    qdot_expr x = QDOT_ZERO, y = QDOT_ZERO, r[2];
    char name[32];

    for (int i = 1; i <= n; i++) {
        snprintf(name, sizeof name, "theta[%d]", i);
        coords(k, name);
    }
    for (int i = 1; i <= n; i++) {
        x = qdot_add(k->pool, x, E(k, "l%d*sin(theta[%d])", i, i));
        y = qdot_sub(k->pool, y, E(k, "l%d*cos(theta[%d])", i, i));
        r[0] = x;
        r[1] = y;
        snprintf(name, sizeof name, "bob[%d]", i);
        must(qdot_scene_particle(k->scene, name, E(k, "m%d", i),
                                 qdot_vector(k->pool, 2, r)));
    }
    gravity(k, "(0, -g)");
}

static void
chain_of_100_links_takes_well_under_a_second(void **state)
{
    (void)state;
    for (int size = 0; size < 3; size++) {
        static const int sizes[] = {8, 32, 100};
        int n = sizes[size];
        kit k_, *k = &k_;
        double start, middle, end;
        size_t before;
        qdot_expr M;

        kit_open(k);
        chain(k, n);
        before = qdot_pool_count(k->pool);
        start = seconds();
        M = qdot_mech_numeric_mass(k->scene);
        middle = seconds();
        must(qdot_pool_check(k->pool));
        assert_int_equal(qdot_expr_arg(k->pool, M, 1),
                         qdot_expr_arg(k->pool, M, (uint32_t)n));
        /* N^2 work, not N^3: about 20 nodes an entry whatever N. */
        assert_true(qdot_pool_count(k->pool) - before <
                    60u * (size_t)n * (size_t)n + 5000);
        end = seconds();
        for (int i = 0; i < n; i++)
            qdot_mech_equation(k->scene, k->scene->coordinates.at[i]);
        must(qdot_pool_check(k->pool));
        printf("N = %d: M and f %.4f s, all equations for people %.4f s\n", n,
               middle - start, seconds() - end);
        assert_true(middle - start < PATIENCE);
        kit_close(k);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_declarations_are_refused),
        cmocka_unit_test(components_that_hold_identically_are_left_out),
        cmocka_unit_test(what_acts_on_a_removed_particle_goes_with_it),
        cmocka_unit_test(things_without_label_go_by_number),
        cmocka_unit_test(scene_prints_as_statements),
        cmocka_unit_test(a_matrix_that_is_no_rotation_is_refused),
        cmocka_unit_test(products_of_rotations_are_rotations_by_their_factors),
        cmocka_unit_test(redundant_constraints_do_not_count),
        cmocka_unit_test(parallel_cranks_are_redundant),
        cmocka_unit_test(running_out_of_memory_anywhere_is_an_error),
        cmocka_unit_test(chain_of_100_links_takes_well_under_a_second),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
