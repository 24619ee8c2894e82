/* constrained.h -- evaluates a plan with constraints: accelerations, multipliers, and the
 * projection of states onto the constraints.
 *
 *     [ M  A^T ] [ q''     ]   [ f     ]
 *     [ A   0  ] [ -lambda ] = [ gamma ]     (num/saddle.h, residual-corrected)
 *
 * Drift. The errors of steps and rounding move states off the constraints. Under `project` a
 * state is moved back by the shortest way in the metric of M,
 *
 *     q += M^-1 A^T nu until f(q, t) = 0,   then q' likewise until df/dt = 0,
 *
 * but only if a residual exceeds its rounding error, 2^-52 sum |A_ki q_i| (q' for velocities;
 * values below 2^-10 count as 2^-10). Under `baumgarte` gamma is
 *
 *     gamma - 2 a df/dt - a^2 f,   velocity constraints: gamma - a f,
 *
 * critical damping with the rate a = QDOT_CONSTRAINED_RATE per unit of t: drift dies out as
 * e^(-a t). Under `none` drift is not corrected.
 *
 * Source  Hairer & Wanner II, VII.1 (index reduction) and VII.2 (projection); Baumgarte,
 *         Comput. Meth. Appl. Mech. Eng. 1 (1972) 1.
 * Tests   tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_CONSTRAINED_H
#define QDOT_SIM_CONSTRAINED_H

#include "base/text.h"
#include "num/saddle.h"
#include "sim/model/constraints.h"

#define QDOT_CONSTRAINED_RATE 5.0

typedef struct qdot_constrained qdot_constrained;

/* For a plan with constraints, borrowed. `shaken` as for qdot_bind_new. Errors:
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

/* Compute a [n + plan->m]: q'' and the multipliers of the scene's constraints. Errors: as
 * qdot_constrained_solve. */
QDOT_MUST_CHECK qdot_status qdot_constrained_accelerate(qdot_constrained *constrained, double t,
                                                        const double *y, double *a);

/* dfdy [2n x 2n row-major] and dfdt [2n] of f = (q', q''), for a plan whose method needs them.
 * The changes of q'' and lambda follow from those of the equations and of gamma (with its
 * damping):
 *
 *     [ M  A^T ] [ dq''     ]   [ df - dM q'' + dA^T lambda ]
 *     [ A   0  ] [ -dlambda ] = [ dgamma - dA q''           ]
 *
 * Errors: as _solve. */
QDOT_MUST_CHECK qdot_status qdot_constrained_jacobian(qdot_constrained *constrained,
                                                      double t, const double *y,
                                                      double *dfdy, double *dfdt);

/* For implicit methods, of all m rows, with nothing solved (ode/system.h, qdot_ode_mass_form):
 *
 *     r [n + m] = (f + A^T z - M a, g),
 *
 * g the rate of a holonomic constraint, or a velocity constraint itself, where states are projected
 * (index 2); else gamma - A a, with its damping (index 1). The multiplier of a redundant row is 0. */
QDOT_MUST_CHECK qdot_status qdot_constrained_implicit(qdot_constrained *constrained, double t,
                                                      const double *y, const double *a,
                                                      const double *z, double *r);
/* Its slopes by q and (v, z), and the matrix before a, [(n + m) x (n + m)] each, and the multipliers
 * z [m] at y. For a plan whose method needs them. Errors: as _solve. */
QDOT_MUST_CHECK qdot_status qdot_constrained_implicit_slopes(qdot_constrained *constrained, double t,
                                                             const double *y, double *z,
                                                             double *dq, double *dv, double *M);

/* A constraint on accelerations does not drift, because it is solved for. But one that is
 * redundant at the start may contradict the others later: QDOT_EDOMAIN names one that does not
 * hold at a state of the run. Test: tests/bad/constraints/constraint-leaves.lag. */
QDOT_MUST_CHECK qdot_status qdot_constrained_check_accelerations(qdot_constrained *constrained,
                                                                 double t, const double *y);

/* Move y [2n] (+ carry [2n], may be NULL) onto the constraints, as qdot_ode_system.project:
 * *moved is the largest change of a component relative to max(1, |y_i|), 0 if nothing was done.
 * QDOT_EDOMAIN if it does not converge. */
QDOT_MUST_CHECK qdot_status qdot_constrained_project(double t, double *y, double *carry,
                                                     double *moved, void *constrained);

/* The constraints, all of them holonomic, as methods take them that hold them themselves
 * (ode/geometric/variational.c). Valid while `constrained` lives; whose user it is. */
qdot_ode_bonds qdot_constrained_bonds(qdot_constrained *constrained);

/* The event `who` has set the values of y [2n] marked in q_set and v_set [n]. They stay; the
 * others move least in the metric of M until the constraints hold, first on positions, then on
 * velocities, as under an impulse: in two doubles, y + low [2n] at t + t_low, unless low is NULL. q_set or v_set NULL: no position or velocity was set that
 * could break a constraint, and none moves. QDOT_EDOMAIN names a constraint that cannot be kept.
 * Allocates. */
QDOT_MUST_CHECK qdot_status qdot_constrained_put(qdot_constrained *constrained, double t,
                                                 double t_low, double *y, double *low,
                                                 const bool *q_set, const bool *v_set,
                                                 const char *who);

/* Residuals at y: the largest |f| of the holonomic rows; the largest |df/dt| or |f| of the
 * velocity rows; the indices of these rows (SIZE_MAX: none). */
typedef struct {
    double position, velocity;
    size_t worst_position, worst_velocity;
} qdot_constrained_residual;
qdot_constrained_residual qdot_constrained_measure(qdot_constrained *constrained,
                                                   double t, const double *y);

/* Check that a run may start at y: QDOT_EINVAL names a constraint that y breaks, with its
 * residual, or constraints that contradict each other; QDOT_ESINGULAR as _solve. Then project
 * away the residual that rounding of the given values leaves. */
QDOT_MUST_CHECK qdot_status qdot_constrained_start(qdot_constrained *constrained,
                                                   double t, double *y, double *low);

/* Factor M and A of a system with all rows; failures name constraints or coordinates as in
 * _solve. */
QDOT_MUST_CHECK qdot_status qdot_constrained_factor(const qdot_plan *plan,
                                                    qdot_saddle *s);

/* Before the first factorisation of a system of the rows `row` (NULL: all): measure how large the
 * rows are near in [2n + 1] (q, q', t), so that a row of pure rounding there is recognised.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_constrained_look_beside(const qdot_plan *plan, qdot_saddle *s,
                                                         const size_t *row, const double *in);

/* The least sine between a row of A and those before it, at y: 0 if rows that were independent
 * are not any more; 1 if it cannot be measured. */
double qdot_constrained_independence(qdot_constrained *constrained, double t,
                                     const double *y);

/* How long the row of A that has shrunk most is at y, over the largest that it was in the run; *row:
 * the constraint that it is of. */
double qdot_constrained_remains(qdot_constrained *constrained, double t, const double *y,
                                size_t *row);

/* Whether the constraints that hold accelerations are nearly dependent at y; if so rows [m] marks
 * which. false also if that cannot be found out. */
bool qdot_constrained_near(qdot_constrained *constrained, double t, const double *y, bool *rows);

/* A constraint is named in messages if its part in a linear dependency (qdot_saddle_parts) reaches this. */
#define QDOT_CONSTRAINED_PART 1e-6
/* Append the names of the rows marked in rows [m]: "constraint a", "constraints a, b and c"; if
 * these are many, a vector constraint is named once for all its components. */
void qdot_constrained_name(const qdot_constraints *c, const bool *rows, qdot_text *to);

/* Append what has become of the rows marked in rows [m]: "constraint a has no direction", "constraints a and b
 * stop being independent"; if none is marked, "constraints stop being independent". */
void qdot_constrained_say_dependent(const qdot_constraints *c, const bool *rows, qdot_text *to);

/* Fail with QDOT_ESINGULAR: the rows marked in rows [m] depend on each other; or row `row` of A has
 * become 0. */
QDOT_MUST_CHECK qdot_status qdot_constrained_fail_dependent(const qdot_constraints *c,
                                                            const bool *rows);
QDOT_MUST_CHECK qdot_status qdot_constrained_without_direction(const qdot_constraints *c,
                                                               size_t row);

/* Convert multipliers lambda [m] of the rows, at t and y = (q, q') [2n], to those of the scene's constraints. */
QDOT_MUST_CHECK qdot_status qdot_constrained_rescale(const qdot_constrained *constrained, double t,
                                                     const double *y, double *lambda);
size_t qdot_constrained_rows(const qdot_constrained *constrained); /* number m of constraint rows */
const qdot_constraints *qdot_constrained_of(const qdot_constrained *constrained);
/* The number of independent constraints; QDOT_SADDLE_UNKNOWN before the first factorisation. */
size_t qdot_constrained_rank(const qdot_constrained *constrained);
/* The number of times that a matrix was factored. */
size_t qdot_constrained_factored(const qdot_constrained *constrained);

#endif
