/* decide.h -- is it zero? An exact normal form, else refutation in balls, else undecided.
 *
 * Class with a proof: rational functions over Q of symbols of every class, undefined
 * functions and their derivatives (modulo relations polynomial in these); sin, cos, sinh,
 * cosh (tan, sec, csc, cot, tanh by them) and exp of rational combinations of symbols and
 * products of symbols (omega*t) with rational multiples of pi; roots and absolute values,
 * nested ones too, with declared signs and conditions (zero.h, domain.h); algebraic
 * constants (constant.h); inverse functions, log, max, min and powers by rules
 * (rewrite.h); undefined functions of equal arguments (unify.h). The method is a multivariate
 * polynomial normal form (FLINT) modulo s^2 + c^2 = 1, C^2 - S^2 = 1, r^k = b. Anything else
 * counts as an independent generator: a zero found is still a proof; that an expression is not
 * zero is then decided only by refutation.
 *
 * A refutation is a point inside the declared domains at which the ball of left - right (Arb) does not
 * contain 0: never rounding.
 */
#ifndef QDOT_NORMAL_DECIDE_H
#define QDOT_NORMAL_DECIDE_H

#include "normal/field/facts.h"

typedef enum { QDOT_PROVED, QDOT_REFUTED, QDOT_UNDECIDED } qdot_verdict;

typedef struct {
    qdot_verdict verdict;
    qdot_expr at;       /* if refuted: a LIST symbol = number of the point of the counterexample */
    double left, right; /* if refuted: values of both sides of the equation at that point */
    int digits;         /* if undecided: to how many digits both sides of the equation agree at `points` points */
    int points;
} qdot_decision;

/* Decide left == right for scalars. facts may be NULL. Errors: QDOT_ELIMIT is never returned
 * (it is `undecided`); QDOT_EINTR, QDOT_ENOMEM, QDOT_ETYPE. */
QDOT_MUST_CHECK qdot_status qdot_decide_equal(qdot_pool *pool, qdot_expr left,
                                              qdot_expr right, const qdot_facts *facts,
                                              qdot_decision *decision);

/* Whether e is proved to be zero. Also false on failure, which the pool keeps. */
bool qdot_is_zero(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
