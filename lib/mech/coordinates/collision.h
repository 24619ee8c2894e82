/* collision.h -- a scene in which a collision of two points is regular (Levi-Civita,
 * Kustaanheimo-Stiefel).
 *
 * Let x be the vector from one point to the other, of d = 1, 2 or 3 components, R = |x|, and
 *
 *     x'' = -k x/R^3 + P,   k > 0,   h = x'.x'/2 - k/R,
 *
 * P smooth at R = 0. With x = L(u) u, where L L^T = R 1 and R = |u|^2 (u of 1, 2 or 4 components),
 * and a variable s with dt = R ds, ' now d/ds:
 *
 *     u'' = h/2 u + 1/2 L^T R P       h' = 2 (L u').P       t' = R        dx/dt = 2 L u'/R
 *
 * is smooth at R = 0: h is a variable of its own, and the motion passes u = 0 at |u'|^2 = k/2, so that
 * x comes back along the line on which it came. Every other coordinate q, in the form
 * Q = q + c.x/k in which it does not feel the collision, has its rate in t as the rate in s of a
 * companion w: w' = dQ/dt,
 *
 *     w'' = R d2Q/dt2                 Q'' = R' w' + R w''
 *
 * Sources  T. Levi-Civita, Acta Math. 42 (1920) 99; P. Kustaanheimo, E. Stiefel, J. reine angew.
 *          Math. 218 (1965) 204; E. Stiefel, G. Scheifele, Linear and Regular Celestial Mechanics
 *          (1971)
 * Tests    tests/mech/coordinates/test_collision.c, tests/script/mechanisms/collisions.lag
 */
#ifndef QDOT_MECH_COLLISION_H
#define QDOT_MECH_COLLISION_H

#include "base/text.h"
#include "mech/scene/things.h"

enum { QDOT_COLLISION_MOST = 3 };

/* A pair of points: its difference x [d] in coordinates; component i contains q[pivot] with the
 * coefficient 1. */
typedef struct {
    size_t d;
    qdot_expr x[QDOT_COLLISION_MOST];
    size_t pivot[QDOT_COLLISION_MOST];
    /* for d > 1: R^2 = square/scale, where `square` is the expression under a root in the scene */
    qdot_expr square, scale;
    qdot_expr distance;      /* distance R of the two points */
} qdot_collision_pair;

typedef qdot_vec(qdot_collision_pair) qdot_collision_pairs;

/* The equations of a scene in which all parameters have numbers. */
typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *q, *accels; /* [n] coordinates; accelerations q'' (not needed to find pairs) */
    qdot_expr energy;            /* the conserved energy; nil: energy is not conserved */
} qdot_collision_equations;

/* Whether e is divided by an expression that contains coordinates, or contains the absolute value of one. */
bool qdot_collision_may(const qdot_collision_equations *of, qdot_expr e);

/* All pairs by whose distance one of the expressions [m], potentials or forces, is divided. `pairs`
 * starts from {0}; free its `at`. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_collision_find(const qdot_collision_equations *of,
                                                size_t m, const qdot_expr *exprs,
                                                qdot_collision_pairs *pairs);

typedef struct {
    qdot_pool *pool;
    qdot_scene *scene; /* the scene in new coordinates and time s, owned; NULL: not regular, see `hindrance` */
    size_t parts;      /* of u, its first coordinates; then come t, the integral of h, and Q and w of
                          each coordinate that stays */
    qdot_expr time;    /* the coordinate of `scene` that is the time t */
    qdot_expr strength; /* strength k of the force k x/R^3 between the points; 0: no force is as 1/R^2 */
    char hindrance[200];
    qdot_collision_pair pair;
    qdot_expr R; /* a symbol for the distance R, used while the scene is made */
    qdot_expr energy; /* energy in new coordinates, without division by R; nil: none */
    qdot_vec(qdot_expr) q0, v0; /* start values of the new coordinates and rates, in the given q, q', t */
    qdot_vec(qdot_expr) from, to; /* replacements: each of q, q', q'', t, R (from) by its value in new coordinates (to) */
} qdot_collision;

/* The scene in which the collision of `pair` is regular; events of s are copied. sign: that of x[0]
 * at the start. `c` starts from {0}; clear it in any case. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_collision_make(qdot_scene *s,
                                                const qdot_collision_equations *of,
                                                const qdot_collision_pair *pair, int sign,
                                                qdot_collision *c);
void qdot_collision_clear(qdot_collision *c);

/* An expression of the given scene, written in the coordinates of c->scene. Nil: the pool keeps the failure. */
qdot_expr qdot_collision_express(const qdot_collision *c, qdot_expr e);

/* For the files of collisions: replace powers of pair->square by powers of the distance R. */
qdot_expr qdot_collision_put_distance(qdot_pool *pool, qdot_expr e,
                                      const qdot_collision_pair *pair, qdot_expr R);

#endif
