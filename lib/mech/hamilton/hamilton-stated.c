/* hamilton-stated.c -- a scene that states H(q, p, t): the Lagrangian that follows, and Hamilton's equations. */
#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/legendre.h"

qdot_status
qdot_hamilton_lagrangian(qdot_scene *s, qdot_expr *L)
{
    uint32_t n;
    qdot_expr *moving = qdot_hamilton_moving(s, &n);

    if (moving == NULL)
        return QDOT_ENOMEM;
    *L = qdot_legendre_of(s, QDOT_MOMENTUM, s->hamiltonian, n, moving);
    qdot_free(moving);
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_hamilton_need_lagrangian(qdot_scene *s)
{
    qdot_expr L;
    qdot_text why = {0};
    qdot_status status;

    if (s->hamiltonian == QDOT_NIL || s->lagrangian != QDOT_NIL)
        return QDOT_OK;
    status = qdot_hamilton_lagrangian(s, &L);
    if (status != QDOT_ESINGULAR && status != QDOT_EDOMAIN)
        return status;
    qdot_text_add(&why, qdot_last_error()->message);
    status = qdot_text_status(&why);
    if (status == QDOT_OK) {
        status = qdot_fail(QDOT_EINVAL, "this scene has no Lagrangian: %s", qdot_text_str(&why));
        qdot_hint("`eom`, `hamiltonian`, `energy`, poisson(f, g) are known, and runs go by Hamilton's equations");
    }
    qdot_text_clear(&why);
    return status;
}

/* q' = dH/dp and p' = -dH/dq + Q + R of coordinate i; velocities in Q and the reactions R are written in momenta.
 * Of a state its own equation. Returns how many they are. */
static uint32_t
equations_of_coordinate(qdot_scene *s, size_t i, qdot_expr pair[2])
{
    qdot_pool *pool = s->pool;
    const qdot_expr q = s->coordinates.at[i], p = qdot_symbol_of(pool, QDOT_MOMENTUM, q);
    const qdot_state *state = qdot_scene_state_of(s, q);
    qdot_expr rate;

    if (state) {
        pair[0] = qdot_rel(pool, QDOT_EQ, qdot_symbol_jet(pool, q, 1), qdot_mech_tidy(s, qdot_hamilton_in_momenta(s, state->rate)));
        return 1;
    }
    rate = qdot_add(pool, qdot_mech_force(s, q), qdot_constraint_reaction(s, i));
    rate = qdot_hamilton_in_momenta(s, rate);
    rate = qdot_sub(pool, rate, qdot_diff(pool, s->hamiltonian, q));
    pair[0] = qdot_rel(pool, QDOT_EQ, qdot_symbol_jet(pool, q, 1),
                       qdot_mech_tidy(s, qdot_diff(pool, s->hamiltonian, p)));
    pair[1] = qdot_rel(pool, QDOT_EQ, qdot_symbol_jet(pool, p, 1), qdot_mech_tidy(s, rate));
    return 2;
}

qdot_expr
qdot_hamilton_equation(qdot_scene *s, qdot_expr q)
{
    qdot_expr pair[2];
    size_t i;
    uint32_t n;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    n = equations_of_coordinate(s, i, pair);
    return n == 1 ? pair[0] : qdot_list(s->pool, n, pair);
}

qdot_expr
qdot_hamilton_equations(qdot_scene *s)
{
    const size_t n = s->coordinates.n;
    qdot_expr *all = qdot_calloc(2 * n + 1, sizeof *all), list;
    uint32_t made = 0;

    if (all == NULL)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < n; i++)
        made += equations_of_coordinate(s, i, all + made);
    list = qdot_list(s->pool, made, all);
    qdot_free(all);
    return list;
}
