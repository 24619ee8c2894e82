/* residual.h -- d'Alembert's form for Taylor series: no M^-1 f, nothing differentiated
 * twice.
 *
 *     R_i = sum_f dd_f/dq_i F_f - Q_i = 0
 *
 * The functions x of mech/dynamics/dalembert make a tree: where x is another one, its parent,
 * and a little more, only the difference d is kept, x = x_parent + d. With x'' summed up
 * from the roots and the forces w x'' from the leaves,
 *
 *     x_f'' = x_parent'' + d_f'',   F_f = sum w x'' + sum of F over the children,
 *
 * a chain of N links takes work N in all that, and 4 N convolutions an order.
 *
 * Where functions depend on many coordinates each, as places along an arm in space do, there are no slopes: all R_i come
 * from one sweep back through the functions (residual-adjoint.h).
 *
 * Order k of R, with coefficient k + 2 of q taken as 0, gives M_0 a_k = -R_k; a_k is then
 * propagated (qdot_taylor_change). The series of d'' is that of d, shifted.
 *
 * Source  Nedialkov & Pryce, BIT 45 (2005) 561; shared sums as in recursive Newton-Euler
 *         schemes (Featherstone, Rigid Body Dynamics Algorithms, ch. 5).
 * Tests   tests/sim/form/test_taylor.c
 */
#ifndef QDOT_SIM_RESIDUAL_H
#define QDOT_SIM_RESIDUAL_H

#include "mech/dynamics/dalembert.h"
#include "series/motion.h"
#include "sim/model/equations.h"

typedef struct {
    uint32_t to, from; /* indices of two functions: F_to has the term w x''_from */
    double w;
    signed char side; /* sign of (exact w - w) */
    double low;       /* exact w - w, rounded */
    qdot_expr exact;  /* the weight w as an expression */
} qdot_residual_weight;

typedef struct {
    /* indices: function f, coordinate i, and the output of `places` that is the derivative dd_f/dq_i */
    uint32_t function, coordinate, output;
} qdot_residual_slope;

struct qdot_residual {
    size_t functions;
    qdot_expr *difference; /* [functions] differences d_f of positions, with parameter values */
    uint32_t *parent;      /* [functions] parent function, earlier in the list; UINT32_MAX: none */
    qdot_residual_weight *weights;
    size_t n_weights;
    qdot_residual_slope *slopes; /* the derivatives dd_f/dq_i that are not identically 0 */
    size_t n_slopes;
    qdot_expr *applied; /* [n] applied forces Q_i, with parameter values */
    uint32_t *force; /* [n] output of `places`, or 1 << 31 and one of `forces`, with Q_i;
                        UINT32_MAX: zero */
    /* Tapes with the inputs q, q' and t: */
    qdot_tape *places; /* outputs: differences d_f in their order, their derivatives, and Q_i's parts without velocities */
    qdot_tape *forces; /* outputs: Q_i that depend on velocities; NULL: none */
    qdot_tape *masses; /* lower triangles of the blocks that are not constant, by rows; NULL: of a
                          plan without M (sim/plan/tree-alone.h) */
    qdot_program of_places, of_forces; /* series programs of these tapes, made by qdot_residual_programs */
    /* Instead of slopes and of the forces that have a potential (residual-adjoint.h); NULL: there are slopes. */
    qdot_tape *adjoint; /* from q, q', t, F [functions], s: outputs sum_f dd_f/dq_i F_f + s dV/dq_i */
    qdot_tape *along;   /* from q, a, t: the differentials of d_f along a, sum_i dd_f/dq_i a_i */
    qdot_motion motion; /* the program of the motion (motion-of-residual.h), filled by the plan, if it
                           has masses */

    /* The energy h as an expression, and its tape of q, q', t; made when needed
     * (sim/form/residual-energy.h). */
    qdot_expr h;
    qdot_tape *energy;
    bool *absent; /* [n] whether h may be independent of the coordinate, as found at sample points; none of many
                     where there is `adjoint`: a proof of it would derive what that spares */
};

#define QDOT_RESIDUAL_FORCES (UINT32_C(1) << 31)

/* Of a scene whose plan has its structure, or has no M. *residual is NULL where the form does
 * not apply. */
QDOT_MUST_CHECK qdot_status qdot_residual_new(qdot_scene *scene, const qdot_plan *plan,
                                              qdot_residual **residual);
/* Of these n > 0 terms and forces Q, with slopes or without. *residual NULL: its tapes have no series. */
QDOT_MUST_CHECK qdot_status qdot_residual_of_terms(const qdot_plan *plan, size_t n, const qdot_dalembert_term *terms,
                                                   qdot_expr Q, bool slopes, qdot_residual **residual);
/* Make the Taylor series programs of the residual's tapes, unless they exist. Errors: those of series. */
QDOT_MUST_CHECK qdot_status qdot_residual_programs(qdot_residual *residual);
void qdot_residual_free(qdot_residual *residual);

/* F [functions] from the second derivatives of the differences, in x [functions], which become
 * those of the functions: down the tree and up again. w [n_weights]. */
void qdot_residual_forces(const qdot_residual *residual, const double *w, double *x, double *F);
/* M [n x n], zeros before, column by column: the forces that q_i'' = 1 alone takes. The value of
 * slope j is slope[j][0]; x, F [functions] are work space. */
void qdot_residual_masses(const qdot_residual *residual, size_t n, const double *w,
                          const double *const *slope, double *x, double *F, double *M);

#endif
