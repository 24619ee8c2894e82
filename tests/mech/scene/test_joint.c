/* Joints: as many independent rows as their kind takes freedoms away; each row's force and torque is its gradient; what is placed. */
#include "expr/build.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/kit.h"
#include "mech/scene/body-joint.h"
#include "normal/prove/decide.h"

static qdot_body_joint
joint_of(kit *k, int kind, const char *a, const char *b)
{
    qdot_body_joint j = {.name = (char *)"J", .end = {(char *)a, (char *)b}, .kind = kind};

    j.place[1] = j.axis[0] = j.axis[1] = j.pitch = QDOT_NIL;
    for (int i = 0; i < 3; i++)
        j.coordinate[i] = QDOT_NIL;
    if (kind == QDOT_JOINT_OF_rolling) {
        j.place[0] = E(k, "(x, y, 0)");
        return j;
    }
    j.place[0] = E(k, "(1, 2, 3)");
    j.place[1] = E(k, "(0, 1, 1)");
    if (qdot_joint_kinds[kind].axes > 0)
        j.axis[0] = E(k, "(1, 2, 2)");
    if (qdot_joint_kinds[kind].axes > 1)
        j.axis[1] = E(k, "(0, 1, -1)");
    if (kind == QDOT_JOINT_OF_screw)
        j.pitch = E(k, "h");
    return j;
}

static void
open_in_space(kit *k)
{
    /* about x, then y, then z: regular where all angles are 0 */
    static const char *const entries[9] = {
        "cos(theta)*cos(psi)", "-cos(theta)*sin(psi)", "sin(theta)",
        "cos(phi)*sin(psi) + sin(phi)*sin(theta)*cos(psi)", "cos(phi)*cos(psi) - sin(phi)*sin(theta)*sin(psi)", "-sin(phi)*cos(theta)",
        "sin(phi)*sin(psi) - cos(phi)*sin(theta)*cos(psi)", "sin(phi)*cos(psi) + cos(phi)*sin(theta)*sin(psi)", "cos(phi)*cos(theta)"};
    qdot_expr R[9], I[3] = {QDOT_ONE, QDOT_ONE, QDOT_ONE};

    kit_open(k);
    coords(k, "x y z phi theta psi");
    for (int i = 0; i < 9; i++)
        R[i] = E(k, "%s", entries[i]);
    must(declare_body(k->scene, "B", E(k, "m"), qdot_vector(k->pool, 3, I), QDOT_NIL, E(k, "(x, y, z)"), QDOT_NIL,
                      qdot_matrix(k->pool, 3, 3, R)));
}

/* The rows, and what is left of six freedoms. */
static void
kinds_take_their_freedoms(void **state)
{
    static const size_t freedoms[] = {[QDOT_JOINT_OF_hinge] = 1, [QDOT_JOINT_OF_slider] = 1, [QDOT_JOINT_OF_ball] = 3,
                                      [QDOT_JOINT_OF_universal] = 2, [QDOT_JOINT_OF_weld] = 0, [QDOT_JOINT_OF_planar] = 3,
                                      [QDOT_JOINT_OF_screw] = 1, [QDOT_JOINT_OF_rolling] = 3};

    (void)state;
    for (int kind = 0; kind < QDOT_JOINT_KINDS; kind++) {
        kit k_, *k = &k_;
        qdot_joint_part wrong;
        qdot_body_joint j;
        qdot_dof dof;

        open_in_space(k);
        j = joint_of(k, kind, NULL, "B");
        must(qdot_scene_joint(k->scene, &j, &wrong));
        assert_int_equal(k->scene->constraints.n, 6 - freedoms[kind]);
        must(qdot_mech_dof(k->scene, &dof));
        assert_int_equal(dof.freedom, freedoms[kind]);
        kit_close(k);
    }
}

/* Of each row the work of its force and torque on B, F.dr_b + tau.dphi, is the row's differential along each coordinate, where
 * the joint holds (d = 0 may be used: of the rows of a slide the force acts at the joint's place in B). */
static void
rows_are_their_reactions(void **state)
{
    (void)state;
    for (int kind = 0; kind < QDOT_JOINT_KINDS; kind++) {
        kit k_, *k = &k_;
        qdot_joint_row rows[QDOT_JOINT_ROWS];
        qdot_body_joint j;
        size_t n;

        open_in_space(k);
        j = joint_of(k, kind, NULL, "B");
        must(qdot_body_joint_rows(k->scene, &j, rows, &n));
        for (size_t i = 0; i < n; i++)
            for (const char *const *q = (const char *const[]){"x", "y", "z", "phi", "theta", "psi", NULL}; *q; q++) {
                const qdot_expr jet = E(k, kind == QDOT_JOINT_OF_rolling || (kind == QDOT_JOINT_OF_screw && i + 1 == n) ? "%s'" : "%s", *q);
                const qdot_expr speed = E(k, "%s'", *q);
                const qdot_expr place = kind == QDOT_JOINT_OF_rolling ? j.place[0] : qdot_scene_point(k->scene, "B", j.place[1]);
                const qdot_expr v = qdot_diff(k->pool, qdot_scene_velocity(k->scene, "B", place), speed);
                const qdot_expr w = qdot_diff(k->pool, qdot_scene_spin(k->scene, "B"), speed);
                const qdot_expr work = qdot_add(k->pool, qdot_dot(k->pool, rows[i].force, v), qdot_dot(k->pool, rows[i].torque, w));
                qdot_decision seen;

                must(qdot_decide_equal(k->pool, work, qdot_diff(k->pool, rows[i].f, jet), NULL, &seen));
                assert_int_equal(seen.verdict, QDOT_PROVED);
            }
        kit_close(k);
    }
}

/* A body placed by a joint fulfils the constraints of the same joint, whatever its coordinates are. */
static void
placed_bodies_fulfil_the_constraints(void **state)
{
    static const char *const names[] = {"a", "b", "c"};

    (void)state;
    for (int kind = 0; kind < QDOT_JOINT_KINDS; kind++) {
        const unsigned named = qdot_joint_kinds[kind].turns + qdot_joint_kinds[kind].slides;
        qdot_expr I[3] = {QDOT_ONE, QDOT_ONE, QDOT_ONE}, one[9];
        qdot_joint_row rows[QDOT_JOINT_ROWS];
        qdot_body_joint j;
        qdot_joint_part wrong;
        kit k_, *k = &k_;
        size_t n;

        if (named == 0)
            continue;
        open_in_space(k);
        coords(k, "a b c");
        for (int i = 0; i < 9; i++)
            one[i] = i % 4 == 0 ? QDOT_ONE : QDOT_ZERO;
        must(declare_body(k->scene, "C", E(k, "m"), qdot_vector(k->pool, 3, I), QDOT_NIL, E(k, "(1, 0, 0)"), QDOT_NIL,
                          qdot_matrix(k->pool, 3, 3, one)));
        j = joint_of(k, kind, "B", "C");
        for (unsigned i = 0; i < named; i++)
            j.coordinate[i] = E(k, "%s", names[i]);
        must(qdot_scene_joint(k->scene, &j, &wrong));
        assert_int_equal(k->scene->constraints.n, 0);
        /* the attitude of C in the reference configuration was that of its axes */
        for (unsigned i = 0; i < named; i++)
            j.coordinate[i] = QDOT_NIL;
        must(qdot_body_joint_rows(k->scene, &j, rows, &n));
        for (size_t i = 0; i < n; i++) {
            qdot_decision seen;

            must(qdot_decide_equal(k->pool, rows[i].f, QDOT_ZERO, NULL, &seen));
            if (seen.verdict != QDOT_PROVED)
                fail_msg("%s, row %zu", qdot_joint_kinds[kind].word, i + 1);
        }
        kit_close(k);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_take_their_freedoms),
        cmocka_unit_test(rows_are_their_reactions),
        cmocka_unit_test(placed_bodies_fulfil_the_constraints),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
