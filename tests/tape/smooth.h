/* smooth.h -- two functions of t to build expressions of, for tests of series. */
#ifndef QDOT_TESTS_TAPE_SMOOTH_H
#define QDOT_TESTS_TAPE_SMOOTH_H

#include <string.h>

#include "expr/expr.h"

typedef struct {
    qdot_pool *pool;
    qdot_expr x, u; /* x = 0.4 + 0.3 t, u = 1.3 + 0.2 t + 0.1 t^2 */
} fixture;

static inline qdot_expr
decimal(fixture *f, const char *text)
{
    return qdot_expr_decimal(f->pool, text, strlen(text));
}

static inline void
begin(fixture *f)
{
    qdot_expr t2;

    f->pool = qdot_pool_new();
    f->x = qdot_add(f->pool, decimal(f, "0.4"),
                    qdot_mul(f->pool, decimal(f, "0.3"), QDOT_T));
    t2 = qdot_pow_int(f->pool, QDOT_T, 2);
    f->u = qdot_add(f->pool, decimal(f, "1.3"),
                    qdot_mul(f->pool, decimal(f, "0.2"), QDOT_T));
    f->u = qdot_add(f->pool, f->u, qdot_mul(f->pool, decimal(f, "0.1"), t2));
}

#endif
