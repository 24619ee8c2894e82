/* stability.h -- stability of equilibria. Internal to mech/. */
#ifndef QDOT_MECH_STABILITY_H
#define QDOT_MECH_STABILITY_H

#include "expr/function.h"
#include "mech/study/lyapunov.h"
#include "mech/linear/rest.h"

typedef struct qdot_stability_numbers qdot_stability_numbers;

typedef struct {
    qdot_scene *s;
    qdot_binder bind;
    void *user;
    qdot_energy_law law;
    bool holonomic;     /* every constraint is holonomic, possibly in disguise (qdot_mech_is_holonomic) */
    bool timed;         /* the equations contain t explicitly */
    bool velocity_kink; /* the equations contain |q'|, sign(q') ...: no linear part at rest */
    qdot_expr at_rest;  /* a LIST of the equations at rest */
    /* generalized forces, dry friction and its velocities, as in struct qdot_rest; the last two are nil without friction */
    qdot_expr forces, friction, slips;
    qdot_expr by_signs; /* forces with each jump written as a sign; nil: not known */
    qdot_expr nonzero; /* a LIST of expressions by which the results are divided; nil: none */
    qdot_stability_numbers *numbers; /* working memory for equilibria given by numbers, allocated at first use */
    qdot_expr parameter; /* parameter left free by `bind`, with a value at each place; nil: none */
} qdot_judge;

/* Prepare for a scene, whose equations at rest are a LIST; then judge each equilibrium: sets
 * e->stability and e->stable_when. */
QDOT_MUST_CHECK qdot_status qdot_judge_new(qdot_scene *s, qdot_expr at_rest,
                                           qdot_binder bind, void *user,
                                           qdot_judge **out);
QDOT_MUST_CHECK qdot_status qdot_judge_place(qdot_judge *judge, qdot_equilibrium *e);
void qdot_judge_free(qdot_judge *judge);

/* Whether the function is not differentiable everywhere: |u|, sign u, floor ... */
static inline bool
qdot_stability_has_kink(uint32_t op)
{
    return op == QDOT_ABS || op == QDOT_SIGN || op == QDOT_FLOOR || op == QDOT_MOD ||
           op == QDOT_MIN || op == QDOT_MAX || op == QDOT_IF;
}

/* Whether coordinate i stands in an equation at rest or is bound by a velocity constraint: along
 * others a family of rests is alike. */
bool qdot_stability_is_told(const qdot_judge *judge, size_t i);

/* Judge an equilibrium known exactly, with holonomic constraints only (stability-exact.c). */
QDOT_MUST_CHECK qdot_status qdot_stability_judge_exact(qdot_judge *judge,
                                                       qdot_equilibrium *e);

/* Judge an equilibrium held by dry friction. *judged is false if this gives no answer
 * (stability-friction.c). */
QDOT_MUST_CHECK qdot_status qdot_stability_judge_held(qdot_judge *judge, qdot_equilibrium *e,
                                                      bool *judged);

/* --- places in numbers (stability-numbers.c) ----
 * The slopes of the equations, with the values of bind; freed by the caller. */
QDOT_MUST_CHECK qdot_status qdot_stability_numbers_new(const qdot_judge *judge,
                                                       qdot_stability_numbers **out);
void qdot_stability_numbers_free(qdot_stability_numbers *numbers);
/* Set e->stability for an equilibrium with numerical values. */
QDOT_MUST_CHECK qdot_status qdot_stability_judge_numbers(const qdot_judge *judge,
                                                         qdot_stability_numbers *numbers,
                                                         qdot_equilibrium *e);

/* An equilibrium by numbers: coordinates, multipliers, and the free parameter [n]. */
typedef struct {
    size_t n;
    const qdot_expr *symbols;
    const double *values;
} qdot_stability_place;

/* The roots s of det(M s^2 + Gamma s + H) in the tangent space; re, im with room for twice the
 * coordinates. */
typedef struct {
    size_t n; /* number of roots; 0: not known */
    double *re, *im;
} qdot_linear_roots;

/* Judge an equilibrium that is given by numbers, and find the roots of its linear motion. */
QDOT_MUST_CHECK qdot_status qdot_stability_judge_at(const qdot_judge *judge,
                                                    qdot_stability_numbers *numbers,
                                                    const qdot_stability_place *at,
                                                    qdot_stability *verdict,
                                                    qdot_linear_roots *all);
/* M, Gamma, H [n * n] each, then the constraints' slopes [c * n], bound; functions of q, q', q'',
 * multipliers and the free parameter. */
const qdot_expr *qdot_stability_slopes(const qdot_stability_numbers *numbers);

#endif
