/* solutions.h -- a set of roots: with conditions, in periodic families, inside a domain.
 *
 * Tests  tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_SOLUTIONS_H
#define QDOT_NORMAL_SOLUTIONS_H

#include "base/memory.h"
#include "normal/solve/conditions.h"

typedef struct {
    qdot_expr value;     /* the root of an equation in x; x itself: every x that satisfies the condition is a root */
    qdot_expr condition; /* a LIST of relations under which it is a root; nil: always */
    qdot_expr period;    /* value + n period is a root for every integer n; nil: a single root */
    qdot_expr members; /* for a family: conditions in x that each member must satisfy; nil: none */
} qdot_root;

typedef struct {
    qdot_vec(qdot_root) root;
    bool complete; /* `root` has all roots, except where a divisor is 0 */
    bool single;   /* they are all but for single places where a power with x in its exponent has a negative base */
    bool recurs; /* x is an angle with one declared bound: roots of one turn, others differ by full turns */
    qdot_vec(qdot_expr) divisor; /* divisors without x, assumed non-zero; a LIST: not all of its entries are 0 */
    qdot_vec(qdot_expr) special; /* divisors that contain parameters only: where one is 0 the roots may differ */
} qdot_solutions;

void qdot_solutions_clear(qdot_solutions *s);

/* --- inside a domain ---- */

/* The interval in which the unknown x is sought; nil: no end. */
typedef struct {
    qdot_expr lo, hi;
    bool lo_open, hi_open;
    bool turn;   /* the interval is one turn of an angle without bounds, and represents all turns */
    bool recurs; /* the interval is one turn of an angle with one declared bound */
    unsigned integer; /* index of the integer that numbers members of a family (qdot_solve_integer) */
} qdot_window;

/* The declared domain of x as an interval; for an angle (f has period 2 pi in x) one turn of it. */
qdot_window qdot_solve_window(qdot_pool *pool, qdot_expr x, bool angle);
/* One turn within the window: of one with one end, the turn from there; -pi < x <= pi if it has none. A window with two
 * ends stays as it is. */
qdot_window qdot_window_turn(qdot_pool *pool, qdot_window w);

/* The conditions under which a value lies in the interval; nil if the interval has no ends. */
qdot_expr qdot_window_relations(qdot_pool *pool, const qdot_window *w, qdot_expr value);

/* Whether e, an expression or a LIST, is proved to be unchanged by a shift of x by `period`. */
bool qdot_is_period(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr period,
                    const qdot_facts *facts);
/* Whether e is proved to be unchanged by a full turn (2 pi) of x. */
bool qdot_is_angle(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts);

/* The interval narrowed by those conditions that are linear in x and have constant bounds. */
qdot_window qdot_solve_tighten(qdot_pool *pool, qdot_expr x, qdot_expr conditions,
                               qdot_window window, const qdot_facts *facts);

/* Append to out what of the root lies in the window: the members of a family one by one where that is a finite
 * list, else the family itself, value + n period with the symbol n of an integer. x: for roots that are all x. */
QDOT_MUST_CHECK qdot_status qdot_solve_members(qdot_pool *pool, qdot_expr x, const qdot_root *root,
                                               const qdot_window *window,
                                               const qdot_facts *facts, qdot_solutions *out);

/* The k-th symbol for an integer, k = 0, 1 ...: n, n1, n2 ..., leaving out names that are declared. */
qdot_expr qdot_solve_integer(qdot_pool *pool, unsigned k);

/* How many of the symbols n, n1, n2 ... must be counted to include those in e. */
unsigned qdot_solve_integers(qdot_pool *pool, qdot_expr e);

/* The expression e without full turns in the arguments of circular functions: sin(x) for sin(x + 2 pi n). */
qdot_expr qdot_solve_without_turns(qdot_pool *pool, qdot_expr e);

/* The expression e with the integers n, n1 ... set to 0: one member of a family of solutions. */
qdot_expr qdot_solve_one_member(qdot_pool *pool, qdot_expr e);

#endif
