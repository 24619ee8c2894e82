/* quantity.h -- T, V, L, momenta, forces, equations ... of a scene, derived on demand and kept
 * until it changes.
 *
 * Each returns nil on failure; the pool keeps the cause (qdot_pool_check). Expressions are
 * simplified for people unless said otherwise. Sign conventions: Lagrange's equations read
 *
 *     d/dt dT/dq' - dT/dq = Q + sum lambda df/d(q, q' or q'')
 *
 * with f = left - right the constraint. For a stated Lagrangian the left side is
 * d/dt dL/dq' - dL/dq and Q contains only the forces declared in addition to L.
 */
#ifndef QDOT_MECH_QUANTITY_H
#define QDOT_MECH_QUANTITY_H

#include "mech/scene/scene.h"

/* --- kinematics and energy --- */
qdot_expr qdot_mech_kinetic(qdot_scene *s);    /* kinetic energy T */
qdot_expr qdot_mech_potential(qdot_scene *s); /* potential energy V of gravity, potentials, springs */
qdot_expr qdot_mech_lagrangian(qdot_scene *s); /* Lagrangian: T - V, or as stated */
qdot_expr qdot_mech_energy(qdot_scene *s);     /* energy function h = sum p q' - L */
qdot_expr qdot_mech_mass_matrix(qdot_scene *s); /* mass matrix of T as an n x n MAT; for a stated L: d2L/dq'dq' */

/* --- momenta and generalized forces --- */
qdot_expr qdot_mech_momentum(qdot_scene *s, qdot_expr q);  /* generalized momentum dL/dq' */
/* Whether the rate p[q]' of a momentum stands in e. */
bool qdot_mech_holds_momentum_rate(qdot_scene *s, qdot_expr e);
qdot_expr qdot_mech_momenta(qdot_scene *s); /* LIST of momenta in the order of coordinates */
/* Whether the time derivatives of the parameter x would stand in the equations of motion, did it vary: it holds a place of
 * a mass or an end of a damper, or stands in a momentum. */
QDOT_MUST_CHECK qdot_status qdot_mech_rate_matters(qdot_scene *s, qdot_expr x, bool *matters);
/* Q[q]: the sum of all applied generalized forces on q, including -dV/dq */
qdot_expr qdot_mech_force(qdot_scene *s, qdot_expr q);
/* The sum of all declared forces along coordinate i, also where what determines its motion is another (states, higher
 * derivatives), simplified. */
qdot_expr qdot_mech_sources(qdot_scene *s, size_t i);
/* The generalized force in Kane's form, sum F . dv/dq'. */
qdot_expr qdot_mech_force_kane(qdot_scene *s, qdot_expr q);
qdot_expr qdot_mech_forces(qdot_scene *s); /* LIST of generalized forces, in the order of coordinates */
qdot_expr qdot_mech_virtual_work(qdot_scene *s); /* virtual work: the sum of Q delta[q] */

/* --- parts of T, V and the generalized forces, listed one by one ----- */
typedef struct {
    const char *kind; /* source of this part: "kinetic energy", "gravity", "potential", "spring" */
    const char *name; /* label of the particle, body, spring ...; NULL: none */
    qdot_expr value;  /* the part as an expression, simplified; nil on failure */
} qdot_energy_part;
/* The kinetic energy of particle or body k: 1/2 m v^2 + 1/2 w.I w; _potential_part: part k of V.
 * False past the end. */
bool qdot_mech_kinetic_part(qdot_scene *s, size_t k, qdot_energy_part *part);
bool qdot_mech_potential_part(qdot_scene *s, size_t k, qdot_energy_part *part);

typedef struct {
    const char *kind, *name; /* "gravity", "spring", "damper" ...; its label or what it acts on, or
                                NULL */
    bool conservative;       /* the force is the gradient of a part of V */
    size_t row, k;           /* place in the list of all sources; for internal use */
} qdot_force_source;
/* The k-th source of generalized forces; false if there are fewer. */
bool qdot_mech_source_at(qdot_scene *s, size_t k, qdot_force_source *source);
/* The contribution of a source to the generalized force on coordinate q, simplified. */
qdot_expr qdot_mech_source_force(qdot_scene *s, const qdot_force_source *source, qdot_expr q);

/* --- equations of motion --- */
qdot_expr qdot_mech_equation(qdot_scene *s, qdot_expr q); /* Lagrange's equation for q, with multipliers */
qdot_expr qdot_mech_equations(qdot_scene *s);             /* LIST of Lagrange's equations */
/* The acceleration q'', free of multipliers; QDOT_ELIMIT past the budget, QDOT_ESINGULAR names the coordinate. */
qdot_expr qdot_mech_accel(qdot_scene *s, qdot_expr q);
qdot_expr qdot_mech_accels(qdot_scene *s); /* LIST of q'' in the order of coordinates */
/* lambda of constraint k in q, q', t, from the same equations; nil without a failure: constraints
 * are redundant, so the multipliers are not unique. */
qdot_expr qdot_mech_multiplier(qdot_scene *s, size_t k);

/* --- conserved quantities, degrees of freedom --- */
typedef struct {
    qdot_expr coordinate, momentum;
    qdot_expr rate;   /* dp/dt: nil if conserved; else the sum of applied forces and multipliers */
} qdot_cyclic;
/* Find the cyclic coordinates: those absent from L (their velocities may occur). *list [*n], owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_mech_cyclic(qdot_scene *s, qdot_cyclic **list, size_t *n);
/* Whether coordinate i is cyclic (*is), with its momentum and rate. */
QDOT_MUST_CHECK qdot_status qdot_mech_cyclic_at(qdot_scene *s, size_t i, qdot_cyclic *cyclic,
                                                bool *is);
/* Whether x stands in what is applied along any coordinate beside V: forces, dampers,
 * reactions. */
QDOT_MUST_CHECK qdot_status qdot_mech_applied_holds(qdot_scene *s, qdot_expr x, bool *holds);
/* Whether the energy function h is proved conserved: dh/dt = 0 by the equations of motion. */
QDOT_MUST_CHECK qdot_status qdot_mech_energy_conserved(qdot_scene *s, bool *conserved);
/* dE/dt along the motion, with multipliers as symbols, if no acceleration has to be solved for: E
 * is the energy h, a momentum p_i or 0, plus a function of q and t; or a function of q, t and the
 * symbols p[q]. Nil without a failure: E is none of these. */
qdot_expr qdot_mech_rate(qdot_scene *s, qdot_expr E);
/* Whether a row of M is 0: the equation of such a coordinate ties velocities or positions, which
 * rates as above do not know. */
bool qdot_mech_lacks_mass(qdot_scene *s);
typedef struct {
    size_t coordinates, constraints, independent; /* numbers of each, without states; independent: symbolic rank of the constraints */
    size_t states;                                /* number of first-order unknowns */
    size_t freedom;                               /* degrees of freedom: coordinates - independent */
    const bool *is_independent; /* [constraints] of those declared before; borrowed until the
                                   scene changes */
    const bool *is_hidden; /* [constraints] not independent, but not redundant: with those before
                              it implies a condition on coordinates or velocities that is none
                              of the constraints (x = t, x' = y: y = 1); likewise */
    bool unmet;           /* no point was found where all constraints hold, whatever the
                             parameters: no proof that there is none */
    bool cartesian;       /* n = N D - C applies: every particle has its own Cartesian coordinates */
    size_t particles, dimension;
} qdot_dof;
QDOT_MUST_CHECK qdot_status qdot_mech_dof(qdot_scene *s, qdot_dof *dof);

/* --- for numerical runs (sim/): not simplified for printing, cheap to evaluate ---
 * M(q, t) q'' = f(q, q', t): M as MAT, f as VEC (LIST when n = 1); n coordinates in declared
 * order. M is built from grouped Jacobians (scene/cache.h), work N^2 for a chain. Without the
 * multipliers of constraints. */
qdot_expr qdot_mech_numeric_kinetic(qdot_scene *s); /* kinetic energy T for numerical evaluation, not simplified */
qdot_expr qdot_mech_numeric_mass(qdot_scene *s);
qdot_expr qdot_mech_numeric_forcing(qdot_scene *s);
/* h with that M. Simplified only if M cannot be used: with a stated Lagrangian, masses or
 * positions that vary with t, potentials with velocities. */
qdot_expr qdot_mech_numeric_energy(qdot_scene *s);

#endif
