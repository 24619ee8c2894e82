/* elementary.h -- what is known of the elementary functions, which function a node is, where functions occur.
 *
 * Tests   tests/expr/test_function.c
 */
#ifndef QDOT_EXPR_ELEMENTARY_H
#define QDOT_EXPR_ELEMENTARY_H

#include "expr/function.h"

/* Properties (bits) of an elementary function f of one real argument; atan2 only has QDOT_FUN_ARC. */
enum {
    QDOT_FUN_ODD = 1,      /* f(-x) = -f(x) */
    QDOT_FUN_EVEN = 2,     /* f(-x) = f(x) */
    QDOT_FUN_RISING = 4,   /* strictly increasing on its domain, which is an interval */
    QDOT_FUN_FALLING = 8,  /* strictly decreasing on its domain, which is an interval */
    QDOT_FUN_ENTIRE = 16,  /* analytic at every real number */
    QDOT_FUN_ARC = 32,     /* its sine and cosine are algebraic functions of the argument */
    QDOT_FUN_AREA = 64,    /* its hyperbolic sine and cosine are algebraic functions of the argument */
    QDOT_FUN_POLE = 128    /* has a pole at some finite argument */
};

/* An end of the range of values of a function: number, or number times pi/2 if `angle`. */
typedef struct {
    bool known; /* whether a bound on this side is known */
    bool open;  /* the function never takes the value at this end of its range */
    bool angle;
    int number;
} qdot_fun_end;

/* A row of the table function.def: the name and the properties of an elementary function. */
typedef struct {
    const char *name;
    int least, most; /* numbers of arguments; most < 0: any number */
    unsigned traits;
    qdot_fun_end lo, hi;
    qdot_fun_id inverse; /* x = inverse(v) solves f(x) = v; for an even f so does -x; QDOT_FUNCTION_KINDS: no inverse */
} qdot_fun_facts;

/* The known properties of a function; for the internal function `hold` only its name and its one argument. */
const qdot_fun_facts *qdot_fun_facts_of(qdot_fun_id id);

/* Find *lo, *hi: doubles just outside the ends of the range of the function; infinite if it has no end. */
void qdot_fun_ends(qdot_fun_id id, double *lo, double *hi);

/* Whether a function has all of the traits. */
bool qdot_fun_is(qdot_fun_id id, unsigned traits);

/* Whether e is a function with all of these traits. */
bool qdot_expr_is_function_that(const qdot_pool *pool, qdot_expr e, unsigned traits);

/* Whether e is an application of the function `id`. */
bool qdot_expr_is_function(const qdot_pool *pool, qdot_expr e, qdot_fun_id id);

/* The first node of e, children before parents, that is one of the functions ids [n] and holds x (nil: any). Nil: there
 * is none, or the pool failed. */
qdot_expr qdot_expr_find_function(qdot_pool *pool, qdot_expr e, size_t n, const qdot_fun_id *ids, qdot_expr x);

#endif
