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
    qdot_expr mass, position; /* centre of mass, in 2 or 3 dimensions */
    qdot_expr rotation;       /* a 2x2 or 3x3 MAT: its columns the body's axes in space */
    qdot_expr inertia;        /* plane: a scalar; space: a symmetric 3x3 MAT, body axes, about the
                                 centre of mass */
    qdot_expr angle;          /* plane: the declared angle; nil in space */
    qdot_expr unused;
} qdot_body;

typedef struct {
    char *name; /* NULL: no label */
    qdot_expr at[2]; /* the ends: positions */
    char *end[2];    /* their labels, NULL for a point */
    qdot_expr stiffness, rest; /* spring; of a damper: coefficient, nil */
} qdot_link;

/* A term of V, a term of the Rayleigh function, or a uniform field. */
typedef struct {
    char *name; /* NULL: no label */
    qdot_expr e, unused;
} qdot_term;

typedef struct {
    char *name;   /* NULL: no label */
    qdot_expr force; /* vector (or scalar in 1-D) */
    qdot_expr point; /* the position of the point on which it acts */
    char *on;     /* label of the particle or body, NULL for a point */
    bool material; /* acts on the material of body `on` that is at `point` at that time:
                      Q = F . dv/dq', v = velocity(on, point); else Q = F . d(point)/dq */
    char unused[7];
} qdot_force;

typedef struct {
    char *name;       /* NULL */
    qdot_expr torque; /* scalar; vector for a spatial body */
    qdot_expr coordinate; /* a generalized force on this coordinate; nil: a torque on `body` */
    bool force;           /* it was declared with `force` */
    char unused[3];
    int body;             /* index of the body that it turns */
} qdot_torque;

typedef enum { QDOT_HOLONOMIC, QDOT_VELOCITY, QDOT_ACCELERATION } qdot_constraint_kind;

typedef struct {
    char *name;       /* "rod", "pin, 1" for a component; "1", "2" ... without label */
    char *label;      /* "rod", "pin"; NULL without label */
    qdot_expr f;      /* left - right = 0 */
    qdot_expr left, right;
    qdot_constraint_kind kind; /* the highest derivative f holds */
    qdot_expr multiplier;      /* the symbol lambda[name] */
    qdot_expr unused;
} qdot_constraint;

/* An event of a run, where left = right. It does not affect the mechanics. */
typedef struct {
    char *name;
    qdot_expr left, right;
    int way;   /* left - right 1: rises, -1: falls as t grows, 0: either */
    bool stop; /* the run ends there */
    char unused[3];
    qdot_vec(qdot_expr) targets, values; /* q, q' or a parameter becomes the value, all at
                                            once */
} qdot_event;

/* A statement `assume`, as it was typed. */
typedef struct {
    qdot_expr relation;
    bool turned; /* written as b > a for the relation a < b */
    char unused[3];
} qdot_assumption;

#pragma GCC diagnostic pop

typedef struct qdot_derived qdot_derived; /* mech/scene/cache.h */

typedef struct qdot_scene {
    qdot_pool *pool;  /* borrowed */
    qdot_arena *texts;
    uint64_t version; /* one number for each state: qdot_scene_changed */
    qdot_vec(qdot_expr) coordinates;
    qdot_vec(qdot_particle) particles;
    qdot_vec(qdot_body) bodies;
    qdot_vec(qdot_term) gravities;    /* vectors: fields that add up, one without label */
    qdot_vec(qdot_term) potentials;   /* terms of V declared with `potential` */
    qdot_vec(qdot_link) springs, dampers;
    qdot_vec(qdot_term) dissipations; /* terms of the Rayleigh function */
    qdot_vec(qdot_force) forces;
    qdot_vec(qdot_torque) torques;
    qdot_vec(qdot_constraint) constraints;
    qdot_vec(qdot_event) events;
    qdot_vec(qdot_assumption) assumed;
    qdot_vec(qdot_expr) conditions; /* its inequalities */
    qdot_vec(qdot_expr) relations;  /* equations and their derivatives, as expressions that are 0 */
    qdot_expr lagrangian;           /* stated; nil: T - V */
    qdot_vec(char *) dropped;       /* what the latest call dropped, for a notice: components of
                                       a constraint that hold identically ("pin, 2"); springs,
                                       forces ... on a removed thing ("spring s1", "a force") */
    qdot_derived *derived;          /* owned; results derived for `version` */
    void *kept;                     /* plans kept by sim; NULL: none */
    void (*kept_free)(void *kept);
} qdot_scene;

/* Kinds of declarations that need no label, in the order of the statement `scene`. */
typedef enum {
    QDOT_GRAVITY,
    QDOT_POTENTIAL,
    QDOT_SPRING,
    QDOT_DAMPER,
    QDOT_DISSIPATION,
    QDOT_FORCE, /* on a particle, a body, at a place; then those on coordinates */
    QDOT_TORQUE
} qdot_scene_kind;

/* The scene's facts for the engine (borrowed, valid until the scene changes). */
static inline qdot_facts
qdot_scene_facts(const qdot_scene *s)
{
    return (qdot_facts){.n_relations = s->relations.n,
                        .relations = s->relations.at,
                        .n_conditions = s->conditions.n,
                        .conditions = s->conditions.at};
}

#endif
