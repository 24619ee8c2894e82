/* constrained-parts.h -- the fields of a qdot_constrained. For sim/model/constrained*.c only. */
#ifndef QDOT_SIM_CONSTRAINED_PARTS_H
#define QDOT_SIM_CONSTRAINED_PARTS_H

#include "num/least-move.h"
#include "sim/model/constraints.h"

/* The constraints of one level: on positions; or on positions and velocities; or on accelerations, too. */
typedef struct {
    qdot_saddle saddle;
    size_t m;
    size_t *row; /* [m] index of each constraint of the level among all constraints */
    double *residual; /* [m] residuals of the level's constraints, computed from the state with its low parts */
    double *noise;    /* [m] change of the residuals caused by rounding of the state */
    bool filled; /* the matrices M and A have been evaluated at the present state */
    bool few;    /* few constraints and diagonal M: projections use `move` */
    bool moves;  /* `move` contains a factorisation for the present state */
    qdot_least_move move;
} qdot_constrained_level;

typedef struct qdot_constrained qdot_constrained;
struct qdot_constrained {
    const qdot_plan *plan;
    const qdot_constraints *c;
    /* copies of the tapes with slightly perturbed constants; NULL: the original tapes */
    qdot_tape *positions, *velocities, *metric, *equations;
    qdot_constrained_level levels[3];
    qdot_constrained_level *at[3]; /* level of each kind of constraint; kinds with the same constraints share a level */
    double *in;                    /* [2 (2n + 1)] inputs q, q', t, then scratch of the same size */
    double *out, *work;
    double *f, *w; /* [m] residuals of positions f and of velocities w, for each constraint */
    double *f_bound,
        *w_bound; /* [m] bounds of the rounding errors in f, w; they only grow during a run */
    double *a;    /* [n + m] accelerations q'', then multipliers */
    double *weight; /* [m] scale factors of the multipliers, then scratch for c->scale; NULL: all 1 */
    /* Derivatives by q, q', t, needed if the method uses a Jacobian; else NULL: */
    double *slopes;      /* [outputs x (2n + 1)] derivatives of a tape by q, q', t */
    double *gains;       /* [(n + m) x (2n + 1)] derivatives of q'' and multipliers */
    double *slopes_work; /* scratch for evaluating derivatives */
    bool *used;          /* [m] which constraints are not redundant, for implicit methods */
};

/* Set the state at which the tapes are evaluated next. */
void qdot_constrained_load(qdot_constrained *h, double t, const double *y);
/* Evaluate the residuals of position constraints f, and of velocity constraints w, at the loaded
 * state; 0 for other rows. */
void qdot_constrained_positions(qdot_constrained *h);
void qdot_constrained_velocities(qdot_constrained *h);

/* Add the terms of Baumgarte's damping to gamma [m]; f and w must have been evaluated. */
void qdot_constrained_damp(const qdot_constrained *h, double *gamma);

/* After qdot_constrained_solve into h->a: the slopes of f - M q'' + A^T lambda and gamma - A q'', with
 * its damping, by q, q', t at q'' and lambda held, into h->gains. */
void qdot_constrained_gains(qdot_constrained *h);

/* Evaluate the constraint residuals f (positions) and w (velocities) at the loaded state. */
void qdot_constrained_residuals(qdot_constrained *h);

/* Raise the bounds [m] to at least the rounding error of the rows caused by x (q or q'); A must be
 * evaluated. */
void qdot_constrained_raise_bounds(const qdot_constrained_level *level, const double *x,
                                   double *bound);
/* Evaluate and factor the matrices M and A at the loaded state. Errors: as qdot_constrained_factor. */
QDOT_MUST_CHECK qdot_status qdot_constrained_factor_metric(qdot_constrained *h,
                                                           qdot_constrained_level *level);
/* Call qdot_constrained_look_beside at the loaded state, if the level's matrix was never factored. */
QDOT_MUST_CHECK qdot_status qdot_constrained_look_first(const qdot_constrained *h,
                                                        qdot_constrained_level *level);
/* Factor a system of the rows `row` [s->m] (NULL: all); failures name constraints or coordinates.
 *  */
QDOT_MUST_CHECK qdot_status qdot_constrained_factor_rows(const qdot_plan *plan,
                                                         qdot_saddle *s,
                                                         const size_t *row);
/* After qdot_constrained_solve into h->a: redundant rows, which were left out, must hold too,
 * except for the effect of uncorrected drift; else `broken`, with the name of a row that does not
 * hold. */
QDOT_MUST_CHECK qdot_status qdot_constrained_check_repeated(qdot_constrained *h,
                                                            qdot_status broken);
/* After qdot_constrained_solve: the first redundant constraint that the solution violates; SIZE_MAX: none. */
size_t qdot_constrained_contradicting(qdot_constrained *h);
/* Evaluate the matrices M and A of a level at the loaded state. */
void qdot_constrained_metric(qdot_constrained *h, qdot_constrained_level *level);

/* Mark in rows [c->m] those that depend on each other (qdot_saddle_parts); whether there are any.
 * row [s->m] of the constraints, NULL: all. */
bool qdot_constrained_dependent(const qdot_constraints *c, qdot_saddle *s,
                                const size_t *row, double below, bool *rows);

static inline const qdot_tape *
qdot_constrained_tape(const qdot_tape *own, const qdot_tape *plans)
{
    return own ? own : plans;
}

#endif
