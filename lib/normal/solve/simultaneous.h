/* simultaneous.h -- the set of all real u with f_1(u) = 0, ..., f_m(u) = 0.
 *
 * A branch is equations that are left, values found so far and conditions. One step takes the equation that is easiest
 * to solve; each of its factors is solved (solve.h) for its easiest unknown, and each root, put in everywhere, is a
 * branch of the next step:
 *
 *     a root with conditions      the branch keeps them
 *     what was divided by         its zeros are a branch of their own, so nothing is lost
 *     a family u = v + n p        a member for each n that the other equations tell apart; where there is no such
 *                                 number, the integer n stays, and what is left without unknowns is solved for it
 *
 * A branch without equations is put back into all of them. If none is refuted and all are defined there, it is a
 * solution, listed member by member inside the declared domains (qdot_solve_members). An unknown that nothing determines
 * is free: it does not stand among the values, but may in the others.
 *
 * Tests  tests/normal/solve/test_simultaneous.c, tests/mech/study/test_equilibrium.c
 */
#ifndef QDOT_NORMAL_SIMULTANEOUS_H
#define QDOT_NORMAL_SIMULTANEOUS_H

#include "normal/field/facts.h"
#include "normal/solve/solutions.h"

typedef struct {
    qdot_expr values;     /* a LIST u = value, in the order of the unknowns */
    qdot_expr conditions; /* a LIST of relations under which the solution exists; nil: always */
} qdot_simultaneous_solution;

/* What is left to solve: equations, LISTs of the values known so far and of conditions (conditions.h), what is to be 0
 * before anything else: a divisor (nil: none), and the equations from which the branch began (nil: all). */
typedef struct {
    qdot_expr equations, known, conditions, first, whole;
} qdot_simultaneous_branch;

/* The equations, the branches still to be solved, and the solutions. The first fields are set by the caller. */
typedef struct {
    qdot_pool *pool;
    qdot_facts facts;
    qdot_expr equations;            /* a LIST of the equations */
    qdot_expr defined; /* further expressions that must be defined at a solution; nil: none */
    qdot_expr domain; /* conditions (conditions.h) for the equations as typed to be defined; nil: none */
    qdot_vec(qdot_expr) unknowns; /* the unknowns; solved from the last to the first, unless another is easier */
    size_t places;                  /* how many unknowns may be periodic (coordinates); these come first */
    /* Whether members of a family with this period, not a full turn, are equivalent for the caller;
     * NULL: always. */
    bool (*alike)(void *user, qdot_expr u, qdot_expr period);
    void *user;
    /* Inserts values into the ends of the domains in which members are listed; NULL: unchanged. */
    qdot_expr (*ends)(void *user, qdot_expr end);
    void *ends_user;
    uint64_t work;                  /* the remaining budget of operations */
    qdot_vec(qdot_simultaneous_branch) todo;

    qdot_vec(qdot_simultaneous_solution) found;
    bool complete; /* no solution has been lost; true at first */
    bool narrowed; /* solutions have been lost on the branches `left` alone */
    qdot_vec(qdot_simultaneous_branch) left; /* where no formula gives the next unknown, or the
                                               * budget was spent: further solutions lie on these */
    bool recurs;   /* an angle has one declared bound: solutions within one turn are listed */
    qdot_vec(qdot_expr) special; /* expressions in parameters: where one is 0 the set of solutions may differ */
    qdot_vec(qdot_expr) period; /* periods of the unknowns that may be periodic; nil: not computed; QDOT_FALSE: none */
} qdot_simultaneous;

/* Every solution of f [n] in the unknowns u [n] under `conditions` (nil: none), each once, ascending where all are
 * constants. A coordinate is generic unless it is an unknown, and so is a parameter. facts may be NULL. *out is cleared by
 * the caller in any case. Errors: QDOT_ENOMEM, QDOT_EINTR, QDOT_ELIMIT, the pool's. (simultaneous-set.c) */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_all(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *u,
                                                  qdot_expr conditions, const qdot_facts *facts,
                                                  qdot_simultaneous *out);
/* Whether the solution `one`, wherever it exists, is contained in `all`: a member of the family, or
 * full turns away. */
bool qdot_simultaneous_lies_in(const qdot_simultaneous *s, const qdot_simultaneous_solution *one,
                               const qdot_simultaneous_solution *all);

/* Solve all branches that are left to do; their solutions are appended to s->found. More than 1024: QDOT_ELIMIT. Past
 * the budget: not complete, and what is left to do is on `left`. */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_solve(qdot_simultaneous *s);
void qdot_simultaneous_clear(qdot_simultaneous *s);

/* The expression e with the values of the equations u = value inserted simultaneously. */
qdot_expr qdot_simultaneous_put(qdot_pool *pool, qdot_expr e, qdot_expr values);

/* The interval in which the unknown u is sought (solutions.h), with parameter values inserted into its ends. */
qdot_window qdot_simultaneous_window(const qdot_simultaneous *s, qdot_expr u, bool angle);

/* Find the smallest shift of the unknown u that leaves all equations unchanged; nil if none is known. */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_period(qdot_simultaneous *s, qdot_expr u, qdot_expr *period);

/* Append the solutions of a branch without equations: all its members inside the declared domains, with the conditions
 * under which they exist. (simultaneous-members.c) */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_emit(qdot_simultaneous *s, const qdot_simultaneous_branch *b);

/* --- steps by which a branch is continued -------------------------------------------------------------- */

/* The number of unknowns that occur in e. */
size_t qdot_simultaneous_unknowns_in(const qdot_simultaneous *s, qdot_expr e);
/* Record that solutions may differ where d = 0, if d contains parameters only. */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_add_special(qdot_simultaneous *s, qdot_expr d);

/* The innermost switch in e that depends on unknowns; nil if e is the last equation, in one unknown, as solving it treats
 * the switch. `others`: a LIST of the other equations. (simultaneous-sides.c) */
qdot_expr qdot_simultaneous_common_switch(const qdot_simultaneous *s, qdot_expr e, qdot_expr others);
/* Continue with a branch for each side of the switching function `choice`; the first side is solved first.
 * (simultaneous-sides.c) */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_on_all_sides(qdot_simultaneous *s, const qdot_simultaneous_branch *b,
                                                           qdot_expr choice);

/* Where k of the `equations`, a LIST, simplified, are linear in the k powers of sums in it, such as 1/r1^3 and 1/r2^3, and
 * give these without unknowns: a branch with the powers' values in place of those k equations, and one on which their
 * determinant is 0. *done: whether b was continued so. (simultaneous-powers.c) */
QDOT_MUST_CHECK qdot_status qdot_simultaneous_by_powers(qdot_simultaneous *s, const qdot_simultaneous_branch *b,
                                                        qdot_expr equations, bool *done);

#endif
