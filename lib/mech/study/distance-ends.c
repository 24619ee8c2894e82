/* distance-ends.c -- finds the points of bodies between which a constraint keeps the distance. */
#include "mech/study/distance-ends.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "mech/study/terms.h"
#include "normal/simplify/simplify.h"

enum {
    LARGE = 3000,     /* constraints with more operations are not examined */
    MOST_BODIES = 12, /* largest number of bodies in the plane; in space half as many */
};

typedef qdot_vec(qdot_expr) expressions;

typedef struct {
    qdot_scene *s;
    qdot_facts facts;
    uint32_t n;        /* number of components of u, the vector from one end to the other */
    qdot_expr square[3]; /* squares of the components of u, in unknown order and with unknown signs */
    qdot_expr u;       /* u with the order and signs of components that are being tried */
} search;

static bool
contains_coordinate(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_node(pool, e)->holds & QDOT_HAS_COORD) != 0;
}

/* --- squares in a constraint -------------------------------------------------------- */

/* Whether e = base^exponent. */
static bool
is_power(const qdot_pool *pool, qdot_expr e, qdot_expr exponent, qdot_expr *base)
{
    if (qdot_expr_kind(pool, e) != QDOT_PROD || qdot_expr_count(pool, e) != 3 ||
        qdot_expr_arg(pool, e, 0) != QDOT_ONE || qdot_expr_arg(pool, e, 2) != exponent)
        return false;
    *base = qdot_expr_arg(pool, e, 1);
    return true;
}

/* Whether D is a sum of as many squares as space has dimensions, all with the same factor. */
static bool
find_distance_squares(search *w, qdot_expr D)
{
    const qdot_pool *pool = w->s->pool;
    qdot_expr factor = QDOT_NIL, base;
    uint32_t n = 0;

    if (is_power(pool, D, QDOT_HALF, &base))
        D = base;
    if (qdot_expr_kind(pool, D) != QDOT_SUM || qdot_expr_size(pool, D) > LARGE)
        return false;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, D); i += 2) {
        const qdot_expr term = qdot_expr_arg(pool, D, i), c = qdot_expr_arg(pool, D, i + 1);

        if (!contains_coordinate(pool, term))
            continue;
        if (n == w->n || (factor != QDOT_NIL && c != factor) ||
            !is_power(pool, term, qdot_expr_int(w->s->pool, 2), &w->square[n]))
            return false;
        factor = c;
        n++;
    }
    return n == w->n;
}

/* --- coordinates of bodies and particles ---------------------------------------------- */

static bool
list_contains(const expressions *list, qdot_expr e)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->at[i] == e)
            return true;
    return false;
}

/* Find the coordinates on which a thing depends: a body's centre and axes, or a particle's position. */
static qdot_status
find_coordinates_of(const qdot_scene *s, qdot_expr r, qdot_expr R, expressions *list)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i];

        if (qdot_expr_contains(s->pool, r, q) ||
            (R != QDOT_NIL && qdot_expr_contains(s->pool, R, q)))
            QDOT_TRY(qdot_vec_push(list, q));
    }
    return QDOT_OK;
}

/* --- ends of a rod -------------------------------------------------------------------- */

/* Whether the point P is fixed in the body: R^T (P - r) contains no coordinate. */
static bool
is_fixed_in(search *w, const qdot_body *b, qdot_expr P)
{
    qdot_pool *pool = w->s->pool;
    qdot_expr own = qdot_value_mul(pool, qdot_transpose(pool, b->rotation),
                                   qdot_value_sub(pool, P, b->position));

    if (own == QDOT_NIL || qdot_expr_size(pool, own) > LARGE)
        return false;
    own = qdot_simplify(pool, own, &w->facts);
    return own != QDOT_NIL && !contains_coordinate(pool, own);
}

/* Where the second end of a rod is sought: in a body, at a particle, or fixed in space. */
typedef struct {
    const qdot_body *body;
    const qdot_particle *particle;
} place;

static bool
is_point_at_place(search *w, const place *where, qdot_expr Q)
{
    qdot_pool *pool = w->s->pool;

    if (where->body != NULL)
        return is_fixed_in(w, where->body, Q);
    return where->particle != NULL
               ? Q == qdot_expand(pool, where->particle->position)
               : !contains_coordinate(pool, Q);
}

/* Try the point P in body b and the point Q at a place; they depend on the coordinates `own` and `other`. */
static qdot_status
try_point_pair(search *w, const qdot_body *b, const expressions *own, const place *where,
               qdot_expr ends[2])
{
    qdot_pool *pool = w->s->pool;
    const qdot_expr r = qdot_expand(pool, b->position);
    expressions other = {0}, only = {0};
    qdot_expr P, Q;
    qdot_status status = QDOT_OK;

    if (where->body != NULL)
        status = find_coordinates_of(w->s, where->body->position, where->body->rotation, &other);
    else if (where->particle != NULL)
        status = find_coordinates_of(w->s, where->particle->position, QDOT_NIL, &other);
    for (size_t i = 0; i < own->n && status == QDOT_OK; i++)
        if (!list_contains(&other, own->at[i]))
            status = qdot_vec_push(&only, own->at[i]);
    if (status == QDOT_OK && only.n > 0) {
        P = qdot_value_add(pool, qdot_mech_terms_of(pool, r, only.n, only.at, false),
                           qdot_mech_terms_of(pool, w->u, only.n, only.at, true));
        if (P != QDOT_NIL && is_fixed_in(w, b, P)) {
            Q = qdot_expand(pool, qdot_value_sub(pool, P, w->u));
            if (Q != QDOT_NIL && is_point_at_place(w, where, Q)) {
                ends[0] = qdot_expand(pool, P);
                ends[1] = Q;
            }
        }
        status = qdot_pool_check(pool);
    }
    qdot_free(other.at);
    qdot_free(only.at);
    return status;
}

/* Try the point P in body i and Q anywhere else, for the present order and signs of the components of u. */
static qdot_status
try_points_of_body(search *w, size_t i, qdot_expr ends[2])
{
    const qdot_scene *s = w->s;
    const qdot_body *b = &s->bodies.at[i];
    expressions own = {0};
    qdot_status status = find_coordinates_of(s, b->position, b->rotation, &own);

    if (status == QDOT_OK)
        status = try_point_pair(w, b, &own, &(place){0}, ends);
    for (size_t k = 0; k < s->particles.n && status == QDOT_OK && ends[0] == QDOT_NIL; k++)
        status = try_point_pair(w, b, &own, &(place){.particle = &s->particles.at[k]}, ends);
    for (size_t k = 0; k < s->bodies.n && status == QDOT_OK && ends[0] == QDOT_NIL; k++)
        if (k != i)
            status = try_point_pair(w, b, &own, &(place){.body = &s->bodies.at[k]}, ends);
    qdot_free(own.at);
    return status;
}

/* Whether the components u can be those of a point of the body: each coordinate of its centre, as x of (x, y),
 * must occur in its component. */
static bool
may_contain_end(const qdot_scene *s, const qdot_body *b, qdot_expr u)
{
    for (uint32_t d = 0; d < qdot_mech_dimension(s->pool, b->position); d++) {
        const qdot_expr r = qdot_mech_component(s->pool, b->position, d);

        if (qdot_expr_is_coordinate(s->pool, r) &&
            !qdot_expr_contains(s->pool, qdot_mech_component(s->pool, u, d), r))
            return false;
    }
    return true;
}

static const unsigned char orders[][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1},
                                          {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};

/* Try every order and all signs of the components of u. */
static qdot_status
try_component_orders(search *w, qdot_expr ends[2])
{
    qdot_pool *pool = w->s->pool;
    const size_t count = w->n == 2 ? 2 : 6;

    for (size_t k = 0; k < count; k++)
        for (unsigned signs = 0; signs < 1u << w->n; signs++) {
            qdot_expr parts[3];

            for (uint32_t d = 0; d < w->n; d++) {
                const qdot_expr part = qdot_expand(pool, w->square[orders[k][d]]);

                parts[d] = signs >> d & 1 ? qdot_neg(pool, part) : part;
            }
            w->u = qdot_expand(pool, qdot_vector(pool, w->n, parts));
            QDOT_TRY(qdot_pool_check(pool));
            for (size_t i = 0; i < w->s->bodies.n; i++) {
                if (may_contain_end(w->s, &w->s->bodies.at[i], w->u))
                    QDOT_TRY(try_points_of_body(w, i, ends));
                if (ends[0] != QDOT_NIL)
                    return QDOT_OK;
            }
        }
    return QDOT_OK;
}

qdot_status
qdot_mech_distance_ends(qdot_scene *s, const qdot_constraint *c, qdot_expr ends[2])
{
    search w = {.s = s, .n = qdot_scene_dimension(s)};
    const bool left = contains_coordinate(s->pool, c->left), right = contains_coordinate(s->pool, c->right);
    const qdot_expr D = !right ? c->left : !left ? c->right : c->f;

    ends[0] = ends[1] = QDOT_NIL;
    if (c->kind != QDOT_HOLONOMIC || w.n < 2 || s->bodies.n == 0 ||
        s->bodies.n > MOST_BODIES / (w.n - 1) || !find_distance_squares(&w, D))
        return QDOT_OK;
    w.facts = qdot_scene_facts(s);
    return try_component_orders(&w, ends);
}
