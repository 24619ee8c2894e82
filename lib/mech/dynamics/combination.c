/* combination.c -- quantities that are combinations of the momenta. */
#include "mech/dynamics/combination.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/generic-null.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "normal/prove/decide.h"

/* The k-th of the functions 1, t, q_1 ... q_n. */
static qdot_expr
linear_function(qdot_scene *s, size_t k)
{
    return k == 0 ? QDOT_ONE : k == 1 ? QDOT_T : qdot_mech_jet(s, k - 2, 0);
}

/* Find xi with dE/dq_i' = sum_j M_ij xi_j; *found: there is one at random points. */
static qdot_status
guess_combination(qdot_scene *s, qdot_expr E, qdot_expr M, qdot_expr *xi, bool *found)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n, each = n + 2, columns = 1 + n * each;
    qdot_expr *e = qdot_calloc(n * columns + 1, sizeof *e), *basis = NULL;
    size_t count = 0;
    qdot_status status = e == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; status == QDOT_OK && i < n; i++) {
        e[i * columns] = qdot_neg(pool, qdot_diff(pool, E, qdot_mech_jet(s, i, 1)));
        for (size_t j = 0; j < n; j++)
            for (size_t k = 0; k < each; k++)
                e[i * columns + 1 + j * each + k] =
                    qdot_mul(pool, qdot_expr_arg(pool, M, (uint32_t)(i * n + j)), linear_function(s, k));
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_generic_null_exact(pool, n, columns, e, &basis, &count);
    *found = count > 0 && basis[0] == QDOT_ONE;
    for (size_t j = 0; j < n && *found; j++) {
        xi[j] = QDOT_ZERO;
        for (size_t k = 0; k < each; k++)
            xi[j] = qdot_add(pool, xi[j], qdot_mul(pool, basis[1 + j * each + k], linear_function(s, k)));
    }
    qdot_free(basis);
    qdot_free(e);
    return status;
}

/* Whether no rest E - sum xi_i p_i holds velocities: dE/dq_j' = sum M_ji xi_i is proved for every j. */
static bool
proves_combination(qdot_scene *s, qdot_expr E, qdot_expr M, const qdot_expr *xi)
{
    qdot_pool *pool = s->pool;
    const uint32_t n = (uint32_t)s->coordinates.n;
    const qdot_facts facts = qdot_scene_facts(s);

    for (uint32_t j = 0; j < n; j++) {
        qdot_expr rest = qdot_diff(pool, E, qdot_mech_jet(s, j, 1));

        for (uint32_t i = 0; i < n; i++)
            rest = qdot_sub(pool, rest, qdot_mul(pool, qdot_expr_arg(pool, M, j * n + i), xi[i]));
        if (!qdot_is_zero(pool, rest, &facts))
            return false;
    }
    return true;
}

/* E - sum xi_i p_i, which holds no velocities, at q' = 0. */
static qdot_expr
rest_of(qdot_scene *s, qdot_expr E, const qdot_expr *xi)
{
    qdot_expr K = E;

    for (size_t i = 0; i < s->coordinates.n; i++)
        K = qdot_sub(s->pool, K, qdot_mul(s->pool, xi[i], qdot_mech_momentum(s, s->coordinates.at[i])));
    for (size_t i = 0; i < s->coordinates.n && K != QDOT_NIL; i++)
        K = qdot_subs(s->pool, K, 1, (qdot_expr[]){qdot_mech_jet(s, i, 1)}, (qdot_expr[]){QDOT_ZERO});
    return K;
}

qdot_status
qdot_combination_of_momenta(qdot_scene *s, qdot_expr E, qdot_expr *xi, qdot_expr *K, bool *is)
{
    const qdot_expr M = qdot_mech_mass_matrix(s);
    qdot_status status = qdot_pool_check(s->pool);

    *is = false;
    QDOT_TRY(status);
    if (!(qdot_mech_holds(s, M) & QDOT_HAS_VELOCITY))
        return QDOT_OK;
    QDOT_TRY(guess_combination(s, E, M, xi, is));
    if (*is)
        *is = proves_combination(s, E, M, xi);
    if (*is)
        *K = rest_of(s, E, xi);
    status = qdot_pool_check(s->pool);
    *is = *is && status == QDOT_OK;
    return status == QDOT_EDOMAIN ? QDOT_OK : status; /* L has no derivatives at q' = 0 */
}
