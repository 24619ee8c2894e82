/* chart-body.c -- represents a rigid body by point masses at its centre and along its axes, in terms of a quaternion. */
#include "mech/coordinates/chart-body.h"

#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

void
qdot_chart_body_axes(qdot_pool *pool, const qdot_expr *e, qdot_expr *R)
{
    const qdot_expr two = qdot_expr_int(pool, 2);

    /* the quaternion is the scalar e_0 with the vector (e_1, e_2, e_3) */
    for (size_t i = 0; i < 3; i++) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const qdot_expr x = e[i + 1], y = e[j + 1], z = e[k + 1];
        const qdot_expr xy = qdot_mul(pool, x, y), wz = qdot_mul(pool, e[0], z);

        R[3 * i + i] = qdot_sub(
            pool, qdot_add(pool, qdot_pow_int(pool, e[0], 2), qdot_pow_int(pool, x, 2)),
            qdot_add(pool, qdot_pow_int(pool, y, 2), qdot_pow_int(pool, z, 2)));
        R[3 * i + j] = qdot_mul(pool, two, qdot_sub(pool, xy, wz));
        R[3 * j + i] = qdot_mul(pool, two, qdot_add(pool, xy, wz));
    }
}

bool
qdot_chart_body_fits(const qdot_scene *s, const size_t *index)
{
    const qdot_expr *q = s->coordinates.at;
    qdot_expr rotation = QDOT_NIL;

    for (size_t i = 0; i < s->bodies.n; i++) {
        if (s->bodies.at[i].angle != QDOT_NIL)
            continue;
        if (rotation == QDOT_NIL)
            rotation = qdot_scene_euler(s->pool, q[index[0]], q[index[1]], q[index[2]]);
        if (rotation == s->bodies.at[i].rotation)
            return true;
    }
    return false;
}

/* Whether a torque, or a force on a material point of a body, acts in the scene. */
static bool
has_torque_or_material_force(const qdot_scene *s)
{
    for (size_t i = 0; i < s->torques.n; i++)
        if (s->torques.at[i].coordinate == QDOT_NIL)
            return true;
    for (size_t i = 0; i < s->forces.n; i++)
        if (s->forces.at[i].material)
            return true;
    return false;
}

/* Add to V the potential of the uniform gravity fields, which act only on the masses of the given scene. */
static qdot_status
add_gravity_potential(const qdot_scene *s, qdot_scene *to)
{
    qdot_pool *pool = s->pool;
    qdot_expr V = QDOT_ZERO;

    for (size_t k = 0; k < s->gravities.n; k++)
        for (size_t i = 0; i < s->particles.n + s->bodies.n; i++) {
            const qdot_massive one = qdot_scene_massive(s, i);

            V = qdot_sub(pool, V,
                         qdot_mul(pool, one.mass, qdot_mech_dot(pool, s->gravities.at[k].e, one.position)));
        }
    to->gravities.n = 0;
    QDOT_TRY(qdot_pool_check(pool));
    return V == QDOT_ZERO ? QDOT_OK : qdot_scene_potential(to, V);
}

/* Add a point mass whose position is column j of the rotation matrix R, or the sum of its columns j and k. */
static qdot_status
add_point_mass(qdot_scene *to, const char *body, qdot_expr mass, const qdot_expr *R, size_t i,
               size_t j)
{
    qdot_pool *pool = to->pool;
    qdot_expr r[3];
    char name[100];

    if (mass == QDOT_ZERO)
        return QDOT_OK;
    for (size_t k = 0; k < 3; k++)
        r[k] = i == j ? R[3 * k + i] : qdot_add(pool, R[3 * k + i], R[3 * k + j]);
    snprintf(name, sizeof name, "%.60s#%zu%zu", body, i + 1, j + 1);
    return qdot_scene_particle(to, name, mass, qdot_vector(pool, 3, r));
}

/* Represent the inertia J of a body by point masses at c_j and c_j + c_k, where c_j are the columns of R. */
static qdot_status
add_point_masses_of_body(qdot_scene *to, const qdot_body *b, const qdot_expr *R)
{
    qdot_pool *pool = to->pool;
    const qdot_expr *I = qdot_expr_args(pool, b->inertia);
    qdot_expr own[9], trace;

    memcpy(own, I, sizeof own);
    trace = qdot_add(pool, own[0], qdot_add(pool, own[4], own[8]));
    if (b->mass != QDOT_ZERO)
        QDOT_TRY(qdot_scene_particle(to, b->name, b->mass, b->position));
    for (size_t i = 0; i < 3; i++) {
        qdot_expr mass = qdot_sub(pool, qdot_mul(pool, QDOT_HALF, trace), own[4 * i]);

        for (size_t j = 0; j < 3; j++)
            if (j != i)
                mass = qdot_add(pool, mass, own[3 * i + j]);
        QDOT_TRY(add_point_mass(to, b->name, mass, R, i, i));
        for (size_t j = i + 1; j < 3; j++)
            QDOT_TRY(add_point_mass(to, b->name, qdot_neg(pool, own[3 * i + j]), R, i, j));
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_chart_body_replace(const qdot_scene *s, qdot_scene *to, qdot_expr rotation,
                        const qdot_expr *R, char *why, size_t size)
{
    size_t left = 0;

    if (has_torque_or_material_force(s)) {
        snprintf(why, size, "a torque acts on a body");
        return QDOT_OK;
    }
    if (to->gravities.n > 0)
        QDOT_TRY(add_gravity_potential(s, to));
    for (size_t i = 0; i < to->bodies.n; i++)
        if (to->bodies.at[i].rotation != rotation)
            to->bodies.at[left++] = to->bodies.at[i];
    to->bodies.n = left;
    for (size_t i = 0; i < s->bodies.n; i++)
        if (s->bodies.at[i].rotation == rotation)
            QDOT_TRY(add_point_masses_of_body(to, s->bodies.at + i, R));
    return QDOT_OK;
}
