/* path.h -- points on curves F(y) = 0, y = (u, p): tangents and corrections.
 *
 * With the weights w of an inner product, t the unit tangent,
 *
 *     [ F'(y)   ]       [ 0 ]         F(y1) = 0,
 *     [ (w t0)^T ] t  =  [ 1 ],        (w t)^T (y1 - y) = s      (pseudo-arclength)
 *
 * The determinant of the first matrix, t in place of t0, changes its sign where two curves cross, and nowhere
 * else on a curve. Curves of equilibria (rest-path.h) and of periodic orbits (orbit-path.h) are such.
 *
 * Source  H. B. Keller, in Applications of Bifurcation Theory (1977), 359; Allgower & Georg,
 *         Introduction to Numerical Continuation Methods (2003), 2 and 8.
 * Tests   tests/sim/branches/test_continuation.c, test_orbits.c
 */
#ifndef QDOT_SIM_PATH_H
#define QDOT_SIM_PATH_H

#include "mech/study/stability.h"
#include "num/lu.h"

enum { QDOT_PATH_REASON = 160 };

/* A point of a curve, with the tangent in the direction in which the curve is followed. */
typedef struct {
    double *y, *t;     /* [width], [n + 1] in one block, owned */
    double det;        /* the determinant of F' bordered by the tangent of the point before */
    long growing;      /* the number of directions in which neighbouring motions depart; -1: unknown */
    int flip;          /* of orbits: its sign changes where a multiplier passes -1; 0: unknown */
    bool rests;        /* of orbits: it is as small as a place at rest; nothing lies behind it; */
    double phase, growth; /* of orbits: the sum of the angles of multipliers, of the logarithms of those that grow */
    bool blurred;      /* what is judged drowns in errors: it is no point */
    qdot_stability stability;
} qdot_path_point;

typedef struct qdot_path qdot_path;
struct qdot_path {
    size_t n, coordinates;   /* unknowns; those that are told come first */
    size_t width;            /* n + 1, and what is told beside u and p at each point */
    const bool *angle;       /* [n] a full turn changes nothing; borrowed, as all that describes F */
    const double *lo, *hi;   /* [n] domains of the unknowns */
    double (*end)(const qdot_path *x, size_t i, bool upper, double p); /* one that moves with p; NULL: none does */
    double least, most;      /* of p */
    double *weight;          /* [n + 1] */
    double exact;            /* Newton corrections smaller than this are rounding errors */
    double most_det;         /* the largest determinant so far */
    double gauge;            /* what the determinant is divided by, as `at` found it */
    double shortest, longest; /* steps along the curve */
    double upright;          /* below this, the component along p of a unit direction is rounding */
    bool dips;               /* test functions are accurate: their dips tell of pairs (dips.h) */
    int least_jump;          /* of `growing`, which says that an oscillation begins */
    int halvings;            /* of the way to a bifurcation, before it is located */
    /* for orbits of doubled period: index in y of the state after half a period; 0 for other orbits */
    size_t half;
    /* Compute F [n], F' [n * (n + 1)] at y; not finite if undefined. Serious failures go to x->failure. */
    void (*at)(qdot_path *x, const double *y);
    /* Judge the point: set a->stability, growing, flip, and the entries of y after the first n + 1. */
    qdot_status (*judge)(qdot_path *x, qdot_path_point *a);
    double *F, *J;
    double *A, *b;           /* [(n + 1)^2], [n + 1] room */
    qdot_lu_row *rows;
    char reason[QDOT_PATH_REASON]; /* why F had no value, the latest time; "": none is known */
    qdot_status failure;     /* of the latest evaluation: not QDOT_OK ends the search */
};

/* Allocate room for n unknowns. From {0}; ended in any case. The rest is filled by the caller. */
QDOT_MUST_CHECK qdot_status qdot_path_begin(qdot_path *x, size_t n);
void qdot_path_end(qdot_path *x);
/* Set the weights of y: 1 / range of p, 1 / size [n] of the unknowns; hidden unknowns get small weights. */
void qdot_path_scale(qdot_path *x, const double *size);

QDOT_MUST_CHECK qdot_status qdot_path_point_begin(const qdot_path *x, qdot_path_point *a);
void qdot_path_point_end(qdot_path_point *a);
void qdot_path_point_copy(const qdot_path *x, const qdot_path_point *from, qdot_path_point *to);

/* The lower or upper end of the domain of unknown i at p, NaN if the domain is empty; whether all
 * unknowns of y lie in their domains. */
double qdot_path_end_of(const qdot_path *x, size_t i, bool upper, double p);
bool qdot_path_is_inside(const qdot_path *x, const double *y);

/* The scaled inner product of a and b; the scaled distance of two points, with angles modulo full turns. */
double qdot_path_product(const qdot_path *x, const double *a, const double *b);
double qdot_path_distance(const qdot_path *x, const double *a, const double *b);

/* Of orbits of twice a period, d the state after half of it less the first: d(a).d(b), 0 where one has half the
 * period. */
double qdot_path_halves(const qdot_path *x, const double *a, const double *b);

/* Solve F(y) = 0 and g.(y - y0) = 0 by Newton's method from the guess y = y0; *steps taken; false:
 * no zero nearby. */
bool qdot_path_solve(qdot_path *x, const double *g, double *y, int *steps);
/* Solve F(y) = 0 from the guess y with y_i held. */
bool qdot_path_hold(qdot_path *x, size_t i, double *y);
/* Compute the tangent a->t and a->sign at a->y, oriented along `along`; false if there is no tangent. */
bool qdot_path_tangent(qdot_path *x, const double *along, qdot_path_point *a);
/* Find the point at arclength s from a, predicted along a->t, with its tangent; false if there is none. */
bool qdot_path_go(qdot_path *x, const qdot_path_point *a, double s, qdot_path_point *to, int *steps);

#endif
