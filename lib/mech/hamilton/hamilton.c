/* hamilton.c -- replaces velocities by momenta: all of them, or those of the cyclic coordinates. */
#include "mech/hamilton/hamilton.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/ostrogradsky.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "mech/hamilton/legendre.h"
#include "mech/hamilton/phase-symbols.h"
#include "normal/simplify/simplify.h"

/* e with q' = dH/dp of a stated H. */
static qdot_expr
put_velocities_of_hamiltonian(qdot_scene *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n;
    qdot_expr *from = qdot_calloc(2 * n + 1, sizeof *from);
    size_t held = 0;

    if (from == NULL)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < n; i++) {
        const qdot_expr q = s->coordinates.at[i];

        if (qdot_phase_space_momentum(s, q) != QDOT_NIL)
            continue;
        from[held] = qdot_symbol_jet(pool, q, 1);
        from[n + held++] = qdot_diff(pool, s->hamiltonian, qdot_symbol_of(pool, QDOT_MOMENTUM, q));
    }
    e = qdot_subs(pool, e, held, from, from + n);
    qdot_free(from);
    return e;
}

qdot_expr *
qdot_hamilton_moving(const qdot_scene *s, uint32_t *n)
{
    qdot_expr *moving = qdot_calloc(s->coordinates.n + 1, sizeof *moving);

    *n = 0;
    if (moving == NULL) {
        qdot_pool_fail(s->pool);
        return NULL;
    }
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (!qdot_scene_state_of(s, s->coordinates.at[i]))
            moving[(*n)++] = s->coordinates.at[i];
    return moving;
}

qdot_expr
qdot_hamilton_in_momenta(qdot_scene *s, qdot_expr e)
{
    qdot_legendre l;
    qdot_expr *moving;
    uint32_t n;

    e = qdot_scene_with_rates(s, e);
    if (s->higher.n > 0) { /* lower derivatives are variables of H too */
        if (qdot_ostrogradsky_is_canonical(s, e))
            return e;
        if (qdot_higher_refuse(s, "momenta in place of velocities") != QDOT_OK)
            qdot_pool_fail(s->pool);
        return QDOT_NIL;
    }
    if (qdot_phase_space_needed(s))
        e = qdot_phase_space_outward(s, e);
    if (e == QDOT_NIL || !(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_VELOCITY))
        return e;
    if (s->hamiltonian != QDOT_NIL)
        return put_velocities_of_hamiltonian(s, e);
    moving = qdot_hamilton_moving(s, &n);
    if (moving == NULL)
        return QDOT_NIL;
    e = qdot_legendre_begin(&l, s, QDOT_COORD, qdot_mech_lagrangian(s), n, moving)
            ? qdot_subs(s->pool, e, l.n, l.x, l.solved)
            : QDOT_NIL;
    qdot_legendre_end(&l);
    qdot_free(moving);
    return e;
}

/* The momentum that goes with coordinate q, in velocities; p is its symbol. */
static qdot_expr
stated_momentum(qdot_scene *s, qdot_expr q, qdot_expr p)
{
    return s->higher.n > 0 ? qdot_ostrogradsky_momentum(s, qdot_expr_symbol(s->pool, p)->base) : qdot_mech_momentum(s, q);
}

qdot_expr
qdot_hamilton_in_velocities(qdot_scene *s, qdot_expr e)
{
    qdot_vec(qdot_expr) from = {0}, to = {0};
    qdot_status status = QDOT_OK;

    if (e == QDOT_NIL || !(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_MOMENTUM))
        return e;
    if (qdot_phase_space_needed(s))
        return qdot_phase_space_inward(s, e);
    for (size_t i = 0; i < s->coordinates.n && status == QDOT_OK; i++) {
        const qdot_expr q = s->coordinates.at[i], p = qdot_ostrogradsky_symbol(s, q);

        for (uint32_t order = 0; order < 2 && status == QDOT_OK; order++) { /* p[q] and p[q]' */
            const qdot_expr symbol = qdot_symbol_jet(s->pool, p, order);

            if (symbol == QDOT_NIL || !qdot_expr_contains(s->pool, e, symbol))
                continue;
            status = qdot_vec_push(&from, symbol);
            if (status == QDOT_OK)
                status = qdot_vec_push(&to, order == 0 ? stated_momentum(s, q, p) : qdot_ddt(s->pool, stated_momentum(s, q, p)));
        }
    }
    e = status == QDOT_OK ? qdot_subs(s->pool, e, from.n, from.at, to.at)
                          : qdot_pool_fail(s->pool);
    qdot_free(from.at);
    qdot_free(to.at);
    return e;
}

/* An argument of Poisson's bracket, with velocities replaced by momenta. */
static qdot_expr
bracket_argument(qdot_scene *s, qdot_expr e)
{
    if (e == QDOT_NIL || (!(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_ACCELERATION) && !qdot_mech_holds_momentum_rate(s, e)))
        return qdot_hamilton_in_momenta(s, e);
    qdot_mech_fail(s, QDOT_ETYPE,
                   "a Poisson bracket is of functions of coordinates, momenta and "
                   "velocities, not of accelerations or rates of momenta");
    return QDOT_NIL;
}

qdot_expr
qdot_hamilton_poisson(qdot_scene *s, qdot_expr f, qdot_expr g)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr sum = QDOT_ZERO;

    if (s->coordinates.n == 0) {
        qdot_mech_fail(s, QDOT_EINVAL, "the scene has no coordinate");
        return QDOT_NIL;
    }
    f = bracket_argument(s, f);
    g = bracket_argument(s, g);
    if (f == QDOT_NIL || g == QDOT_NIL)
        return QDOT_NIL;
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i],
                        p = qdot_symbol_of(pool, QDOT_MOMENTUM, q);

        sum = qdot_add(pool, sum,
                       qdot_sub(pool,
                                qdot_mul(pool, qdot_diff(pool, f, q), qdot_diff(pool, g, p)),
                                qdot_mul(pool, qdot_diff(pool, f, p), qdot_diff(pool, g, q))));
    }
    return qdot_simplify(pool, sum, &facts);
}

/* H = sum_k p_k q^(k) - L of a Lagrangian with second derivatives or higher, the highest, q^(s), solved for from its momentum
 * p_s = dL/dq^(s); the lower ones are variables as q is. */
static qdot_expr
hamiltonian_of_higher(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    const uint32_t n = (uint32_t)(s->coordinates.n - s->higher.n);
    qdot_expr *below = qdot_calloc(n + 1, sizeof *below), H = QDOT_ZERO;
    uint32_t moving = 0;

    if (below == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr q = s->coordinates.at[i];
        const uint32_t order = qdot_higher_order(s, q);

        if (qdot_scene_state_of(s, q))
            continue;
        for (uint32_t k = 1; k < order; k++)
            H = qdot_add(pool, H, qdot_mul(pool, qdot_symbol_of(pool, QDOT_MOMENTUM, qdot_symbol_jet(pool, q, k - 1)),
                                           qdot_symbol_jet(pool, q, k)));
        below[moving++] = qdot_symbol_jet(pool, q, order - 1);
    }
    H = qdot_add(pool, H, qdot_legendre_of(s, QDOT_COORD, qdot_higher_in_jets(s, s->higher_lagrangian), moving, below));
    qdot_free(below);
    return qdot_higher_in_motion(s, H);
}

/* Of the coordinates q [n] move those in whose velocities L is linear behind the others; returns how many others there are. */
static uint32_t
sort_out_linear(qdot_scene *s, qdot_expr L, uint32_t n, qdot_expr *q, bool *linked)
{
    uint32_t curved = 0;

    *linked = false;
    for (uint32_t i = 0; i < n && L != QDOT_NIL; i++) {
        const qdot_expr slope = qdot_diff(s->pool, L, qdot_symbol_jet(s->pool, q[i], 1)), own = q[i];

        if (slope != QDOT_NIL && !(qdot_expr_node(s->pool, slope)->holds & QDOT_HAS_VELOCITY)) {
            *linked |= slope != QDOT_ZERO;
            continue;
        }
        q[i] = q[curved];
        q[curved++] = own;
    }
    return curved;
}

qdot_expr
qdot_hamilton_linear(qdot_scene *s)
{
    qdot_expr list = QDOT_NIL, *moving;
    uint32_t n, curved;
    bool linked;

    if (s->hamiltonian != QDOT_NIL || s->higher.n > 0)
        return QDOT_NIL;
    moving = qdot_hamilton_moving(s, &n);
    if (moving == NULL)
        return QDOT_NIL;
    curved = sort_out_linear(s, qdot_mech_lagrangian(s), n, moving, &linked);
    if (linked)
        list = qdot_list(s->pool, n - curved, moving + curved);
    qdot_free(moving);
    return list;
}

/* H of a Lagrangian that is linear in the velocities of some coordinates: their terms cancel in sum p q' - L. */
static qdot_expr
transform_lagrangian(qdot_scene *s, uint32_t n, qdot_expr *moving)
{
    qdot_expr L = qdot_mech_lagrangian(s);
    bool linked;
    const uint32_t curved = sort_out_linear(s, L, n, moving, &linked);

    if (!linked)
        return qdot_legendre_of(s, QDOT_COORD, L, n, moving);
    for (uint32_t i = curved; i < n; i++)
        L = qdot_subs(s->pool, L, 1, (qdot_expr[]){qdot_symbol_jet(s->pool, moving[i], 1)}, (qdot_expr[]){QDOT_ZERO});
    return qdot_legendre_of(s, QDOT_COORD, L, curved, moving);
}

qdot_expr
qdot_hamilton_hamiltonian(qdot_scene *s)
{
    qdot_expr *moving, H;
    uint32_t n;

    if (s->hamiltonian != QDOT_NIL)
        return s->hamiltonian;
    if (s->higher.n > 0)
        return hamiltonian_of_higher(s);
    moving = qdot_hamilton_moving(s, &n);
    if (moving == NULL)
        return QDOT_NIL;
    H = transform_lagrangian(s, n, moving);
    qdot_free(moving);
    return H;
}

/* The Routhian R for the coordinates q [n], in the shorter of two forms. */
static qdot_expr
routhian(qdot_scene *s, uint32_t n, const qdot_expr *q)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr result = qdot_legendre_of(s, QDOT_COORD, qdot_mech_lagrangian(s), n, q), shorter;

    if (result == QDOT_NIL)
        return QDOT_NIL;
    result = qdot_neg(s->pool, result);
    shorter = qdot_simplify(s->pool, result, &facts);
    return qdot_expr_size(s->pool, shorter) < qdot_expr_size(s->pool, result) ? shorter
                                                                              : result;
}

qdot_expr
qdot_hamilton_routhian(qdot_scene *s, uint32_t n, const qdot_expr *q)
{
    qdot_cyclic *list;
    size_t found;
    qdot_expr *cyclic, result = QDOT_NIL;

    if (n > 0)
        return routhian(s, n, q);
    if (qdot_mech_cyclic(s, &list, &found) != QDOT_OK)
        return qdot_pool_fail(s->pool);
    cyclic = qdot_calloc(found + 1, sizeof *cyclic);
    if (cyclic == NULL)
        qdot_pool_fail(s->pool);
    for (size_t i = 0; cyclic != NULL && i < found; i++)
        cyclic[i] = list[i].coordinate;
    if (cyclic != NULL)
        result = found == 0 ? qdot_mech_lagrangian(s) : routhian(s, (uint32_t)found, cyclic);
    qdot_free(cyclic);
    qdot_free(list);
    return result;
}
