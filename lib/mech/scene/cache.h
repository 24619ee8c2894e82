/* cache.h -- results derived from a scene, kept until it changes. Internal to mech/.
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
 * an expression e and the set of terms p that have it; sets are interned, and the
 * weights of an intersection are added once. A chain of N links has N sets.
 */
#ifndef QDOT_MECH_CACHE_H
#define QDOT_MECH_CACHE_H

#include "mech/scene/things.h"

/* w x' y'; axis: the component of a centre's or particle's position, -1 for a body's
 * axes. */
typedef struct {
    qdot_expr w, x, y;
    int axis;
} qdot_inertial;

typedef struct {
    qdot_expr e;
    uint32_t set; /* index of the set of inertial terms p in which the expression occurs */
} qdot_group;

typedef qdot_vec(qdot_group) qdot_groups;

typedef struct {
    size_t n;     /* number of coordinates; index n stands for t */
    size_t words; /* number of 64-bit words that represent a set */
    qdot_vec(qdot_inertial) terms;
    qdot_vec(uint64_t) bits; /* [sets * words] bit i of a set: term i belongs to it; set 0 is empty */
    qdot_vec(qdot_expr) weight; /* [sets] sum of the weights w of each set; nil until needed */
    qdot_vec(uint32_t) slots;   /* open hash table of the sets of inertial terms; an entry is a set's index + 1 */
    uint32_t axis_set[3];       /* index of the set of inertial terms that are positions along axis x, y, z */
    qdot_groups *dx, *dy;       /* [n + 1] groups of dx/dq_i, then of dx/dt; dy == dx if y = x in all inertial terms */
    bool rest_ready, place_ready;
    qdot_groups rest;  /* groups of x'' at q'' = 0; computed by qdot_kinematics_rest */
    qdot_groups place; /* groups of x itself, summand by summand; computed by qdot_kinematics_place */
} qdot_kinematics;

typedef struct {
    uint32_t j, k; /* row and column of an entry of M, j <= k */
    uint32_t i;    /* index of the coordinate of the derivative; n: the derivative by t */
    qdot_expr value;
} qdot_mass_slope;

/* A sum that was simplified once for all sums that differ from it only in their symbols (qdot_mech_alike). */
typedef struct {
    qdot_expr pattern, atoms, simple;
} qdot_pattern;

/* Whether a coordinate is cyclic, and if so its momentum and rate, as in qdot_cyclic. */
typedef struct {
    bool known, is;
    qdot_expr momentum, rate;
} qdot_cyclic_known;

/* A long sum by coordinates (mech/dynamics/long-sum.h). */
typedef struct {
    qdot_expr sum, *part; /* the sum; [n] those terms of it that hold coordinate i */
} qdot_divided_sum;

struct qdot_derived {
    uint64_t newest;  /* the highest version number given to any state of the scene */
    uint64_t version; /* the version of the scene for which the results below hold */
    size_t n;
    bool kinematics_ready;
    qdot_kinematics kinematics;
    qdot_expr *square_spring,
        *square_damper;  /* u.u of each spring and damper, simplified; nil until requested */
    qdot_expr *M, *b, c; /* T = 1/2 q'Mq' + b q' + c: [n*n], [n], scalar, simplified; M is NULL until requested */
    bool slopes_ready;
    qdot_vec(qdot_mass_slope) slopes; /* derivatives of entries of M that are not 0 */
    qdot_vec(qdot_pattern) patterns;
    qdot_vec(qdot_divided_sum) divided;
    qdot_expr kinetic, potential, lagrangian, energy, mass_matrix;
    qdot_expr *momentum, *force, *rest, *left, *equation; /* [n] each: by coordinate */
    size_t n_speeds;  /* m */
    qdot_expr *speeds; /* [3 m + n] symbols and values of the speeds for which the rest holds, their equations, then the
                        * velocities (mech/dynamics/speeds.h); NULL until requested */
    qdot_expr *higher; /* [n] what is applied to each coordinate so that the equations are those of higher_lagrangian */
    qdot_expr *accel; /* [n] accelerations q'', computed together */
    qdot_expr *friction; /* values of the multipliers that forces hold, and of their magnitudes (mech/dynamics/multiplier-forces.h) */
    bool friction_bound; /* these are undefined somewhere: friction acts on the multiplier that it comes from */
    qdot_expr *lambda; /* [constraints] multipliers, computed with accel; nil if not unique */
    qdot_expr numeric_mass, numeric_forcing, numeric_energy;
    /* [constraints] of velocity constraints that are holonomic in disguise: F and mu, mu f = dF/dt
     * (mech/dynamics/integrated.h); nil for others */
    qdot_expr *integral, *factor;
    bool *integral_known;
    bool holonomic_known, holonomic; /* whether the next is known; cached answer of qdot_mech_is_holonomic */
    bool *independent; /* [constraints] whether a constraint is independent of the constraints before it */
    bool *hidden;      /* [constraints] whether a constraint implies a further condition (qdot_dof.is_hidden) */
    bool unmet;        /* no point was found where all constraints hold */
    bool conserved_known, conserved;
    qdot_cyclic_known *cyclic; /* [n] facts of cyclic coordinates; NULL until requested */
};

/* The stored results for the scene; emptied first if the scene has changed. */
qdot_derived *qdot_derived_get(qdot_scene *s);
void qdot_derived_free(qdot_derived *d);
/* Allocate *array with [n] nil expressions, unless it is allocated already. */
bool qdot_derived_array(qdot_scene *s, qdot_expr **array, size_t n);
/* Clear the inertial terms, which are computed again when needed. */
void qdot_kinematics_clear(qdot_kinematics *k);

#endif
