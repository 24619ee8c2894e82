/* algebra.h -- functions that differentiate and rewrite; their table rows are in builtin.c. */
#ifndef QDOT_LANG_ALGEBRA_H
#define QDOT_LANG_ALGEBRA_H

#include "base/memory.h"
#include "lang/session/parts.h"

/* Handlers for the rows of functions/builtin.c, with args [n]. */
#define QDOT_ALGEBRA(word)                                                               \
    QDOT_MUST_CHECK qdot_status qdot_algebra_##word(                                     \
        qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
QDOT_ALGEBRA(diff);
QDOT_ALGEBRA(ddt);
QDOT_ALGEBRA(lhs);
QDOT_ALGEBRA(rhs);
QDOT_ALGEBRA(residual);
QDOT_ALGEBRA(expand);
QDOT_ALGEBRA(collect);
QDOT_ALGEBRA(simplify);
QDOT_ALGEBRA(subs);
QDOT_ALGEBRA(factor);
QDOT_ALGEBRA(eigenvalues);
#undef QDOT_ALGEBRA

/* *value = result in the shortest form found, unless it is too large to be read. */
QDOT_MUST_CHECK qdot_status qdot_algebra_give_short(qdot_session *s, qdot_expr result,
                                                    qdot_expr *value);

#define QDOT_ALGEBRA_SUBS "subs(e, x = a, y = b)"

/* Replacements x = a, y = b; the caller frees the arrays. */
typedef struct {
    qdot_vec(qdot_expr) from, to;
} qdot_replacements;

/* Add the equation e, or those in a list or vector; `name`, `usage`: of the function that
 * takes them. */
QDOT_MUST_CHECK qdot_status qdot_algebra_gather(qdot_session *s, const char *name,
                                                const char *usage, qdot_expr e,
                                                qdot_replacements *r);
void qdot_algebra_drop(qdot_replacements *r);

#endif
