/* decide.h -- is it zero? An exact normal form, else refutation in balls, else undecided.
 *
 * Class with a proof: rational functions over Q of symbols of every class, undefined
 * functions and their derivatives (modulo relations polynomial in these); sin, cos, sinh,
 * cosh (tan, sec, csc, cot, tanh by them) and exp of rational combinations of symbols and
 * products of symbols (omega*t) with rational multiples of pi; roots and absolute values,
 * nested ones too, with declared signs and conditions (zero.h, domain.h); algebraic
 * constants (constant.h); inverse functions, log, max, min and powers by rules
 * (rewrite.h); undefined functions of equal arguments (unify.h). A multivariate
 * polynomial normal form (FLINT) modulo s^2 + c^2 = 1, C^2 - S^2 = 1, r^k = b. What is
 * outside counts as an independent generator: a zero found is still a proof; a nonzero is
 * then only decided by refutation.
 *
 * A refutation is a point inside the declared domains at which the ball of left - right (Arb) does not
 * contain 0: never rounding.
 */
#ifndef QDOT_NORMAL_DECIDE_H
#define QDOT_NORMAL_DECIDE_H

#include "expr/expr.h"

typedef enum { QDOT_PROVED, QDOT_REFUTED, QDOT_UNDECIDED } qdot_verdict;

/* What may be used: relations (each a scalar expression that is 0) and conditions (RELs that
 * sample points must satisfy). Arrays borrowed. */
typedef struct {
    size_t n_relations;
    const qdot_expr *relations;
    size_t n_conditions;
    const qdot_expr *conditions;
    /* Undefined functions in the relations: derivatives up to this order are bound by nothing but
     * the relations themselves. 0: their consequences may bind any that is higher than theirs. 2:
     * the relations are constraints of a motion whose accelerations are put in. */
    uint32_t free_derivatives;
    /* A LIST (or nil) of what must have values where sides are compared, though it may be gone from
     * them: sqrt(x) for sqrt(x)^2, which is x. */
    qdot_expr defined;
} qdot_facts;

typedef struct {
    qdot_verdict verdict;
    qdot_expr at;       /* refuted: a LIST of equations symbol = number, the point */
    double left, right; /* refuted: the values there */
    int digits;         /* undecided: agreed to so many digits at `points` points */
    int points;
} qdot_decision;

/* Decide left == right for scalars. facts may be NULL. Errors: QDOT_ELIMIT is never returned
 * (it is `undecided`); QDOT_EINTR, QDOT_ENOMEM, QDOT_ETYPE. */
QDOT_MUST_CHECK qdot_status qdot_decide_equal(qdot_pool *pool, qdot_expr left,
                                              qdot_expr right, const qdot_facts *facts,
                                              qdot_decision *decision);

/* Whether e is proved to be zero. False also when it fails; the pool keeps the failure. */
bool qdot_is_zero(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* Decide left < right (or <=) from signs and declared domains; else refute by a point. */
QDOT_MUST_CHECK qdot_status qdot_decide_less(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, bool strict,
                                             const qdot_facts *facts,
                                             qdot_decision *decision);

/* Two equations are equal when one residual is the other times a factor free of velocities and
 * accelerations that is nonzero inside the declared domains. a, b: residuals. *factor: the
 * factor if proved; *may_vanish: it could be zero somewhere in the domains (a notice is due). */
QDOT_MUST_CHECK qdot_status qdot_decide_proportional(qdot_pool *pool, qdot_expr a,
                                                     qdot_expr b, const qdot_facts *facts,
                                                     qdot_decision *decision,
                                                     qdot_expr *factor, bool *may_vanish);
#endif
