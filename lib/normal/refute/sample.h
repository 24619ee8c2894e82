/* sample.h -- points inside the declared domains, at which expressions are evaluated in
 * balls.
 *
 * Symbols get small rationals. Applications of undefined functions are independent
 * values (jets), except where two of one function would have equal arguments: such a
 * point is left out. With relations, each is solved for one symbol or application in
 * which it is linear or quadratic (either root, chosen at each point); where that cannot
 * be done, at each point by itself for one symbol, whose value is then a ball that surely
 * holds a solution. Two that would be solved for each other have no points.
 */
#ifndef QDOT_NORMAL_SAMPLE_H
#define QDOT_NORMAL_SAMPLE_H

#include <flint/fmpq.h>

#include "normal/field/facts.h"
#include "normal/refute/ball.h"

typedef struct {
    qdot_expr atom, solution; /* a symbol; its value from the relations, nil: chosen freely */
    bool implicit;            /* the value is a root: `solution` is an expression that is 0 */
    qdot_ball *relation;      /* the expression `solution` for evaluation; made when first needed */
    fmpq x;                   /* the chosen value, if free */
    bool turn;                /* the value is x times pi */
    bool edge;                /* the value is a closed bound of the domain */
    bool ready;
    arb_t value;
} qdot_sample_atom;

/* A condition that is linear in a symbol (atom): the symbol lies below (or above) `bound`. */
typedef struct {
    qdot_expr atom, bound;
    bool below;
} qdot_sample_bound;

typedef struct {
    qdot_pool *pool;
    qdot_sample_atom
        *atom; /* free symbols first, each after those in its bounds; then solved symbols in reverse order */
    size_t n;
    qdot_sample_bound *bound;
    size_t n_bounds, bounds_capacity;
    qdot_ball ball; /* evaluates all expressions, bounds, conditions and solutions */
    qdot_expr list; /* a LIST of all these expressions */
    const qdot_facts *facts;
    int k;             /* index of the point */
    int64_t root_work; /* operations used for roots so far, limited by a budget */
    uint64_t seed;
    bool possible; /* false if a contradiction was found, so that no points exist */
} qdot_sample;

/* Prepare to sample e[n] under facts (may be NULL). Errors: QDOT_ENOMEM, QDOT_EINTR, those of the pool. */
QDOT_MUST_CHECK qdot_status qdot_sample_begin(qdot_sample *s, qdot_pool *pool, size_t n,
                                              const qdot_expr *e,
                                              const qdot_facts *facts);
void qdot_sample_end(qdot_sample *s);

/* Choose the k-th sample point. */
void qdot_sample_point(qdot_sample *s, int k);
/* The k-th special point, at which sides may differ though they agree around it: one atom is 0,
 * 1, -1, a quarter turn, a declared bound that belongs to it, another atom's value or its
 * negative. False: there are no more. */
bool qdot_sample_edge(qdot_sample *s, int k);
/* Evaluate there; whether it is a point: conditions surely hold, solved values inside
 * their domains. The values: qdot_ball_get(&s->ball, e). */
bool qdot_sample_eval(qdot_sample *s, slong prec);
/* The same, though applications of one undefined function might have equal arguments:
 * their values are then not those of a function, but all others are right. */
bool qdot_sample_values(qdot_sample *s, slong prec);

/* The sample point as a LIST of equations symbol = number. */
qdot_expr qdot_sample_list(qdot_sample *s);

/* For the files of samples: the value of a free atom, put in; whether a symbol is the sign before a
 * root that solves a relation. */
void qdot_sample_set(qdot_sample_atom *a, slong prec);
/* Find the range in which a value of the symbol may be sought, with the other symbols at the present point. */
void qdot_sample_range(qdot_sample *s, qdot_expr atom, double *from, double *to);
/* The value of a symbol at the sample point, as a callback of qdot_ball_eval. */
bool qdot_sample_value(void *user, qdot_expr atom, arb_t value, slong prec);
/* A symbol given by relations: atom = solution; or (implicit) the expression `solution` is 0 at its value. */
typedef struct {
    qdot_expr atom, solution;
    bool implicit;
} qdot_sample_solution;

static inline bool
qdot_sample_is_solved(size_t n, const qdot_sample_solution *solved, qdot_expr atom)
{
    for (size_t k = 0; k < n; k++)
        if (solved[k].atom == atom)
            return true;
    return false;
}

/* Solve relation = 0, the number-th, for an atom for which none of `solved` [n] is. atom nil: it holds
 * anyway. False: it cannot be solved. */
bool qdot_sample_solve(qdot_pool *pool, qdot_expr relation, size_t number, size_t n,
                       const qdot_sample_solution *solved, qdot_sample_solution *out);
/* Find the value of an implicit atom; the atoms it depends on are known. Returns whether there is
 * one. */
bool qdot_sample_root(qdot_sample *s, qdot_sample_atom *a, slong prec);
bool qdot_sample_is_sign(const qdot_pool *pool, qdot_expr e);

#endif
