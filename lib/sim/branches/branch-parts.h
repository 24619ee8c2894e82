/* branch-parts.h -- branches, their bifurcations, and the state of the search for them. */
#ifndef QDOT_SIM_BRANCH_PARTS_H
#define QDOT_SIM_BRANCH_PARTS_H

#include "sim/branches/bifurcation.h"

typedef enum {
    QDOT_END_RANGE,   /* the end of the range of the parameter */
    QDOT_END_DOMAIN,  /* the end of the domain of a coordinate */
    QDOT_END_CLOSED,  /* it came back to where it began */
    QDOT_END_FAR,     /* the branch goes to infinity */
    QDOT_END_REST,    /* an orbit shrinks to an equilibrium */
    QDOT_END_HALF,    /* an orbit becomes one of half its period */
    QDOT_END_PERIOD,  /* the period of an orbit grows to infinity */
    QDOT_END_LOST,    /* nothing is found further on: the equations have no value there, jump, or have a kink */
    QDOT_END_BLURRED, /* errors are too large to decide on stability and bifurcations */
    QDOT_END_NO_REST, /* known exactly: these equilibria do not exist further on */
    QDOT_END_STOPPED  /* interrupted, or too many points */
} qdot_branch_end;

typedef struct {
    size_t n, room;
    double *y;                 /* [n * width] */
    qdot_stability *stability; /* [n] */
    size_t *mark;              /* [n] 1 + the bifurcation that the point is; 0: none */
    qdot_branch_end end[2];    /* before its first point, behind its last */
    char reason[2][QDOT_PATH_REASON]; /* of an end that is lost: why there was no value; "": there was one */
} qdot_branch;

typedef struct {
    size_t n, coordinates; /* of the unknowns: those that are told, then others */
    size_t width;          /* n + 1, and what is told beside them at each point */
    double *size;          /* [width] of each; of p its range */
    qdot_vec(qdot_branch) branches;
    qdot_vec(qdot_bifurcation) bifurcations;
    qdot_vec(double) left; /* places [n + 1] from which no curve is followed: they have no single direction */
    bool conserved; /* of orbits: the energy is conserved */
    bool complete;  /* of equilibria, proved: there are no other branches, but for such at single values of p */
    bool families;  /* of equilibria: of those that recur without end one is followed */
    qdot_expr undefined; /* of equilibria: a LIST of what is 0 at single p without an energy or a force; nil: none */
    bool corners;   /* of equilibria: where forces jump there may be others */
    bool interrupted;
} qdot_continuation;

/* A crossing whose second curve has still to be followed. */
typedef struct {
    size_t at;     /* the bifurcation */
    double *other; /* [n + 1] the direction of the other branch, owned */
} qdot_branch_crossing;

/* Two crossings that lie close together. */
typedef struct {
    size_t a, b; /* the bifurcations */
    double gap;
} qdot_branch_pair;

typedef struct {
    qdot_path *x;
    qdot_bifurcation_finder *find;
    void *user; /* of `find` */
    qdot_continuation *all;
    qdot_vec(qdot_branch_crossing) crossings;
    qdot_vec(qdot_branch_pair) pairs; /* of crossings */
    bool leapt; /* the latest step went over to another curve, which does not cross this one, or over two
                   bifurcations: it is made again, shorter */
    size_t most_points; /* of a branch; 0: as many as any may have */
    qdot_branch_end over; /* the latest step led to that end of the branch; QDOT_END_STOPPED: it goes on */
} qdot_branch_search;

#endif
