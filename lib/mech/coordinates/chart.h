/* chart.h -- a scene in other coordinates, regular where those given are singular.
 *
 * A group of coordinates is replaced where all positions and forces are smooth functions of the
 * new ones:
 *
 *     plane      r, phi          x = r cos phi, y = r sin phi
 *     space      r, theta, phi   x = r sin theta cos phi, y = r sin theta sin phi, z = r cos theta
 *     sphere     theta, phi      the same with r = 1, and x^2 + y^2 + z^2 = 1
 *     body       phi, theta, psi e_0 = cos(theta/2) cos((phi + psi)/2),
 *                                e_1 = sin(theta/2) cos((phi - psi)/2),
 *                                e_2 = sin(theta/2) sin((phi - psi)/2),
 *                                e_3 = cos(theta/2) sin((phi + psi)/2), and |e|^2 = 1
 *     parabolic  xi, eta         x = xi eta, y = (xi^2 - eta^2)/2
 *     elliptic   u, v            x = cosh u cos v, y = sinh u sin v
 *     these about an axis, phi   one of x, y is the distance from it
 *     root       none            w = sqrt(P(q)), and w^2 = P(q): the q stay
 *
 * What the coordinates given are made of, beside x, y, z (or e), are roots: of the first four groups
 * N, the distance from the singular place, N = (x^2 + y^2)^(1/2), or of a body |sin theta|, and a
 * sign s: r = s N, cos phi = s x/N, sin phi = s y/N, sin theta = s N. Of the others they are xi and
 * eta, or cosh u, sinh u, cos v, sin v, themselves. Products of two of them, and their squares, are
 * functions of the new coordinates; in a regular scene no root is left, and no angle outside sin and
 * cos. So (r, phi) and (-r, phi + pi), or (xi, eta) and (-xi, -eta), are one place. Of a root w it
 * is not the sign that is lost: where w < 0 the motion has left the places that sqrt(P) can write.
 *
 * xi, eta and u, v are read by an angle that no coordinate is: with rho = (x^2 + y^2)^(1/2),
 * alpha = atan2(x, y),
 *
 *     xi = (2 rho)^(1/2) cos(alpha/2),      eta = (2 rho)^(1/2) sin(alpha/2)
 *     sinh u = S^(1/2) cos(beta/2),         sin v = S^(1/2) sin(beta/2)
 *
 * where S = sinh^2 u + sin^2 v, S^2 = (x^2 + y^2 - 1)^2 + 4 y^2, beta = atan2(2 y, x^2 + y^2 - 1).
 * In the plane (u, v) and (-u, -v) are one place. In a domain u > 0, or xi > 0, or eta > 0, the angle
 * has no turns: where u would become negative, on the line between the foci, v jumps to -v.
 *
 * A body whose axes are R = Rz(phi) Rx(theta) Rz(psi) becomes masses at its centre and at the
 * columns c_j of R(e):
 *
 *     T = 1/2 sum_jk J_jk c_j' . c_k',   J = 1/2 tr(I) 1 - I
 *
 * which is 1/2 omega . I omega where |e| = 1.
 *
 * Tests  tests/mech/coordinates/test_chart.c
 */
#ifndef QDOT_MECH_CHART_H
#define QDOT_MECH_CHART_H

#include "base/text.h"
#include "mech/scene/things.h"

typedef enum {
    QDOT_CHART_PLANE,
    QDOT_CHART_SPACE,
    QDOT_CHART_SPHERE,
    QDOT_CHART_BODY,
    QDOT_CHART_PARABOLIC,
    QDOT_CHART_PARABOLOIDS, /* paraboloids about an axis; x is the distance from it */
    QDOT_CHART_ELLIPTIC,
    QDOT_CHART_PROLATE, /* prolate spheroidal, about an axis; y is the distance from it */
    QDOT_CHART_OBLATE,  /* oblate spheroidal, about an axis; x is the distance from it */
    QDOT_CHART_ROOT
} qdot_chart_kind;

/* A group of coordinates that can be replaced: its kind, and their indices in the order of the table at the top. */
typedef struct {
    qdot_chart_kind kind;
    size_t index[3];
    bool turned;        /* theta (or v) is shifted by a quarter turn, so that sin and cos are exchanged */
    qdot_expr square;   /* if the group contains a root w = sqrt(P): the expression P */
    qdot_expr distance; /* signed distance from the singular position, in the given coordinates */
} qdot_chart_group;

typedef qdot_vec(qdot_chart_group) qdot_chart_groups;

typedef enum {
    QDOT_CHART_LENGTH,
    QDOT_CHART_ANGLE,     /* an angle, known from its sine and cosine up to full turns */
    QDOT_CHART_HYPERBOLIC /* a quantity known from its cosh and sinh */
} qdot_chart_sort;

/* A coordinate of a group, or an auxiliary angle, in terms of new coordinates and roots. */
typedef struct {
    qdot_expr q; /* the coordinate; for an auxiliary angle a symbol of its own */
    qdot_chart_sort sort;
    qdot_expr value;        /* for a quantity that is not an angle: its value */
    qdot_expr cosine, sine; /* of an angle: cosine and sine; of a hyperbolic quantity: cosh and sinh */
    qdot_expr x, y;         /* the angle is atan2(y, x), up to full turns */
    qdot_expr factor;       /* y = factor sin(alpha/2) with the angle alpha of index `half`; nil: y is not of this form */
    size_t half;
    bool cut;        /* the angle differs from pi `middle` by no more than half a turn */
    int middle;
    qdot_expr bare;  /* a symbol for the angle where it occurs elsewhere than in sin and cos */
    qdot_expr rate; /* time derivative of the coordinate; nil: computed from value, or from x and y */
    qdot_expr given; /* its formula in the given coordinates */
    qdot_expr ends[2]; /* values at which its domain may end: singular positions; nil: none */
    size_t sign;       /* its formula contains the sign with index `sign` - 1; 0: it contains no sign */
    bool between;      /* its domain ends at singular places, so it makes no full turns */
} qdot_chart_moved;

/* A new coordinate, expressed in terms of the given ones. */
typedef struct {
    qdot_expr q, given;
} qdot_chart_fresh;

/* A root that occurs in formulas of a group: the distance N, xi, cosh u ... */
typedef struct {
    qdot_expr symbol, square;   /* the root's symbol; symbol^2 in new coordinates and other roots */
    qdot_expr partner, product; /* symbol * partner = product, where both are roots; nil: no partner */
    qdot_expr rate;             /* time derivative of the root; nil: computed from that of `square` */
    qdot_expr value;            /* the root in terms of other symbols; nil: the positive square root of `square` */
} qdot_chart_root;

/* What is 1 or -1 along the run: it changes where a singular place is passed exactly, if no domain
 * forbids that. Of a root w that is its sign. */
typedef struct {
    qdot_expr symbol; /* the symbol of the sign s, or of the root w */
    int start;
    bool branch; /* the sign is that of w, a square root of `square` */
    bool fixed;
    qdot_expr square;
    qdot_expr distance; /* the distance with its sign: s N */
} qdot_chart_sign;

typedef struct {
    qdot_pool *pool;
    qdot_scene *of;    /* the scene in the given coordinates, borrowed while the chart is made */
    qdot_scene *scene; /* the scene in new coordinates, owned; NULL: not regular, see `hindrance` */
    char hindrance[200];
    bool open;          /* forces may contain roots, and are then singular where a root is 0 */
    bool signed_events; /* events contain a sign s = +-1: none may change during the run */
    qdot_vec(qdot_chart_moved) moved;
    qdot_vec(qdot_chart_fresh) fresh;
    qdot_vec(qdot_chart_root) roots; /* roots in formulas; the value of a root contains only roots that follow it in the list */
    qdot_vec(qdot_chart_sign) signs;
    qdot_vec(qdot_expr) unit; /* expressions that `scene` constrains to be 0, such as x^2 + y^2 + z^2 - 1 on a sphere */
    qdot_text names; /* formulas of the new coordinates as text: "x = r*cos(phi), y = r*sin(phi)" */
} qdot_chart;

/* All groups of the scene that can be replaced one by one, no coordinate in two of them. open: those
 * of the plane and of space alone, where forces may be singular at N = 0. `groups` starts from {0};
 * free its `at`. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_chart_find(qdot_scene *s, bool open, qdot_chart_groups *groups);

/* The scene with these groups replaced. `sign` [n]: of each distance at the start, 1 or -1. The
 * chart starts from {0}; clear it in any case. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_chart_make(qdot_scene *s,
                                            const qdot_chart_groups *groups,
                                            const int *sign, bool open, qdot_chart *chart);
void qdot_chart_clear(qdot_chart *chart);

/* An expression of c->scene, in new coordinates, written in the given coordinates. */
qdot_expr qdot_chart_given(const qdot_chart *c, qdot_expr e);

/* An expression of the scene given in the new coordinates. An angle outside of sin and cos is
 * counted from so many quarter turns, of which it is within half a turn; quarters [moved], and
 * behind them the signs [signs]; NULL: no quarters, and the signs of the start. *turns (may be
 * NULL): whether it holds such an angle, or a sign. Nil: the pool keeps the failure. */
qdot_expr qdot_chart_express(const qdot_chart *chart, qdot_expr e, const int64_t *quarters,
                             bool *turns);

/* A root w contained in e (in new coordinates) that is negative there, judged by `quarters`; NULL: none. */
const qdot_chart_sign *qdot_chart_beyond(const qdot_chart *chart, qdot_expr e,
                                         const int64_t *quarters);

/* Inside (chart-formulas.c): how many coordinates a group has; what is 0 at its singular place, in
 * the coordinates given. */
size_t qdot_chart_size(qdot_chart_kind kind);
qdot_expr qdot_chart_distance(const qdot_scene *s, const qdot_chart_group *g);
/* Put the group into the chart: its new coordinates, what it is made of, its constraints. `sign`:
 * of its distance at the start. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_chart_add(qdot_chart *chart, const qdot_chart_group *g, int sign);

/* Inside: in new coordinates and roots, products of two roots by what they are, angles outside of sin and cos as
 * their symbols. */
qdot_expr qdot_chart_put(const qdot_chart *chart, qdot_expr e);
/* For the files of charts: the time derivative de/dt of e, which is in new coordinates and roots. */
qdot_expr qdot_chart_rate(const qdot_chart *chart, qdot_expr e);
/* For the files of charts: e without roots if e is regular; otherwise nil, which is no failure. */
qdot_expr qdot_chart_regular(const qdot_chart *chart, qdot_expr e);

#endif
