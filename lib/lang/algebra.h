/* algebra.h -- functions of the language that solve and take apart; rows in lang/builtin.c. */
#ifndef QDOT_LANG_ALGEBRA_H
#define QDOT_LANG_ALGEBRA_H

#include "lang/session.h"

#define QDOT_ALGEBRA(word)                                                               \
    QDOT_MUST_CHECK qdot_status qdot_algebra_##word(                                     \
        qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
QDOT_ALGEBRA(subs);
QDOT_ALGEBRA(factor);
QDOT_ALGEBRA(solve);
QDOT_ALGEBRA(series);
QDOT_ALGEBRA(eigenvalues);
#undef QDOT_ALGEBRA

#endif
