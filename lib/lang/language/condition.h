/* condition.h -- equations and inequalities as values, and as conditions.
 *
 * Tests: tests/lang/language/test_evaluate.c
 */
#ifndef QDOT_LANG_CONDITION_H
#define QDOT_LANG_CONDITION_H

#include "expr/id.h"

/* Make the relation a op b for op == < <= > >=. QDOT_ETYPE: an inequality between values that are
 * not numbers. */
QDOT_MUST_CHECK qdot_status qdot_condition_relation(qdot_pool *pool, const char *op, qdot_expr a,
                                                    qdot_expr b, qdot_expr *value);
/* Whether e is a relation, a logical combination of relations, or a truth value. */
bool qdot_condition_is(const qdot_pool *pool, qdot_expr e);
/* Replace an equation between numbers by true or false, as a condition needs it. */
qdot_expr qdot_condition_decide(qdot_pool *pool, qdot_expr e);

#endif
