/* variation-parts.h -- a scene with derivatives of its motion as further coordinates (variation.h). */
#ifndef QDOT_SIM_VARIATION_PARTS_H
#define QDOT_SIM_VARIATION_PARTS_H

#include "sim/run/run.h"

/* A direction of differentiation: the variable s by which derivatives are taken. */
typedef struct {
    const char *name;
    qdot_expr parameter; /* nil: s moves the start alone */
    const qdot_expr
        *values; /* [n_values] of the request with that parameter free; NULL: as there */
    const qdot_expr *
        start; /* [2n] dq/ds, dq'/ds at the start: exact constants; NULL: any, of size 1e-6 */
    double scale; /* of s, where it is known; else 0 */
} qdot_variation_by;

typedef struct {
    qdot_scene *of, *scene;          /* borrowed; owned */
    const qdot_run_request *request; /* borrowed */
    size_t n, m, k;                  /* coordinates, constraints held, directions */
    size_t n_massless;               /* equations of coordinates without mass (sim/model/massless.h) */
    size_t w;                        /* of these, those held: all or none */
    qdot_expr *G;                    /* [n] of them, 0 = G, without numbers */
    size_t *massless;                /* [n] the massless coordinate to which each belongs */
    bool *of_positions;              /* [n] whether such an equation holds no velocity of these */
    const qdot_variation_by *by;     /* [k] borrowed */
    qdot_expr *y;                    /* [k x n] */
    qdot_expr *a, *lambda;           /* [n], [m] from q, q', t */
    qdot_expr *start;                /* [2 (k + 1) n] q, y, q', y' at the start */
    bool *named;                     /* [2 (k + 1) n] of these, which the start names */
    double *scales;                  /* [2 (k + 1) n] of these, as in a request; NULL: none is known */
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
/* The rate de/dt along the motion, with parameter values. */
qdot_expr qdot_variation_rate(const qdot_variation *v, qdot_expr e);

#endif
