/* cases.h -- equality proved case by case: every order of what max and min choose from, every
 * sign under abs and sign.
 *
 * Each point is in one of the cases; in a case the functions are one of their arguments, plus or
 * minus theirs, or a number, and what is left is proved by the normal form.
 * Before that inverse functions of their own functions are put in (within.h). Arguments that are proved
 * to be equal count as one; an order of arguments knows the sign of their difference.
 *
 * Tests  tests/normal/test_decide.c, tests/script/identities-cases.inc
 */
#ifndef QDOT_NORMAL_CASES_H
#define QDOT_NORMAL_CASES_H

#include "normal/field/facts.h"

/* Whether left = right is proved in every case (facts may be NULL); not where there is nothing to
 * tell apart or too much. */
QDOT_MUST_CHECK qdot_status qdot_prove_cases(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, const qdot_facts *facts,
                                             bool *equal);

#endif
