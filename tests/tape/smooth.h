/* smooth.h -- two functions of t to build expressions of, and all functions of these, for tests of
 * series. */
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

/* Every function of one argument, by name, checked. */
static inline void
check_functions(void (*check)(fixture *f, qdot_expr e, const char *what))
{
    static const struct {
        qdot_fun_id f;
        bool above; /* of u > 1, else of 0 < x < 1 */
        const char *name;
    } rows[] = {
        {QDOT_SIN, false, "sin"},     {QDOT_COS, false, "cos"},
        {QDOT_TAN, false, "tan"},     {QDOT_SEC, false, "sec"},
        {QDOT_CSC, false, "csc"},     {QDOT_COT, false, "cot"},
        {QDOT_ASIN, false, "asin"},   {QDOT_ACOS, false, "acos"},
        {QDOT_ATAN, false, "atan"},   {QDOT_SINH, false, "sinh"},
        {QDOT_COSH, false, "cosh"},   {QDOT_TANH, false, "tanh"},
        {QDOT_ASINH, false, "asinh"}, {QDOT_ACOSH, true, "acosh"},
        {QDOT_ATANH, false, "atanh"}, {QDOT_EXP, false, "exp"},
        {QDOT_LOG, true, "log"},      {QDOT_ERF, false, "erf"},
        {QDOT_ERFC, true, "erfc"},
    };
    fixture f;

    begin(&f);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check(&f, qdot_fun1(f.pool, rows[i].f, rows[i].above ? f.u : f.x), rows[i].name);
    check(&f, qdot_pow_int(f.pool, qdot_fun1(f.pool, QDOT_COSH, f.x), -3), "cosh^-3");
    check(&f, qdot_pow_int(f.pool, qdot_add(f.pool, QDOT_ONE, qdot_fun1(f.pool, QDOT_EXP, f.x)), -1),
          "1/(1 + exp)");
    qdot_pool_free(f.pool);
}

#endif
