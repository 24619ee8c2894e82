/* condition.h -- equations and inequalities as values, and as conditions.
 *
 * Tests: tests/lang/language/test_evaluate.c
 */
#ifndef QDOT_LANG_CONDITION_H
#define QDOT_LANG_CONDITION_H

#include "expr/id.h"

/* a op b for = == < <= > >=. QDOT_ETYPE: an inequality between values that are not numbers. */
QDOT_MUST_CHECK qdot_status qdot_condition_relation(qdot_pool *pool, const char *op, qdot_expr a,
                                                    qdot_expr b, qdot_expr *value);
/* Whether e is a relation, a combination of such, or a truth value. */
bool qdot_condition_is(const qdot_pool *pool, qdot_expr e);
/* An equation between numbers is a value; as a condition it is true or false. */
qdot_expr qdot_condition_decide(qdot_pool *pool, qdot_expr e);

#endif
