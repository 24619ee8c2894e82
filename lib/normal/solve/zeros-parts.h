/* zeros-parts.h -- the search for zeros in one box. Internal to zeros*.c. */
#ifndef QDOT_NORMAL_ZEROS_PARTS_H
#define QDOT_NORMAL_ZEROS_PARTS_H

#include "base/memory.h"
#include "normal/refute/enclosure.h"
#include "normal/solve/isolate.h"
#include "normal/solve/zeros.h"

enum { QDOT_ZEROS_DOUBTS = 4000 }; /* largest number of undecided boxes, beyond which the search ends */

/* A zero that was proved to exist in one system of equations. */
typedef struct {
    double at[QDOT_ZEROS_MOST_UNKNOWNS], radius[QDOT_ZEROS_MOST_UNKNOWNS];
    qdot_interval
        alone[QDOT_ZEROS_MOST_UNKNOWNS]; /* [n] box in which this is the only zero of its system */
    bool simple;
} qdot_zero_place;

typedef struct {
    qdot_interval at[QDOT_ZEROS_MOST_UNKNOWNS];
} qdot_zero_box;

/* A system of equations f = 0 with the zeros found so far. */
typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *f, *x; /* [n] the equations' left sides and the unknowns; borrowed */
    qdot_enclosure *bounds; /* enclosures of f over boxes */
    qdot_enclosure
        *also; /* `others` further expressions that must have a zero there, too; NULL: none */
    size_t others;
    qdot_enclosure **held; /* [ranges] regions of zeros, where all expressions of one enclosure are positive; borrowed */
    size_t ranges;
    double least; /* a box with sides below this width is not halved */
    qdot_isolate isolate;
    uint64_t evaluations, budget;
    qdot_vec(qdot_zero_box) todo, small, doubt; /* boxes to be searched; small ones for later; undecided ones */
    bool late;                                  /* the boxes `small` are being searched */
    size_t next; /* with one unknown: index of the next box in `todo` */
    qdot_vec(qdot_zero_place) found;
    bool exhausted;
} qdot_zeros_system;

QDOT_MUST_CHECK qdot_status qdot_zeros_system_begin(qdot_zeros_system *s, qdot_pool *pool,
                                                    size_t n, const qdot_expr *f,
                                                    const qdot_expr *x);
void qdot_zeros_system_end(qdot_zeros_system *s); /* to be called in any case */

/* Search the boxes of s->todo; zeros go to s->found, undecided boxes to s->doubt. (zeros-box.c) */
QDOT_MUST_CHECK qdot_status qdot_zeros_search(qdot_zeros_system *s);

/* Find a zero by Newton's method from x0 [n], and prove it; false if that fails. */
bool qdot_zeros_prove(qdot_zeros_system *s, const double *x0, qdot_zero_place *place);

/* Whether the Jacobian [n x n] is regular on the whole box, judged by the enclosures of the latest evaluation. */
bool qdot_zeros_is_regular(const qdot_enclosure *bounds, size_t n);

/* Merge boxes of s->doubt that touch each other. */
void qdot_zeros_join(qdot_zeros_system *s);

/* One unknown: decide boxes of s->doubt by derivatives at exact candidates, then with more bits.
 * ends: LIST of exact candidates. (zeros-multiple.c) */
QDOT_MUST_CHECK qdot_status qdot_zeros_decide_doubts(qdot_zeros_system *s,
                                                     qdot_expr ends);

/* --- exact candidates (zeros-exact.c) ---- */
/* The k-th exact number that may be meant by a value within X: the simplest fraction, the simplest part
 * of pi; nil: there is none. */
qdot_expr qdot_zeros_candidate(qdot_pool *pool, qdot_interval X, int k);
/* Whether all functions f [m] are proved to be 0 at x = value [n]. */
QDOT_MUST_CHECK qdot_status qdot_zeros_vanish(qdot_pool *pool, size_t m,
                                              const qdot_expr *f, size_t n,
                                              const qdot_expr *x, const qdot_expr *value,
                                              bool *yes);

/* One unknown: *R such that f(sign x) has no zeros for x >= R, proved by the growth of its terms; infinity where that
 * does not tell. Errors: QDOT_ENOMEM, QDOT_EINTR, the pool's. (zeros-far.c) */
QDOT_MUST_CHECK qdot_status qdot_zeros_far(qdot_pool *pool, qdot_expr f, qdot_expr x,
                                           int sign, double *R);

/* --- systems (zeros-systems.c) ---- */
/* Find those factors of f's numerator that may be 0, as a LIST; only f itself if it does not factor. */
QDOT_MUST_CHECK qdot_status qdot_zeros_factors(qdot_pool *pool, qdot_expr f, size_t n,
                                               const qdot_expr *x, qdot_expr *list);

/* A chart: new variables that cover what lies beyond |x| = R, or the neighbourhood of a point. */
typedef struct {
    size_t n;
    int8_t sign
        [QDOT_ZEROS_MOST_UNKNOWNS]; /* x_j = sign/s if x_j is the largest of its group; 0: it is not */
    int8_t inverse
        [QDOT_ZEROS_MOST_UNKNOWNS]; /* x_i = y_i/s, where s belongs to unknown inverse[i]; -1: x_i is not transformed */
    bool near; /* chart near a point: x_j = centre_j + sign s, x_i = centre_i + s y_i */
    qdot_expr centre[QDOT_ZEROS_MOST_UNKNOWNS];
    qdot_expr y[QDOT_ZEROS_MOST_UNKNOWNS]; /* [n] unknowns of the chart */
    qdot_zero_box box;
} qdot_zeros_chart;

/* Make the k-th chart; k = 0: the box within R. lo, hi [n]: bounds of the ranges. *out->n = 0:
 * there is no k-th. */
void qdot_zeros_chart_at(qdot_pool *pool, size_t n, const qdot_expr *x,
                         const qdot_zeros_range *range, const qdot_interval *bounds,
                         size_t k, qdot_zeros_chart *out);
/* Make the k-th chart, k < 2 n, of the neighbourhood of size `reach` of a point. */
void qdot_zeros_chart_near(qdot_pool *pool, size_t n, const qdot_expr *centre,
                           double reach, size_t k, qdot_zeros_chart *out);
/* Write the functions f [n] in the unknowns of the chart, into the second array [n]. */
QDOT_MUST_CHECK qdot_status qdot_zeros_chart_put(qdot_pool *pool, const qdot_expr *x,
                                                 const qdot_zeros_chart *chart,
                                                 const qdot_expr *f, qdot_expr *to);
/* Write f [n] in the chart without powers of s and factors that never vanish; *empty: one of them
 * never vanishes. */
QDOT_MUST_CHECK qdot_status qdot_zeros_chart_clear(qdot_pool *pool,
                                                   const qdot_zeros_chart *chart,
                                                   qdot_expr *f, bool *empty);
/* Convert a point y in the unknowns of the chart to x. */
void qdot_zeros_chart_place(const qdot_zeros_chart *chart, const double *y, double *x);
/* Whether f oscillates or jumps at arbitrarily large values of an unbounded unknown. */
bool qdot_zeros_is_wild(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *x,
                        const qdot_zeros_range *range);

#endif
