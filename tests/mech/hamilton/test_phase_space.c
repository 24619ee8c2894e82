/* The phase space of a scene that states H alone: its Lagrangian, its states, and the way back. */
#include "expr/build.h"
#include "expr/symbol.h"
#include "mech/kit.h"

#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
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

static void
constraints_are_refused_body(kit *k)
{
    qdot_phase_space x = {0};

    coords(k, "x");
    (void)state_hamiltonian(k);
    assert_int_equal(qdot_scene_constraint(k->scene, NULL, E(k, "x^2"), E(k, "1")), QDOT_OK);
    assert_int_equal(qdot_phase_space_enter(k->scene, false, &x), QDOT_ENOTBUILT);
    qdot_phase_space_leave(k->scene, &x);
    assert_int_equal(k->scene->coordinates.n, 1);
    qdot_phase_space_clear(&x);
}
TEST(constraints_are_refused)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lagrange_equations_are_hamiltons),
        cmocka_unit_test(phase_space_has_one_version),
        cmocka_unit_test(states_have_hamiltons_rates),
        cmocka_unit_test(constraints_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
