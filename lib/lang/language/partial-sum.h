/* partial-sum.h -- keeps sums that a loop evaluates again with one term more.
 *
 *     particle bob[k] ... at (sum(l[j]*sin(theta[j]), j, 1, k), ...) for k = 1..N
 *
 * has N^2/2 terms, of which N differ. A sum is kept until the outermost loop ends if its terms
 * depend only on its own index: numbers, parameters and coordinates by their names, elementary
 * functions. A sum with the same beginning that goes at least as far continues from it.
 *
 * Tests  tests/lang/language/test_partial-sum.c, tests/script/solve/partial-sums.lag
 */
#ifndef QDOT_LANG_PARTIAL_SUM_H
#define QDOT_LANG_PARTIAL_SUM_H

#include "lang/language/machine.h"
#include "lang/source/token.h"

typedef struct qdot_partial_sum {
    const qdot_token *place; /* the token of the sum's index, which identifies the sum */
    int64_t first, last;
    qdot_expr value;
} qdot_partial_sum;

/* The sum at this place from `first` as far as it is known, not beyond `last`; NULL: none. Valid
 * until the next is kept. */
const qdot_partial_sum *qdot_partial_sum_find(const qdot_session *session,
                                              const qdot_token *place, int64_t first, int64_t last);
/* Store the sum for the next pass of a loop, in place of one with fewer terms; nothing outside of loops. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_partial_sum_keep(qdot_session *session, qdot_partial_sum sum);

/* An instruction was carried out, its value on top: what the terms of the sums under way depend on
 * by it. */
void qdot_partial_sum_note(qdot_machine *m, const qdot_postfix *code);

#endif
