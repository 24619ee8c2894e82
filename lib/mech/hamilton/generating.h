/* generating.h -- a generating function of a canonical transformation.
 *
 *     F1(q, Q): p = dF1/dq,  P = -dF1/dQ          F2(q, P): p = dF2/dq,  Q = dF2/dP
 *     F3(p, Q): q = -dF3/dp, P = -dF3/dQ          F4(p, P): q = -dF4/dp, Q = dF4/dP
 *
 * Of type 1 the equations Q(q, p) = Q are solved for p, so that p and P are functions of q and Q; F1 is the potential of
 * the field (p, -P). The others likewise; of several degrees of freedom each old
 * and each new pair may choose for itself, dF = sum (p dq or -q dp) + sum (-P dQ or Q dP). What was found is put back and proved: with Q(q, p) in place of Q its derivatives
 * are p and -P for all q, p.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 9.1.
 * Tests   tests/script/derive/generating.lag
 */
#ifndef QDOT_MECH_GENERATING_H
#define QDOT_MECH_GENERATING_H

#include "normal/field/facts.h"

typedef struct {
    size_t n;
    const qdot_expr *q, *p, *Q, *P; /* [n] old and new coordinates and momenta, symbols */
    const qdot_expr *Q_of, *P_of;   /* [n] the new ones as functions of the old ones and t */
} qdot_transformation;

/* F without its dependence on time alone; nil: none was found. Bit k of of_p: it is a function of p_k, not q_k; of of_P: of P_k,
 * not Q_k. Both 0: type 1; all P: 2; all p: 3; all p and P: 4; else mixed. */
typedef struct {
    qdot_expr F;
    unsigned of_p, of_P;
} qdot_generating;

/* The first that is found: of types 1 to 4, then of the mixed types, of at most three degrees of freedom. */
QDOT_MUST_CHECK qdot_status qdot_generating_find(qdot_pool *pool, const qdot_transformation *x, const qdot_facts *facts,
                                                 qdot_generating *F);

#endif
