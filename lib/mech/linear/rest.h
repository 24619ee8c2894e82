/* rest.h -- equilibria of a scene, and their properties. */
#ifndef QDOT_MECH_REST_H
#define QDOT_MECH_REST_H

#include "expr/id.h"

typedef enum {
    QDOT_STABLE,
    QDOT_UNSTABLE,
    QDOT_STABLE_TO_FIRST_ORDER,
    QDOT_STABILITY_UNDECIDED
} qdot_stability;

typedef struct {
    qdot_expr
        equations;    /* a LIST: coordinate = value ..., then multipliers lambda[...] = value ... */
    qdot_expr exists; /* a LIST of conditions (REL) under which the equilibrium is real; nil: always */
    qdot_expr range; /* a LIST lo <= u, u <= hi: every u between is an equilibrium; nil: a single point */
    bool touched;       /* at a point inside the range friction is exactly at its limit */
    bool numeric_range; /* an end of the range is a decimal number, known to 12 digits */
    qdot_stability stability;
    qdot_expr stable_when; /* a LIST of conditions (REL) under which `stability` holds; nil: wherever the equilibrium exists */
    qdot_expr otherwise_to_first_order; /* a LIST of conditions under which the linear motion alone is bounded, where
                                         * `stable_when` does not hold; nil: of that nothing is known */
    bool numeric;
    bool may_jump; /* the energy may be discontinuous there: stability is not judged */
} qdot_equilibrium;

/* Whether the equilibrium is unstable wherever it exists. */
static inline bool
qdot_equilibrium_is_unstable(const qdot_equilibrium *e)
{
    return e->stability == QDOT_UNSTABLE && e->stable_when == QDOT_NIL;
}

typedef struct {
    qdot_equilibrium *at; /* [n] the equilibria of the list, owned */
    size_t n;
    bool complete;        /* the list has all equilibria, for generic parameter values */
    bool recurs; /* an angle has one declared bound: one turn is listed, others differ by full turns */
    size_t starts;        /* number of start points of a numerical search; 0: no such search */
    double reach;         /* start points lay within +-reach if no domain is declared */
    size_t unproved;      /* number of start points that led to a zero within rounding errors that is not proved */
    qdot_expr special; /* a LIST of divisors in the results: where one is 0 the list does not hold; nil: none */
    qdot_expr undefined; /* a LIST: where one of these is 0 the energy or a force is undefined everywhere; nil: none */
    qdot_expr meeting; /* a LIST: where one of these is 0 two kinks coincide and equilibria may differ; nil: none */
    const char *pole;     /* a coordinate whose open domain ends where the chart alone is singular: a rest may be there,
                           * which is not looked for; NULL: none. The pool's */
    qdot_expr jump; /* the energy jumps where this function does; equilibria there are not searched; nil: none */
    qdot_expr unsolved; /* a LIST of LISTs of equations: further equilibria fulfil one of these; nil: nothing is known of them */
    const char *unset; /* a parameter that the numerical search needs but has no value, in the pool; NULL: none */
} qdot_equilibria;

/* Replaces the parameters in e by their values, as far as they are known. */
typedef qdot_expr (*qdot_binder)(void *user, qdot_expr e);

#endif
