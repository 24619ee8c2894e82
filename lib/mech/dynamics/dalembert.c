/* dalembert.c -- inertial terms and generalized forces from accelerations (d'Alembert), without
 * derivatives of L. */
#include "mech/dynamics/dalembert.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "mech/dynamics/kinematics.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/recursive.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"

static qdot_expr
generalized_forces(qdot_scene *s, bool applied)
{
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n;
    qdot_expr *e = qdot_calloc(n, sizeof *e), Q;

    if (!e)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < n; i++)
        e[i] = qdot_mech_at_rest(s, qdot_force_total(s, i, false, applied));
    Q = n > 1 && !applied ? qdot_vector(pool, (uint32_t)n, e) : qdot_list(pool, (uint32_t)n, e);
    qdot_free(e);
    return Q;
}

/* Whether the principle applies in this form: V without velocities, no stated Lagrangian. */
static bool
applies(qdot_scene *s)
{
    return !qdot_mech_stated(s) && qdot_potential_with_velocities(s) == QDOT_ZERO;
}

static qdot_status
copy_terms(const qdot_kinematics *k, qdot_dalembert_term **terms, size_t *n)
{
    *terms = qdot_calloc(k->terms.n + 1, sizeof **terms);
    if (!*terms)
        return QDOT_ENOMEM;
    for (size_t p = 0; p < k->terms.n; p++)
        (*terms)[(*n)++] =
            (qdot_dalembert_term){k->terms.at[p].w, k->terms.at[p].x, k->terms.at[p].y,
                                  k->terms.at[p].axis};
    return QDOT_OK;
}

qdot_status
qdot_mech_dalembert(qdot_scene *s, qdot_dalembert_term **terms, size_t *n, qdot_expr *Q)
{
    qdot_kinematics *k;

    *terms = NULL;
    *n = 0;
    *Q = QDOT_NIL;
    if (!applies(s))
        return qdot_pool_check(s->pool);
    k = qdot_kinematics_get(s);
    if (!k)
        return qdot_pool_check(s->pool);
    if (!qdot_recursive_applies(s, k))
        return QDOT_OK;
    *Q = generalized_forces(s, false);
    QDOT_TRY(qdot_pool_check(s->pool));
    return copy_terms(qdot_kinematics_get(s), terms, n);
}

qdot_status
qdot_mech_dalembert_terms(qdot_scene *s, qdot_dalembert_term **terms, size_t *n)
{
    qdot_kinematics k = {0};
    qdot_status status;

    *terms = NULL;
    *n = 0;
    if (!applies(s))
        return qdot_pool_check(s->pool);
    status = qdot_kinematics_terms(s, &k);
    if (status == QDOT_OK && qdot_recursive_applies(s, &k))
        status = copy_terms(&k, terms, n);
    qdot_free(k.terms.at);
    return status;
}

qdot_expr
qdot_mech_dalembert_applied(qdot_scene *s)
{
    return generalized_forces(s, true);
}

qdot_expr
qdot_mech_dalembert_potential(qdot_scene *s, size_t n, const qdot_dalembert_term *terms,
                              const qdot_expr *places)
{
    qdot_pool *pool = s->pool;
    qdot_expr *sum = qdot_calloc(n + 1, sizeof *sum), V;

    if (!sum)
        return qdot_pool_fail(pool);
    for (size_t p = 0; p < n; p++) {
        qdot_expr field = QDOT_ZERO;

        for (size_t i = 0; i < s->gravities.n && terms[p].axis >= 0; i++)
            if ((uint32_t)terms[p].axis < qdot_mech_dimension(pool, s->gravities.at[i].e))
                field = qdot_add(pool, field,
                                 qdot_mech_component(pool, s->gravities.at[i].e,
                                                     (uint32_t)terms[p].axis));
        sum[p] = qdot_neg(pool, qdot_mul(pool, qdot_mul(pool, terms[p].w, field), places[p]));
    }
    sum[n] = qdot_potential_but_gravity(s);
    V = qdot_sum(pool, n + 1, sum);
    qdot_free(sum);
    return V;
}
