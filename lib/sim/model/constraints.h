/* constraints.h -- the constraints of a plan, with parameter values, as tapes.
 *
 *     f(q, t) = 0          holonomic      A = df/dq
 *     f(q, q', t) = 0      velocity       A = df/dq'  (nonlinear ones: Chetaev's rule)
 *     f(q, q', q'', t) = 0 acceleration   A = df/dq'', linear in q''
 *
 * Differentiated twice, once or not at all, each gives A q'' = gamma(q, q', t), and with the
 * signs of mech/dynamics/quantity.h the motion is
 *
 *     M q'' = f + A^T lambda,   A q'' = gamma
 *
 * (sim/model/constrained.h solves it). Rows stand in the order of the scene's constraints, a vector
 * constraint one row a component.
 *
 * Tests  tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_CONSTRAINTS_H
#define QDOT_SIM_CONSTRAINTS_H

#include "mech/scene/scene.h"
#include "num/saddle.h"
#include "sim/model/equations.h"

typedef struct {
    char *name;           /* name of the constraint (with component): "rod", "pin, 1"; owned */
    qdot_constraint_kind kind;
    qdot_expr f;          /* left side of f = 0, with parameter values */
    qdot_expr multiplier; /* the symbol lambda[name]; nil: the equation of a massless coordinate */
} qdot_constraints_row;

/* An entry that is not zero: of M (row >= column) or of A (a constraint, a coordinate).
 */
typedef qdot_saddle_entry qdot_constraints_entry;

struct qdot_constraints {
    size_t m; /* number of constraint rows: constraints of the scene, then n_massless equations */
    size_t count[3]; /* number of rows of each kind: on positions, velocities, accelerations */
    qdot_constraints_row *rows;
    qdot_constraints_entry *masses; /* [n_masses] non-zero entries of M, and the diagonal of massless coordinates */
    size_t n_masses;
    qdot_constraints_entry *slopes; /* [n_slopes] entries of A = df/dq (or df/dq', df/dq''), row by row */
    size_t n_slopes;
    signed char *sign; /* [n_slopes] entry of A = this sign times the corresponding row of the series program */
    qdot_expr *A;      /* [n_slopes] entries of A as expressions */
    qdot_expr *gamma;  /* [m] right-hand sides of A q'' = gamma */

    /* Tapes from q [n], q' [n] and t (n: coordinates of the plan); the first two give residuals: */
    qdot_tape *positions;  /* outputs: f of the holonomic constraints, in their order */
    qdot_tape *velocities; /* df/dt of the holonomic and f of the velocity rows, in the
                              order of all rows without those on accelerations */
    qdot_tape *metric; /* outputs: M [n_masses], with 2^-60 for massless coordinates, then A [n_slopes] */
    qdot_tape *scale; /* outputs: mu [m]; the scene's multiplier = mu * multiplier of the row; NULL: all mu are 1 */
    qdot_tape *equations;  /* f [n], M [n_masses], A [n_slopes], gamma [m]; moved to plan->tape,
                              then NULL */

    /* For Taylor series: f [n], M [n_masses], A [n_slopes] up to `sign`, and of each row f, gamma of
     * one on accelerations [m]; the program that is made of it (sim/form/motion-of-constraints.h), if
     * it is smooth. */
    qdot_tape *series;
    qdot_motion motion;
};

/* For a scene whose plan has its values, M, f and massless coordinates; *constraints is NULL where
 * there are neither constraints nor those.
 * Errors: those of lowering. */
QDOT_MUST_CHECK qdot_status qdot_constraints_new(qdot_scene *scene,
                                                 const qdot_plan *plan,
                                                 qdot_constraints **constraints);
void qdot_constraints_free(qdot_constraints *c);

#endif
