/* equilibrium-search.h -- data and steps of the search for equilibria. Internal to mech/. */
#ifndef QDOT_MECH_EQUILIBRIUM_SEARCH_H
#define QDOT_MECH_EQUILIBRIUM_SEARCH_H

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/walk.h"
#include "mech/scene/things.h"
#include "mech/linear/rest.h"
#include "normal/solve/assumptions.h"
#include "normal/solve/simultaneous.h"

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_assumptions assumed; /* assumptions on coordinates and parameters, from which `facts` borrows */
    qdot_simultaneous system; /* equations at rest; unknowns: coordinates, multipliers, then sides of jumps */
    qdot_expr forces; /* a LIST: generalized force on each coordinate at rest, with multipliers */
    qdot_expr friction; /* a LIST of unknowns in [-1, 1] that replace signs of velocities; nil: no friction */
    qdot_expr slips;     /* a LIST of the velocities u whose signs `friction` replaces */
    qdot_expr energy;    /* the Lagrangian L at rest */
    qdot_expr sliding; /* conditions under which the friction forces hold and do not drive the motion */
    size_t searched; /* number of unknowns of the numerical search: all except sides of jumps */
    qdot_vec(qdot_equilibrium) found;
    qdot_binder bind; /* gives values of parameters for a numerical search; may be NULL */
    void *user;
    qdot_expr meeting; /* a LIST of (expression, place): two kinks of a coordinate coincide where it is 0; nil: none */
    bool formulas;   /* formulas give all equilibria, for all parameter values */
    bool unresolved; /* kinks were left unsearched: the list may be incomplete */
} qdot_rest;

/* The equations at rest and their unknowns; ended in any case. Then all places of rest, to r->found, not
 * judged; *out: what is known of a search in numbers. (equilibrium.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_begin(qdot_rest *r, qdot_scene *s);
QDOT_MUST_CHECK qdot_status qdot_rest_find(qdot_rest *r, qdot_binder bind, void *user,
                                           qdot_equilibria *out);
/* The places that formulas give alone; r->system.complete: these are all. (equilibrium.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_find_exactly(qdot_rest *r);
void qdot_rest_end(qdot_rest *r);

/* Whether the equations of motion too are the same after that shift of u: then all members of a family are alike.
 * (equilibrium-members.c) */
bool qdot_rest_moves_alike(void *scene, qdot_expr u, qdot_expr period);

/* Solve all branches that are left to do, to r->found; r->system.complete: these are all.
 * (equilibrium-members.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_solve(qdot_rest *r);

/* The equations at rest, simplified, those that hold identically left out: a LIST.
 * (equilibrium-equations.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_equations(qdot_rest *r, qdot_expr *list);
/* In the n forces G a symbol in -1 ... 1 for each sign of a velocity, where it holds: to r->friction.
 * (equilibrium-corners.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_sides(qdot_rest *r, size_t n, qdot_expr *G);
/* Find an expression *u at whose zeros the forces at rest jump; nil if there is none.
 * (equilibrium-corners.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_corner(qdot_rest *r, qdot_expr *u);
/* In equilibrium-corners.c: whether forces jump at an equilibrium, which is given as a LIST of equations u = value. */
QDOT_MUST_CHECK qdot_status qdot_rest_is_corner(qdot_rest *r, qdot_expr place, bool *yes);
/* Add branches of the search for points at which forces jump. (equilibrium-corners.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_corners(qdot_rest *r, qdot_expr equations);

typedef enum {
    QDOT_HELD_UNKNOWN,
    QDOT_HELD,    /* the force beside the kink, on either side, does not push away from it */
    QDOT_NOT_HELD /* the force beside the kink pushes away on one side, and the force at the kink is not 0 */
} qdot_held;

/* In equilibrium-corners.c: decide whether the forces hold the only coordinate at its value in the LIST `values` when p =
 * value. */
QDOT_MUST_CHECK qdot_status qdot_rest_is_held(qdot_rest *r, qdot_expr values, qdot_expr p, qdot_expr value,
                                              const qdot_facts *facts, qdot_held *held);

/* The members of a LIST with jumps of coordinates written as signs, where that is possible: else r->unresolved.
 * (equilibrium-kinks.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_by_signs(qdot_rest *r, qdot_expr list, qdot_expr *out);
/* Whether one of the equations, a LIST by signs, may jump where u = 0: it is not proved that what stands beside sign u
 * vanishes there. (equilibrium-kinks.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_jumps(const qdot_rest *r, qdot_expr equations, qdot_expr u, bool *yes);
/* Sets r->unresolved where there is the tip of a cone, sqrt(x^2 + y^2), at which forces have no value.
 * (equilibrium-kinks.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_tips(qdot_rest *r);
/* The force with its jumps in velocity, as in if(x' > 0, ...) or x'/|x'|, written as signs.
 * (equilibrium-kinks.c) */
qdot_expr qdot_rest_slips_by_signs(qdot_rest *r, qdot_expr force);
/* Remove places at which the energy jumps, as sign(x) does at 0: forces do not tell what it does to a body there. Where
 * that is not known of a place it is marked. *jump: a function by which the energy jumps, with r->unresolved; nil: none.
 * (equilibrium-kinks.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_leave_out_jumps(qdot_rest *r, qdot_expr *jump);

/* Find equations without t that are equivalent to `equations` holding for all t. */
QDOT_MUST_CHECK qdot_status qdot_rest_at_all_times(qdot_rest *r, qdot_expr equations,
                                                   qdot_expr *list);

/* Remove places that belong to a listed family, or differ by full turns from one listed before.
 * (equilibrium-twice.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_leave_out_twice(qdot_rest *r);

/* After the places are judged: a condition a < b of parameters becomes a <= b where the place is a rest for a = b
 * too, and no other place is the same one there. Where that holds of some factors of b - a alone, these are added to
 * the LIST *special (nil: none). (equilibrium-ends.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_ends(qdot_rest *r, qdot_expr *special);
/* After that: a LIST of expressions that vanish where two kinks meet at a point of which it is not known whether it is
 * listed rightly; nil: none. Places that are none there get the condition that the expression is not 0. */
QDOT_MUST_CHECK qdot_status qdot_rest_meetings(qdot_rest *r, qdot_expr *left);

/* A LIST of what the places [n] divide by that may be 0 at some values of parameters; nil: none.
 * (equilibrium-special.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_special(const qdot_rest *r, size_t n, const qdot_equilibrium *places,
                                              qdot_expr *special);

/* Append those factors of e that may be 0 to the LIST; a factor sqrt(a) or |a| as a. (equilibrium-special.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_add_factors(qdot_pool *pool, qdot_expr e, qdot_expr *list);

/* Of a scene in which no place is found, to the LIST *special what of parameters alone is 0 where there may be one; where
 * that is not known r->system.complete becomes false. (equilibrium-special.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_none(qdot_rest *r, qdot_expr *special);

/* Whether the conditions, a LIST, cannot hold where d = 0: put in for the first symbol that d gives.
 * (equilibrium-special.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_is_excluded(const qdot_rest *r, qdot_expr exists, qdot_expr d, bool *yes);

/* The conditions under which the energy and the forces have values, as they are written: to r->system.domain.
 * (equilibrium-domain.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_domain(qdot_rest *r);
/* What is 0 at single values of parameters at which the energy or a force has no value: at no place, to *everywhere (nil:
 * there is no such value), or at one of the places found, to the LIST *special, which gets it if *everywhere has it not.
 * (equilibrium-domain.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_undefined(const qdot_rest *r, qdot_expr *everywhere, qdot_expr *special);

/* A coordinate whose open domain ends at a place that is singular in these coordinates alone (chart.h), where no rest is
 * looked for; NULL: none. (equilibrium-special.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_pole(const qdot_rest *r, const char **pole);
/* Rests at which every coordinate is 0, or half a turn of an angle, where that is proved.
 * (equilibrium-symmetric.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_symmetric(qdot_rest *r);
/* List each region of rests in one coordinate as intervals, where they can be found.
 * (equilibrium-ranges.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_ranges(qdot_rest *r);

/* --- numbers (equilibrium-numeric.c) ---- */
enum { QDOT_PLACES_MOST = 100 };

/* Equilibria that are proved to exist, found numerically: their coordinates at [n * unknowns]; owned. */
typedef struct {
    double *at;
    size_t n, starts;
    bool complete;   /* proved that these are all; then no start points were used */
    double reach;    /* start points lay within +-reach if no domain is declared */
    size_t unproved; /* number of start points that led to a zero within rounding errors that is not proved */
} qdot_places;

/* Zeros of r [unknowns] in the unknowns, every other symbol bound; rest->complete if these are
 * all. */
QDOT_MUST_CHECK qdot_status qdot_rest_search(qdot_rest *rest, const qdot_expr *r,
                                             qdot_places *out);
/* An end of the domain of the k-th unknown (0: the lower) with the values of parameters put in; nil: there is
 * none. */
qdot_expr qdot_rest_domain_end(const qdot_rest *rest, size_t k, int which);
/* The interval in which the k-th unknown is sought: its domain with parameter values inserted; one turn of an angle. */
qdot_window qdot_rest_window(const qdot_rest *rest, size_t k, qdot_expr equations);
/* Add to *out all equilibria that are found by excluding the rest of a box; out->complete: there are no others.
 * (equilibrium-proved.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_exclude(qdot_rest *rest, const qdot_expr *r,
                                              qdot_places *out);
/* Whether a proved zero at [n] is known to the digits in which places are listed, not merely enclosed.
 * (equilibrium-proved.c) */
bool qdot_rest_is_sharp(size_t n, const double *at, const double *radius);
/* Add to *out all equilibria on the branches that formulas left unsolved, each searched by exclusion for the unknowns
 * left on it; out->complete: with those that formulas gave these are all. (equilibrium-branches.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_search_branches(const qdot_rest *rest, qdot_places *out);
/* Those branches as equations, the values known and what is left of the equations at rest: a LIST of LISTs. Nil: equilibria
 * may be elsewhere, or an equation is long. (equilibrium-branches.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_unsolved(const qdot_rest *rest, qdot_expr *list);
/* Sort the places of n unknowns by the first one, then by the next ones. */
void qdot_places_sort(qdot_places *places, size_t n);
void qdot_places_clear(qdot_places *places);

#endif
