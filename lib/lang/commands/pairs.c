/* pairs.c -- lists of symbols with values, as in `set m = 1, k = 2`. */
#include "lang/commands/pairs.h"

void
qdot_pairs_free(qdot_pairs *p)
{
    qdot_free(p->symbols.at);
    qdot_free(p->values.at);
    qdot_free(p->places.at);
}

qdot_status
qdot_pairs_push(qdot_pairs *p, const qdot_token *place, qdot_expr symbol, qdot_expr value)
{
    QDOT_TRY(qdot_vec_push(&p->symbols, symbol));
    QDOT_TRY(qdot_vec_push(&p->values, value));
    return qdot_vec_push(&p->places, place);
}
