/* statics.c -- scenes without masses. */
#include "mech/dynamics/statics.h"

#include "expr/build.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"
#include "normal/solve/linear.h"

bool
qdot_statics_applies(const qdot_scene *s)
{
    return s->particles.n == 0 && s->bodies.n == 0 && !qdot_mech_stated(s);
}

bool
qdot_statics_acts(const qdot_scene *s)
{
    return s->forces.n + s->torques.n + s->springs.n + s->potentials.n + s->constraints.n + s->dampers.n +
               s->dissipations.n > 0;
}

/* Fail unless there are as many constraints, all of positions, as coordinates. */
static bool
needs_determinate(qdot_scene *s, size_t k)
{
    const size_t n = s->coordinates.n, m = s->constraints.n;
    const char *name = s->constraints.at[k].name;

    for (size_t i = 0; i < m; i++)
        if (s->constraints.at[i].kind != QDOT_HOLONOMIC) {
            qdot_mech_fail(s, QDOT_EINVAL, "lambda[%.200s] has no value: constraint %.200s is not one of positions, and nothing "
                           "has mass", name, s->constraints.at[i].name);
            return false;
        }
    if (m > n) {
        qdot_fail(QDOT_EINVAL, "lambda[%.200s] is not determined: statically indeterminate, %zu constraints for %zu "
                  "coordinate%s", name, m, n, n == 1 ? "" : "s");
        qdot_hint("elastic bars are springs: spring between A, B stiffness k rest L");
        qdot_pool_fail(s->pool);
    } else if (m < n) {
        qdot_fail(QDOT_EINVAL, "lambda[%.200s] has a value at an equilibrium only: nothing has mass, and the constraints "
                  "leave freedom to move", name);
        qdot_hint("`equilibria` lists the multipliers too");
        qdot_pool_fail(s->pool);
    }
    return m == n;
}

qdot_expr
qdot_statics_multiplier(qdot_scene *s, size_t k)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n;
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr *A, *b, *lambda, value = QDOT_NIL;
    uint32_t pivot = 0;
    qdot_status status;

    if (!needs_determinate(s, k))
        return QDOT_NIL;
    A = qdot_calloc(n * n + 2 * n, sizeof *A);
    if (A == NULL)
        return qdot_pool_fail(pool);
    b = A + n * n;
    lambda = b + n;
    for (size_t i = 0; i < n; i++) {
        b[i] = qdot_neg(pool, qdot_force_total(s, i, true, false));
        for (size_t j = 0; j < n; j++)
            A[i * n + j] = qdot_mech_tidy(s, qdot_constraint_slope(s, j, i));
    }
    status = qdot_pool_failed(pool) ? QDOT_OK : qdot_solve_linear(pool, (uint32_t)n, A, b, lambda, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        qdot_mech_fail(s, QDOT_EINVAL, "lambda[%.200s] is not determined: constraints repeat each other",
                       s->constraints.at[k].name);
    else if (status != QDOT_OK)
        qdot_pool_fail(pool);
    else if (!qdot_pool_failed(pool))
        value = qdot_mech_tidy(s, lambda[k]);
    qdot_free(A);
    return value;
}
