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

/* A point of a curve, with its tangent in the direction in which the curve is followed. */
typedef struct {
    double *y, *t;     /* point [width] and tangent [n + 1], in one block, owned */
    double det;        /* determinant of F' extended by the tangent at the previous point as its last row */
    int64_t growing;      /* dimension of the unstable directions; -1: unknown */
    int flip;          /* orbits: a number whose sign changes where a multiplier passes -1; 0: unknown */
    bool rests;        /* orbits: the orbit has shrunk to an equilibrium, where the curve ends */
    double phase, growth; /* orbits: sum of the angles of multipliers; sum of the logarithms of growing ones */
    bool blurred;      /* errors are too large to judge the point's stability: it is not used */
    qdot_stability stability;
} qdot_path_point;

typedef struct qdot_path qdot_path;
struct qdot_path {
    size_t n, coordinates; /* number of unknowns; how many of them, from the first on, are reported as coordinates */
    size_t width;            /* numbers stored at each point: n + 1 (unknowns, parameter), then further reported quantities */
    const bool *angle;       /* [n] whether unknown i is an angle with period 2 pi; borrowed, like all that describes F */
    const double *lo, *hi;   /* [n] bounds of the unknowns */
    /* bound of unknown i if it depends on p; NULL: no bound depends on p */
    double (*end)(const qdot_path *x, size_t i, bool upper, double p);
    double least, most;      /* range of the parameter p */
    double *weight;          /* [n + 1] weights of the unknowns and p in lengths along the curve */
    double exact;            /* Newton corrections smaller than this are rounding errors */
    double most_det;         /* largest magnitude of the determinant so far */
    double gauge;            /* scale factor divided out of the determinant by `at` */
    double shortest, longest; /* shortest and longest step along the curve */
    double upright;          /* p-components of unit directions smaller than this are rounding */
    bool dips; /* test functions are accurate enough to detect pairs of zeros by dips (dips.h) */
    int least_jump;          /* smallest change of `growing` that means the onset of an oscillation */
    int halvings;            /* number of bisections that narrow a bifurcation before it is located */
    /* for orbits of doubled period: index in y of the state after half a period; 0 for other orbits */
    size_t half;
    /* Compute F [n] and F' [n * (n + 1)] at y; not finite where undefined. Serious failures: x->failure. */
    void (*at)(qdot_path *x, const double *y);
    /* Judge a point: set a->stability, growing, flip, and the entries of a->y after the first n + 1. */
    qdot_status (*judge)(qdot_path *x, qdot_path_point *a);
    double *F, *J;
    double *A, *b;           /* scratch: [(n + 1)^2], [n + 1] */
    qdot_lu_row *rows;
    char reason[QDOT_PATH_REASON]; /* why F was undefined the last time; "": unknown */
    qdot_status failure; /* failure of the latest evaluation; unless QDOT_OK it ends the search */
};

/* Allocate a path with n unknowns; start from {0}; must be ended in any case. The caller fills the rest. */
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

/* The scaled inner product of a and b; the scaled distance of points, angles taken modulo full turns. */
double qdot_path_product(const qdot_path *x, const double *a, const double *b);
double qdot_path_distance(const qdot_path *x, const double *a, const double *b);

/* Of orbits of twice a period, d the state after half of it less the first: d(a).d(b), 0 where one has half the
 * period. */
double qdot_path_halves(const qdot_path *x, const double *a, const double *b);

/* Solve F(y) = 0 and g.(y - y0) = 0 by Newton's method from the guess y = y0; *steps taken; false:
 * no zero nearby. */
bool qdot_path_solve(qdot_path *x, const double *g, double *y, int *steps);
/* Solve F(y) = 0 from the guess y, keeping component y_i fixed. */
bool qdot_path_hold(qdot_path *x, size_t i, double *y);
/* Compute the tangent a->t and a->det at a->y, oriented along the vector `along`; false if there is no tangent. */
bool qdot_path_tangent(qdot_path *x, const double *along, qdot_path_point *a);
/* Find the point at arclength s from a, predicted along a->t, with its tangent; false if there is none. */
bool qdot_path_go(qdot_path *x, const qdot_path_point *a, double s, qdot_path_point *to, int *steps);

#endif
