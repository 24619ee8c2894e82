/* geometric.h -- methods that keep the structure of a mechanical system over long times.
 *
 *     q' = v(t, q, p),   p' = F(t, q, v)      n coordinates
 *
 * Either p = v = q', where M and what else belongs to the momenta are constant (`halves` of
 * ode/system.h): then F are the accelerations. Or p are the canonical momenta dL/dq' (`phase` there).
 * One of them holds constraints g(t, q) = 0 (`bonds`), with A^T lambda in p', A = dg/dq.
 *
 * In these variables the methods are symplectic and symmetric, if forces come from a potential. So
 * the error of the energy stays bounded for times far beyond the length of a step, as long as that
 * length is constant (Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed. 2006, IX.8).
 *
 * Steps. Where the length is not given it is found by a trial of 64 steps of varying length from the
 * start, each under the tolerance, and 0.9 of the shortest is taken. The error of a step is its
 * difference from two steps of half the length,
 *
 *     ratio = max_i |y_i - y_i,halves| / (tol max(s_i, |y_i|)),     y = (q, q').
 *
 * Every sixteenth step is measured like that. If its ratio is above 1 the step is repeated with a
 * shorter length, and all that follow have that one: the length never grows. But for a start so near
 * a singular place, as the rim of a contact of fractional power, that the steps of the trial grow
 * 10^4-fold: there all are measured, and grow to the shortest of the trial's later half.
 *
 * Rounding. The state is a sum y + low of two doubles, and each increment is added to it without
 * error (VIII.5). Coefficients whose doubles are off have the rest beside them: else the energy
 * would drift.
 *
 * Tests  tests/ode/geometric/test_geometric.c
 */
#ifndef QDOT_ODE_GEOMETRIC_H
#define QDOT_ODE_GEOMETRIC_H

#include <stdbool.h>
#include <stdint.h>

#include "ode/run.h"

typedef struct qdot_geometric qdot_geometric;
typedef struct qdot_geometric_kernel qdot_geometric_kernel;

struct qdot_geometric_kernel {
    int order;
    bool separable;    /* the method is explicit: the force F must not depend on v */
    int stages;        /* number of stages of a collocation method; 0: another method */
    size_t rows, more; /* size of the work space: rows of n doubles; further doubles */
    size_t of_bonds; /* further doubles for each constraint; 0: the method cannot treat constraints */
    /* Fill the constant part of the work space g->work; NULL: there is no such part. */
    void (*begin)(qdot_geometric *g);
    /* Advance g->y + g->low from t by h; on a failure they are undefined. QDOT_EDOMAIN where an
     * iteration does not converge. */
    qdot_status (*step)(qdot_geometric *g, double t, double h);
};

struct qdot_geometric {
    const qdot_ode_system *system; /* the system that is integrated; borrowed */
    const qdot_geometric_kernel *kernel;
    size_t n;        /* number of coordinates */
    double *y, *low; /* [2n] the state as two doubles: (q, p) is the sum y + low */
    double *work;    /* [rows x n + more] work space of the method */
    double *state, *rates; /* [2n] the state as (q, q'); the time derivative of this */
    bool known;      /* whether what the method stored at the end of the last step is still valid for y */
    double h;        /* length of the last step */
    uint64_t evaluations;
};

/* Evaluate the velocity v [n] at (t, q, p). Can fail like the functions of qdot_ode_system. */
QDOT_MUST_CHECK qdot_status qdot_geometric_velocity(qdot_geometric *g, double t, const double *q,
                                                    const double *p, double *v);
/* Evaluate the force F [n] at (t, q, v). QDOT_EDOMAIN if a component is not finite. */
QDOT_MUST_CHECK qdot_status qdot_geometric_force(qdot_geometric *g, double t, const double *q,
                                                 const double *v, double *F);

/* The functions of geometric (structure-preserving) methods, for the table of method.h; constant-steps.c has the controller
 * of their steps (ode/step.h), which fails with QDOT_EINVAL if the system is none that the method is for. */
extern const qdot_geometric_kernel qdot_verlet, qdot_composition8; /* explicit splitting methods, in splitting.c */
/* Gauss's collocation methods of order 4, 6, 8 and 12, in gauss.c */
extern const qdot_geometric_kernel qdot_gauss4, qdot_gauss6, qdot_gauss8, qdot_gauss12;
extern const qdot_geometric_kernel qdot_variational; /* the variational integrator, in variational.c */

#endif
