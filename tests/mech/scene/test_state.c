/* States: what is refused; their equations; what the energy makes of them. */
#include "expr/build.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/kit.h"
#include "normal/prove/decide.h"

static void
state(kit *k, const char *name, const char *rate)
{
    const qdot_expr z = qdot_symbol_get(k->pool, QDOT_COORD, name);

    if (!qdot_scene_state_of(k->scene, z))
        must(qdot_scene_state(k->scene, z, QDOT_NIL));
    if (rate)
        must(qdot_scene_state(k->scene, z, E(k, "%s", rate)));
}

static void
wrong_states_are_refused(void **unused)
{
    kit k_, *k = &k_;

    (void)unused;
    kit_open(k);
    coords(k, "x");
    state(k, "z", NULL);
    refused(k, qdot_scene_check_states(k->scene), QDOT_EINVAL, "no rate");
    refused(k, qdot_scene_state(k->scene, E(k, "x"), E(k, "1")), QDOT_ENAME, "no state");
    refused(k, qdot_scene_state(k->scene, E(k, "z"), E(k, "x''")), QDOT_ENOTBUILT, "accelerations");
    refused(k, qdot_scene_state(k->scene, E(k, "z"), E(k, "(x, x)")), QDOT_ETYPE, "number");
    refused(k, qdot_scene_state(k->scene, E(k, "z"), E(k, "2*z'")), QDOT_EINVAL, "itself");
    state(k, "z", "x - z");
    must(qdot_scene_check_states(k->scene));
    refused(k, qdot_scene_state(k->scene, E(k, "z"), E(k, "1")), QDOT_ENAME, "already");
    refused(k, qdot_scene_particle(k->scene, "a", E(k, "m"), E(k, "x + z")), QDOT_ENOTBUILT, "position");
    refused(k, qdot_scene_potential(k->scene, E(k, "x*z'")), QDOT_ENOTBUILT, "rate");
    refused(k, qdot_scene_constraint(k->scene, NULL, E(k, "x"), E(k, "z")), QDOT_ENOTBUILT, "constraint");
    kit_close(k);
}

/* m x'' = -(k + z) x, z' = x' - z with z, w in one another's rates: the potential pulls on x alone. */
static void
nothing_pulls_on_a_state(void **unused)
{
    kit k_, *k = &k_;
    qdot_dof dof;
    bool conserved;
    qdot_expr f;

    (void)unused;
    kit_open(k);
    coords(k, "x");
    state(k, "z", NULL);
    state(k, "w", NULL);
    state(k, "z", "w' - z");
    state(k, "w", "x'");
    particle(k, "b", "m", "x");
    must(qdot_scene_potential(k->scene, E(k, "(kk + z)*x^2/2")));
    assert_int_equal(qdot_scene_state_of(k->scene, E(k, "z"))->rate, E(k, "x' - z"));
    assert_int_equal(qdot_mech_force(k->scene, E(k, "z")), QDOT_ZERO);
    f = qdot_mech_numeric_forcing(k->scene);
    assert_true(qdot_is_zero(k->pool, qdot_sub(k->pool, qdot_expr_arg(k->pool, f, 0), E(k, "-(kk + z)*x")), NULL));
    assert_true(qdot_is_zero(k->pool, qdot_sub(k->pool, qdot_expr_arg(k->pool, f, 1), E(k, "x' - z - z'")), NULL));
    must(qdot_mech_dof(k->scene, &dof));
    assert_int_equal(dof.freedom, 1);
    assert_int_equal(dof.states, 2);
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_false(conserved);
    kit_close(k);
}

/* Energy is conserved beside a state that only looks on. */
static void
a_state_that_looks_on_keeps_the_energy(void **unused)
{
    kit k_, *k = &k_;
    bool conserved;

    (void)unused;
    kit_open(k);
    coords(k, "x");
    particle(k, "b", "m", "x");
    must(qdot_scene_potential(k->scene, E(k, "kk*x^2/2")));
    state(k, "z", "x - z");
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_true(conserved);
    kit_close(k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_states_are_refused),
        cmocka_unit_test(nothing_pulls_on_a_state),
        cmocka_unit_test(a_state_that_looks_on_keeps_the_energy),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
