/* still.c -- finds the largest set of coordinates that stay at 0, by removing those that do not stay. */
#include "sim/model/still.h"

#include <string.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "ode/scale.h"

typedef struct {
    const qdot_plan *plan;
    bool *still;         /* [n] the coordinate stays at 0 */
    size_t n_zeros;
    qdot_expr *of, *to;  /* [2n] substitution: q and q' of coordinates that stay at 0 (of) become 0 (to) */
} set;

static qdot_expr
insert_zeros(const set *z, qdot_expr e)
{
    return qdot_subs(z->plan->pool, e, z->n_zeros, z->of, z->to);
}

static bool
coordinate_stays(const set *z, size_t i)
{
    const size_t n = z->plan->n;

    for (size_t j = 0; j < n; j++)
        if (!z->still[j] && insert_zeros(z, z->plan->M[i * n + j]) != QDOT_ZERO)
            return false;
    return insert_zeros(z, z->plan->f[i]) == QDOT_ZERO;
}

/* Whether M does not depend on other coordinates as long as those of the set are 0. */
static bool
has_constant_masses(const set *z)
{
    for (size_t k = 0; k < z->plan->n * z->plan->n; k++) {
        const qdot_expr e = insert_zeros(z, z->plan->M[k]);

        if (e == QDOT_NIL || (qdot_expr_node(z->plan->pool, e)->holds & QDOT_HAS_COORD))
            return false;
    }
    return true;
}

/* Remove coordinates whose equations are violated at 0, until the equations of all those left hold. */
static qdot_status
remove_moving_coordinates(set *z)
{
    const qdot_plan *p = z->plan;
    bool dropped = true;

    while (dropped) {
        dropped = false;
        z->n_zeros = 0;
        for (size_t k = 0; k < 2 * p->n; k++)
            if (z->still[k % p->n]) {
                z->to[z->n_zeros] = QDOT_ZERO;
                z->of[z->n_zeros++] = p->inputs[k];
            }
        for (size_t i = 0; i < p->n; i++)
            if (z->still[i] && !coordinate_stays(z, i)) {
                z->still[i] = false;
                dropped = true;
            }
    }
    if (!has_constant_masses(z))
        memset(z->still, 0, p->n * sizeof *z->still);
    return qdot_grave(qdot_pool_check(p->pool)); /* ignore this failure: the expression may be undefined at 0 */
}

/* Find the coordinates that are 0 at the start, with velocity and acceleration 0. */
static bool
find_coordinates_at_rest(set *z, const qdot_ode_system *system, double t0, const double *y, const double *low,
                         double *rate)
{
    const size_t n = z->plan->n;
    bool any = false, known = false;

    for (size_t i = 0; i < n - z->plan->n_states; i++) {
        const size_t v = n + i;

        if (y[i] != 0 || y[v] != 0 || low[i] != 0 || low[v] != 0)
            continue;
        if (!known && system->rhs(t0, y, rate, system->user) != QDOT_OK)
            return false;
        known = true;
        z->still[i] = rate[v] == 0;
        any = any || z->still[i];
    }
    return any;
}

qdot_status
qdot_still_find(const qdot_plan *plan, const qdot_ode_system *system, double t0,
                 const double *y, const double *low, double *units)
{
    const size_t n = plan->n;
    set z = {.plan = plan};
    double *rate;
    qdot_status status;

    for (size_t i = 0; i < 2 * n; i++)
        units[i] = i % n < n - plan->n_states ? qdot_ode_scale(system->scales, i) : 0;
    if (!plan->M || !plan->f || plan->constraints || plan->massless)
        return QDOT_OK;
    z.still = qdot_calloc(n, sizeof *z.still);
    z.of = qdot_malloc(4 * n * sizeof *z.of);
    rate = qdot_malloc(2 * n * sizeof *rate);
    status = z.still && z.of && rate ? QDOT_OK : QDOT_ENOMEM;
    z.to = z.of + 2 * n;
    if (status == QDOT_OK && find_coordinates_at_rest(&z, system, t0, y, low, rate))
        status = remove_moving_coordinates(&z);
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        if (z.still[i % n])
            units[i] = 0;
    qdot_free(z.still);
    qdot_free(z.of);
    qdot_free(rate);
    return status;
}
