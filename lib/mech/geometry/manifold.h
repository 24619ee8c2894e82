/* manifold.h -- a metric with what follows from it, each part found once when it is asked for. Internal to this room.
 *
 * Tests  tests/mech/geometry/test_geometry.c
 */
#ifndef QDOT_MECH_MANIFOLD_H
#define QDOT_MECH_MANIFOLD_H

#include "mech/scene/things.h"

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_expr R, det; /* the place or line element; the determinant of g */
    uint32_t n;
    bool diagonal;      /* whether g is */
    qdot_expr *q;       /* [n] coordinates */
    qdot_expr *g;       /* [n*n] metric g_ij */
    qdot_expr *inverse; /* [n*n] inverse metric g^ij */
    qdot_expr *gamma;   /* [n*n*n] Christoffel symbols; nil until requested */
    qdot_expr *ricci;   /* [n*n] R_ij; nil until requested */
    qdot_expr scalar;   /* R = g^ij R_ij; nil until requested */
    uint32_t pairs;     /* n (n - 1)/2 pairs of indices i < j */
    qdot_expr *riemann; /* [pairs*pairs] R_ijkl, all indices down, i < j, k < l; nil until requested; NULL: none yet */
} qdot_manifold;

/* Find the metric of R and its inverse; false: the pool keeps the failure, else end it. */
bool qdot_manifold_begin(qdot_manifold *m, qdot_scene *s, qdot_expr R);
void qdot_manifold_end(qdot_manifold *m);
/* The expression e simplified with the facts of the scene. */
qdot_expr qdot_manifold_tidy(const qdot_manifold *m, qdot_expr e);

qdot_expr qdot_manifold_christoffel(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k); /* G^i_jk */
qdot_expr qdot_manifold_riemann(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l); /* R_ijkl */

/* The MAT whose entry in row i and column j is f(m, prefix, i, j). */
qdot_expr qdot_manifold_matrix(qdot_manifold *m, const uint32_t *prefix,
                               qdot_expr (*f)(qdot_manifold *m, const uint32_t *prefix, uint32_t row, uint32_t column));
/* The LIST with the members f(m, prefix, i), i = 1 ... n. */
qdot_expr qdot_manifold_list(qdot_manifold *m, const uint32_t *prefix,
                             qdot_expr (*f)(qdot_manifold *m, const uint32_t *prefix, uint32_t i));

#endif
