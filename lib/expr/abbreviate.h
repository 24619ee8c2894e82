/* abbreviate.h -- names for the parts that an expression repeats.
 *
 * A sum, product or function is a part if it stands at several places of what is written and the
 * names save at least QDOT_ABBREVIATE_SAVED operations: (places - 1)(its operations). Places
 * inside of a named part count once, as that is written once.
 *
 * Tests  tests/expr/test_abbreviate.c: parts put back give the expression.
 */
#ifndef QDOT_EXPR_ABBREVIATE_H
#define QDOT_EXPR_ABBREVIATE_H

#include "base/memory.h"
#include "expr/id.h"

enum { QDOT_ABBREVIATE_SAVED = 4 };

typedef struct {
    qdot_vec(qdot_expr) symbols; /* D1, D2, ...: formal symbols */
    qdot_vec(qdot_expr) parts;   /* their values, which contain only earlier symbols */
    qdot_expr whole;             /* the expression e, written with these symbols */
} qdot_abbreviated;

/* Symbols take the names D1, D2, ... that `is_taken` does not refuse. Errors: QDOT_ENOMEM,
 * QDOT_EINTR. To be cleared in any case. */
QDOT_MUST_CHECK qdot_status qdot_abbreviate(qdot_pool *pool, qdot_expr e,
                                            bool (*is_taken)(const char *name, void *user),
                                            void *user, qdot_abbreviated *out);
void qdot_abbreviated_clear(qdot_abbreviated *a);

#endif
