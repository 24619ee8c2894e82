/* branch-parts.h -- branches, their bifurcations, and the state of the search for them. */
#ifndef QDOT_SIM_BRANCH_PARTS_H
#define QDOT_SIM_BRANCH_PARTS_H

#include "sim/branches/bifurcation.h"

typedef enum {
    QDOT_END_RANGE,   /* reached the end of the parameter's range */
    QDOT_END_DOMAIN,  /* reached the end of a coordinate's domain */
    QDOT_END_CLOSED,  /* the branch returned to its first point: a closed curve */
    QDOT_END_FAR,     /* the unknowns grow without bound */
    QDOT_END_REST,    /* an orbit shrinks to an equilibrium */
    QDOT_END_HALF,    /* the orbit becomes one of half its period */
    QDOT_END_PERIOD,  /* the orbit's period grows to infinity */
    QDOT_END_LOST,    /* no further point: the equations are undefined, jump or have a kink there */
    QDOT_END_BLURRED, /* errors are too large to judge stability and bifurcations */
    QDOT_END_NO_REST, /* known exactly: the equilibria do not exist beyond this parameter value */
    QDOT_END_STOPPED  /* interrupted, or the largest number of points was reached */
} qdot_branch_end;

typedef struct {
    size_t n, room;
    double *y;                 /* [n * width] points of the branch */
    qdot_stability *stability; /* [n] stability at each point */
    size_t *mark;              /* [n] 1 + index of the bifurcation at this point; 0: none */
    qdot_branch_end end[2];    /* how the branch ends: before its first point, after its last */
    char reason[2][QDOT_PATH_REASON]; /* for QDOT_END_LOST: why the equations had no value; "": unknown */
} qdot_branch;

typedef struct {
    size_t n, coordinates; /* number of unknowns; how many of them, from the first on, are reported as coordinates */
    size_t width;          /* numbers stored at each point: n + 1 (unknowns, parameter), then further reported quantities */
    double *size;          /* [width] typical size of each number stored at a point; for the parameter p its range */
    qdot_vec(qdot_branch) branches;
    qdot_vec(qdot_bifurcation) bifurcations;
    qdot_vec(double) left; /* [n + 1] start points not followed, as a curve starts there in no unique direction */
    bool conserved; /* orbits: energy is conserved */
    bool complete; /* equilibria: proved that there are no other branches, except at isolated parameter values p */
    bool families;  /* equilibria: of an infinite periodic family of equilibria, one is followed */
    qdot_expr undefined; /* equilibria: LIST of expressions, 0 at those p where energy or a force is undefined; nil: none */
    bool corners;   /* equilibria: there may be other equilibria where forces jump */
    bool interrupted;
} qdot_continuation;

/* A crossing whose second curve has still to be followed. */
typedef struct {
    size_t at;     /* index of the bifurcation at which the two curves cross */
    double *other; /* [n + 1] direction of the second curve, owned */
} qdot_branch_crossing;

/* Two crossings that lie close together. */
typedef struct {
    size_t a, b; /* indices of the two bifurcations */
    double gap;
} qdot_branch_pair;

typedef struct {
    qdot_path *x;
    qdot_bifurcation_finder *find;
    void *user; /* user pointer, the first argument of `find` */
    qdot_continuation *all;
    qdot_vec(qdot_branch_crossing) crossings;
    qdot_vec(qdot_branch_pair) pairs; /* pairs of crossings close to each other */
    bool leapt; /* the latest step went over to another curve, which does not cross this one, or over two
                   bifurcations: it is made again, shorter */
    size_t most_points; /* largest number of points on a branch; 0: the general limit */
    qdot_branch_end over; /* how the branch ended at the latest step; QDOT_END_STOPPED: it continues */
} qdot_branch_search;

#endif
