/* sides.h -- equations with |u|, sign u, max, min and if(...), one side of u at a time.
 *
 * All of these functions that choose by the sign of one u are a switch: |u|, sign(2 u), max(a, b) with u = a - b,
 * if(b < a, ...). Where u > 0 each of them is something smooth, and something else where u < 0:
 *
 *     |v|        v      -v      0         v = c u, c > 0; the other way round for c < 0
 *     sign v     1      -1      0
 *     max(a, b)  a       b      a
 *     if(b < a, A, B)  A    B    B
 *
 * A side of u is chosen once, for all equations and conditions; its relation (u > 0) then is a condition of what follows.
 * An end u = 0 belongs to every side with which all functions of the switch agree there; where there is no such side the
 * zeros of u are a case of their own, a jump.
 *
 * Tests  tests/normal/solve/test_sides.c
 */
#ifndef QDOT_NORMAL_SIDES_H
#define QDOT_NORMAL_SIDES_H

#include "base/memory.h"
#include "expr/id.h"

enum { QDOT_SIDES_MOST = 8 };

typedef struct {
    qdot_pool *pool;
    size_t n; /* number of sides; 0: the condition of an if(...) is not a < b or a <= b */
    qdot_expr relations[QDOT_SIDES_MOST]; /* [n] a LIST of relations that define each side */
    qdot_expr jump;                       /* u, if the points where u = 0 belong to no side; else nil */
    qdot_vec(qdot_expr) choice;           /* the functions that switch at u = 0 */
    qdot_vec(qdot_expr) value; /* [choice.n x n] value of each function on each side; u = 0 last */
} qdot_sides;

/* The innermost |u|, sign u, max, min or if(...) in e that contains x (nil: any); nil if there is none. */
qdot_expr qdot_sides_choice(qdot_pool *pool, qdot_expr e, qdot_expr x);

/* The switch to which `choice` belongs, with all functions in e (or a LIST) that it decides. *out
 * is cleared by the caller in any case. */
QDOT_MUST_CHECK qdot_status qdot_sides_of(qdot_pool *pool, qdot_expr e, qdot_expr choice, qdot_sides *out);
/* The expression e on side number `side` of a switch; for s->n at u = 0. Nil (QDOT_EDOMAIN): undefined there. */
qdot_expr qdot_sides_put(const qdot_sides *s, size_t side, qdot_expr e);
void qdot_sides_clear(qdot_sides *s);

#endif
