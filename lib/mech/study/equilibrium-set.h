/* equilibrium-set.h -- the equilibria that are known as formulas of one parameter p, where all others have values.
 *
 *     u_i = f_i(p)   wherever   g_1(p) > 0, g_2(p) > 0 ...
 *
 * each a member. Between two neighbouring zeros of the g and of denominators, ends of the domains of roots and
 * logarithms, steps and kinks of sign, floor, mod, atan2, abs, min, max and relations, a member exists throughout or
 * nowhere, and does not jump: the values of p that separate such cells are found by exclusion (normal/solve/zeros.h).
 * So where the set is complete, so are places in every cell.
 *
 * Tests  tests/mech/study/test_equilibrium-set.c
 */
#ifndef QDOT_MECH_EQUILIBRIUM_SET_H
#define QDOT_MECH_EQUILIBRIUM_SET_H

#include "mech/study/equilibrium-curve.h"

typedef struct {
    qdot_equilibrium place;
    qdot_expr value; /* a LIST of coordinates f [n] and multipliers g as functions of p */
    bool corner;     /* forces jump at this place, so that it is not a zero of the smooth equations */
    bool known;      /* proved: all its special values of p ("walls") are known; continuous between them */
    bool judged; /* place.stability holds where all members of `when` are positive; elsewhere it is undecided */
    qdot_expr when;  /* a LIST of expressions that must be positive */
} qdot_equilibrium_member;

/* A single value of p at which the energy or a force is undefined, because `what` is 0 there. */
typedef struct {
    qdot_expr what;
    double at;
} qdot_equilibrium_gap;

typedef struct {
    const qdot_equilibrium_curve *c; /* equations of the equilibria; borrowed */
    double least, most;              /* range of the parameter p */
    qdot_vec(qdot_equilibrium_member) member;
    qdot_vec(double) wall; /* special values of p that separate intervals, ascending; first least, last most */
    /* proved: except for single values of p, all equilibria are members of the set, and all walls are known */
    bool complete;
    qdot_vec(qdot_equilibrium_gap) gap;
    bool families; /* some equilibria are infinite families, of which only one member is listed */
} qdot_equilibrium_set;

/* Fill a set that is {0}; call _end in any case. If nothing can be found the set is empty and incomplete. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_set_begin(qdot_equilibrium_set *set, qdot_equilibrium_curve *c,
                                                       double least, double most);
void qdot_equilibrium_set_end(qdot_equilibrium_set *set);

/* Walls where a curve of equilibria turns, as far as exclusion finds them: so that one that closes within the range is
 * met between two of them. (equilibrium-folds.c) */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_set_add_folds(qdot_equilibrium_set *set);
/* Sort the walls (special values of p), each once. */
void qdot_equilibrium_set_sort_walls(qdot_equilibrium_set *set);

/* Member k at y[n] = p: y [n + 1], NaN where there is no value; *exists: all conditions hold there, and it has
 * values. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_set_place(const qdot_equilibrium_set *set, size_t k, double *y,
                                                       bool *exists);
/* Add values of p at which the stability of member k may change. If not all can be found it becomes undecided. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_set_add_verdicts(qdot_equilibrium_set *set, size_t k);
/* Find the stability of member k at p. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_set_judge(qdot_equilibrium_set *set, size_t k, double p,
                                                       qdot_stability *verdict);

#endif
