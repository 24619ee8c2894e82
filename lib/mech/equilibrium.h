/* equilibrium.h -- where a scene can rest, whether it stays there, and how it swings about it.
 *
 * At rest, q' = q'' = 0, Lagrange's equations and the constraints read
 *
 *     G_i(q, lambda) = 0,   f_k(q) = 0.
 *
 * They are solved one for one unknown at a time, factor by factor, all combinations
 * (normal/solve.h); the multipliers are unknowns like the coordinates. A coordinate that stands
 * in none of them is free and left out. What cannot be solved exactly is searched for in
 * numbers, when every parameter has a value.
 *
 * Linearised about it, with q = q0 + x, x restricted to the constraints' tangent space,
 *
 *     M x'' + Gamma x' + H x = 0,   H = -dG/dq (multipliers held).
 *
 * Where H is symmetric (the forces at rest have a potential) and the damping, the symmetric part
 * of Gamma, is not negative, the equilibrium is stable if H is positive definite; without
 * gyroscopic terms (the antisymmetric part) unstable if x.H x takes negative values. Two degrees
 * of freedom with gyroscopic terms and no damping: stable if both squares of the frequencies are
 * positive and different. Otherwise undecided.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 6.1-6.2; Merkin, Introduction to the Theory of
 *         Stability, 3 and 6 (Lagrange, Dirichlet, Kelvin).
 * Tests   tests/mech/test_equilibrium.c
 */
#ifndef QDOT_MECH_EQUILIBRIUM_H
#define QDOT_MECH_EQUILIBRIUM_H

#include "mech/scene.h"

typedef enum { QDOT_STABLE, QDOT_UNSTABLE, QDOT_STABILITY_UNDECIDED } qdot_stability;

typedef struct {
    qdot_expr
        equations;    /* a LIST: coordinate = value ..., then lambda[...] = value ... */
    qdot_expr exists; /* a LIST of RELs under which it is real; nil: always */
    qdot_stability stability;
    qdot_expr stable_when; /* STABLE: a LIST of RELs; nil: always */
    bool numeric;
} qdot_equilibrium;

/* Values of parameters for numbers: e bound as far as they are known. */
typedef qdot_expr (*qdot_binder)(void *user, qdot_expr e);

/* *list [*n], owned by the caller. QDOT_EDOMAIN if the equations at rest hold the time, QDOT_EUNSET
 * names a parameter if numbers are needed, QDOT_EFAILED if nothing can be said. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_find(qdot_scene *s, qdot_binder bind,
                                                  void *user, qdot_equilibrium **list,
                                                  size_t *n);

/* The same up to the first that is not unstable; all if there is none. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_first(qdot_scene *s, qdot_binder bind,
                                                   void *user, qdot_equilibrium **list,
                                                   size_t *n);

/* The equations of motion about `equations`, which hold where `exists` does (a LIST; nil:
 * everywhere): M, Gamma, H [*n * *n] over the coordinates of the
 * tangent space; N [coordinates * *n], x = N y. Each owned by the caller. keep_free: with the
 * coordinates that stand in no equation. */
typedef struct {
    size_t n;
    qdot_expr *M, *Gamma, *H, *N;
} qdot_linear_motion;
QDOT_MUST_CHECK qdot_status qdot_equilibrium_linear(qdot_scene *s, qdot_expr equations,
                                                    qdot_expr exists, bool keep_free,
                                                    qdot_linear_motion *out);
void qdot_linear_motion_clear(qdot_linear_motion *m);

/* Set stability and stable_when; e->equations and e->exists are there. (stability.c) */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_judge(qdot_scene *s, qdot_equilibrium *e);

/* --- numbers (equilibrium-numeric.c) ----
 * Unknowns u [n] with r [n] = 0, every other symbol bound: found [*count * n] doubles, owned. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_search(qdot_scene *s, size_t n,
                                                    const qdot_expr *u,
                                                    const qdot_expr *r, double **found,
                                                    size_t *count);

/* --- normal modes (modes.c) ----
 * (H - w^2 M) a = 0 about `equations`: frequencies w [n] ascending, amplitudes a
 * [n * coordinates], a row each, the first component that is not 0 is 1. Exact where the
 * characteristic polynomial factors into linear and quadratic ones in w^2, else (or at once, if
 * `numbers`) numbers, which need every parameter's value. QDOT_ETYPE with damping or gyroscopic terms, QDOT_EDOMAIN
 * where H is not positive semidefinite. */
typedef struct {
    size_t n;
    qdot_expr *frequency, *amplitude;
    bool numeric;
} qdot_modes;
QDOT_MUST_CHECK qdot_status qdot_modes_about(qdot_scene *s, qdot_expr equations,
                                             bool numbers, qdot_binder bind, void *user,
                                             qdot_modes *out);
void qdot_modes_clear(qdot_modes *m);

#endif
