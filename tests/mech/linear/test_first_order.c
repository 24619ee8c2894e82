/* The linear motion near a state: matrices that are known in closed form. */
#include "mech/kit.h"

#include <math.h>

#include "expr/constant.h"
#include "mech/linear/first-order.h"
#include "mech/scene/scene.h"

static qdot_expr
equation(kit *k, const char *symbol, const char *value)
{
    return qdot_rel(k->pool, QDOT_EQ, E(k, "%s", symbol), E(k, "%s", value));
}

/* The change of a symbol with column a. */
static qdot_expr
change_of(kit *k, const qdot_first_order *x, const char *symbol, size_t a)
{
    const qdot_expr wanted = E(k, "%s", symbol);

    for (size_t i = 0; i < x->n; i++)
        if (x->symbol[i] == wanted)
            return x->change[i * (x->states + x->inputs) + a];
    fail_msg("%s does not move", symbol);
    return QDOT_NIL;
}

static qdot_expr
same_expression(void *user, qdot_expr e)
{
    (void)user;
    return e;
}

static void
pendulum_in_the_plane_body(kit *k)
{
    qdot_first_order x;
    qdot_expr place[2];
    qdot_first_order_request request = {0};

    coords(k, "x y");
    particle(k, "bob", "m1", "(x, y)");
    gravity(k, "(0, -g)");
    constraint(k, "rod", "x^2 + y^2", "L1^2");
    constraint(k, "again", "3*x^2 + 3*y^2", "3*L1^2");
    place[0] = equation(k, "x", "0");
    place[1] = equation(k, "y", "-L1");
    request.place = qdot_list(k->pool, 2, place);
    must(qdot_first_order_about(k->scene, &request, &x));
    assert_int_equal(x.states, 2);
    READS(k, x.state[0], "x");
    READS(k, x.state[1], "x'");
    SAME(k, change_of(k, &x, "x''", 0), "-g/L1");
    SAME(k, change_of(k, &x, "x''", 1), "0");
    SAME(k, change_of(k, &x, "y''", 0), "0");
    assert_false(x.moves);
    qdot_first_order_clear(&x);
}
TEST(pendulum_in_the_plane)

/* Chaplygin's sleigh without offset on a straight path: the blade binds y', whose coordinate stays a state. */
static void
blade_body(kit *k)
{
    qdot_first_order x;
    qdot_expr place[3];
    qdot_first_order_request request = {0};

    coords(k, "y x phi");
    must(qdot_scene_lagrangian(k->scene, E(k, "m1*(x'^2 + y'^2)/2 + m2*phi'^2/2")));
    torque(k, "g", "phi");
    must(qdot_scene_input(k->scene, E(k, "g")));
    constraint(k, "blade", "y'*cos(phi) - x'*sin(phi)", "0");
    place[0] = equation(k, "phi", "0");
    place[1] = equation(k, "x'", "L1");
    request.place = qdot_list(k->pool, 2, place);
    must(qdot_first_order_about(k->scene, &request, &x));
    assert_int_equal(x.states, 5);
    assert_int_equal(x.inputs, 1);
    SAME(k, change_of(k, &x, "y'", 2), "L1");
    SAME(k, change_of(k, &x, "phi''", 5), "1/m2");
    SAME(k, change_of(k, &x, "lambda[blade]", 4), "m1*L1");
    qdot_first_order_clear(&x);
    /* the state does not fulfil the constraint */
    place[2] = equation(k, "y'", "1");
    request.place = qdot_list(k->pool, 3, place);
    assert_int_equal(qdot_first_order_about(k->scene, &request, &x), QDOT_EINVAL);
    must(qdot_pool_check(k->pool));
}
TEST(blade)

/* A free particle in speeds along turning axes, u' = w s, s' = -w u, and a pendulum that the rod leaves one speed. */
static void
speeds_body(kit *k)
{
    const qdot_expr symbol[3] = {qdot_symbol_get(k->pool, QDOT_COORD, "u"), qdot_symbol_get(k->pool, QDOT_COORD, "s"),
                                 qdot_symbol_get(k->pool, QDOT_COORD, "w")};
    qdot_first_order x;
    qdot_expr value[3], place[3];
    qdot_speeds speeds = {3, symbol, value};
    qdot_first_order_request request = {.speeds = &speeds};

    coords(k, "x y phi");
    must(qdot_scene_lagrangian(k->scene, E(k, "m1*(x'^2 + y'^2)/2 + m2*phi'^2/2")));
    value[0] = E(k, "x'*cos(phi) + y'*sin(phi)");
    value[1] = E(k, "y'*cos(phi) - x'*sin(phi)");
    value[2] = E(k, "phi'");
    place[0] = equation(k, "phi", "0");
    place[1] = qdot_rel(k->pool, QDOT_EQ, symbol[0], E(k, "L1"));
    place[2] = qdot_rel(k->pool, QDOT_EQ, symbol[2], E(k, "m1"));
    request.place = qdot_list(k->pool, 3, place);
    must(qdot_first_order_about(k->scene, &request, &x));
    assert_int_equal(x.states, 6);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(x.state[3 + i], symbol[i]);
    for (size_t i = 0; i < x.n; i++) {
        const qdot_expr *row = x.change + i * x.states;

        if (x.symbol[i] == qdot_symbol_jet(k->pool, symbol[0], 1)) {
            SAME(k, row[2], "0");
            SAME(k, row[4], "m1");
        }
        if (x.symbol[i] == qdot_symbol_jet(k->pool, symbol[1], 1)) {
            SAME(k, x.value[i], "-m1*L1");
            SAME(k, row[2], "0");
            SAME(k, row[3], "-m1");
            SAME(k, row[5], "-L1");
        }
    }
    SAME(k, change_of(k, &x, "y'", 2), "L1");
    SAME(k, change_of(k, &x, "y'", 4), "1");
    qdot_first_order_clear(&x);
    /* two speeds of three */
    speeds.n = 2;
    assert_int_equal(qdot_first_order_about(k->scene, &request, &x), QDOT_EINVAL);
    must(qdot_pool_check(k->pool));
}
TEST(speeds)

static void
numbers_agree_with_symbols_body(kit *k)
{
    qdot_first_order exact, numbers;
    qdot_expr place[2];
    qdot_first_order_request request = {.bind = same_expression};

    coords(k, "theta1 theta2");
    must(qdot_scene_lagrangian(
        k->scene, E(k, "theta1'^2 + theta2'^2/2 + theta1'*theta2'*cos(theta1 - theta2) + 2*cos(theta1) + cos(theta2)")));
    place[0] = equation(k, "theta1", "pi/3");
    place[1] = equation(k, "theta2", "0");
    request.place = qdot_list(k->pool, 2, place);
    must(qdot_first_order_about(k->scene, &request, &exact));
    request.numbers = true;
    must(qdot_first_order_about(k->scene, &request, &numbers));
    assert_true(exact.moves && numbers.moves);
    for (size_t i = 0; i < exact.n * exact.states; i++) {
        double a, b;

        must(qdot_constant_double(k->pool, exact.change[i], &a));
        must(qdot_constant_double(k->pool, numbers.change[i], &b));
        assert_true(fabs(a - b) <= 1e-15 * (1 + fabs(a)));
    }
    qdot_first_order_clear(&exact);
    qdot_first_order_clear(&numbers);
}
TEST(numbers_agree_with_symbols)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pendulum_in_the_plane),
        cmocka_unit_test(blade),
        cmocka_unit_test(speeds),
        cmocka_unit_test(numbers_agree_with_symbols),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
