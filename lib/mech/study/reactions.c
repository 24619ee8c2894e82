/* reactions.c -- turns generalized reactions into forces, where the positions r(q) determine these. */
#include "mech/study/reactions.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/body.h"
#include "mech/scene/constraint.h"
#include "normal/solve/linear.h"

typedef struct {
    qdot_scene *s;
    size_t n;
    qdot_expr *R;   /* [n] generalized reactions */
    uint32_t *uses; /* [n] how many particles and bodies depend on the coordinate */
    bool *told;     /* [n] the coordinate's reaction is contained in a reported force or torque */
    qdot_vec(qdot_reaction) list;
} work;

static bool
depends_on_coordinate(const work *w, const qdot_massive *one, size_t j)
{
    qdot_expr q = w->s->coordinates.at[j];
    const qdot_pool *pool = w->s->pool;

    return qdot_expr_contains(pool, one->position, q) ||
           (one->body && qdot_expr_contains(pool, one->body->rotation, q));
}

/* Column j of the Jacobian d(position, rotation)/dq as its components. */
static uint32_t
jacobian_column(const work *w, const qdot_massive *one, size_t j, qdot_expr out[6])
{
    qdot_pool *pool = w->s->pool;
    qdot_expr q = w->s->coordinates.at[j];
    uint32_t dim = qdot_mech_dimension(pool, one->position), rows = 0;

    for (uint32_t d = 0; d < dim; d++)
        out[rows++] = qdot_diff(pool, qdot_mech_component(pool, one->position, d), q);
    if (one->body) {
        qdot_expr spin = qdot_body_partial_spin(w->s, one->body, q);
        uint32_t turns = spin == QDOT_NIL ? 0 : qdot_mech_dimension(pool, spin);

        for (uint32_t d = 0; d < turns; d++)
            out[rows++] = qdot_mech_component(pool, spin, d);
    }
    return rows;
}

/* Solve for x = J (J^T J)^-1 R, J [rows x k] stored by columns; for square J this is J^-T R. */
static qdot_status
reactions_solve(const work *w, uint32_t rows, uint32_t k, const qdot_expr *J, const qdot_expr *R,
                qdot_expr *x)
{
    qdot_pool *pool = w->s->pool;
    qdot_facts facts = qdot_scene_facts(w->s);
    qdot_expr A[36], y[6];
    uint32_t pivot;
    bool square = rows == k;

    for (uint32_t i = 0; i < k; i++)
        for (uint32_t j = 0; j < k; j++) {
            A[i * k + j] = square ? J[i * rows + j] : QDOT_ZERO;
            for (uint32_t d = 0; d < rows && !square; d++)
                A[i * k + j] = qdot_add(
                    pool, A[i * k + j],
                    qdot_mul(pool, J[i * rows + d], J[j * rows + d]));
        }
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_solve_linear(pool, k, A, R, y, &pivot, &facts));
    for (uint32_t d = 0; d < rows; d++) {
        x[d] = square ? y[d] : QDOT_ZERO;
        for (uint32_t i = 0; i < k && !square; i++)
            x[d] = qdot_add(pool, x[d], qdot_mul(pool, J[i * rows + d], y[i]));
        x[d] = qdot_mech_tidy(w->s, x[d]);
    }
    return qdot_pool_check(pool);
}

/* Remove rows of J [rows x k] that are 0: nothing moves in these directions; kept[]: indices of the remaining rows. */
static uint32_t
moving_rows(uint32_t rows, uint32_t k, qdot_expr *J, uint32_t kept[6])
{
    uint32_t m = 0;

    for (uint32_t d = 0; d < rows; d++) {
        bool moves = false;

        for (uint32_t i = 0; i < k; i++)
            moves |= J[i * rows + d] != QDOT_ZERO;
        if (moves)
            kept[m++] = d;
    }
    for (uint32_t i = 0; i < k; i++)
        for (uint32_t d = 0; d < m; d++)
            J[i * m + d] = J[i * rows + kept[d]]; /* in place, since m <= rows */
    return m;
}

/* Find the reaction force on a thing, if no other thing depends on its coordinates. */
static qdot_status
find_reaction_force(work *w, const qdot_massive *one)
{
    qdot_pool *pool = w->s->pool;
    uint32_t dim = qdot_mech_dimension(pool, one->position), rows = dim, k = 0;
    uint32_t kept[6], moving;
    qdot_reaction r = {.name = one->name};
    qdot_expr J[36], R[6], part[6], x[6];
    bool acts = false;
    size_t own[6];
    qdot_status status;

    for (size_t j = 0; j < w->n; j++) {
        if (!depends_on_coordinate(w, one, j))
            continue;
        if (w->uses[j] > 1 || k == 6)
            return QDOT_OK;
        own[k++] = j;
        acts |= w->R[j] != QDOT_ZERO;
    }
    if (!acts)
        return QDOT_OK;
    for (uint32_t i = 0; i < k; i++) {
        qdot_expr slopes[6];

        rows = jacobian_column(w, one, own[i], slopes);
        QDOT_TRY(qdot_pool_check(pool));
        if (rows < k) /* more coordinates than directions: the force is not determined */
            return QDOT_OK;
        memcpy(J + i * rows, slopes, rows * sizeof *slopes);
        R[i] = w->R[own[i]];
    }
    moving = moving_rows(rows, k, J, kept);
    if (one->body && moving != k) /* not unique: a smallest force and torque would mix units */
        return QDOT_OK;
    status = reactions_solve(w, moving, k, J, R, part);
    if (status == QDOT_ESINGULAR)
        return QDOT_OK;
    QDOT_TRY(status);
    for (uint32_t d = 0; d < rows; d++)
        x[d] = QDOT_ZERO;
    for (uint32_t d = 0; d < moving; d++)
        x[kept[d]] = part[d];
    r.force = dim == 1 ? x[0] : qdot_vector(pool, dim, x);
    if (one->body)
        r.torque = rows - dim == 1 ? x[dim] : qdot_vector(pool, rows - dim, x + dim);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < k; i++)
        w->told[own[i]] = true;
    return qdot_vec_push(&w->list, r);
}

static qdot_status
collect_particles_and_bodies(work *w)
{
    qdot_scene *s = w->s;
    size_t things = s->particles.n + s->bodies.n;

    for (size_t j = 0; j < w->n; j++)
        w->R[j] = qdot_constraint_reaction(s, j);
    QDOT_TRY(qdot_pool_check(s->pool));
    for (size_t i = 0; i < things; i++) {
        const qdot_massive one = qdot_scene_massive(s, i);

        for (size_t j = 0; j < w->n; j++)
            w->uses[j] += depends_on_coordinate(w, &one, j);
    }
    for (size_t i = 0; i < things; i++) {
        const qdot_massive one = qdot_scene_massive(s, i);

        QDOT_TRY(find_reaction_force(w, &one));
    }
    for (size_t j = 0; j < w->n; j++) {
        qdot_reaction r = {.coordinate = s->coordinates.at[j], .force = w->R[j]};

        if (!w->told[j] && w->R[j] != QDOT_ZERO)
            QDOT_TRY(qdot_vec_push(&w->list, r));
    }
    return QDOT_OK;
}

qdot_status
qdot_mech_reactions(qdot_scene *s, qdot_reaction **list, size_t *n)
{
    work w = {.s = s, .n = s->coordinates.n};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(s->pool));
    w.R = qdot_calloc(w.n + 1, sizeof *w.R);
    w.uses = qdot_calloc(w.n + 1, sizeof *w.uses);
    w.told = qdot_calloc(w.n + 1, sizeof *w.told);
    status = w.R && w.uses && w.told ? collect_particles_and_bodies(&w) : QDOT_ENOMEM;
    qdot_free(w.R);
    qdot_free(w.uses);
    qdot_free(w.told);
    if (status != QDOT_OK) {
        qdot_free(w.list.at);
        return status;
    }
    *list = w.list.at;
    *n = w.list.n;
    return QDOT_OK;
}

qdot_expr
qdot_mech_reaction_list(qdot_scene *s)
{
    qdot_vec(qdot_expr) parts = {0};
    qdot_reaction *list = NULL;
    qdot_expr value = QDOT_NIL;
    size_t n = 0;
    qdot_status status = qdot_mech_reactions(s, &list, &n);

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        status = qdot_vec_push(&parts, list[i].force);
        if (status == QDOT_OK && list[i].torque != QDOT_NIL)
            status = qdot_vec_push(&parts, list[i].torque);
    }
    if (status == QDOT_OK)
        value = qdot_list(s->pool, (uint32_t)parts.n, parts.at);
    qdot_free(parts.at);
    qdot_free(list);
    return status == QDOT_OK ? value : qdot_pool_fail(s->pool);
}
