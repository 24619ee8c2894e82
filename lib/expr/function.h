/* function.h -- the elementary functions (function.def): their ids, their constructors.
 *
 * Tests  tests/expr/test_function.c
 */
#ifndef QDOT_EXPR_FUNCTION_H
#define QDOT_EXPR_FUNCTION_H

#include "expr/id.h"

typedef enum {
#define X(ID, ...) QDOT_##ID,
#include "expr/function.def"
#undef X
    QDOT_FUNCTION_COUNT,
    /* Operators that are not in function.def, and have no name in the language: */
    QDOT_HOLD = QDOT_FUNCTION_COUNT, /* that of qdot_hold */
    QDOT_LOOKUP, /* lookup(x, handle) of a table of data (num/samples.h): constant in pieces; in values of functions only */
    QDOT_FUNCTION_KINDS
} qdot_fun_id;

/* An elementary function with its special values, parity and inverse pairs applied. Number of
 * arguments as in the table, else QDOT_ETYPE; outside the domain (log 0): QDOT_EDOMAIN. */
qdot_expr qdot_fun(qdot_pool *pool, qdot_fun_id id, uint32_t n, const qdot_expr *args);
qdot_expr qdot_fun1(qdot_pool *pool, qdot_fun_id id, qdot_expr x);
/* e as one value that surrounding sums and products do not merge: hold(a + b) + c stays a sum of
 * two terms, so that a + b is computed once, and exp(-hold(log(a))) an exponential. For a
 * number, a symbol or another function: e itself. Only in equations for numerical runs. */
qdot_expr qdot_hold(qdot_pool *pool, qdot_expr e);
/* e without that, for people and for proofs: every hold(x) is x. */
qdot_expr qdot_released(qdot_pool *pool, qdot_expr e);
/* Find a function by its name; false if there is none. */
bool qdot_fun_find(const char *name, qdot_fun_id *id);
const char *qdot_fun_name(qdot_fun_id id);

#endif
