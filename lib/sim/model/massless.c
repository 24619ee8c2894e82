/* massless.c -- finds coordinates without mass, and which variables their equations determine. */
#include "sim/model/massless.h"

#include "base/memory.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "sim/model/substitute.h"

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
is_constrained(const qdot_scene *scene, const qdot_plan *p, size_t i)
{
    for (size_t k = 0; k < scene->constraints.n; k++)
        for (size_t order = 0; order < 3; order++)
            if (qdot_expr_contains(p->pool, scene->constraints.at[k].f,
                                   p->inputs[order * p->n + (order == 2) + i]))
                return true;
    return false;
}

bool
qdot_massless_is(const qdot_scene *scene, const qdot_plan *p, size_t i)
{
    return !has_mass(p, i) && !is_constrained(scene, p, i);
}

/* Count how many of the n symbols from input `first` on occur in f_i: those of massless coordinates, or all. */
static size_t
count_symbols_in_force(const qdot_plan *p, size_t i, size_t first, bool massless)
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
    return count_symbols_in_force(p, i, p->n, true) > 0 ? QDOT_VELOCITY : QDOT_HOLONOMIC;
}

/* Fail if the equation f_i determines no massless coordinate. */
static qdot_status
check_massless_equation(const qdot_plan *p, size_t i)
{
    const bool velocities = count_symbols_in_force(p, i, p->n, false) > 0;

    if (count_symbols_in_force(p, i, p->n, true) > 0 || (!velocities && count_symbols_in_force(p, i, 0, true) > 0))
        return QDOT_OK;
    (void)qdot_fail(QDOT_ESINGULAR,
                    "the mass matrix is singular: no mass moves with %s%s", p->names[i],
                    velocities
                        ? ", and its equation contains only velocities of other coordinates"
                        : "");
    return qdot_hint("a mass, damping or a potential that determines %s", p->names[i]);
}

qdot_status
qdot_massless_find(const qdot_scene *scene, qdot_plan *p)
{
    const size_t n = p->n - p->n_states;

    for (size_t i = 0; i < n; i++) {
        if (!qdot_massless_is(scene, p, i))
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
            QDOT_TRY(check_massless_equation(p, i));
    return QDOT_OK;
}

bool
qdot_massless_switch(const qdot_plan *p, const qdot_switches *s)
{
    for (size_t i = 0; i < p->n && p->massless; i++)
        for (size_t k = 0; k < qdot_switches_own(s) && p->massless[i]; k++)
            if (qdot_expr_contains(p->pool, s->surfaces.at[k].u, p->inputs[p->n + i])
                || (qdot_massless_kind(p, i) == QDOT_HOLONOMIC
                    && qdot_expr_contains(p->pool, s->surfaces.at[k].u, p->inputs[i])))
                return true;
    return false;
}

/* Whether e, with parameter values, contains the given time derivative of any massless coordinate. */
static bool
contains_massless(qdot_scene *scene, qdot_expr e, const bool *massless, uint32_t order)
{
    for (size_t i = 0; i < scene->coordinates.n; i++)
        if (massless[i]
            && qdot_expr_contains(scene->pool, e, qdot_symbol_jet(scene->pool, scene->coordinates.at[i], order)))
            return true;
    return false;
}

static bool
constraints_contain(const qdot_scene *scene, size_t i)
{
    for (size_t c = 0; c < scene->constraints.n; c++)
        for (uint32_t order = 0; order < 3; order++)
            if (qdot_expr_contains(scene->pool, scene->constraints.at[c].f,
                                   qdot_symbol_jet(scene->pool, scene->coordinates.at[i], order)))
                return true;
    return false;
}

qdot_status
qdot_massless_of_scene(qdot_scene *scene, const qdot_run_request *request, qdot_massless *x)
{
    const size_t n = scene->coordinates.n;
    qdot_pool *pool = scene->pool;
    const qdot_expr M = qdot_mech_numeric_mass(scene), f = qdot_mech_numeric_forcing(scene);
    bool *massless = qdot_calloc(n + 1, sizeof *massless);

    *x = (qdot_massless){.equations = qdot_calloc(n + 1, sizeof *x->equations),
                         .of_positions = qdot_calloc(n + 1, sizeof *x->of_positions)};
    if (massless == NULL || x->equations == NULL || x->of_positions == NULL) {
        qdot_free(massless);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        massless[i] = !constraints_contain(scene, i);
        for (size_t j = 0; j < n && massless[i]; j++)
            massless[i] = qdot_substitute(pool, qdot_expr_arg(pool, M, (uint32_t)(i * n + j)), request->n_values,
                                          request->symbols, request->values) == QDOT_ZERO;
    }
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++)
        if (massless[i]) {
            const qdot_expr own = qdot_substitute(pool, qdot_expr_arg(pool, f, (uint32_t)i), request->n_values,
                                                  request->symbols, request->values);

            x->of_positions[x->n] = own != QDOT_NIL && !contains_massless(scene, own, massless, 1);
            x->equations[x->n++] = own;
        }
    qdot_free(massless);
    return qdot_pool_check(pool);
}

size_t
qdot_massless_determines(const qdot_massless *x)
{
    size_t count = 0;

    for (size_t c = 0; c < x->n; c++)
        count += x->of_positions[c] ? 2 : 1;
    return count;
}

void
qdot_massless_clear(qdot_massless *x)
{
    qdot_free(x->equations);
    qdot_free(x->of_positions);
    *x = (qdot_massless){0};
}
