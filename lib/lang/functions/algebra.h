/* algebra.h -- what functions that rewrite share. */
#ifndef QDOT_LANG_ALGEBRA_H
#define QDOT_LANG_ALGEBRA_H

#include "base/memory.h"
#include "lang/session/parts.h"

/* Set *value to `result` in the shortest form found, unless it is too large to be read. */
QDOT_MUST_CHECK qdot_status qdot_algebra_give_short(qdot_session *s, qdot_expr result,
                                                    qdot_expr *value);

/* A list of replacements x = a, y = b; the caller frees its arrays. */
typedef struct {
    qdot_vec(qdot_expr) from, to;
} qdot_replacements;

/* Add the equation e, or those in a list or vector; `name`: of the function that takes them. */
QDOT_MUST_CHECK qdot_status qdot_algebra_gather(qdot_session *s, const char *name, qdot_expr e,
                                                qdot_replacements *r);
void qdot_algebra_drop(qdot_replacements *r);

#endif
