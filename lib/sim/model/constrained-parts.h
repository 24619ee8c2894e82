/* constrained-parts.h -- a plan with constraints from inside. For sim/model/constrained*.c
 * only.
 */
#ifndef QDOT_SIM_CONSTRAINED_PARTS_H
#define QDOT_SIM_CONSTRAINED_PARTS_H

#include "num/least-move.h"
#include "sim/model/constraints.h"

/* The rows that restrict positions, velocities, accelerations: kinds up to it. */
typedef struct {
    qdot_saddle saddle;
    size_t m;
    size_t *row; /* [m] of the constraints */
    double *residual; /* [m] what is left of those rows, the carry counted in */
    bool filled; /* M and A hold numbers */
    bool few;    /* M is diagonal, and a projection goes by `move`, if that is */
    bool moves;  /* factored */
    qdot_least_move move;
} qdot_constrained_level;

typedef struct qdot_constrained qdot_constrained;
struct qdot_constrained {
    const qdot_plan *plan;
    const qdot_constraints *c;
    qdot_tape *positions, *velocities, *metric, *equations; /* shaken copies or NULL */
    qdot_constrained_level levels[3];
    qdot_constrained_level *at[3]; /* those that have the same rows are one */
    double *in;                    /* [2n + 1] q, q', t */
    double *out, *work;
    double *f, *w; /* [m] residuals of positions and velocities, by row */
    double *f_bound,
        *w_bound; /* [m] what rounding makes of them; they grow along a run */
    double *a;    /* [n + m] */
    /* Where a Jacobian is asked for, else NULL; by q, q', t: */
    double *slopes;      /* [outputs x (2n + 1)] of a tape */
    double *gains;       /* [(n + m) x (2n + 1)] of the equations */
    double *slopes_work; /* of the derivatives */
};

/* What the tapes are evaluated at next. */
void qdot_constrained_load(qdot_constrained *h, double t, const double *y);
/* f and w at what is loaded, 0 where a row has none. */
void qdot_constrained_positions(qdot_constrained *h);
void qdot_constrained_velocities(qdot_constrained *h);

/* Both. */
void qdot_constrained_residuals(qdot_constrained *h);

/* What rounding of x, q or q', makes of the rows, A being there: bounds [m] grow to it. */
void qdot_constrained_raise_bounds(const qdot_constrained_level *level, const double *x,
                                   double *bound);
/* M and A at what is loaded, factored. Errors: qdot_constrained_factor's. */
QDOT_MUST_CHECK qdot_status qdot_constrained_factor_metric(qdot_constrained *h,
                                                           qdot_constrained_level *level);
/* At what is loaded, if the level was never factored: qdot_constrained_look_beside. */
QDOT_MUST_CHECK qdot_status qdot_constrained_look_first(const qdot_constrained *h,
                                                        qdot_constrained_level *level);
/* Factor a system of the rows that `row` [s->m] says (NULL: all); its failures named. */
QDOT_MUST_CHECK qdot_status qdot_constrained_factor_rows(const qdot_plan *plan,
                                                         qdot_saddle *s,
                                                         const size_t *row);
/* After qdot_constrained_solve into h->a: rows that were left out as repetitions must agree with
 * those that were not, but for what drift that is not taken back makes of them; else `broken`, with
 * the name of one that does not. */
QDOT_MUST_CHECK qdot_status qdot_constrained_check_repeated(qdot_constrained *h,
                                                            qdot_status broken);
/* The first of those, after the same; SIZE_MAX: there is none. */
size_t qdot_constrained_contradicting(qdot_constrained *h);
/* M and A at what is loaded, into a level. */
void qdot_constrained_metric(qdot_constrained *h, qdot_constrained_level *level);

/* The rows of the dependencies (qdot_saddle_parts) by name, added to a text; their number.
 * row [s->m] of the constraints, NULL: all. */
size_t qdot_constrained_dependent(const qdot_constraints *c, qdot_saddle *s,
                                  const size_t *row, double below, qdot_text *names);

static inline const qdot_tape *
qdot_constrained_tape(const qdot_tape *own, const qdot_tape *plans)
{
    return own ? own : plans;
}

#endif
