/* task.h -- what the parts of one integration share: the pool, what is known, and the signs that were assumed.
 *
 * Where the form of an antiderivative depends on the sign of a parameter that is not known, the sign is assumed
 * and the condition is recorded; the integration is repeated with the other sign (antiderivative.c).
 */
#ifndef QDOT_INTEGRAL_TASK_H
#define QDOT_INTEGRAL_TASK_H

#include "normal/field/facts.h"

enum { QDOT_INTEGRAL_SIGNS = 3, QDOT_INTEGRAL_DEPTH = 6 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    bool may_assume;    /* signs of parameters may be assumed */
    bool failed;        /* a sign was needed that may not be assumed */
    unsigned fresh;     /* number of variables of substitutions made so far */
    size_t asked;       /* number of conditions assumed */
    qdot_expr condition[QDOT_INTEGRAL_SIGNS]; /* relations 0 < e */
    bool holds[QDOT_INTEGRAL_SIGNS];          /* how each is assumed */
    int64_t effort;        /* steps left until the integration is given up */
} qdot_integral_task;

/* The integral of e over x at a nesting depth; nil: not found. */
qdot_expr qdot_integral_any(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth);

/* The sign of e, which is not 0 for generic parameters: 1 or -1, known or assumed; 0: e is 0 or the sign must be known. */
int qdot_integral_sign(qdot_integral_task *t, qdot_expr e);

/* Whether e is 0 by its normal form, or proved to be. */
bool qdot_integral_zero(qdot_integral_task *t, qdot_expr e);

/* A new variable for a substitution; positive: it is known to be > 0. */
qdot_expr qdot_integral_variable(qdot_integral_task *t, bool positive);

/* log|u|, or log u where u > 0 is known. */
qdot_expr qdot_integral_log(qdot_integral_task *t, qdot_expr u);

/* The normal form of e. */
qdot_expr qdot_integral_normal(qdot_integral_task *t, qdot_expr e);

/* sqrt(v), with |p| written p: for formulas that are even in the root, up to a constant. */
qdot_expr qdot_integral_root(qdot_integral_task *t, qdot_expr v);

/* Whether steps are left; counts one. */
bool qdot_integral_goes(qdot_integral_task *t);

#endif
