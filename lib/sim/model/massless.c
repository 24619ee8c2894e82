/* massless.c -- which coordinates have no mass, and what their equations hold. */
#include "sim/model/massless.h"

#include "base/memory.h"
#include "expr/walk.h"

static bool
has_mass(const qdot_plan *p, size_t i)
{
    for (size_t j = 0; j < p->n; j++)
        if (p->M[i * p->n + j] != QDOT_ZERO)
            return true;
    return false;
}

/* Whether a constraint of the scene acts on coordinate i. */
static bool
is_held(const qdot_scene *scene, const qdot_plan *p, size_t i)
{
    for (size_t k = 0; k < scene->constraints.n; k++)
        for (size_t order = 0; order < 3; order++)
            if (qdot_expr_contains(p->pool, scene->constraints.at[k].f,
                                   p->inputs[order * p->n + (order == 2) + i]))
                return true;
    return false;
}

/* How many of the symbols from `first` on f_i holds, of massless coordinates alone or of all. */
static size_t
held(const qdot_plan *p, size_t i, size_t first, bool massless)
{
    size_t count = 0;

    for (size_t j = 0; j < p->n - p->n_states; j++)
        count += (!massless || p->massless[j]) &&
                 qdot_expr_contains(p->pool, p->f[i], p->inputs[first + j]);
    return count;
}

qdot_constraint_kind
qdot_massless_kind(const qdot_plan *p, size_t i)
{
    return held(p, i, p->n, true) > 0 ? QDOT_VELOCITY : QDOT_HOLONOMIC;
}

/* Fail if f_i determines nothing of the massless coordinates. */
static qdot_status
check(const qdot_plan *p, size_t i)
{
    const bool velocities = held(p, i, p->n, false) > 0;

    if (held(p, i, p->n, true) > 0 || (!velocities && held(p, i, 0, true) > 0))
        return QDOT_OK;
    (void)qdot_fail(QDOT_ESINGULAR,
                    "the mass matrix is singular: no mass moves with %s%s", p->names[i],
                    velocities
                        ? ", and its equation holds velocities of other coordinates alone"
                        : "");
    return qdot_hint("a mass, damping or a potential that determines %s", p->names[i]);
}

qdot_status
qdot_massless_find(const qdot_scene *scene, qdot_plan *p)
{
    const size_t n = p->n - p->n_states;

    for (size_t i = 0; i < n; i++) {
        if (has_mass(p, i) || is_held(scene, p, i))
            continue;
        if (!p->massless)
            p->massless = qdot_calloc(p->n, sizeof *p->massless);
        if (!p->massless)
            return QDOT_ENOMEM;
        p->massless[i] = true;
        p->n_massless++;
    }
    for (size_t i = 0; i < n && p->n_massless > 0; i++)
        if (p->massless[i])
            QDOT_TRY(check(p, i));
    return QDOT_OK;
}
