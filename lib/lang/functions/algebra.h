/* algebra.h -- functions of the language that solve and take apart; rows in lang/functions/builtin.c. */
#ifndef QDOT_LANG_ALGEBRA_H
#define QDOT_LANG_ALGEBRA_H

#include "lang/session/session.h"

#define QDOT_ALGEBRA(word)                                                               \
    QDOT_MUST_CHECK qdot_status qdot_algebra_##word(                                     \
        qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
QDOT_ALGEBRA(subs);
QDOT_ALGEBRA(factor);
QDOT_ALGEBRA(solve);
QDOT_ALGEBRA(series); /* in lang/functions/series.c */
QDOT_ALGEBRA(eigenvalues);
#undef QDOT_ALGEBRA

/* x = a, y = b as replacements; the arrays are the caller's to drop. */
typedef struct {
    qdot_vec(qdot_expr) from, to;
} qdot_replacements;

/* Add the equation e, or those in a list or vector; `name`: the function that takes them. */
QDOT_MUST_CHECK qdot_status qdot_algebra_gather(qdot_session *s, const char *name, qdot_expr e,
                                                qdot_replacements *r);
void qdot_algebra_drop(qdot_replacements *r);

#endif
