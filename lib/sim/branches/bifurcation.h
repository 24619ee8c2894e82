/* bifurcation.h -- points at which curves turn, cross, or lose their stability, and how they are asked for.
 *
 * At a crossing with null vectors v1, v2 of F_y, psi of F_y^T, the directions alpha v1 + beta v2 of the two
 * curves solve
 *
 *     c11 alpha^2 + 2 c12 alpha beta + c22 beta^2 = 0,   c_ij = v_i.(psi.F)_yy v_j.
 *
 * It is a pitchfork if one of them has no part along p, else transcritical.
 *
 * Source  Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), 5.
 * Tests   tests/sim/branches/test_continuation.c, test_orbits.c
 */
#ifndef QDOT_SIM_BIFURCATION_H
#define QDOT_SIM_BIFURCATION_H

#include "sim/branches/path.h"

typedef enum {
    QDOT_FOLD,
    QDOT_PITCHFORK,
    QDOT_TRANSCRITICAL,
    QDOT_HOPF,
    QDOT_COLLISION,   /* two frequencies become equal */
    QDOT_DOUBLING,    /* period doubling of an orbit: a multiplier passes -1 */
    QDOT_HALVING,     /* period halving: an orbit of twice the period ends at an orbit of the single period */
    QDOT_TORUS,       /* orbit: a pair of multipliers crosses the unit circle */
    QDOT_KREIN,       /* orbit: two pairs of multipliers meet on the unit circle and leave it */
    QDOT_NOT_SIMPLE /* another bifurcation: located between two points, its branches not followed */
} qdot_bifurcation_kind;

/* "fold", "pitchfork", "transcritical", "hopf", "hamiltonian hopf", "period doubling", "period doubling",
 * "torus", "krein collision", "degenerate". */
const char *qdot_bifurcation_name(qdot_bifurcation_kind kind);

typedef struct {
    qdot_bifurcation_kind kind;
    double *y, *error;                 /* [width] place of the bifurcation and its error, in one block, owned */
    double frequency, frequency_error; /* Hopf: angular frequency; torus: angle of the multipliers */
    bool reached; /* period doubling: a branch of twice the period begins or ends there */
    char reason[QDOT_PATH_REASON]; /* why no branch of doubled period was followed; "": one was, or none was sought */
} qdot_bifurcation;

/* The bracket of a bifurcation: it lies between arclengths `from` and `to` from the point a, along
 * its tangent a->t. */
typedef struct {
    const qdot_path_point *a;
    double from, to;
    bool changes; /* the test function has clearly different signs at both ends */
    bool stays;   /* the test function has clearly the same sign at both ends */
    bool jumps;   /* the test function jumps: the two end points lie on different curves */
} qdot_bifurcation_bracket;

typedef enum {
    QDOT_BIFURCATION_NONE,  /* no regular bifurcation was found */
    QDOT_BIFURCATION_FOUND,
    QDOT_BIFURCATION_APART, /* two curves come close to each other without crossing */
    QDOT_BIFURCATION_REST   /* an orbit shrinks to an equilibrium at out->y, and comes back as its mirror image */
} qdot_bifurcation_answer;

/* Locate that of the kind out->kind, near out->y: out->y, out->error; PITCHFORK stands for any crossing, whose
 * kind and other curve's direction (`other` [n + 1]) are found, HOPF for an oscillation that begins. */
typedef qdot_status qdot_bifurcation_finder(void *user, const qdot_bifurcation_bracket *in,
                                            qdot_bifurcation *out, double *other,
                                            qdot_bifurcation_answer *answer);

/* The right singular vectors of the `count` least singular values of A [rows * columns], rows >= columns:
 * out [count * columns], the least first. */
QDOT_MUST_CHECK qdot_status qdot_null_vectors(size_t rows, size_t columns, const double *A,
                                              size_t count, double *out);
/* Which crossing it is, from c11, c12, c22 and v1, v2, and the direction of the curve that does not go along t;
 * parts along p below `upright` of a unit direction are none. v [4 (n + 1)]: v1, v2, room. False: it is no crossing
 * of two curves: c12^2 - c11 c22 is at most `least` of the sum of squares. */
bool qdot_bifurcation_cross(const qdot_path *x, const double *c, double *v, const double *t,
                            double upright, double least, qdot_bifurcation_kind *kind, double *other);

#endif
