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
        equations;    /* a LIST: coordinate = value ..., then lambda[...] = value ... */
    qdot_expr exists; /* a LIST of RELs under which it is real; nil: always */
    qdot_expr range;  /* a LIST of RELs lo <= u, u <= hi: every u between is a rest; nil: none */
    bool touched;       /* at a point inside the range friction is at its limit */
    bool numeric_range; /* an end of it is a decimal number, known to 12 digits */
    qdot_stability stability;
    qdot_expr stable_when; /* a LIST of RELs under which `stability` holds; nil: wherever the place exists */
    bool numeric;
    bool may_jump; /* the energy may jump there: nothing is said of its stability */
} qdot_equilibrium;

/* Whether it is unstable wherever it exists. */
static inline bool
qdot_equilibrium_is_unstable(const qdot_equilibrium *e)
{
    return e->stability == QDOT_UNSTABLE && e->stable_when == QDOT_NIL;
}

typedef struct {
    qdot_equilibrium *at; /* [n], owned */
    size_t n;
    bool complete;        /* these are all, for generic parameters */
    bool recurs;          /* an angle with one declared end: of one turn, the others are whole turns away */
    size_t starts;        /* of a numerical search; 0: there was none */
    double reach;         /* starts lay within +-reach if no domain is declared */
    size_t unproved;      /* starts that ended at an unproved zero within rounding */
    qdot_expr special;    /* a LIST of what values divide by: where one is 0 this is not the list; nil: none */
    qdot_expr undefined;  /* a LIST of what is 0 where the energy or a force has no value at any place; nil: none */
    qdot_expr meeting;    /* a LIST of what is 0 where kinks meet: rests there may be others; nil: none */
    const char *pole;     /* a coordinate whose open domain ends where the chart alone is singular: a rest may be there,
                           * which is not looked for; NULL: none. The pool's */
    qdot_expr jump;       /* a function by which the energy jumps: no rest is looked for where it does; nil: none */
    const char *unset;    /* a parameter whose value a numerical search needs; NULL: none. The pool's */
} qdot_equilibria;

/* Replaces the parameters in e by their values, as far as they are known. */
typedef qdot_expr (*qdot_binder)(void *user, qdot_expr e);

#endif
