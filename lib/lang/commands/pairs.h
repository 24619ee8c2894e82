/* pairs.h -- lists of symbols with values, as in `set m = 1, k = 2`. */
#ifndef QDOT_LANG_PAIRS_H
#define QDOT_LANG_PAIRS_H

#include "expr/id.h"
#include "lang/source/token.h"

typedef struct {
    qdot_vec(qdot_expr) symbols, values;
    qdot_vec(const qdot_token *) places; /* token at which each symbol was named; NULL: none */
} qdot_pairs;

void qdot_pairs_free(qdot_pairs *p);
QDOT_MUST_CHECK qdot_status qdot_pairs_push(qdot_pairs *p, const qdot_token *place,
                                            qdot_expr symbol, qdot_expr value);

#endif
