/* legendre.h -- Legendre's transform of a function F(x), other symbols held:
 *
 *     y_i = dF/dx_i,     G(y) = sum x_i y_i - F(x),     x solved for in terms of y
 *
 * From velocities to momenta F = L gives H; from momenta to velocities F = H gives L. The variables are
 * divided into the blocks of d2F/dx dx, which are solved apart:
 *
 *     F quadratic in the block    x is linear in y; G as squares where that is shorter
 *     F = f(u) + linear terms     u = Q(x) of second degree, as a relativistic particle has it; with X = B^-1 (y - b),
 *                                 u = Q(x0) + (y - b).X/2 f'(u)^2 is one equation for u, and x = x0 + X/f'(u)
 *     one variable                one equation (normal/solve)
 *
 * What is found so is put into y = dF/dx, and proved. F homogeneous of first degree in the block, beside
 * terms without it, has no transform: the y obey a relation, the primary constraint.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 8.1; Dirac, Lectures on Quantum Mechanics, 1.
 * Tests   tests/mech/hamilton/test_legendre.c
 */
#ifndef QDOT_MECH_LEGENDRE_H
#define QDOT_MECH_LEGENDRE_H

#include "expr/symbol.h"
#include "mech/scene/things.h"

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_class of;  /* what x is: QDOT_COORD, velocities, or QDOT_MOMENTUM */
    uint32_t n;
    qdot_expr F, F_left, G_bent; /* F; its terms outside of bent blocks; those blocks' parts of G */
    bool mixed; /* F_left holds terms of bent blocks, at the solution */
    qdot_expr *q, *x, *y; /* [n] coordinates; the variables of F and of G */
    qdot_expr *rest;      /* [n] y - dF/dx at x = 0, of blocks in which F is quadratic */
    qdot_expr *solved;    /* [n] x in terms of y */
    qdot_expr *A;         /* [n*n] d2F/dx dx */
    size_t *block;        /* [n] the smallest variable of the block of each */
    bool *bent;           /* [n] F is not quadratic in this block */
} qdot_legendre;

/* Solve y = dF/dx for x, the velocities of the coordinates q [n] (QDOT_COORD) or their momenta (QDOT_MOMENTUM).
 * False: the pool has the cause: QDOT_ESINGULAR, y does not determine x, or QDOT_EDOMAIN, no formula was found. To be
 * ended in any case. */
bool qdot_legendre_begin(qdot_legendre *l, qdot_scene *s, qdot_class of, qdot_expr F, uint32_t n, const qdot_expr *q);
void qdot_legendre_end(qdot_legendre *l);
/* G(y). Nil: the pool has the cause, as of qdot_legendre_begin. */
qdot_expr qdot_legendre_of(qdot_scene *s, qdot_class of, qdot_expr F, uint32_t n, const qdot_expr *q);

/* Whether y = dF/dx can determine x. FIRST: not, for F is homogeneous of first degree in x beside terms without x; SINGULAR:
 * not, for another reason. */
typedef enum { QDOT_LEGENDRE_REGULAR, QDOT_LEGENDRE_FIRST, QDOT_LEGENDRE_SINGULAR } qdot_legendre_degree;

/* Solve y_i = dF/dx_i, i < n, of one block in which F is not quadratic. *bound: an expression in y that is 0 where x is not
 * determined; nil: not found. *there: F at the solution; nil: no formula was found. */
QDOT_MUST_CHECK qdot_status qdot_legendre_bent(qdot_pool *pool, qdot_expr F, uint32_t n, const qdot_expr *x,
                                               const qdot_expr *y, const qdot_facts *facts, qdot_expr *solved,
                                               qdot_legendre_degree *degree, qdot_expr *bound, qdot_expr *there);
/* The sum of those terms of e that hold no x [n]. Nil: the pool failed. */
qdot_expr qdot_legendre_terms_without(qdot_pool *pool, qdot_expr e, uint32_t n, const qdot_expr *x);

/* F - sum x_i dF/dx_i, simplified: the terms without x where the others are homogeneous of first degree. */
qdot_expr qdot_legendre_lower(qdot_pool *pool, qdot_expr F, uint32_t n, const qdot_expr *x, const qdot_facts *facts);

#endif
