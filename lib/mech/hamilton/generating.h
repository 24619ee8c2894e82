/* generating.h -- a generating function of a canonical transformation.
 *
 *     F1(q, Q): p = dF1/dq,  P = -dF1/dQ          F2(q, P): p = dF2/dq,  Q = dF2/dP
 *     F3(p, Q): q = -dF3/dp, P = -dF3/dQ          F4(p, P): q = -dF4/dp, Q = dF4/dP
 *
 * Of type 1 the equations Q(q, p) = Q are solved for p, so that p and P are functions of q and Q; F1 is the potential of
 * the field (p, -P). The others likewise. What was found is put back and proved: with Q(q, p) in place of Q its derivatives
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

/* The first that is found, of type *type 1 ... 4, without its dependence on time alone; nil: none. */
QDOT_MUST_CHECK qdot_status qdot_generating_find(qdot_pool *pool, const qdot_transformation *x, const qdot_facts *facts,
                                                 int *type, qdot_expr *F);

#endif
