/* id.h -- what an expression is: the id of an interned node in a pool.
 *
 * A qdot_expr is a 32-bit id in a pool; 0 is nil. Nodes are interned: two expressions that are
 * built alike have the same id, so equality of form is an integer compare. The pool owns every
 * node; nothing is freed before the pool is. Children have smaller ids than their parents, so id
 * order is topological and a pass over an expression is a loop (expr/walk.h).
 *
 * Failure. Constructors never fail in the middle: nil absorbs, the pool keeps the first cause,
 * and the caller asks once with qdot_pool_check().
 *
 * Everything is real. Canonical form: sums are maps term -> rational coefficient, products maps
 * base -> exponent with one rational coefficient, so like terms meet at construction. A number
 * times a sum stays a product (2*(x + y)) until it is added to something.
 *
 * Tests  tests/expr/
 */
#ifndef QDOT_EXPR_ID_H
#define QDOT_EXPR_ID_H

#include <stdbool.h>
#include <stdint.h>

#include "base/status.h"

typedef uint32_t qdot_expr;
typedef struct qdot_pool qdot_pool;

#define QDOT_NIL 0u

typedef enum {
    QDOT_NUM = 1, /* an exact rational number; read it by qdot_expr_rational() */
    QDOT_SYM,     /* a symbol; read its data by qdot_expr_symbol() */
    QDOT_SUM,     /* args: c0, t1, c1, t2, c2, ...: c0 + c1 t1 + ...; every c a NUM, no t a NUM
                     or SUM or a PROD with a coefficient other than 1 */
    QDOT_PROD,    /* args: c, b1, e1, b2, e2, ...: c b1^e1 b2^e2 ...; a power is {1, b, e} */
    QDOT_FUN,     /* op: a qdot_fun_id; args: its arguments */
    QDOT_UFUN,    /* op: an undefined function; args: a1 ... an, then n orders (NUMs) of partial
                     derivatives: D1^o1 ... Dn^on x (a1, ..., an) */
    QDOT_INTEGRAL, /* args: f, a, b, an integral over a variable that f holds as a QDOT_BOUND symbol; or f, x, a
                     function of x with the derivative f that was not found (expr/integral.h) */
    QDOT_REL,     /* op: a qdot_rel_op; args: left, right */
    QDOT_LOGIC,   /* op: a qdot_logic_op; args: operands */
    QDOT_VEC,     /* args: components, 2 or more */
    QDOT_MAT,     /* op: columns; args: entries, row by row */
    QDOT_LIST     /* args: members, 0 or more */
} qdot_kind;

/* Nodes with fixed ids. */
#define QDOT_ZERO 1u
#define QDOT_ONE 2u
#define QDOT_MINUS_ONE 3u
#define QDOT_HALF 4u
#define QDOT_PI 5u
#define QDOT_TRUE 6u
#define QDOT_FALSE 7u
#define QDOT_T 8u /* the symbol t of the time */
#define QDOT_INFINITY 9u /* legal only as an end of an integral and as the place of a limit, there also with a minus */

typedef enum { QDOT_EQ, QDOT_LT, QDOT_LE } qdot_rel_op; /* a > b is stored as b < a */
typedef enum { QDOT_AND, QDOT_OR, QDOT_NOT } qdot_logic_op;

qdot_pool *qdot_pool_new(void); /* returns NULL if memory runs out */
void qdot_pool_free(qdot_pool *pool);
size_t qdot_pool_count(const qdot_pool *pool); /* number of nodes so far */
size_t qdot_pool_bytes(const qdot_pool *pool); /* bytes used by the pool, without large numbers */

/* The first failure since the last check, QDOT_OK if none. It becomes the thread's last error
 * again, and the pool drops it and is usable as before. */
QDOT_MUST_CHECK qdot_status qdot_pool_check(qdot_pool *pool);

/* Record a failure in the pool (the thread's last error); returns nil. */
qdot_expr qdot_pool_fail(qdot_pool *pool);

/* Whether a failure is pending, so that a loop can stop early. */
bool qdot_pool_failed(const qdot_pool *pool);

/* Allow at most `work` further constructor calls (a node of n args counts 1 + n/16), then
 * QDOT_ELIMIT; UINT64_MAX: no limit. Returns the rest of the previous limit, for restoring it. */
uint64_t qdot_pool_budget(qdot_pool *pool, uint64_t work);

/* Record that a simplification stopped at its work budget: the form is right, but a shorter one
 * may exist. _taken: whether that happened since its last call. */
void qdot_pool_unfinished(qdot_pool *pool);
bool qdot_pool_unfinished_taken(qdot_pool *pool);

#endif
