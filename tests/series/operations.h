/* operations.h -- expressions that need every operation and every recurrence of series. */
#ifndef TESTS_SERIES_OPERATIONS_H
#define TESTS_SERIES_OPERATIONS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "expr/expr.h"

enum { MOST_OUT = 64 };

/* x, u, t, of which series are given, and a number c. */
typedef struct {
    qdot_pool *pool;
    qdot_expr in[4], out[MOST_OUT];
    size_t n;
} fixture;

static inline void
push(fixture *f, qdot_expr e)
{
    assert_true(f->n < MOST_OUT);
    f->out[f->n++] = e;
}

static inline qdot_expr
apply(fixture *f, qdot_fun_id id, qdot_expr x)
{
    return qdot_fun1(f->pool, id, x);
}

/* What is smooth where 0 < x < 1 < u, t is about 0.25 and c about 0.7; c is a parameter, or 7/10. */
static inline void
smooth(fixture *f, bool parameter)
{
    static const qdot_fun_id below[] = {QDOT_SIN,  QDOT_COS,   QDOT_TAN,   QDOT_ASIN,
                                        QDOT_ACOS, QDOT_ATAN,  QDOT_SINH,  QDOT_COSH,
                                        QDOT_TANH, QDOT_ASINH, QDOT_ATANH, QDOT_EXP,
                                        QDOT_ERF,  QDOT_ERFC};
    qdot_pool *pool = f->pool = qdot_pool_new();
    qdot_expr x = f->in[0] = qdot_symbol_get(pool, QDOT_COORD, "x");
    qdot_expr u = f->in[1] = qdot_symbol_get(pool, QDOT_COORD, "u");
    qdot_expr t = f->in[2] = QDOT_T, s = apply(f, QDOT_SIN, u), e = apply(f, QDOT_EXP, x);
    qdot_expr c = f->in[3] = parameter ? qdot_symbol_get(pool, QDOT_PARAM, "c")
                                       : qdot_expr_ratio(pool, 7, 10);
    qdot_expr tenth = qdot_expr_ratio(pool, 1, 10), k = apply(f, QDOT_COS, c);

    f->n = 0;
    for (size_t i = 0; i < sizeof below / sizeof *below; i++)
        push(f, apply(f, below[i], x));
    push(f, apply(f, QDOT_LOG, u));
    push(f, apply(f, QDOT_ACOSH, u));
    push(f, apply(f, QDOT_SIN, qdot_mul(pool, t, x)));
    push(f, apply(f, QDOT_COS, qdot_mul(pool, t, u)));
    push(f, qdot_mul(pool, s, e));
    push(f, qdot_div(pool, s, e));
    push(f, qdot_div(pool, s, k));
    push(f, qdot_pow_int(pool, s, 2));
    push(f, qdot_pow_int(pool, u, -3));
    push(f, qdot_sqrt(pool, u));
    push(f, qdot_pow(pool, u, tenth));
    push(f, qdot_pow(pool, u, c));
    push(f, qdot_pow(pool, u, x));
    push(f, qdot_sub(pool, qdot_mul(pool, s, e), qdot_mul(pool, e, t)));
    push(f, qdot_sub(pool, x, qdot_mul(pool, s, t)));
    push(f, qdot_add(pool, t, qdot_mul(pool, tenth, s)));
    push(f, qdot_sub(pool, t, qdot_mul(pool, k, e)));
    push(f, qdot_sub(pool, qdot_mul(pool, tenth, e), u));
    push(f, qdot_sub(pool, qdot_mul(pool, s, u), qdot_mul(pool, t, t)));
    push(f, qdot_neg(pool, s));
    push(f, qdot_fun(pool, QDOT_ATAN2, 2, (qdot_expr[]){s, e}));
    push(f, qdot_add(pool, apply(f, QDOT_SINH, s), apply(f, QDOT_COSH, s)));
    push(f, qdot_pow_int(pool, apply(f, QDOT_COSH, x), -3));
    push(f, qdot_pow_int(pool, qdot_add(pool, QDOT_ONE, e), -2));
    push(f, tenth);
    push(f, qdot_mul(pool, k, qdot_add(pool, QDOT_PI, c)));
}

#endif
