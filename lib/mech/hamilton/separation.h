/* separation.h -- the equation of Hamilton and Jacobi, and its separation in the coordinates of the scene.
 *
 *     H(q, dS/dq, t) + dS/dt = 0,    S = -E t + sum W_i(q_i; constants),   p_i = dW_i/dq_i
 *
 * A coordinate that H does not hold has a constant momentum, the symbol p[q]. A coordinate is separated from the others
 * where a factor mu(q) makes
 *
 *     mu (H - E) = A(q_i, p_i) + B(the others):    A = -beta, B = beta,
 *
 * and the others are then separated in B = beta. mu is 1 or T_i/g_i, where g_i p_i^2 stands in H and g_i/g_k = T_i(q_i)
 * T_k(the others). The mixed derivatives of A + B are proved to be 0. An H with t separates with t as one coordinate more,
 * whose momentum is dS/dt; where H is linear in q with constants or functions of t, S = sum P_i(t) q_i + F(t).
 *
 * Where no factor is found, Levi-Civita's condition decides whether H - E separates at all: for all i < k
 *
 *     H_qi H_qk H_pi,pk + H_pi H_pk H_qi,qk = H_qi H_pk H_pi,qk + H_pi H_qk H_qi,pk.
 *
 * Source  Landau & Lifshitz, Mechanics, 48; Goldstein, Poole, Safko, Classical Mechanics, 10.4-10.5; Levi-Civita, Math.
 *         Ann. 59 (1904) 383.
 * Tests   tests/script/studies/hamilton-jacobi.lag, tests/mech/hamilton/test_separation.c
 */
#ifndef QDOT_MECH_SEPARATION_H
#define QDOT_MECH_SEPARATION_H

#include "mech/scene/things.h"

/* One coordinate: p = shift +- sqrt(square) solves relation(q, p) = 0. */
typedef struct {
    qdot_expr q, p;      /* the coordinate, or t; the symbol of its momentum, or of dS/dt */
    bool cyclic;         /* p is a constant */
    qdot_expr relation;  /* is 0; nil: the coordinate was not separated, or it is cyclic beside others */
    qdot_expr shift, square; /* nil: not solved for; square nil alone: p = shift */
    qdot_expr constant;  /* beta, the separation constant that this coordinate's equation was the first to have; nil: none */
} qdot_separated;

typedef enum { QDOT_SEPARATES, QDOT_SEPARATES_NOT, QDOT_SEPARATION_UNKNOWN, QDOT_SEPARATION_NOT_FOUND } qdot_separation_verdict;

typedef struct {
    qdot_expr H, energy; /* H(q, p, t); the symbol or value E; nil: H holds t */
    size_t n;
    qdot_separated *of;  /* [n] the scene's coordinates in order, and t last where H holds it */
    /* QDOT_SEPARATION_NOT_FOUND: it separates by Levi-Civita's condition, but no factor was found */
    qdot_separation_verdict verdict;
    qdot_expr signs;     /* a LIST 0 < beta for the separation constants that cannot be negative; nil: none */
    qdot_expr S;         /* the solution linear in q; nil: there is none, or the equation separates */
} qdot_separation;

/* Whether a name may be that of a new constant. */
typedef struct {
    bool (*is_free)(void *user, const char *name);
    void *user;
} qdot_constant_names;

/* Separate the equation. energy: the value of H; nil: a new symbol. *out is cleared by the caller in any case. QDOT_EINVAL:
 * constraints, forces without potential, or states; QDOT_ELIMIT; what hamiltonian fails with. */
QDOT_MUST_CHECK qdot_status qdot_separation_find(qdot_scene *s, qdot_expr energy, const qdot_constant_names *names,
                                                 qdot_separation *out);
void qdot_separation_clear(qdot_separation *x);

/* The equation for an undefined function S of the coordinates and t. */
QDOT_MUST_CHECK qdot_status qdot_separation_equation(qdot_scene *s, qdot_expr H, const qdot_constant_names *names, qdot_expr *equation);
/* The equation of one coordinate as `p^2 = ...` or `p = ...`, or relation = 0. */
qdot_expr qdot_separated_equation(qdot_pool *pool, const qdot_separated *x);
/* Whether all coordinates are cyclic: H is a function of the momenta, and the energy no constant of its own. */
bool qdot_separation_is_free(const qdot_separation *x);
/* The complete integral S; integrals that are not found stand. Nil: the equation did not separate. */
qdot_expr qdot_separation_integral(qdot_scene *s, const qdot_separation *x);

#endif
