/* constrained.h -- a plan with constraints, evaluated: accelerations and multipliers, and states
 * brought back onto the constraints.
 *
 *     [ M  A^T ] [ q''     ]   [ f     ]
 *     [ A   0  ] [ -lambda ] = [ gamma ]     (num/saddle.h, residual-corrected)
 *
 * Drift. Integration leaves the constraints by its error of a step and by rounding. Under
 * `project` a state is moved back by the shortest way in the metric of M,
 *
 *     q += M^-1 A^T nu until f(q, t) = 0,   then q' likewise until df/dt = 0,
 *
 * when a residual is above what rounding alone makes of it, 2^-52 sum |A_ki q_i| (q' at
 * the level of velocities; values below 2^-10 count as that), and only then. Under `baumgarte` gamma is
 *
 *     gamma - 2 a df/dt - a^2 f,   velocity constraints: gamma - a f,
 *
 * critical damping with the rate a = QDOT_CONSTRAINED_RATE per unit of t: drift dies out as
 * e^(-a t). Under `none` nothing is done.
 *
 * Source  Hairer & Wanner II, VII.1 (index reduction) and VII.2 (projection); Baumgarte,
 *         Comput. Meth. Appl. Mech. Eng. 1 (1972) 1.
 * Tests   tests/sim/test_constraints.c
 */
#ifndef QDOT_SIM_CONSTRAINED_H
#define QDOT_SIM_CONSTRAINED_H

#include "base/text.h"
#include "num/saddle.h"
#include "sim/model/constraints.h"

#define QDOT_CONSTRAINED_RATE 5.0

typedef struct qdot_constrained qdot_constrained;

/* Of a plan with constraints, borrowed. `shaken` as for qdot_bind_new. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_constrained_new(const qdot_plan *plan, bool shaken,
                                                 qdot_constrained **constrained);
void qdot_constrained_free(qdot_constrained *constrained);

/* q'' [n] and lambda [m] (may be NULL) at t, y = (q, q') [2n]. Errors: QDOT_ESINGULAR
 * names constraints that stop being independent, or the coordinate without mass;
 * QDOT_EDOMAIN the coordinate whose acceleration is undefined. */
QDOT_MUST_CHECK qdot_status qdot_constrained_solve(qdot_constrained *constrained,
                                                   double t, const double *y, double *a,
                                                   double *lambda);

/* dfdy [2n x 2n row-major] and dfdt [2n] of f = (q', q''), of a plan whose method needs them.
 * q'' and lambda take up what the equations and, with its damping, gamma gain:
 *
 *     [ M  A^T ] [ dq''     ]   [ df - dM q'' + dA^T lambda ]
 *     [ A   0  ] [ -dlambda ] = [ dgamma - dA q''           ]
 *
 * Errors: as _solve. */
QDOT_MUST_CHECK qdot_status qdot_constrained_jacobian(qdot_constrained *constrained,
                                                      double t, const double *y,
                                                      double *dfdy, double *dfdt);

/* Of accelerations nothing drifts: a constraint on them holds because it is solved for, but not
 * where it repeats others at the start and says something else later. QDOT_EDOMAIN names one that
 * does not hold at a state of the run. Test: tests/bad/constraint-leaves.lag. */
QDOT_MUST_CHECK qdot_status qdot_constrained_check_accelerations(qdot_constrained *constrained,
                                                                 double t, const double *y);

/* Move y [2n] (+ carry [2n], may be NULL) onto the constraints, as qdot_ode_system.project
 * is to: *moved is the largest change of a component relative to max(1, |y_i|), 0 where
 * nothing was done. QDOT_EDOMAIN where it does not converge. */
QDOT_MUST_CHECK qdot_status qdot_constrained_project(double t, double *y, double *carry,
                                                     double *moved, void *constrained);

/* The event `who` has set the values of y [2n] that q_set and v_set [n] say: they stay, the others
 * move least in the metric of M until the constraints hold, first of positions, then of
 * velocities, as under an impulse. NULL: nothing was set that could break these, and none of them
 * moves. QDOT_EDOMAIN names a constraint that they leave no way. Allocates. */
QDOT_MUST_CHECK qdot_status qdot_constrained_put(qdot_constrained *constrained, double t,
                                                 double *y, const bool *q_set,
                                                 const bool *v_set, const char *who);

/* Nanoseconds that bringing a step's end back takes, about: 0 where nothing is done. */
double qdot_constrained_cost(const qdot_plan *plan);

/* What y breaks: the largest |f| of the holonomic rows; the largest |df/dt| or |f| of the
 * velocity rows; which rows these are (SIZE_MAX: none). */
typedef struct {
    double position, velocity;
    size_t worst_position, worst_velocity;
} qdot_constrained_residual;
qdot_constrained_residual qdot_constrained_measure(qdot_constrained *constrained,
                                                   double t, const double *y);

/* Whether a run may start at y: QDOT_EINVAL names a constraint that y breaks, with its
 * residual, or constraints that contradict each other; QDOT_ESINGULAR as _solve. What is
 * left (rounding of the values typed) is then projected away. */
QDOT_MUST_CHECK qdot_status qdot_constrained_start(qdot_constrained *constrained,
                                                   double t, double *y, double *low);

/* Factor M and A of a system that holds all rows; its failures named as _solve's. */
QDOT_MUST_CHECK qdot_status qdot_constrained_factor(const qdot_plan *plan,
                                                    qdot_saddle *s);

/* Before the first factorisation of a system of the rows that `row` says (NULL: all): how large
 * they are beside in [2n + 1] (q, q', t), so that what rounding leaves of one there is told from a
 * direction. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_constrained_look_beside(const qdot_plan *plan, qdot_saddle *s,
                                                         const size_t *row, const double *in);

/* The least sine between a row of A and those before it, at y: 0 where rows that were
 * independent are no more; without a direction to be measured in, 1. */
double qdot_constrained_independence(qdot_constrained *constrained, double t,
                                     const double *y);

/* Whether the constraints that hold accelerations are nearly dependent at y, and then which:
 * "constraints a and b". false also where that cannot be told. */
bool qdot_constrained_near(qdot_constrained *constrained, double t, const double *y,
                           qdot_text *names);

/* A row's part (qdot_saddle_parts) from which it is named. */
#define QDOT_CONSTRAINED_PART 1e-6
/* "constraint a", "constraints a, b and c": the rows [m] that are set; where these are many,
 * vector constraints once for all their components. */
void qdot_constrained_name(const qdot_constraints *c, const bool *rows, qdot_text *to);

/* The failure that row `row` of A has become 0. QDOT_ESINGULAR. */
QDOT_MUST_CHECK qdot_status qdot_constrained_without_direction(const qdot_constraints *c,
                                                               size_t row);

size_t qdot_constrained_rows(const qdot_constrained *constrained); /* m */
/* Independent rows; QDOT_SADDLE_UNKNOWN before anything was solved. */
size_t qdot_constrained_rank(const qdot_constrained *constrained);
/* How often a matrix was factored. */
size_t qdot_constrained_factored(const qdot_constrained *constrained);

#endif
