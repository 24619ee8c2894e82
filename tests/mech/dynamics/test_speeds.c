/* Equations in quasi-velocities: the textbook's, and Lagrange's by another way. */
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/dynamics/speeds.h"

enum { MOST = 6 };

/* Speeds of a scene with their equations. */
typedef struct {
    qdot_speeds speeds;
    qdot_expr symbol[MOST], value[MOST], velocity[MOST], equation[MOST];
} chosen;

/* names "u v", values one each */
static void
choose(kit *k, chosen *c, const char *names, const char *const *values)
{
    char name[16];
    int length;

    *c = (chosen){0};
    for (; sscanf(names, " %15s%n", name, &length) == 1; names += length) {
        c->symbol[c->speeds.n] = qdot_symbol_get(k->pool, QDOT_COORD, name);
        c->value[c->speeds.n] = E(k, "%s", values[c->speeds.n]);
        c->speeds.n++;
    }
    c->speeds.symbol = c->symbol;
    c->speeds.value = c->value;
}

static void
derive(kit *k, chosen *c)
{
    must(qdot_speeds_kinematics(k->scene, &c->speeds, c->velocity));
    must(qdot_speeds_equations(k->scene, &c->speeds, c->velocity, c->equation));
}

/* The equation is left = right, up to no factor. */
static void
is_equation(kit *k, qdot_expr got, qdot_expr left, qdot_expr right, int line)
{
    same_at(k, lhs(k, got), left, line);
    same_at(k, rhs(k, got), right, line);
}

static qdot_expr
rate_of(kit *k, const chosen *c, size_t i)
{
    return qdot_symbol_jet(k->pool, c->symbol[i], 1);
}

/* Euler's equations of a free body. */
static void
spin_components_give_eulers_equations(void **state)
{
    static const char *const w[] = {"sin(theta)*sin(psi)*phi' + cos(psi)*theta'", "sin(theta)*cos(psi)*phi' - sin(psi)*theta'",
                                    "cos(theta)*phi' + psi'"};
    kit k;
    chosen c;

    (void)state;
    kit_open(&k);
    coords(&k, "phi theta psi");
    must(declare_body(k.scene, "top", E(&k, "m"), E(&k, "(A, B, C)"), QDOT_NIL, E(&k, "(0, 0, 0)"), QDOT_NIL,
                      qdot_scene_euler(k.pool, E(&k, "phi"), E(&k, "theta"), E(&k, "psi"))));
    choose(&k, &c, "w1 w2 w3", w);
    derive(&k, &c);
    is_equation(&k, c.equation[0], qdot_mul(k.pool, E(&k, "A"), rate_of(&k, &c, 0)),
                qdot_mul(k.pool, E(&k, "B - C"), qdot_mul(k.pool, c.symbol[1], c.symbol[2])), __LINE__);
    is_equation(&k, c.equation[1], qdot_mul(k.pool, E(&k, "B"), rate_of(&k, &c, 1)),
                qdot_mul(k.pool, E(&k, "C - A"), qdot_mul(k.pool, c.symbol[2], c.symbol[0])), __LINE__);
    is_equation(&k, c.equation[2], qdot_mul(k.pool, E(&k, "C"), rate_of(&k, &c, 2)),
                qdot_mul(k.pool, E(&k, "A - B"), qdot_mul(k.pool, c.symbol[0], c.symbol[1])), __LINE__);
    kit_close(&k);
}

/* A skate with its centre a before the blade: m v' = m a w^2, (I + m a^2) w' = -m a v w (Chaplygin's sleigh). */
static void
sleigh_has_chaplygins_equations(void **state)
{
    static const char *const of[] = {"x'*cos(phi) + y'*sin(phi)", "phi'"};
    kit k;
    chosen c;

    (void)state;
    kit_open(&k);
    coords(&k, "x y phi");
    must(declare_body(k.scene, "sleigh", E(&k, "m"), E(&k, "I"), QDOT_NIL, E(&k, "(x + a*cos(phi), y + a*sin(phi))"),
                      E(&k, "phi"), QDOT_NIL));
    constraint(&k, "blade", "x'*sin(phi)", "y'*cos(phi)");
    choose(&k, &c, "v w", of);
    derive(&k, &c);
    same_at(&k, c.velocity[0], qdot_mul(k.pool, E(&k, "cos(phi)"), c.symbol[0]), __LINE__);
    is_equation(&k, c.equation[0], qdot_mul(k.pool, E(&k, "m"), rate_of(&k, &c, 0)),
                qdot_mul(k.pool, E(&k, "m*a"), qdot_pow_int(k.pool, c.symbol[1], 2)), __LINE__);
    is_equation(&k, c.equation[1], qdot_mul(k.pool, E(&k, "I + m*a^2"), rate_of(&k, &c, 1)),
                qdot_mul(k.pool, E(&k, "-m*a"), qdot_mul(k.pool, c.symbol[0], c.symbol[1])), __LINE__);
    kit_close(&k);
}

/* With u = E and u' = dE/dt, accelerations put in, every equation holds. */
static void
equations_agree_with_accelerations(void **state)
{
    static const char *const of[] = {"theta1' + theta2'*cos(theta1 - theta2)", "theta2' - t"};
    kit k;
    chosen c;

    (void)state;
    kit_open(&k);
    symbolic_double_pendulum(&k);
    choose(&k, &c, "u v", of);
    derive(&k, &c);
    for (size_t j = 0; j < 2; j++) {
        qdot_expr e = qdot_sub(k.pool, lhs(&k, c.equation[j]), rhs(&k, c.equation[j]));

        for (size_t i = 0; i < 2; i++) {
            qdot_expr from[2] = {rate_of(&k, &c, i), c.symbol[i]}, to[2] = {qdot_ddt(k.pool, c.value[i]), c.value[i]};

            e = qdot_subs(k.pool, e, 2, from, to);
        }
        for (size_t i = 0; i < 2; i++) {
            qdot_expr from = qdot_symbol_jet(k.pool, k.scene->coordinates.at[i], 2);
            qdot_expr to = qdot_mech_accel(k.scene, k.scene->coordinates.at[i]);

            e = qdot_subs(k.pool, e, 1, &from, &to);
        }
        same_at(&k, e, QDOT_ZERO, (int)j);
    }
    kit_close(&k);
}

/* The scene of first-order unknowns has x' = v cos(phi), w' = -m a v w/(I + m a^2), and an unknown of its own. */
static void
scene_of_states_has_the_same_rates(void **state)
{
    static const char *const of[] = {"x'*cos(phi) + y'*sin(phi)", "phi'"};
    qdot_scene *states;
    kit k;
    chosen c;

    (void)state;
    kit_open(&k);
    coords(&k, "x y phi");
    must(declare_body(k.scene, "sleigh", E(&k, "m"), E(&k, "I"), QDOT_NIL, E(&k, "(x + a*cos(phi), y + a*sin(phi))"),
                      E(&k, "phi"), QDOT_NIL));
    constraint(&k, "blade", "x'*sin(phi)", "y'*cos(phi)");
    choose(&k, &c, "v w", of);
    assert_true(qdot_speeds_suffice(k.scene, 2));
    assert_false(qdot_speeds_suffice(k.scene, 3));
    must(qdot_speeds_scene(k.scene, &c.speeds, &states));
    assert_int_equal(states->coordinates.n, 5);
    assert_int_equal(states->states.n, 5);
    same_at(&k, qdot_scene_state_of(states, k.scene->coordinates.at[0])->rate, qdot_mul(k.pool, E(&k, "cos(phi)"), c.symbol[0]),
            __LINE__);
    same_at(&k, qdot_scene_state_of(states, c.symbol[1])->rate,
            qdot_mul(k.pool, E(&k, "-m*a/(I + m*a^2)"), qdot_mul(k.pool, c.symbol[0], c.symbol[1])), __LINE__);
    qdot_scene_free(states);
    kit_close(&k);
}

/* Of a scene with z' = 2 x' - z the kinematic equations have the rate of z in speeds; it needs no speed of its own. */
static void
unknowns_keep_their_rates(void **state)
{
    static const char *const of[] = {"3*x'"};
    kit k;
    chosen c;
    qdot_expr z;

    (void)state;
    kit_open(&k);
    coords(&k, "x");
    particle(&k, "a", "m", "x");
    z = qdot_symbol_get(k.pool, QDOT_COORD, "z");
    must(qdot_scene_state(k.scene, z, QDOT_NIL));
    must(qdot_scene_state(k.scene, z, E(&k, "2*x' - z")));
    choose(&k, &c, "u", of);
    derive(&k, &c);
    same_at(&k, c.velocity[1], qdot_sub(k.pool, qdot_mul(k.pool, E(&k, "2/3"), c.symbol[0]), z), __LINE__);
    is_equation(&k, c.equation[0], qdot_mul(k.pool, E(&k, "m/9"), rate_of(&k, &c, 0)), QDOT_ZERO, __LINE__);
    kit_close(&k);
}

static void
wrong_speeds_are_refused(void **state)
{
    static const char *const square[] = {"x'^2", "y'"}, *const same[] = {"x'", "2*x'"};
    kit k;
    chosen c;

    (void)state;
    kit_open(&k);
    coords(&k, "x y");
    particle(&k, "a", "m", "(x, y)");
    choose(&k, &c, "u v", square);
    assert_int_equal(qdot_speeds_kinematics(k.scene, &c.speeds, c.velocity), QDOT_EINVAL);
    choose(&k, &c, "u v", same);
    assert_int_equal(qdot_speeds_kinematics(k.scene, &c.speeds, c.velocity), QDOT_EINVAL);
    choose(&k, &c, "u", same);
    assert_int_equal(qdot_speeds_kinematics(k.scene, &c.speeds, c.velocity), QDOT_EINVAL);
    kit_close(&k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spin_components_give_eulers_equations),
        cmocka_unit_test(sleigh_has_chaplygins_equations),
        cmocka_unit_test(equations_agree_with_accelerations),
        cmocka_unit_test(scene_of_states_has_the_same_rates),
        cmocka_unit_test(unknowns_keep_their_rates),
        cmocka_unit_test(wrong_speeds_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
