/* rods.c -- finds distances of a scene that are constant: rods, and points fixed in bodies. */
#include "mech/study/rods.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "mech/study/distance-ends.h"
#include "mech/study/terms.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum {
    LARGE = 3000,  /* expressions with more operations are not examined */
    ALL_PAIRS = 8, /* up to this number of particles every pair is examined */
};

typedef struct {
    qdot_scene *s;
    qdot_facts facts;
    qdot_arms
        points; /* positions of particles, the origin, fixed ends of springs and dampers */
    size_t particles; /* how many of `points` are particles; equal positions count once */
    qdot_rods *rods;
} search;

static bool
point_moves(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_node(pool, e)->holds & QDOT_HAS_COORD) != 0;
}

/* The squared distance |a - b|^2 between two points. */
static qdot_expr
squared_distance(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    qdot_expr d = qdot_value_sub(pool, a, b);

    return qdot_dot(pool, d, d);
}

/* Whether the distance between the points a and b is a non-zero constant because of their positions r(q). */
static bool
is_constant_distance(const search *w, qdot_expr a, qdot_expr b)
{
    qdot_pool *pool = w->s->pool;
    qdot_expr D = squared_distance(pool, a, b);

    if (D == QDOT_NIL || qdot_expr_size(pool, D) > LARGE)
        return false;
    if (point_moves(pool, D))
        D = qdot_simplify(pool, D, &w->facts);
    return D != QDOT_NIL && D != QDOT_ZERO && !point_moves(pool, D);
}

static qdot_status
add_rod(search *w, qdot_expr a, qdot_expr b, const char *name)
{
    for (size_t i = 0; i < w->rods->n; i++) {
        const qdot_expr *ends = w->rods->at[i].ends;

        if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a))
            return QDOT_OK;
    }
    return qdot_vec_push(w->rods, ((qdot_rod){{a, b}, name}));
}

static bool
point_has_rod(const search *w, qdot_expr a)
{
    for (size_t i = 0; i < w->rods->n; i++)
        if (w->rods->at[i].ends[0] == a || w->rods->at[i].ends[1] == a)
            return true;
    return false;
}

/* The position r without the terms that contain coordinate i; nil if r does not contain it. */
static qdot_expr
hinge_of_position(qdot_scene *s, qdot_expr r, size_t i)
{
    qdot_expr q = s->coordinates.at[i];

    return qdot_expr_contains(s->pool, r, q) ? qdot_mech_terms_of(s->pool, r, 1, &q, false)
                                             : QDOT_NIL;
}

static bool
is_listed_point(const search *w, qdot_expr r)
{
    for (size_t i = 0; i < w->points.n; i++)
        if (w->points.at[i] == r)
            return true;
    return false;
}

static qdot_status
rods_add_point(search *w, qdot_expr r)
{
    return r == QDOT_NIL || is_listed_point(w, r) ? qdot_pool_check(w->s->pool)
                                           : qdot_vec_push(&w->points, r);
}

static qdot_expr
origin(qdot_pool *pool, uint32_t dimension)
{
    const qdot_expr zero[] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};

    return qdot_vector(pool, dimension, zero);
}

/* Collect the points: particles first, then fixed points. */
static qdot_status
collect_points(search *w, uint32_t dimension)
{
    qdot_scene *s = w->s;

    for (size_t i = 0; i < s->particles.n; i++)
        QDOT_TRY(rods_add_point(w, qdot_expand(s->pool, s->particles.at[i].position)));
    w->particles = w->points.n;
    QDOT_TRY(rods_add_point(w, origin(s->pool, dimension)));
    for (size_t i = 0; i < 2 * (s->springs.n + s->dampers.n); i++) {
        const qdot_link *link = i / 2 < s->springs.n
                                    ? &s->springs.at[i / 2]
                                    : &s->dampers.at[i / 2 - s->springs.n];

        if (!point_moves(s->pool, link->at[i % 2]))
            QDOT_TRY(rods_add_point(w, qdot_expand(s->pool, link->at[i % 2])));
    }
    return QDOT_OK;
}

/* --- distances kept constant by positions r(q) -------------------------------------- */

static qdot_status
add_rods_between_particles(search *w)
{
    for (size_t i = 0; i < w->particles && w->particles <= ALL_PAIRS; i++)
        for (size_t j = 0; j < i; j++)
            if ((point_moves(w->s->pool, w->points.at[i]) ||
                 point_moves(w->s->pool, w->points.at[j])) &&
                is_constant_distance(w, w->points.at[i], w->points.at[j]))
                QDOT_TRY(add_rod(w, w->points.at[i], w->points.at[j], NULL));
    return qdot_pool_check(w->s->pool);
}

/* Add the hinge about which a point turns, the hinge about which that one turns, and so on, while they are new. */
static qdot_status
add_hinges(search *w, qdot_expr r)
{
    qdot_scene *s = w->s;

    while (r != QDOT_NIL) {
        qdot_expr next = QDOT_NIL;

        for (size_t i = s->coordinates.n; i-- > 0;) {
            qdot_expr c = hinge_of_position(s, r, i);
            bool known;

            if (c == QDOT_NIL || c == r)
                continue;
            known = is_listed_point(w, c) || !point_moves(s->pool, c);
            if ((!known && point_has_rod(w, r)) || !is_constant_distance(w, r, c))
                continue;
            QDOT_TRY(add_rod(w, r, c, NULL));
            if (!known) {
                QDOT_TRY(rods_add_point(w, c));
                next = c;
            }
            break;
        }
        r = next;
    }
    return qdot_pool_check(s->pool);
}

/* --- distances kept constant by constraints ----------------------------------------- */

/* Whether d|a - b|^2 and df are parallel everywhere, in the coordinates and t; every
 * coordinate of f counts. */
static bool
constraint_keeps_distance(const search *w, qdot_expr f, qdot_expr a, qdot_expr b)
{
    qdot_scene *s = w->s;
    qdot_pool *pool = s->pool;
    qdot_expr D = squared_distance(pool, a, b), pivot = QDOT_NIL, D1 = QDOT_NIL, f1 = QDOT_NIL;

    if (D == QDOT_NIL || qdot_expr_size(pool, D) + qdot_expr_size(pool, f) > LARGE)
        return false;
    for (size_t i = 0; i <= s->coordinates.n; i++) {
        qdot_expr q = i < s->coordinates.n ? s->coordinates.at[i] : QDOT_T;
        bool in = qdot_expr_contains(pool, f, q);
        qdot_expr Dq, fq;

        if (in != qdot_expr_contains(pool, D, q))
            return false;
        if (!in)
            continue;
        Dq = qdot_diff(pool, D, q);
        fq = qdot_diff(pool, f, q);
        if (pivot == QDOT_NIL) {
            pivot = q;
            D1 = Dq;
            f1 = fq;
        } else if (!qdot_is_zero(
                       pool,
                       qdot_sub(pool, qdot_mul(pool, Dq, f1), qdot_mul(pool, fq, D1)),
                       &w->facts)) {
            return false;
        }
    }
    return pivot != QDOT_NIL && D1 != QDOT_ZERO;
}

/* The centre c of g = k |r - c|^2 + ...: c_i = r_i - g_i/g_ii with the derivatives of g; nil if
 * there is none. */
static qdot_expr
sphere_centre(const search *w, qdot_expr g, qdot_expr r)
{
    qdot_pool *pool = w->s->pool;
    uint32_t n = qdot_mech_dimension(pool, r);
    qdot_expr c[3] = {QDOT_NIL, QDOT_NIL, QDOT_NIL};

    for (uint32_t d = 0; d < n; d++) {
        qdot_expr x = qdot_mech_component(pool, r, d), slope, second;

        if (!qdot_expr_is_coordinate(pool, x))
            return QDOT_NIL;
        slope = qdot_expand(pool, qdot_diff(pool, g, x));
        second = qdot_expand(pool, qdot_diff(pool, slope, x));
        if (second == QDOT_NIL || second == QDOT_ZERO || point_moves(pool, second))
            return QDOT_NIL;
        c[d] = qdot_expand(pool, qdot_sub(pool, x, qdot_div(pool, slope, second)));
        if (c[d] == QDOT_NIL || point_moves(pool, c[d]))
            return QDOT_NIL;
    }
    return qdot_vector(pool, n, c);
}

/* Add the rod between points of bodies that constraint c represents, if it represents one. */
static qdot_status
add_rod_between_bodies(search *w, const qdot_constraint *c)
{
    qdot_expr ends[2];

    QDOT_TRY(qdot_mech_distance_ends(w->s, c, ends));
    return ends[0] == QDOT_NIL ? QDOT_OK : add_rod(w, ends[0], ends[1], c->label);
}

/* Add the rod that constraint c represents, if it represents one. */
static qdot_status
add_rod_of_constraint(search *w, const qdot_constraint *c)
{
    qdot_pool *pool = w->s->pool;
    const size_t n = w->points.n;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (constraint_keeps_distance(w, c->f, w->points.at[i], w->points.at[j])) {
                bool first = point_moves(pool, w->points.at[i]);

                return add_rod(w, w->points.at[first ? i : j],
                               w->points.at[first ? j : i], c->label);
            }
    for (size_t i = 0; i < n; i++) {
        qdot_expr r = w->points.at[i], centre = sphere_centre(w, c->f, r);

        if (centre == QDOT_NIL) /* a constraint of the form norm(a - c) = L */
            centre = sphere_centre(w,
                                   qdot_sub(pool, qdot_pow_int(pool, c->left, 2),
                                            qdot_pow_int(pool, c->right, 2)),
                                   r);
        if (centre != QDOT_NIL && constraint_keeps_distance(w, c->f, r, centre))
            return add_rod(w, r, centre, c->label);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return add_rod_between_bodies(w, c);
}

qdot_status
qdot_mech_rods(qdot_scene *s, qdot_rods *rods)
{
    search w = {.s = s, .facts = qdot_scene_facts(s), .rods = rods};
    uint32_t dimension = qdot_scene_dimension(s);
    qdot_status status;

    if (dimension < 2)
        return QDOT_OK;
    status = collect_points(&w, dimension);
    if (status == QDOT_OK)
        status = add_rods_between_particles(&w);
    for (size_t i = 0; i < w.particles && status == QDOT_OK; i++)
        status = add_hinges(&w, w.points.at[i]);
    for (size_t k = 0; k < s->constraints.n && status == QDOT_OK; k++)
        if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
            status = add_rod_of_constraint(&w, &s->constraints.at[k]);
    qdot_free(w.points.at);
    return status;
}

/* --- points fixed in bodies --------------------------------------------------------- */

/* Append the point P to the list of points of the body (arms) if it is fixed in the body and is not its centre. */
static qdot_status
append_if_fixed_in_body(qdot_scene *s, const qdot_body *b, qdot_expr P, qdot_arms *arms)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr own;

    P = qdot_expand(pool, P);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_mech_dimension(pool, P) != qdot_mech_dimension(pool, b->position))
        return QDOT_OK;
    for (size_t i = 0; i < arms->n; i++)
        if (arms->at[i] == P)
            return QDOT_OK;
    own = qdot_value_mul(pool, qdot_transpose(pool, b->rotation),
                         qdot_value_sub(pool, P, b->position));
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_size(pool, own) > LARGE)
        return QDOT_OK;
    own = qdot_simplify(pool, own, &facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (point_moves(pool, own) || qdot_dot(pool, own, own) == QDOT_ZERO)
        return qdot_pool_check(pool);
    return qdot_vec_push(arms, P);
}

/* Find points fixed in a body among the sides of constraints whose successive components form a vector. */
static qdot_status
find_body_points_in_constraints(qdot_scene *s, const qdot_body *b, qdot_arms *arms)
{
    uint32_t n = qdot_mech_dimension(s->pool, b->position);

    for (size_t k = 0; k + n <= s->constraints.n; k++) {
        const qdot_constraint *c = &s->constraints.at[k];
        qdot_expr left[3], right[3];
        bool whole = c->kind == QDOT_HOLONOMIC && c->label != NULL;

        for (uint32_t d = 0; d < n && whole; d++) {
            whole = qdot_label_is(c[d].label, c->label);
            left[d] = c[d].left;
            right[d] = c[d].right;
        }
        if (!whole)
            continue;
        QDOT_TRY(append_if_fixed_in_body(s, b, qdot_vector(s->pool, n, left), arms));
        QDOT_TRY(append_if_fixed_in_body(s, b, qdot_vector(s->pool, n, right), arms));
        k += n - 1;
    }
    return QDOT_OK;
}

qdot_status
qdot_mech_arms(qdot_scene *s, size_t i, const qdot_rods *rods, qdot_arms *arms)
{
    const qdot_body *b = &s->bodies.at[i];
    qdot_expr r = qdot_expand(s->pool, b->position);
    size_t before = arms->n;

    QDOT_TRY(qdot_pool_check(s->pool));
    for (size_t k = s->coordinates.n; k-- > 0 && arms->n == before;) {
        qdot_expr c = hinge_of_position(s, r, k);

        if (c != QDOT_NIL && c != r &&
            qdot_expr_contains(s->pool, b->rotation, s->coordinates.at[k]))
            QDOT_TRY(append_if_fixed_in_body(s, b, c, arms));
    }
    for (size_t k = 0; k < s->particles.n; k++)
        QDOT_TRY(append_if_fixed_in_body(s, b, s->particles.at[k].position, arms));
    for (size_t k = 0; k < s->forces.n; k++)
        QDOT_TRY(append_if_fixed_in_body(s, b, s->forces.at[k].point, arms));
    for (size_t k = 0; k < 2 * (s->springs.n + s->dampers.n); k++) {
        const qdot_link *link = k / 2 < s->springs.n
                                    ? &s->springs.at[k / 2]
                                    : &s->dampers.at[k / 2 - s->springs.n];

        QDOT_TRY(append_if_fixed_in_body(s, b, link->at[k % 2], arms));
    }
    for (size_t k = 0; k < 2 * rods->n; k++)
        QDOT_TRY(append_if_fixed_in_body(s, b, rods->at[k / 2].ends[k % 2], arms));
    return find_body_points_in_constraints(s, b, arms);
}
