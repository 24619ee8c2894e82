/* cases.h -- proves equality case by case: every order of the arguments of max and min, every
 * sign of the arguments of abs and sign.
 *
 * Every point belongs to one of the cases; in a case max, min, abs and sign are one of their
 * arguments, plus or minus their argument, or a number, and the normal form proves the rest.
 * Before that inverse functions of their own functions are replaced (within.h). Arguments that
 * are proved equal count as one; an order of arguments gives the sign of their difference.
 *
 * Tests  tests/normal/prove/test_decide.c, tests/script/prove/identities-cases.inc
 */
#ifndef QDOT_NORMAL_CASES_H
#define QDOT_NORMAL_CASES_H

#include "normal/field/facts.h"

/* Whether left = right is proved in every case (facts may be NULL); false if there are no cases
 * or too many. */
QDOT_MUST_CHECK qdot_status qdot_prove_cases(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, const qdot_facts *facts,
                                             bool *equal);

#endif
