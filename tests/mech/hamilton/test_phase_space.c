/* The phase space of a scene that states H alone: its Lagrangian, its states, and the way back. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/phase-constraints.h"
#include "mech/hamilton/phase-space.h"

/* H = x p + p^4 of a scene with x. */
static qdot_expr
state_hamiltonian(kit *k)
{
    const qdot_expr p = qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "x"));
    const qdot_expr H = qdot_add(k->pool, qdot_mul(k->pool, E(k, "x"), p), qdot_pow_int(k->pool, p, 4));

    assert_int_equal(qdot_scene_hamiltonian(k->scene, H, QDOT_NIL), QDOT_OK);
    return p;
}

static void
lagrange_equations_are_hamiltons_body(kit *k)
{
    qdot_phase_space x = {0};
    qdot_expr p, P;
    uint64_t version;

    coords(k, "x");
    p = state_hamiltonian(k);
    version = k->scene->version;
    assert_true(qdot_phase_space_needed(k->scene));
    assert_int_equal(qdot_phase_space_enter(k->scene, false, &x), QDOT_OK);
    assert_int_equal(k->scene->coordinates.n, 2);
    P = k->scene->coordinates.at[1];
    assert_true(qdot_phase_space_momentum(k->scene, P) == p);
    assert_true(qdot_phase_space_inward(k->scene, p) == P);
    assert_true(qdot_phase_space_outward(k->scene, P) == p);
    assert_true(qdot_mech_momentum(k->scene, E(k, "x")) == P);
    same_at(k, qdot_mech_energy(k->scene), qdot_phase_space_inward(k->scene, k->scene->hamiltonian), __LINE__);
    qdot_phase_space_leave(k->scene, &x);
    assert_int_equal(k->scene->coordinates.n, 1);
    assert_true(qdot_phase_space_needed(k->scene));
    assert_true(k->scene->version == version);
    qdot_phase_space_clear(&x);
}
TEST(lagrange_equations_are_hamiltons)

/* Programs of runs are kept by version: that of the phase space is the same each time. */
static void
phase_space_has_one_version_body(kit *k)
{
    qdot_phase_space x = {0};
    uint64_t version[3];

    coords(k, "x");
    (void)state_hamiltonian(k);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(qdot_phase_space_enter(k->scene, i == 1, &x), QDOT_OK);
        version[i] = k->scene->version;
        qdot_phase_space_leave(k->scene, &x);
    }
    assert_true(version[0] == version[2]);
    assert_true(version[0] != version[1]);
    qdot_phase_space_clear(&x);
}
TEST(phase_space_has_one_version)

static void
states_have_hamiltons_rates_body(kit *k)
{
    qdot_phase_space x = {0};
    qdot_expr p, rate;

    coords(k, "x");
    p = state_hamiltonian(k);
    assert_int_equal(qdot_phase_space_enter(k->scene, true, &x), QDOT_OK);
    assert_int_equal(k->scene->states.n, 2);
    rate = qdot_scene_state_of(k->scene, k->scene->coordinates.at[1])->rate;
    assert_true(rate == qdot_neg(k->pool, qdot_phase_space_inward(k->scene, p)));
    qdot_phase_space_leave(k->scene, &x);
    assert_int_equal(k->scene->states.n, 0);
    assert_true(k->scene->hamiltonian != QDOT_NIL);
    qdot_phase_space_clear(&x);
}
TEST(states_have_hamiltons_rates)

/* H = p^4/4 + p^2/2 + r^4/4 + r^2/2 + x with the momenta p, r of x, y, on x = 2 y. */
static void
constrained_scene(kit *k)
{
    qdot_expr H, p, r;

    coords(k, "x y");
    p = qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "x"));
    r = qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "y"));
    H = qdot_add(k->pool, E(k, "x"), qdot_mul(k->pool, QDOT_HALF, qdot_add(k->pool, qdot_pow_int(k->pool, p, 2), qdot_pow_int(k->pool, r, 2))));
    H = qdot_add(k->pool, H, qdot_mul(k->pool, qdot_expr_ratio(k->pool, 1, 4), qdot_add(k->pool, qdot_pow_int(k->pool, p, 4), qdot_pow_int(k->pool, r, 4))));
    assert_int_equal(qdot_scene_hamiltonian(k->scene, H, QDOT_NIL), QDOT_OK);
    assert_int_equal(qdot_scene_constraint(k->scene, "rod", E(k, "x"), E(k, "2*y")), QDOT_OK);
}

/* x'' = (3 p^2 + 1)(lambda - 1) and y'' = -2 lambda (3 r^2 + 1) agree with x'' = 2 y''. */
static void
multipliers_keep_constraints_body(kit *k)
{
    qdot_expr lambda, p, r, a, b;

    constrained_scene(k);
    p = qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "x"));
    r = qdot_symbol_of(k->pool, QDOT_MOMENTUM, E(k, "y"));
    assert_int_equal(qdot_phase_constraints_multipliers(k->scene, &lambda), QDOT_OK);
    a = qdot_add(k->pool, QDOT_ONE, qdot_mul(k->pool, qdot_expr_ratio(k->pool, 3, 1), qdot_pow_int(k->pool, p, 2)));
    b = qdot_add(k->pool, QDOT_ONE, qdot_mul(k->pool, qdot_expr_ratio(k->pool, 3, 1), qdot_pow_int(k->pool, r, 2)));
    same_at(k, qdot_mul(k->pool, lambda, qdot_add(k->pool, a, qdot_mul(k->pool, qdot_expr_ratio(k->pool, 4, 1), b))), a, __LINE__);
}
TEST(multipliers_keep_constraints)

static void
constraints_are_eliminated_body(kit *k)
{
    qdot_phase_space x = {0};

    constrained_scene(k);
    assert_int_equal(qdot_phase_space_enter(k->scene, true, &x), QDOT_ENOTBUILT);
    assert_int_equal(qdot_phase_space_enter(k->scene, false, &x), QDOT_OK);
    assert_int_equal(k->scene->constraints.n, 0);
    assert_int_equal(k->scene->eliminated.n, 1);
    assert_true(k->scene->eliminated.at[0].position == k->scene->constraints.at[0].f);
    qdot_phase_space_leave(k->scene, &x);
    assert_int_equal(k->scene->constraints.n, 1);
    assert_int_equal(k->scene->eliminated.n, 0);
    qdot_phase_space_clear(&x);
}
TEST(constraints_are_eliminated)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lagrange_equations_are_hamiltons),
        cmocka_unit_test(phase_space_has_one_version),
        cmocka_unit_test(states_have_hamiltons_rates),
        cmocka_unit_test(multipliers_keep_constraints),
        cmocka_unit_test(constraints_are_eliminated),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
