/* export-massless.c -- rows of M and f, those without mass by their rates. */
#include "lang/declare/export-massless.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"

static qdot_expr
jet(const qdot_scene *s, size_t i, uint32_t order)
{
    return qdot_symbol_jet(s->pool, s->coordinates.at[i], order);
}

static bool
is_massless(const qdot_scene *s, const qdot_expr *M, size_t i)
{
    for (size_t j = 0; j < s->coordinates.n; j++)
        if (M[i * s->coordinates.n + j] != QDOT_ZERO)
            return false;
    for (size_t k = 0; k < s->constraints.n; k++)
        for (uint32_t order = 0; order < 3; order++)
            if (qdot_expr_contains(s->pool, s->constraints.at[k].f, jet(s, i, order)))
                return false;
    return true;
}

static qdot_status
refuse_jumps(const qdot_scene *s)
{
    for (size_t k = 0; k < s->events.n; k++)
        if (s->events.at[k].targets.n > 0)
            return qdot_fail(QDOT_ENOTBUILT,
                             "not built yet: exports of the event %.100s of a scene with a coordinate without mass",
                             s->events.at[k].name);
    return QDOT_OK;
}

/* The rate of f_i that holds accelerations. */
static qdot_expr
rate_of(const qdot_scene *s, const bool *massless, qdot_expr f)
{
    bool velocity = false;

    for (size_t j = 0; j < s->coordinates.n; j++)
        velocity = velocity || (massless[j] && qdot_expr_contains(s->pool, f, jet(s, j, 1)));
    return velocity ? qdot_ddt(s->pool, f) : qdot_ddt(s->pool, qdot_ddt(s->pool, f));
}

/* Row i by that rate. accelerations [n], zeros [n] */
static void
put_rate(const qdot_scene *s, const qdot_expr *accelerations, const qdot_expr *zeros, qdot_expr rate, qdot_expr *M,
         qdot_expr *f)
{
    const size_t n = s->coordinates.n;

    for (size_t j = 0; j < n; j++)
        M[j] = qdot_diff(s->pool, rate, accelerations[j]);
    *f = qdot_neg(s->pool, qdot_subs(s->pool, rate, n, accelerations, zeros));
}

qdot_status
qdot_export_massless(qdot_scene *scene, qdot_expr *M, qdot_expr *f, bool *any)
{
    const size_t n = scene->coordinates.n;
    const qdot_expr mass = qdot_mech_numeric_mass(scene), forcing = qdot_mech_numeric_forcing(scene);
    bool *massless = qdot_calloc(n + 1, sizeof *massless);
    qdot_expr *accelerations = qdot_calloc(2 * n + 1, sizeof *accelerations);
    qdot_status status = massless != NULL && accelerations != NULL ? qdot_pool_check(scene->pool) : QDOT_ENOMEM;

    *any = false;
    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        M[i] = qdot_expr_arg(scene->pool, mass, (uint32_t)i);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        f[i] = qdot_expr_arg(scene->pool, forcing, (uint32_t)i);
        massless[i] = is_massless(scene, M, i);
        *any = *any || massless[i];
        accelerations[i] = jet(scene, i, 2);
        accelerations[n + i] = QDOT_ZERO;
    }
    if (status == QDOT_OK && *any)
        status = refuse_jumps(scene);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (massless[i]) {
            put_rate(scene, accelerations, accelerations + n, rate_of(scene, massless, f[i]), M + i * n, f + i);
            status = qdot_pool_check(scene->pool);
        }
    qdot_free(massless);
    qdot_free(accelerations);
    return status;
}
