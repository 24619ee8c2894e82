/* chart.h -- a scene in other coordinates, regular where those given are singular.
 *
 * A group of coordinates is replaced where all positions and forces are smooth functions of the
 * new ones:
 *
 *     plane   r, phi           x = r cos phi, y = r sin phi
 *     space   r, theta, phi    x = r sin theta cos phi, y = r sin theta sin phi, z = r cos theta
 *     sphere  theta, phi       the same with r = 1, and x^2 + y^2 + z^2 = 1
 *     body    phi, theta, psi  e_0 = cos(theta/2) cos((phi + psi)/2),
 *                              e_1 = sin(theta/2) cos((phi - psi)/2),
 *                              e_2 = sin(theta/2) sin((phi - psi)/2),
 *                              e_3 = cos(theta/2) sin((phi + psi)/2), and |e|^2 = 1
 *
 * Let N be the distance from the singular place: (x^2 + y^2)^(1/2), or of a body
 * |sin theta|. The coordinates given are written in x, y, z (or e) and N: r = N, cos phi = x/N,
 * sin phi = y/N, sin theta = N. In a regular scene N is left in even powers alone, and no angle
 * outside sin and cos.
 *
 * A body whose axes are R = Rz(phi) Rx(theta) Rz(psi) becomes masses at its centre and at the
 * columns c_j of R(e):
 *
 *     T = 1/2 sum_jk J_jk c_j' . c_k',   J = 1/2 tr(I) 1 - I
 *
 * which is 1/2 omega . I omega where |e| = 1.
 *
 * Tests  tests/mech/test_chart.c
 */
#ifndef QDOT_MECH_CHART_H
#define QDOT_MECH_CHART_H

#include "base/text.h"
#include "mech/scene/things.h"

typedef enum {
    QDOT_CHART_PLANE,
    QDOT_CHART_SPACE,
    QDOT_CHART_SPHERE,
    QDOT_CHART_BODY
} qdot_chart_kind;

/* A group that can be replaced: the indices of its coordinates, in the order of the table. */
typedef struct {
    qdot_chart_kind kind;
    size_t index[3];
    qdot_expr distance; /* N in the coordinates given, with its sign */
} qdot_chart_group;

typedef qdot_vec(qdot_chart_group) qdot_chart_groups;

/* A coordinate of a group, in new coordinates and N. */
typedef struct {
    qdot_expr q;
    bool angle;
    qdot_expr value;        /* of a length */
    qdot_expr cosine, sine; /* of an angle */
    qdot_expr x, y;         /* the angle is atan2(y, x), to whole turns */
    qdot_expr bare;         /* a symbol for it outside of sin and cos */
} qdot_chart_moved;

/* A new coordinate, in those given. */
typedef struct {
    qdot_expr q, given;
} qdot_chart_fresh;

typedef struct {
    qdot_expr symbol, square; /* N, and N^2 in new coordinates */
} qdot_chart_distance;

typedef struct {
    qdot_pool *pool;
    qdot_scene *of;    /* the scene given, while the chart is made */
    qdot_scene *scene; /* owned; NULL: it is not regular, `hindrance` says where */
    char hindrance[200];
    bool open;         /* forces may hold N, as a root: they are singular where N is 0 */
    qdot_vec(qdot_chart_moved) moved;
    qdot_vec(qdot_chart_fresh) fresh;
    qdot_vec(qdot_chart_distance) distances;
    qdot_vec(qdot_expr) unit; /* each is 1: constraints of `scene` */
    qdot_text names;          /* "x = r*cos(phi), y = r*sin(phi)" of what is new */
} qdot_chart;

/* All groups of the scene that can be replaced one by one, no coordinate in two of them; none in
 * a scene with constraints. open: those of the plane and of space alone, where forces may be singular
 * at N = 0. `groups` starts from {0}; free its `at`. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_chart_find(qdot_scene *s, bool open,
                                            qdot_chart_groups *groups);

/* The scene with these groups replaced. `sign` [n]: of each N at the start, 1 or -1. The chart
 * starts from {0}; clear it in any case. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_chart_make(qdot_scene *s,
                                            const qdot_chart_groups *groups,
                                            const int *sign, bool open, qdot_chart *chart);
void qdot_chart_clear(qdot_chart *chart);

/* An expression of c->scene in the coordinates given. */
qdot_expr qdot_chart_given(const qdot_chart *c, qdot_expr e);

/* An expression of the scene given in the new coordinates. An angle outside of sin and cos is
 * counted from so many quarter turns, of which it is within half a turn; quarters
 * [moved]. *turns (may be NULL): whether there is one. Nil: the pool keeps the failure. */
qdot_expr qdot_chart_express(const qdot_chart *chart, qdot_expr e, const long *quarters,
                             bool *turns);

/* Inside: in new coordinates and N, angles outside of sin and cos as their symbols. */
qdot_expr qdot_chart_put(const qdot_chart *chart, qdot_expr e);
/* Inside: that without N, if it is regular; else nil, with no failure. */
qdot_expr qdot_chart_regular(const qdot_chart *chart, qdot_expr e);

#endif
