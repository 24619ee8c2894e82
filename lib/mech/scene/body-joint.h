/* body-joint.h -- joints between two bodies: their constraints, their reactions, and bodies that they place.
 *
 * A joint has a place p and axes u, v, w, at right angles, in each of two bodies A and B. With r + R p the place in space and
 * R u the axis,
 *
 *     d = (r_B + R_B p_B) - (r_A + R_A p_A)
 *
 *     MEET       d = 0                                  a force lambda on B
 *     ACROSS     v_A.d = w_A.d = 0                      forces lambda v_A, lambda w_A
 *     ALONG      u_A.d = 0                              a force lambda u_A
 *     PARALLEL   v_A.u_B = w_A.u_B = 0                  torques lambda u_B x v_A, lambda u_B x w_A
 *     TURN       w_A.v_B = 0; in the plane the angle of B less that of A is as in the reference configuration
 *     CROSS      u_A.v_B = 0                            a torque lambda v_B x u_A
 *     ADVANCE    d(u_A.d)/dt = h u_A.(omega_B - omega_A),  h = pitch/(2 pi): of velocities, since angles are many-valued
 *     CONTACT    the materials of A and B at the place p of contact, which moves, have one velocity
 *
 * In the reference configuration all coordinates and t are 0. One place and axis are those in space then; of two, each stands
 * in its own body's axes, and axes that are given once are A's. The ground's axes are those of space.
 *
 * A joint that names its coordinates q (a weld has none) places B, whose own place is the one in the reference configuration:
 *
 *     R_B = R_A G(q) R_A0^T R_B0,    r_B = r_A + R_A (p_A + g(q)) - R_B p_B
 *
 * with G the rotations about its axes and g its slides. There are no multipliers then, and no reactions.
 *
 * Tests  tests/mech/scene/test_joint.c, tests/script/joints/, tests/bad/joints/
 */
#ifndef QDOT_MECH_BODY_JOINT_H
#define QDOT_MECH_BODY_JOINT_H

#include "mech/scene/scene.h"

typedef enum {
    QDOT_JOINT_MEET = 1,
    QDOT_JOINT_ACROSS = 2,
    QDOT_JOINT_ALONG = 4,
    QDOT_JOINT_PARALLEL = 8,
    QDOT_JOINT_TURN = 16,
    QDOT_JOINT_CROSS = 32,
    QDOT_JOINT_ADVANCE = 64,
    QDOT_JOINT_CONTACT = 128
} qdot_joint_fixes;

enum {
#define JOINT(word, plane, space, axes, turns, slides, sentence) QDOT_JOINT_OF_##word,
#include "mech/scene/body-joint.def"
#undef JOINT
    QDOT_JOINT_KINDS
};

typedef struct {
    const char *word, *sentence;
    unsigned plane, space; /* bits of qdot_joint_fixes */
    unsigned axes, turns, slides;
} qdot_joint_kind;

extern const qdot_joint_kind qdot_joint_kinds[QDOT_JOINT_KINDS];

/* One constraint f = 0, or of velocities, with what a multiplier of 1 applies to B: a force at the joint and a torque about it
 * (a scalar in the plane). */
typedef struct {
    qdot_expr f, force, torque;
} qdot_joint_row;

enum { QDOT_JOINT_ROWS = 6 };

/* The place and axes of a joint in the axes of A [0] and of B [1]; the attitude R_A0^T R_B0 of B in A's
 * axes in the reference configuration. */
typedef struct {
    const qdot_body *body[2]; /* borrowed; NULL: the ground */
    uint32_t dim;
    qdot_expr place[2], u[2], v[2], w[2], attitude;
} qdot_joint_frames;

/* What an error is about. */
typedef enum {
    QDOT_JOINT_WHOLE,
    QDOT_JOINT_KIND,
    QDOT_JOINT_A,
    QDOT_JOINT_B,
    QDOT_JOINT_PLACE,
    QDOT_JOINT_AXIS,
    QDOT_JOINT_PITCH
} qdot_joint_part;

/* Add a joint: its constraints, named as those of one `constraint` of its name with a component each; or, if it names
 * coordinates, give B its place. A weld, which has no coordinates, places a B that has none. Everything is copied; `places` is
 * found. QDOT_ENAME: no such body; QDOT_EINVAL, QDOT_ETYPE: what does not fit; *wrong: which part. */
QDOT_MUST_CHECK qdot_status qdot_scene_joint(qdot_scene *s, const qdot_body_joint *joint, qdot_joint_part *wrong);
/* Take the latest joint back, with the place of its second body, `before`, if it placed one (NULL: it did not). */
void qdot_scene_take_back_joint(qdot_scene *s, const qdot_body *before);
const qdot_body_joint *qdot_scene_find_joint(const qdot_scene *s, const char *label);
/* Whether a body, NULL: the ground, moves by coordinates or in time. */
bool qdot_body_joint_moves(const qdot_scene *s, const char *label);
/* Whether the bodies are at one place in the reference configuration, both by coordinates, so that a place given once is one
 * point of the axes of both. */
bool qdot_body_joint_is_at_one_place(qdot_scene *s, const qdot_body_joint *joint);

/* The expression e in the reference configuration: all coordinates and t are 0. */
qdot_expr qdot_body_joint_reference(qdot_scene *s, qdot_expr e);
/* The place and axes of a joint; its constraints; parts of qdot_scene_joint. */
QDOT_MUST_CHECK qdot_status qdot_body_joint_frames(qdot_scene *s, const qdot_body_joint *joint, qdot_joint_frames *x);
QDOT_MUST_CHECK qdot_status qdot_body_joint_rows(qdot_scene *s, const qdot_body_joint *joint,
                                                 qdot_joint_row rows[QDOT_JOINT_ROWS], size_t *n);
QDOT_MUST_CHECK qdot_status qdot_body_joint_place(qdot_scene *s, const qdot_body_joint *joint);

/* What the joint applies to B: the force at the joint and the torque about it, with the multipliers as symbols. QDOT_EINVAL:
 * the scene holds a part of the joint by itself, so that nothing tells its force; or the joint has placed B. */
QDOT_MUST_CHECK qdot_status qdot_body_joint_reaction(qdot_scene *s, const qdot_body_joint *joint, qdot_expr *force,
                                                     qdot_expr *torque);
/* Print the statement that declares it, with an end of line. */
QDOT_MUST_CHECK qdot_status qdot_body_joint_print(const qdot_scene *s, const qdot_body_joint *joint, qdot_text *out);

#endif
