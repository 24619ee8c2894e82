/* derived.h -- what was derived of a scene, kept until it changes. Internal to mech/.
 *
 * Kinetic energy of everything, particles and bodies alike, is a sum over inertial terms
 *
 *     T = 1/2 sum_p w_p x_p' y_p'
 *
 * of scalar functions x, y of (q, t): a particle gives m r_d' r_d' for each axis d; a
 * body its centre and, from the second moments J = 1/2 tr(I) 1 - I, J_ab (R e_a)_d' (R
 * e_b)_d'.
 *
 * Terms that share a Jacobian entry are grouped before anything is expanded: a group is
 * an expression e and the set of terms p at which it stands, sets are interned, and the
 * weights of an intersection are added once. A chain of N links has N sets.
 */
#ifndef QDOT_MECH_DERIVED_H
#define QDOT_MECH_DERIVED_H

#include <string.h>

#include "mech/dynamics/quantity.h"
#include "normal/field/facts.h"

/* Whether two labels are the same; NULL is none. */
static inline bool
qdot_label_is(const char *a, const char *b)
{
    return a && b && strcmp(a, b) == 0;
}

/* w x' y'; axis: the component of a centre's or particle's position, -1 for a body's
 * axes. */
typedef struct {
    qdot_expr w, x, y;
    int axis;
} qdot_inertial;

typedef struct {
    qdot_expr e;
    uint32_t set; /* of terms p */
} qdot_group;

typedef qdot_vec(qdot_group) qdot_groups;

typedef struct {
    size_t n;     /* coordinates; index n stands for t */
    size_t words; /* of a set */
    qdot_vec(qdot_inertial) terms;
    qdot_vec(uint64_t) bits;    /* [sets * words]; set 0 is empty */
    qdot_vec(qdot_expr) weight; /* [sets]: sum of w, nil until asked */
    qdot_vec(uint32_t) slots;   /* open hash table of sets, + 1 */
    uint32_t axis_set[3];       /* terms of positions along an axis */
    qdot_groups *dx, *dy;       /* [n + 1]: dx/dq_i, dx/dt; dy == dx where all y = x */
    bool rest_ready, place_ready;
    qdot_groups rest;  /* x'' at q'' = 0; ask qdot_kinematics_rest */
    qdot_groups place; /* x itself, by its terms; ask qdot_kinematics_place */
} qdot_kinematics;

typedef struct {
    uint32_t j, k; /* entry j <= k of M */
    uint32_t i;    /* by this coordinate; n: by t */
    qdot_expr value;
} qdot_mass_slope;

/* A sum simplified once for all that are alike but for their symbols (qdot_mech_alike). */
typedef struct {
    qdot_expr pattern, atoms, simple;
} qdot_pattern;

struct qdot_derived {
    uint64_t version; /* of the scene all below belongs to */
    size_t n;
    bool kinematics_ready;
    qdot_kinematics kinematics;
    qdot_expr *square_spring,
        *square_damper;  /* u.u of a link, simplified, nil until asked */
    qdot_expr *M, *b, c; /* of T: [n*n], [n], scalar; simplified; M NULL until asked */
    bool slopes_ready;
    qdot_vec(qdot_mass_slope) slopes; /* of M, nonzero ones */
    qdot_vec(qdot_pattern) patterns;
    qdot_expr kinetic, potential, lagrangian, energy, mass_matrix;
    qdot_expr *momentum, *force, *rest, *left, *equation; /* [n] each */
    qdot_expr *accel;                                     /* [n], all at once */
    qdot_expr *lambda; /* [constraints], with accel; nil where they are not unique */
    qdot_expr numeric_mass, numeric_forcing;
    bool *independent; /* [constraints] */
    bool *hidden;      /* [constraints] behind those: leaves a condition (qdot_dof.is_hidden) */
    bool unmet;        /* no point was found where they all hold */
    bool conserved_known, conserved;
    /* Survives changes: the relations and their derivatives. */
    qdot_vec(qdot_expr) relations;
};

/* The cache, emptied if the scene has changed; NULL: no memory, the pool has failed. */
qdot_derived *qdot_derived_get(qdot_scene *s);
void qdot_derived_free(qdot_derived *d);
/* The index of a coordinate in the scene; fails (pool) with QDOT_ENAME and returns false.
 * */
bool qdot_derived_index(qdot_scene *s, qdot_expr q, size_t *i);

/* --- small helpers --- */
/* Record the failure just raised in the pool; nil. */
#define qdot_mech_fail(s, ...) (qdot_fail(__VA_ARGS__), qdot_pool_fail((s)->pool))
uint32_t qdot_mech_holds(const qdot_scene *s, qdot_expr e);
/* 1 for a scalar, the size of a VEC, 0 for anything else. */
uint32_t qdot_mech_dimension(const qdot_pool *pool, qdot_expr r);
qdot_expr qdot_mech_component(const qdot_pool *pool, qdot_expr r, uint32_t d);
qdot_expr qdot_mech_dot(qdot_pool *pool, qdot_expr a, qdot_expr b); /* scalars too */
/* Simplified with the scene's facts; above a size only what its parts already are. */
qdot_expr qdot_mech_tidy(qdot_scene *s, qdot_expr e);
/* The same for a sum of parts that are simplified: tried while it is short. */
qdot_expr qdot_mech_tidy_whole(qdot_scene *s, qdot_expr e);
/* Simplified, by substitution where the same form with other symbols was simplified before: of
 * the N^2 entries of a chain's M one is enough. */
qdot_expr qdot_mech_alike(qdot_scene *s, qdot_expr e);
/* Coordinate, velocity, acceleration i. */
qdot_expr qdot_mech_jet(qdot_scene *s, size_t i, uint32_t order);
/* e with every acceleration 0. */
qdot_expr qdot_mech_at_rest(qdot_scene *s, qdot_expr e);
bool qdot_mech_stated(const qdot_scene *s);
/* QDOT_EINVAL in the pool unless the scene has T and V. */
bool qdot_mech_needs_particles(qdot_scene *s, const char *what);
/* Size of the scene's space: 1, 2, 3; 0 while nothing tells. */
uint32_t qdot_scene_dimension(const qdot_scene *s);
/* Angular velocity as a linear form: its coefficient of q_i', from R or the angle. */
qdot_expr qdot_body_spin(qdot_scene *s, const qdot_body *body);
qdot_expr qdot_body_partial_spin(qdot_scene *s, const qdot_body *body, qdot_expr q);
/* d velocity(body, place) / dq'. */
qdot_expr qdot_body_partial_velocity(qdot_scene *s, const qdot_body *body, qdot_expr place,
                                     qdot_expr q);
/* Put [n] nil expressions in *array unless it is there. */
bool qdot_derived_array(qdot_scene *s, qdot_expr **array, size_t n);
void qdot_scene_forget_dropped(qdot_scene *s);
QDOT_MUST_CHECK qdot_status qdot_scene_drop(qdot_scene *s, const char *kind,
                                            const char *name);
/* A copy that lasts as long as the scene; *copy NULL for NULL. */
QDOT_MUST_CHECK qdot_status qdot_scene_copy_text(qdot_scene *s, const char *text, char **copy);
/* Where among the torques the k-th of a kind (QDOT_FORCE beyond the forces, QDOT_TORQUE) is. */
size_t qdot_scene_torque_at(const qdot_scene *s, qdot_scene_kind kind, size_t k);
QDOT_MUST_CHECK qdot_status qdot_event_print(const qdot_scene *s, const qdot_event *e,
                                             qdot_text *out);

/* --- kinematics.c --- */
void qdot_kinematics_clear(qdot_kinematics *k);
/* Terms, sets and Jacobian groups; NULL on failure. */
qdot_kinematics *qdot_kinematics_get(qdot_scene *s);
/* k->rest, k->place, made when first asked for: sets are added to k. NULL on failure. */
const qdot_groups *qdot_kinematics_rest(qdot_scene *s, qdot_kinematics *k);
const qdot_groups *qdot_kinematics_place(qdot_scene *s, qdot_kinematics *k);
uint32_t qdot_kinematics_and(qdot_scene *s, qdot_kinematics *k, uint32_t a, uint32_t b);
qdot_expr qdot_kinematics_weight(qdot_scene *s, qdot_kinematics *k, uint32_t set);
/* sum over p of w_p a_p b_p for two grouped functions; people: simplified. */
qdot_expr qdot_kinematics_pair(qdot_scene *s, qdot_kinematics *k, const qdot_groups *a,
                               const qdot_groups *b, bool people);
/* The same over one function and the gravity fields: sum w_p g_axis(p) a_p. */
qdot_expr qdot_kinematics_gravity(qdot_scene *s, qdot_kinematics *k,
                                  const qdot_groups *a);

/* --- nested.c --- */
/* Sets of items that have values; bits of items >= `items` are 0. */
typedef struct {
    size_t items, sets, words; /* words of 64 bits a set */
    const qdot_expr *value;    /* [items] */
    const uint64_t *bits;      /* [sets * words] */
} qdot_family;

/* sum [sets]: of the values of each set, held (qdot_hold), made of the sums of sets within
 * it. Work sets^2 words. False on failure. */
bool qdot_nested_sums(qdot_scene *s, const qdot_family *family, qdot_expr *sum);

/* --- recursive.c --- */
/* Whether no mass varies with place, time or velocity, so that the next has an answer. */
bool qdot_recursive_applies(const qdot_scene *s, const qdot_kinematics *k);
/* f [n] of M q'' = f by nested sums; false on failure. */
bool qdot_recursive_forcing(qdot_scene *s, qdot_kinematics *k, qdot_expr *f);
/* M_ij of T in products that a row and a column share. Nil on failure. */
qdot_expr qdot_recursive_mass(qdot_scene *s, qdot_kinematics *k, size_t i, size_t j);

/* --- mass-matrix.c --- */
/* M, b, c of T = 1/2 M q'q' + b q' + c in the cache; false on failure. */
bool qdot_mass_get(qdot_scene *s);
qdot_expr qdot_mass_entry(qdot_scene *s, size_t i, size_t j); /* after qdot_mass_get */
bool qdot_mass_slopes(qdot_scene *s);
/* M of L = T - V (V may hold velocities) or of the stated L: entry i, j, simplified. */
qdot_expr qdot_mass_of_lagrangian(qdot_scene *s, size_t i, size_t j);

/* --- energy.c --- */
/* u . u of the ends of spring or damper k, simplified. */
qdot_expr qdot_link_square(qdot_scene *s, bool damper, size_t k);
qdot_expr qdot_spring_potential(qdot_scene *s, size_t k);
qdot_expr qdot_potential_but_gravity(qdot_scene *s);
/* V's terms that hold velocities, as a sum: potentials may. */
qdot_expr qdot_potential_with_velocities(qdot_scene *s);
/* dL/dx, x a coordinate, velocity or t, from the parts of L. */
qdot_expr qdot_lagrangian_slope(qdot_scene *s, qdot_expr x);
bool qdot_lagrangian_has(qdot_scene *s, qdot_expr x, bool *has);
/* Whether that is proved zero, x a coordinate or t: entry by entry of M and b where V holds no
 * velocities. */
bool qdot_lagrangian_is_still(qdot_scene *s, qdot_expr x);

/* --- virtual-work.c --- */
/* Generalized force on coordinate i. people: simplified. applied: without -dV/dq. */
qdot_expr qdot_force_total(qdot_scene *s, size_t i, bool people, bool applied);
/* The same without gravity, not simplified. */
qdot_expr qdot_force_but_gravity(qdot_scene *s, size_t i);
/* What `force` and `torque` declare alone. */
qdot_expr qdot_force_declared(qdot_scene *s, size_t i);

/* --- lagrange.c --- */
/* -(d/dt dF/dq' - dF/dq) at q'' = 0 for any F(q, q', t). */
qdot_expr qdot_lagrange_forcing(qdot_scene *s, qdot_expr F, size_t i);
/* d/dt dT/dq' - dT/dq at q'' = 0, simplified. */
qdot_expr qdot_lagrange_rest(qdot_scene *s, size_t i);

/* f_i of M q'' = f, from simplified parts. */
qdot_expr qdot_lagrange_people_forcing(qdot_scene *s, size_t i);

/* --- constraint.c --- */
/* df/dq, df/dq', df/dq'' by the constraint's kind. */
qdot_expr qdot_constraint_slope(qdot_scene *s, size_t constraint, size_t i);
/* The constraints' terms on the right of equation i. */
qdot_expr qdot_constraint_reaction(qdot_scene *s, size_t i);
/* The scene's relations and its constraints with their derivatives, for proofs on the
 * constraints' manifold. *relations owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_constraint_facts(qdot_scene *s, qdot_expr **relations,
                                                  qdot_facts *facts);
/* --- freedom.c --- */
/* Which constraints are independent of those before them: d->independent. */
bool qdot_freedom_independent(qdot_scene *s);

/* --- generic.c --- */
/* Values of e [n] in double at a point: symbols [m] have values; any other symbol or
 * undefined function gets one of its own from `seed`. NaN where undefined. */
QDOT_MUST_CHECK qdot_status qdot_generic_evaluate(const qdot_pool *pool, size_t n,
                                                  const qdot_expr *e, size_t m,
                                                  const qdot_expr *symbols,
                                                  const double *values, uint64_t seed,
                                                  double *out);
/* A number of its own for a symbol: inside its domain, of about size 1. */
double qdot_generic_value(const qdot_pool *pool, qdot_expr symbol, uint64_t seed);

#endif
