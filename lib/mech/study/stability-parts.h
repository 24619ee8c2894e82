/* stability-parts.h -- one place judged: what is known there, what must hold for a verdict. Internal to
 * the files of stability. */
#ifndef QDOT_MECH_STABILITY_PARTS_H
#define QDOT_MECH_STABILITY_PARTS_H

#include "mech/linear/linear-motion.h"
#include "mech/study/stability.h"

typedef struct {
    qdot_judge *judge;
    qdot_scene *s;
    qdot_facts facts;
    qdot_vec(qdot_expr) known; /* expressions that are known to be positive */
    qdot_vec(qdot_expr) when;  /* relations (REL) under which the verdict holds */
    /* Of a family of places, what was taken to be positive and holds its coordinates: a parameter is
     * generic, a coordinate runs through every value. */
    qdot_vec(qdot_expr) claims;
    qdot_linear_motion m;
    qdot_expr *M, *Gamma, *H; /* [n x n] matrices of M, Gamma, H for the coordinates y that the equations at rest determine */
    size_t n;
    bool regular; /* the constraints' Jacobian has full rank at the place, as elsewhere */
} qdot_judgement;

/* --- signs and conditions (stability-signs.c) ---- */

typedef enum {
    QDOT_DEFINITE_POSITIVE,
    QDOT_DEFINITE_CONDITIONAL, /* positive definite under conditions that have been recorded in `when` */
    QDOT_NEGATIVE_SOMEWHERE,
    QDOT_DEFINITE_UNKNOWN
} qdot_definite;

/* A mark to which a judgement can be reset: how many conditions and claims it had recorded. */
typedef struct {
    size_t when, known, claims;
} qdot_judgement_point;

qdot_judgement_point qdot_judgement_mark(const qdot_judgement *j);
/* Drop everything recorded since the mark; the second function drops only conditions: a refuted claim needs none. */
void qdot_judgement_back_to(qdot_judgement *j, qdot_judgement_point m);
void qdot_judgement_drop_conditions(qdot_judgement *j, qdot_judgement_point m);

/* Ask whether e > 0: true, false, or a condition, which is recorded. */
QDOT_MUST_CHECK qdot_status qdot_judgement_ask(qdot_judgement *j, qdot_expr e, qdot_expr *answer);
/* Ask that all e [n] are positive, one after another. NEGATIVE_SOMEWHERE where one is proved below 0
 * whatever the parameters, or wherever those before it are not. e is simplified. */
QDOT_MUST_CHECK qdot_status qdot_judgement_all_positive(qdot_judgement *j, size_t n, qdot_expr *e,
                                                        qdot_definite *how);
/* Whether A [n * n], symmetric, is positive definite; conditions are noted. A negative minor behind
 * positive ones, or a negative diagonal entry: NEGATIVE_SOMEWHERE. */
QDOT_MUST_CHECK qdot_status qdot_judgement_definiteness(qdot_judgement *j, size_t n,
                                                        const qdot_expr *A, qdot_definite *how);
/* Find whether A is positive definite without further conditions: *yes. */
QDOT_MUST_CHECK qdot_status qdot_judgement_is_definite(qdot_judgement *j, size_t n,
                                                       const qdot_expr *A, bool *yes);
/* Whether A^T = A; with sign -1 whether A^T = -A. */
bool qdot_judgement_is_symmetric(qdot_judgement *j, size_t n, const qdot_expr *A, int sign);
/* Whether the symmetric part of Gamma is proved not negative: zero, or diagonal with known signs. */
bool qdot_judgement_is_damping(qdot_judgement *j, size_t n, const qdot_expr *Gamma);
/* Whether e != 0 (or e > 0 if `above`) is proved wherever the facts and the noted conditions hold. */
QDOT_MUST_CHECK qdot_status qdot_judgement_is_sure(qdot_judgement *j, qdot_expr e, bool above,
                                                   bool *yes);
/* Drop conditions that follow from others. known [n]: expressions that are positive in any case. */
QDOT_MUST_CHECK qdot_status qdot_judgement_drop_implied(qdot_judgement *j, size_t n);

/* Check that expressions claimed to be positive are so along a whole family of equilibria
 * (stability-exact.c). */
QDOT_MUST_CHECK qdot_status qdot_judgement_confirm(qdot_judgement *j, bool *yes);

/* *leading: the term of lowest order in eps > 0 of F, near eps = 0, where |u|, sign u and the like are what they are
 * there; nil: none was found. *sign: 1 or -1 where it has that sign for all parameters, else 0. *known is false where it is open what
 * they are (stability-exact.c). */
QDOT_MUST_CHECK qdot_status qdot_judgement_one_side(qdot_judgement *j, qdot_expr F, qdot_expr eps, qdot_expr *leading,
                                                    int *sign, bool *known);

/* A corner of the potential of several coordinates: by its derivatives in all directions. Sets e->stability, notes
 * conditions (stability-corners.c). */
QDOT_MUST_CHECK qdot_status qdot_stability_by_corner(qdot_judgement *j, qdot_equilibrium *e);

/* A strict minimum of the potential by its lowest terms, where the linear motion does not decide. Sets e->stability
 * (stability-degenerate.c). */
QDOT_MUST_CHECK qdot_status qdot_stability_by_degenerate_minimum(qdot_judgement *j, qdot_equilibrium *e);

/* --- the linear motion (stability-roots.c) ----
 * By the roots s of det(M s^2 + Gamma s + H), block by block of coordinates that are coupled:
 * unstable, asymptotically stable, or bounded: stable where nothing is neglected, else to first order.
 * Sets e->stability, notes conditions. Lyapunov; Gantmacher II, ch. XV; Kelvin and Chetaev. */
QDOT_MUST_CHECK qdot_status qdot_stability_by_roots(qdot_judgement *j, qdot_equilibrium *e);

#endif
