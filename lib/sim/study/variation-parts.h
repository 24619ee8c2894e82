/* variation-parts.h -- fields of a scene that has derivatives of its motion as further coordinates. */
#ifndef QDOT_SIM_VARIATION_PARTS_H
#define QDOT_SIM_VARIATION_PARTS_H

#include "sim/run/run.h"

/* A direction of differentiation: the variable s by which the motion is differentiated. */
typedef struct {
    const char *name;
    qdot_expr parameter; /* the parameter by which is differentiated; nil: only the start depends on s */
    const qdot_expr
        *values; /* [n_values] parameter values, this parameter being a free symbol; NULL: as in the request */
    const qdot_expr *
        start; /* [2n] dq/ds, dq'/ds at the start, exact constants; NULL: any vector of size 1e-6 */
    double scale; /* typical size of s; 0: unknown */
} qdot_variation_by;

typedef struct {
    qdot_scene *of, *scene;          /* the given scene, borrowed; the variational scene, owned */
    const qdot_run_request *request; /* request for the given scene; borrowed */
    size_t n, m, k; /* number of coordinates; of constraints kept in the scene; of directions of differentiation */
    size_t n_massless; /* number of equations of massless coordinates (sim/model/massless.h) */
    size_t w; /* number of massless coordinates' equations that are kept in the scene: all or none */
    qdot_expr *G;                    /* [n_massless] left sides G of G = 0, with parameters as symbols */
    size_t *massless; /* [n_massless] index of the massless coordinate that the equation determines */
    bool *of_positions;              /* [n_massless] whether the equation contains no massless velocity */
    const qdot_variation_by *by;     /* [k] the directions; borrowed */
    qdot_expr *y;                    /* [k x n] further coordinates y_j = dq/ds_j */
    qdot_expr *a, *lambda;           /* [n] q'', [m] multipliers as functions of q, q', t */
    qdot_expr *start;                /* [2 (k + 1) n] start of q, y, q', y' */
    bool *named;                     /* [2 (k + 1) n] whether the start prescribes this value */
    double *scales; /* [2 (k + 1) n] scales of q, y, q', y' as in a request; NULL: unknown */
} qdot_variation;

/* The symbol of q, q', q'' (order 0, 1, 2) of coordinate i of the given scene, or of its derivative
 * in direction k. */
qdot_expr qdot_variation_jet(const qdot_variation *v, size_t i, uint32_t order);
qdot_expr qdot_variation_slope_jet(const qdot_variation *v, size_t k, size_t i,
                                   uint32_t order);
/* e with the parameter values of the request; e with q'' replaced by the accelerations. Nil: the
 * pool failed. */
qdot_expr qdot_variation_with_numbers(const qdot_variation *v, qdot_expr e);
qdot_expr qdot_variation_with_motion(const qdot_variation *v, qdot_expr e);
/* The derivative de/ds by the parameter of direction k, with parameter values; 0 if s changes the
 * start only. */
qdot_expr qdot_variation_by_parameter(const qdot_variation *v, qdot_expr e, size_t k);

/* De/Ds in direction k of an expression in q, q', q'', t and parameters, with numbers put in: an
 * expression of the new scene. Nil: the pool keeps the failure. */
qdot_expr qdot_variation_of(const qdot_variation *v, qdot_expr e, size_t k);
/* The time derivative de/dt along the motion, with parameter values inserted. */
qdot_expr qdot_variation_rate(const qdot_variation *v, qdot_expr e);

#endif
