/* system.h -- a system of ordinary differential equations: arrays and callbacks.
 *
 *     dy/dt = f(t, y),   y of n components
 */
#ifndef QDOT_ODE_SYSTEM_H
#define QDOT_ODE_SYSTEM_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "num/two.h"

/* A point of a solution: time t + t_low, state y + carry [n] (carry NULL: 0). */
typedef struct {
    double t, t_low;
    const double *y, *carry;
} qdot_ode_place;

/* The first orders of a Taylor series in sums of two doubles (ode/leading.h). */
typedef struct {
    const qdot_two *x; /* coefficients x_ik = x[i stride + k] for k below the stride */
    size_t stride;
    /* Order 0 of the solution through a place, about which the series in doubles stands, by
     * the same unit of time; then order k, those below being there, up to
     * QDOT_ODE_LEADING_MOST and to one below the highest in doubles. Failures are those of
     * qdot_ode_system. */
    qdot_status (*begin)(const qdot_ode_place *at, double unit, void *user);
    qdot_status (*next)(int k, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_leading;

enum { QDOT_ODE_LEADING_MOST = 12 };

/* value of `digits` with machine code, unless all that is solved for are numbers */
enum { QDOT_ODE_DIGITS = 18 };

/* What expansions cost, in nanoseconds, of which only the ratios matter: one to order p takes about
 * c[0] + c[1] p + c[2] p^2. Orders are chosen by it (ode/taylor.h). */
typedef struct {
    double kernels[3];
    double code[3]; /* the same three coefficients for generated machine code; all 0: no code is available */
    double wider; /* with machine code: added for each `of_vector` orders (or a part of these) beyond `narrow` */
    int narrow, of_vector;
    /* Natural digits that an order is chosen for at least where there is code: an oscillation that
     * is hardly there bounds the step, and as it has no singularity a higher order is worth more
     * than its radius says (doc/methods.md). Whether it is chosen by the longest step that lets no
     * oscillation grow as well (ode/taylor.h). */
    double digits;
    bool by_stability;
    double worth; /* generating machine code for order p costs as much as it saves in worth/p expansions */
} qdot_ode_cost;

/* Callbacks for Taylor expansions by generated machine code. */
typedef struct {
    /* Write it for expansions to order p, before a `begin`, so that others of the same shape, to orders
     * up to `most`, can share it; NULL: none can be. */
    qdot_status (*write)(int p, int most, void *user);
    /* Take such code that an earlier run left, if there is some and nothing else is in use; asked for
     * once. Whether expansions to order p are code. Go back to kernels. */
    bool (*take)(int p, int most, void *user);
    bool (*there)(int p, void *user);
    void (*drop)(void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_code;

/* A system that gives the Taylor coefficients of its solutions. With s = (t' - t)/unit,
 *
 *     y_i(t') = sum_k x_ik s^k
 *
 * Failures are those of qdot_ode_system. */
typedef struct {
    int most;        /* the highest order that can be computed */
    const double *x; /* x_ik = x[i stride + k], written by the callbacks */
    size_t stride;
    size_t checked; /* dy_i/dt = y_{checked + i} for i below it: no check, and what the
                       state holds beyond y enters order 1 */
    qdot_ode_cost cost; /* the cost of a Taylor expansion */
    /* Called before many expansions to order p are made. May be NULL. */
    qdot_status (*prepare)(int p, void *user);
    qdot_ode_code code;
    /* Compute orders 0 and 1 of the Taylor series of the solution through y [n] at t. */
    qdot_status (*begin)(double t, const double *y, double unit, void *user);
    /* Continue the Taylor series with orders 2 ... p. */
    qdot_status (*extend)(int p, void *user);
    /* What the coefficients at the point begun last are worth, relative to the state, where
     * that may be less than a double: near a singularity that the solution passes
     * smoothly. No step is held to a tighter tolerance. NULL: all they can. */
    double (*noise)(void *user);
    /* Where there is noise: the time from that point, in the direction of the unit, to the
     * place that causes it, from the series; 0 where it lies behind or is not known. Steps
     * go over it, or stay well before. */
    double (*ahead)(void *user);
    /* Called when a step has passed the time that `ahead` returned last, at time t; may be NULL. */
    void (*crossed)(double t, void *user);
    /* A step of s units, INFINITY for any, or as much of it as no part of f that is not seen where
     * it begins is stepped over in, by an expansion to order p; `least` units are the narrowest part
     * that counts (series/near.h). NULL: there are no such parts. */
    double (*near)(int p, double s, double least, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_series;

/* Components that are not integrated but follow from the others at every moment, with what
 * stays constant along a solution: velocities, where momenta are kept. */
typedef struct {
    size_t n;
    const size_t *index; /* [n] indices of the components that are derived from the others */
    /* The solution to be followed begins at y + carry (carry NULL: 0): what is constant along
     * it is found there, and kept until another one is entered. Entered twice in a row it is
     * the same solution, by its y. Failures as those of f. */
    qdot_status (*enter)(double t, const double *y, const double *carry, void *user);
    /* Compute the derived components of y from the other components. QDOT_EDOMAIN if undefined. */
    qdot_status (*derive)(double t, double *y, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_following;

/* The same system without the inverse of what stands before the highest derivatives, for implicit
 * methods:
 *
 *     y = (q, v),   q' = v,   M(t, y) v' = f(t, y) + A^T z,   N v' = g(t, y)
 *
 * v the last m components, q the n - m before: m, or none; z [k] are multipliers, which the k rows
 * of g determine (N = 0: constraints of velocities, index 2; N = A: index 1). Failures are those of
 * qdot_ode_system. */
typedef struct {
    size_t m, k;
    /* Compute the residual r [m + k] = (f + A^T z - M a, g - N a), for any a [m], z [k]. */
    qdot_status (*residual)(double t, const double *y, const double *a, const double *z, double *r,
                            void *user);
    /* z [k] at the state; the slopes of r by q and (v, z) at a and z held, and (M, N); each
     * [(m + k) x (m + k) row-major], with columns of zeros where there is nothing; dq is not touched
     * without q */
    qdot_status (*slopes)(double t, const double *y, const double *a, double *z, double *dq,
                          double *dv, double *M, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_mass_form;

/* Conversion of a system with state y = (q, q') to canonical momenta p. Can fail like f of the system. */
typedef struct {
    qdot_status (*momenta)(double t, const double *q, const double *v, double *p, void *user);
    qdot_status (*velocity)(double t, const double *q, const double *p, double *v, void *user);
    /* Compute the force, p' = dp/dt. */
    qdot_status (*force)(double t, const double *q, const double *v, double *F, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_phase;

/* Constraints g(t, q) = 0 beside such momenta: p' = F + A^T lambda, A = dg/dq. For methods that hold
 * them themselves; others take the accelerations under them from f. Failures as those of f. */
typedef struct {
    size_t m;
    /* positions: compute the constraint values g [m] at (t, q); velocities: dg/dt [m] at (t, q, v) */
    qdot_status (*positions)(double t, const double *q, double *g, void *user);
    qdot_status (*velocities)(double t, const double *q, const double *v, double *w, void *user);
    /* Add the constraint forces to F [n]: A^T lambda. */
    qdot_status (*pull)(double t, const double *q, const double *lambda, double *F, void *user);
    /* S = A M^-1 A^T at (t, q), until the next call; with it nu [m] = S^-1 c [m], of least norm where
     * rows are redundant, and x [n] = M^-1 A^T nu: A x = c. c is lost. */
    qdot_status (*prepare)(double t, const double *q, void *user);
    void (*solve)(double *c, double *nu, double *x, void *user);
    void *user; /* passed to the callbacks; borrowed */
} qdot_ode_bonds;

/* A step that is about to be accepted, and the tolerance. */
typedef struct {
    double t, t_end, tol;
    const double *y, *y_end; /* [n] states at t and at t_end */
    double until;         /* output: the step may be accepted up to this time; t_end: the whole step */
    uint64_t evaluations; /* output: number of evaluations of f, approximately */
} qdot_ode_look;

/* A part of a system that is decoupled from the other parts. */
typedef struct {
    const struct qdot_ode_system *system; /* the part as a system of its own, which has no parts; borrowed */
    const size_t *index; /* [system->n] indices of its components in the whole system */
} qdot_ode_part;

/* The callbacks may write nothing but their outputs and what `user` owns. A system that
 * is used by two threads at once must be two, each with its own `user`.
 *
 * Where f is undefined return QDOT_EDOMAIN or QDOT_ESINGULAR through qdot_fail(): the
 * integrator tries smaller steps, and if none works the run stops with that message. An
 * output that is not finite counts as QDOT_EDOMAIN. Any other status ends the run at
 * once. */
typedef struct qdot_ode_system {
    size_t n; /* number of components of y, at least 1 */
    /* Compute the right-hand side dydt [n] = f(t, y [n]). */
    qdot_status (*rhs)(double t, const double *y, double *dydt, void *user);
    /* Compute dfdy [n x n, row-major] = df_i/dy_j and dfdt [n] = df/dt; NULL if not available. */
    qdot_status (*jacobian)(double t, const double *y, double *dfdy, double *dfdt,
                            void *user);
    void *user; /* passed to the callbacks; borrowed */
    /* the system written as M dy/dt = f, with its Jacobian; NULL if not available; borrowed */
    const qdot_ode_mass_form *mass_form;
    bool halves; /* y = (q, v) with q' = v and v' = F(t, q, v), what else momenta are made of being
                    constant: geometric methods take v for p */
    const qdot_ode_phase *phase; /* conversion to canonical momenta, unless `halves` is set; NULL: none; borrowed */
    const qdot_ode_bonds *bonds; /* holonomic constraints, for geometric methods; NULL: none; borrowed */
    /* Taylor coefficients of the solution; NULL if these are not available; borrowed */
    const qdot_ode_series *series;
    /* What is not integrated; NULL if all is; borrowed. f and the coefficients read nothing
     * of it: dydt is 0 there, and rows of coefficients hold its series, to the order below
     * the highest, order 0 in place of y. */
    const qdot_ode_following *following;
    /* Bring y [n] + carry [n] (NULL: none) back to where solutions are: called before a
     * step is taken, not by multistep methods. *moved: the largest change of a component
     * relative to max(1, |y_i|), 0 where nothing was done; a step that had to be moved by
     * far more than its error may be is taken back. NULL if there is nothing to do. */
    qdot_status (*project)(double t, double *y, double *carry, double *moved, void *user);
    /* How far a state is from a place where the equations determine nothing, 0 there, in any unit:
     * asked for where steps are taken back. NULL if there are no such places. */
    double (*margin)(double t, const double *y, void *user);
    /* Whether a step of a method without series goes over a part of f that acts for less than the
     * step; NULL if there are no such parts. Errors end the run. */
    qdot_status (*look)(qdot_ode_look *step, void *user);
    /* The first time beyond t, in the direction +1 or -1, at which f(t, y) or a derivative of it jumps for every y; infinite if
     * there is none. A step ends there; at that time f has the values of what follows. If f itself jumps, the double
     * before that time is returned first: a step up to it has values of one side only, and a step of one double follows,
     * across the jump. NULL: f is smooth. */
    double (*until)(double t, int direction, void *user);
    /* The same system once more as parts, all of its components in one of them, if there are
     * two or more; borrowed. Each then takes its own steps where nobody looks at those of
     * the whole (ode/apart.h). */
    const qdot_ode_part *parts;
    size_t n_parts;
    /* The first orders of the Taylor series in two doubles each; NULL if not available; borrowed */
    const qdot_ode_leading *leading;
    /* [n] s_i, positive: errors of y_i are relative to max(s_i, |y_i|) (scale.h). NULL: all are 1;
     * borrowed */
    const double *scales;
} qdot_ode_system;

/* The end of a step from t that would go on to t1: the next such time, or t1. */
static inline double
qdot_ode_until(const qdot_ode_system *system, double t, double t1)
{
    const int direction = t1 < t ? -1 : 1;
    const double until = system->until ? system->until(t, direction, system->user) : t1;

    return direction * (t1 - until) > 0 ? until : t1;
}

/* Whether a status can mean that f is undefined at a point, so that a shorter step may succeed. */
static inline bool
qdot_ode_may_be_undefined(qdot_status status)
{
    return status == QDOT_EDOMAIN || status == QDOT_ESINGULAR || status == QDOT_EFAILED;
}

#endif
