/* things.h -- the data of a scene (scene.h has its functions).
 *
 * A scene owns its arrays and texts and borrows the pool.
 */
#ifndef QDOT_MECH_THINGS_H
#define QDOT_MECH_THINGS_H

#include "base/memory.h"
#include "normal/field/facts.h"

/* `undo` compares items byte by byte, so padding bytes are members, `unused`, which initialisers
 * set to 0. The compiler rejects other padding. */
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wpadded"

typedef struct {
    char *name;
    qdot_expr mass, position;
} qdot_particle;

typedef struct {
    char *name;
    qdot_expr mass, position; /* mass; position of the centre of mass in 2 or 3 dimensions */
    qdot_expr rotation;       /* 2x2 or 3x3 MAT whose columns are the body's axes in space */
    qdot_expr inertia;        /* plane: a scalar; space: a symmetric 3x3 MAT, body axes, about the
                                 centre of mass */
    qdot_expr angle;          /* in the plane: the declared angle; nil in space */
    qdot_expr unused;
} qdot_body;

typedef struct {
    char *name; /* NULL: no label */
    qdot_expr at[2]; /* positions of the two ends */
    char *end[2];    /* labels of the particles or bodies at the two ends; NULL for a plain point */
    qdot_expr stiffness, rest; /* spring: stiffness and rest length; damper: coefficient and nil */
} qdot_link;

/* A term of V, a term of the Rayleigh function, or a uniform field. */
typedef struct {
    char *name; /* NULL: no label */
    qdot_expr e, unused;
} qdot_term;

typedef struct {
    char *name;   /* NULL: no label */
    qdot_expr force; /* the force: a vector; in one dimension a scalar */
    qdot_expr point; /* position of the point on which the force acts */
    char *on;     /* label of the particle or body; NULL for a point */
    bool material; /* acts on the material of body `on` that is at `point` at that time:
                      Q = F . dv/dq', v = velocity(on, point); else Q = F . d(point)/dq */
    char unused[7];
} qdot_force;

typedef struct {
    char *name;       /* label; NULL: none */
    qdot_expr torque; /* the torque: a scalar in the plane, a vector for a body in space */
    qdot_expr coordinate; /* coordinate on which a generalized force acts; nil: this is a torque on `body` */
    bool force;           /* declared by the statement `force`, not by `torque` */
    char unused[3];
    int body;             /* index of the body on which the torque acts */
} qdot_torque;

typedef enum { QDOT_HOLONOMIC, QDOT_VELOCITY, QDOT_ACCELERATION } qdot_constraint_kind;

typedef struct {
    char *name;       /* name of the constraint: "rod"; "pin, 1" for a component; without label "1", "2" ... */
    char *label;      /* the declared label, such as "rod"; NULL: no label */
    qdot_expr f;      /* the constraint is f = left - right = 0 */
    qdot_expr left, right;
    qdot_constraint_kind kind; /* by the highest time derivative in f: of positions, velocities, accelerations */
    qdot_expr multiplier;      /* its Lagrange multiplier, the symbol lambda[name] */
    qdot_expr unused;
} qdot_constraint;

/* A joint between two bodies (mech/scene/body-joint.h). */
typedef struct {
    char *name;
    char *end[2];       /* labels of the bodies A and B; NULL: the ground */
    qdot_expr place[2]; /* in space, in the reference configuration, and nil; or in A's axes and in B's. Rolling: the contact,
                           in space, as it moves */
    qdot_expr axis[2];  /* as the places; nil: none */
    qdot_expr pitch;    /* of a screw, the advance with each turn; nil: none */
    qdot_expr coordinate[3]; /* the coordinates that it names, angles, then lengths; nil: no more */
    int kind;           /* index of its row of mech/scene/body-joint.def */
    int places;         /* 1: it has placed B, by its coordinates, and has no constraints; 0: it has */
} qdot_body_joint;

/* A constraint whose multiplier is solved for in the forces of the scene: the motion keeps it by itself from a start that
 * fulfils it. */
typedef struct {
    qdot_expr position, rate; /* what vanishes on such a start: f (nil: it is of velocities), and what it says of velocities */
    qdot_expr multiplier;     /* the value of lambda[name] */
} qdot_eliminated;

/* A first-order unknown: z' = rate, an expression of coordinates, velocities, states and t. It is among
 * the coordinates of the scene, but no mass moves with it, no force acts on it, and it pulls on nothing: for everything
 * else it is a function of time. A scene may have nothing but such unknowns. */
typedef struct {
    qdot_expr z;    /* the symbol, a coordinate of the scene */
    qdot_expr rate; /* nil: declared, but its right side is not known yet */
} qdot_state;

/* A coordinate u that stands for a higher derivative, u = base^(order), where a Lagrangian of second or higher derivatives is
 * stated. With order 2, 4, ... up to twice that of L less 2, all equations are of second order again. Such coordinates come
 * after all others. (mech/scene/higher.c) */
typedef struct {
    qdot_expr u, base;
    uint32_t order;
} qdot_higher;

/* An event of a run, where left = right. It does not affect the mechanics. */
typedef struct {
    char *name;
    qdot_expr left, right;
    int way;   /* direction of left - right as t grows: 1 rising, -1 falling, 0 either */
    bool stop; /* the run ends at this event */
    char unused[3];
    qdot_vec(qdot_expr) targets, values; /* q, q' or a parameter becomes the value, all at
                                            once */
} qdot_event;

/* A statement `assume`, as it was typed. */
typedef struct {
    qdot_expr relation;
    bool turned; /* the user wrote b > a, stored as a < b */
    char unused[3];
} qdot_assumption;

#pragma GCC diagnostic pop

typedef struct qdot_derived qdot_derived; /* defined in mech/scene/cache.h */

typedef struct qdot_scene {
    qdot_pool *pool;  /* pool of all expressions of the scene; borrowed */
    qdot_arena *texts;
    uint64_t version; /* a different number for each state of the scene: qdot_scene_changed */
    qdot_vec(qdot_expr) coordinates;
    qdot_vec(qdot_particle) particles;
    qdot_vec(qdot_body) bodies;
    qdot_vec(qdot_term) gravities; /* uniform gravity fields, vectors, which add up; at most one has no label */
    qdot_vec(qdot_term) potentials;   /* terms of V declared with `potential` */
    qdot_vec(qdot_link) springs, dampers;
    qdot_vec(qdot_term) dissipations; /* terms of the Rayleigh function */
    qdot_vec(qdot_force) forces;
    qdot_vec(qdot_torque) torques;
    qdot_vec(qdot_constraint) constraints;
    qdot_vec(qdot_body_joint) joints; /* their constraints are among `constraints`, with the name of the joint as label */
    qdot_vec(qdot_eliminated) eliminated; /* [i] belongs to constraints.at[i], and constraints.n is 0: phase space alone (mech/hamilton) */
    qdot_vec(qdot_state) states;
    qdot_vec(qdot_higher) higher;
    qdot_vec(qdot_event) events;
    qdot_vec(qdot_expr) inputs;  /* parameters that drive the scene: 0 at rest, in runs a value or a function of t and q */
    qdot_vec(qdot_expr) outputs; /* expressions that are observed */
    qdot_vec(qdot_assumption) assumed;
    qdot_vec(qdot_expr) conditions; /* assumptions that are inequalities */
    qdot_vec(qdot_expr) relations;  /* assumptions that are equations left = right, as left - right; also their derivatives */
    qdot_expr lagrangian;           /* the stated Lagrangian, or the one found from a stated H; nil: L = T - V */
    qdot_expr higher_lagrangian; /* the stated Lagrangian where it holds second derivatives; `lagrangian` is then sum 1/2 q'^2 over
                                    all coordinates, and what is applied to them makes the equations of this one; else nil */
    qdot_expr hamiltonian; /* the stated H(q, p, t); nil: not stated. `lagrangian` nil beside it: none was found */
    qdot_vec(char *) dropped;       /* what the latest call dropped, for a notice: components of
                                       a constraint that hold identically ("pin, 2"); springs,
                                       forces ... on a removed thing ("spring s1", "a force") */
    qdot_derived *derived;          /* results derived from the declarations of this `version`, such as the Lagrangian; owned */
    void *kept;                     /* programs for numerical runs that the directory sim/ keeps for reuse; NULL: none */
    void (*kept_free)(void *kept);
} qdot_scene;

/* Kinds of declarations that need no label, in the order of the statement `scene`. */
typedef enum {
    QDOT_GRAVITY,
    QDOT_POTENTIAL,
    QDOT_SPRING,
    QDOT_DAMPER,
    QDOT_DISSIPATION,
    QDOT_FORCE, /* forces on particles, bodies and points come first, then generalized forces on coordinates */
    QDOT_TORQUE
} qdot_scene_kind;

/* The assumptions of the scene as used in proofs and simplification; borrowed, valid until the scene changes. */
static inline qdot_facts
qdot_scene_facts(const qdot_scene *s)
{
    return (qdot_facts){.n_relations = s->relations.n,
                        .relations = s->relations.at,
                        .n_conditions = s->conditions.n,
                        .conditions = s->conditions.at};
}

#endif
